"""An option that `create` does not have, or a value that it does not read.

`create` of ros_gz_sim ignores an option that it does not know, and its value: after `-entity`, the
robot has the name that its description states. `-entity`, `-robot_namespace` and the like are
options of Gazebo Classic's spawners; `"-x 0"` in one text is none, it has to be `"-x", "0"`.
`-allow_renaming` is a switch, which a `false` behind it does not turn off: the value of a switch
stands behind `=`.

Fix: write `-name` for `-entity`; give a namespace to the node, and leave the others out. Leave out
`-allow_renaming` with its `false`.
Source: ros_gz_sim, `create.cpp` calls `AllowCommandLineReparsing` of gflags, after which an unknown
flag is no error; tried with gflags 2.2.2.
"""

import re
from collections.abc import Mapping
from itertools import pairwise, takewhile

from checker.launch.ros2.graph import Ros2Launch
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located

_OPTION = re.compile(r"--?[A-Za-z]")
_HINTS: Mapping[str, str] = {
    "entity": "write -name",
    "entity_name": "write -name",
    "model": "write -name",
    "model_name": "write -name",
    "robot_name": "write -name",
    "roll": "write -R",
    "pitch": "write -P",
    "yaw": "write -Y",
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
"""Options of spawn_entity.py and spawn_model, and arguments of launch files that spawn."""
_SWITCHES = ("-allow_renaming", "--allow_renaming")
_FALSE = ("false", "f", "no", "n", "0")
"""What gflags reads as false, without case."""


@rule("LCH009", "unknown-create-option", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report options that `create` does not have."""
    for graph in launch.entries:
        for node in graph.nodes:
            if node.program != ("ros_gz_sim", "create"):
                continue
            words = [*takewhile(lambda it: it.value != "--ros-args", node.arguments)]
            yield from filter(None, map(_unknown, words))
            for switch, value in pairwise(words):
                if switch.value in _SWITCHES and value.value.lower() in _FALSE:
                    yield _unread_value(switch, value)


def _unknown(word: Located[str]) -> Finding | None:
    name = word.value.lstrip("-").partition("=")[0]
    option, blank, value = word.value.partition(" ")
    hint = f"write {option!r}, {value!r}" if blank else _HINTS.get(name, "")
    if not (_OPTION.match(word.value) and hint):
        return None
    message = f"create ignores {word.value!r}, an option that it does not have: {hint}"
    return finding(word, message, key=name)


def _unread_value(switch: Located[str], value: Located[str]) -> Finding:
    return finding(
        value,
        f"create does not read {value.value!r}, and {switch.value} alone allows another name: "
        f"leave both out, or write {f'{switch.value}={value.value}'!r}",
        severity=Severity.INFO,
        key=switch.value,
    )


_CREATE = """        Node(package='ros_gz_sim', executable='create',
             arguments=['-topic', 'robot_description', '-name', 'arm', '-z', '-0.5']),"""

_RENAMING = _CREATE.replace("'-z', '-0.5'", "'-allow_renaming', 'true'")

GOOD = [
    {"@ros2": _CREATE},
    {"@ros2": _RENAMING},
    {"@ros2": _RENAMING.replace("', 'true'", "=false'")},
]
BAD = [
    {"@ros2": _CREATE.replace("'-name'", "'-entity_name'").replace("]),", "]),  # ^ LCH009")},
    {"@ros2": _RENAMING.replace("true", "false").replace("]),", "]),  # ^ LCH009")},
    {"@ros2": _CREATE.replace("'-name'", "'-entity'").replace("]),", "]),  # ^ LCH009")},
    {"@ros2": _CREATE.replace("'-z', '-0.5'", "'-z -0.5'").replace("]),", "]),  # ^ LCH009")},
]
