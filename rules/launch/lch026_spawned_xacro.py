"""A spawner gives Gazebo a xacro file that nothing expands.

`spawn_entity.py` of gazebo_ros and `create` of ros_gz_sim pass the file behind `-file` to Gazebo as
it is: neither runs xacro. Gazebo refuses numbers such as `${wheel_radius}`, and finds no link in
`<xacro:include>`: the robot does not appear, or without parts of it. A file that names itself xacro
and has nothing to expand is not reported, nor is a text in which the launch file replaces parts
before it is spawned.

Fix: run xacro in the launch file, publish the result as `robot_description`, and spawn with
`-topic robot_description`; or expand the file before, `xacro arm.urdf.xacro -o arm.urdf`.
Source: gazebo_ros, `spawn_entity.py`; ros_gz_sim, `create.cpp`: the text of the file is what they
send to Gazebo.
"""

import re
from collections.abc import Iterator
from itertools import pairwise

from checker.formats.xacro.files import local_path
from checker.launch.ros2.descriptions import loaded_descriptions
from checker.launch.ros2.graph import LaunchGraph, Ros2Launch
from checker.package.package import Package
from checker.package.uris import own_path_on_machine
from checker.ros.spawned import EVERY_SPAWN
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Span
from checker.source.xml import XmlDocument

_EXPRESSION = re.compile(r"(?<!\$)\$(?:\{[^{}]{1,200}\}|\((?:arg|find|eval)\s[^()]{1,200}\))")
_TAGS = frozenset(f"xacro:{tag}" for tag in ("include", "macro", "if", "unless", "insert_block"))
"""Elements of xacro whose content, or what they include, is missing where it does not run."""


@rule("LCH026", "spawned-xacro", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report files that spawners read as they are, and that only xacro can read."""
    for graph in launch.entries:
        for span, file in _spawned_files(package, graph):
            unexpanded = _unexpanded(package, file)
            if unexpanded and not span.source.file.startswith("../"):
                yield finding(
                    span,
                    f"Gazebo gets {file} as it is, with {unexpanded}: run xacro into "
                    "robot_description, and spawn with -topic robot_description",
                    key=file,
                )


def _spawned_files(package: Package, graph: LaunchGraph) -> Iterator[tuple[Span, str]]:
    """Yield the files that spawners read as they are: the place, and the path in the package."""
    for loaded in loaded_descriptions(package, graph):
        program = (loaded.node.package.value, loaded.node.executable.value)
        path = local_path(package, loaded.load.path)
        as_it_is = not loaded.load.by_xacro and not loaded.replacing
        if program in EVERY_SPAWN and as_it_is and path:
            yield loaded.span, path
    for node in graph.nodes_and_spawns:
        if node.program in EVERY_SPAWN:
            for option, word in pairwise(node.arguments):
                path = _on_machine(package, word.value) if option.value == "-file" else ""
                if path:
                    yield word.span, path


def _on_machine(package: Package, path: str) -> str:
    """Return the file of a package that a path on its author's machine means; else empty."""
    if not path.startswith("/"):
        return ""
    if own := own_path_on_machine(package, path):
        return own
    folders = path.split("/")
    for place, folder in enumerate(folders):
        holder, inside = package.named(folder) if folder else None, "/".join(folders[place + 1 :])
        if holder is not None and inside and holder.exists(inside):
            return inside if holder is package else f"../{holder.name}/{inside}"
    return ""


def _unexpanded(package: Package, path: str) -> str:
    """Return the first that only xacro understands in a file; empty if it has nothing of that."""
    document = package.xml(path)
    if not isinstance(document, XmlDocument):
        return ""
    for element in (document.root, *document.root.descendants()):
        if element.tag in _TAGS:
            return f"<{element.tag}>"
        for text in (*element.attributes.values(), element.raw_text):
            if found := _EXPRESSION.search(text):
                return found.group()
    return ""


_SPAWN = """        Node(package='@', executable='%', arguments=[
            '-name', 'arm', '-file', in_package('urdf', 'arm.urdf.xacro')]),"""
_SIM = _SPAWN.replace("@", "ros_gz_sim").replace("%", "create")
_CLASSIC = _SPAWN.replace("@", "gazebo_ros").replace("%", "spawn_entity.py")
_AT_HOME = _SIM.replace(
    "in_package('urdf', 'arm.urdf.xacro')", "'/home/ann/ws/src/acme_arm_bringup/urdf/arm.xacro'"
)
_ELSEWHERE = _AT_HOME.replace("acme_arm_bringup", "acme_hand")
_STRING = """        Node(package='ros_gz_sim', executable='create', arguments=['-string', open(@
            get_package_share_directory('acme_arm_bringup') + '/urdf/arm.urdf.xacro').read()]),"""
_MARK = "  # ^ LCH026"
_XACRO = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="radius" value="0.1"/>
  <link name="base_link">
    <visual><geometry><sphere radius="@"/></geometry></visual>
  </link>
</robot>
"""
_OPEN = _XACRO.replace("@", "${radius}")
_EXPANDED = _XACRO.replace("@", "0.1")
_HAND = {"../acme_hand/package.xml": "<package><name>acme_hand</name></package>"}
GOOD = [
    {"@ros2": _SIM, "urdf/arm.urdf.xacro": _EXPANDED},
    {"@ros2": _SIM.replace("create", "other"), "urdf/arm.urdf.xacro": _OPEN},
    {"@ros2": _AT_HOME},
    {
        "@ros2": _STRING.replace("@", "").replace("read()", "read().replace('${radius}', '0.1')"),
        "urdf/arm.urdf.xacro": _OPEN,
    },
]
BAD = [
    {"@ros2": f"{_SIM}{_MARK}", "urdf/arm.urdf.xacro": _OPEN},
    {"@ros2": _STRING.replace("@", _MARK), "urdf/arm.urdf.xacro": _OPEN},
    {"@ros2": f"{_CLASSIC}{_MARK}", "urdf/arm.urdf.xacro": _OPEN},
    {"@ros2": f"{_AT_HOME}{_MARK}", "urdf/arm.xacro": _OPEN},
    {"@ros2": f"{_ELSEWHERE}{_MARK}", **_HAND, "../acme_hand/urdf/arm.xacro": _OPEN},
]
