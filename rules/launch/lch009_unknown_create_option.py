"""An option of another spawner among the arguments of `create`.

`create` of ros_gz_sim ignores an option that it does not know, and its value: after `-entity`, the
robot has the name that its description states. `-entity`, `-robot_namespace` and the like are
options of Gazebo Classic's spawners; `"-x 0"` in one text is none, it has to be `"-x", "0"`.

Fix: write `-name` for `-entity`; give a namespace to the node, and leave the others out.
Source: ros_gz_sim, `create.cpp` calls `AllowCommandLineReparsing` of gflags, after which an unknown
flag is no error; tried with gflags 2.2.2.
"""

import re
from collections.abc import Mapping

from checker.launch.ros2.graph import Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule

_OPTION = re.compile(r"--?[A-Za-z]")
_HINTS: Mapping[str, str] = {
    "entity": "write -name",
    "model": "write -name",
    "robot_namespace": "give a namespace to the nodes",
    "reference_frame": "leave it out",
    "gazebo_namespace": "leave it out",
    "spawn_service_timeout": "leave it out",
    "package_to_model": "leave it out",
    "unpause": "leave it out",
    "database": "write -file with the model's URI",
    "urdf": "leave it out: the format is recognized",
    "sdf": "leave it out: the format is recognized",
}
"""Options of spawn_entity.py and spawn_model."""


@rule("LCH009", "unknown-create-option", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report options that `create` does not have."""
    for graph in launch.entries:
        for node in graph.nodes:
            if (node.package.value, node.executable.value) != ("ros_gz_sim", "create"):
                continue
            for word in node.arguments:
                if word.value == "--ros-args":
                    break
                name = word.value.lstrip("-").partition("=")[0]
                option, blank, value = word.value.partition(" ")
                hint = f"write {option!r}, {value!r}" if blank else _HINTS.get(name, "")
                if _OPTION.match(word.value) and hint:
                    yield finding(
                        word,
                        f"create ignores {word.value!r}, an option that it does not have: {hint}",
                        key=name,
                    )


_CREATE = """        Node(package='ros_gz_sim', executable='create',
             arguments=['-topic', 'robot_description', '-name', 'arm', '-z', '-0.5']),"""

GOOD = [{"@ros2": _CREATE}]
BAD = [
    {"@ros2": _CREATE.replace("'-name'", "'-entity'").replace("]),", "]),  # ^ LCH009")},
    {"@ros2": _CREATE.replace("'-z', '-0.5'", "'-z -0.5'").replace("]),", "]),  # ^ LCH009")},
]
