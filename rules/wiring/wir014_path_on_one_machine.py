"""A parameter of a node, or a file in a launch file, is a path on the machine of its author.

On every other machine the node does not find the file: the map server has no map, the navigator no
behaviour tree. A path in a home, such as `/home/me/maps/hall.yaml`, on a drive of Windows, or in
the folders of a workspace, such as `~/ros2_ws/src`, is reported in a parameter file, if it is that
of a file. The name of a
parameter such as `output_file` says that the node writes it. Where a launch file names the
parameter, it may replace the value: this is an info. Below the `WORKDIR` of a Dockerfile, the path
works in its container alone. The placeholder of a template, `/path/to/your/arm.urdf`, is on no
machine. In launch files of ROS 1 and ROS 2, defaults of arguments, parameters and the files that a
command line gives a node to read are judged, and those in commands of ROS 2; also the
files that a launch file opens, or gives to xacro, for a parameter: the launch stops without them,
which is an error, unless an argument replaces the path.
So are the folders that it puts on a search path of the environment: Gazebo finds no models there.

Fix: install the file with the package, and give its path in the launch file; or write
`$(find-pkg-share PACKAGE)/maps/hall.yaml`, and load the file with `allow_substs=True`. In ROS 1
write `$(find PACKAGE)/maps/hall.yaml` in the launch file.
Source: ROS 2, launch_ros `ParameterFile`; ros-navigation/navigation2@b978cff5.
"""

import re
from collections.abc import Iterator, Sequence

from checker.finding import Place
from checker.launch.ros1.package_launch import LaunchEntries
from checker.launch.ros2.graph import LaunchGraph, Parameter, ParameterFile, Ros2Launch
from checker.launch.ros2.named_paths import is_written
from checker.launch.ros2.package_launch import is_ros2_only
from checker.package.containers import container_with
from checker.package.package import Package
from checker.package.uris import (
    is_below_home,
    is_on_one_machine,
    is_placeholder,
    own_path_on_machine,
)
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located, Span

_FILE = re.compile(r"[^/\\]\.[A-Za-z]\w{1,9}\Z")
_WITHOUT_SUFFIX = frozenset({"map_file_name"})
"""Parameters of files to which the node adds the suffix, as slam_toolbox does."""
_FOLDER = re.compile(r"""["'](/(?:home|Users)/[^"'\n]{1,300})["']""")
_READ = re.compile(r"\.(?:rviz|ya?ml|urdf|xacro|sdf|sh|world|lua)\Z")
"""Ends of files that a node reads where its command line names one."""
_ARGUMENT, _OF_COMMAND = "argument {}", "the command line of {}"
_HOME = "$(env HOME)"
_OPENING = ("$(file-content ", "$(command ")
_READ_AT_ONCE = ("textfile", "load")
"""Kinds of parameters of ROS 1 whose files roslaunch reads itself."""
_BY_LAUNCH = {"yaml_filename": "map"}
"""Arguments of Nav2's own launch files that replace parameters of another name."""


@rule("WIR014", "path-on-one-machine", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, launch: Ros2Launch | None, entries: LaunchEntries) -> Findings:
    """Report the files of one machine that parameter files and launch files name."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        for block in blocks_in(package, file.path, "ros__parameters"):
            for name, parameter in block.parameters.items():
                for text in () if is_written(name) else parameter.texts:
                    if _is_wrong(text, name):
                        yield _in_parameters(package, f"{name} of {block.node}", name, text)
    named = [*_in_ros_2(launch)] if launch is not None else []
    if not is_ros2_only(package):
        named += _in_ros_1(entries)
    wrong = [(label, text) for label, text in named if _is_wrong(text)]
    wrong += _in_environment(launch) if launch is not None else ()
    wrong = [it for it in wrong if not it[1].span.source.file.startswith("../")]
    parts = ((label, text, _written_part(text)) for label, text in wrong)
    own = {part.span.place(): (label, text, part) for label, text, part in parts if part}
    stops = _stopping(launch.entries if launch is not None else (), entries)
    for label, text, part in own.values():
        yield _in_launch_file(package, label, text, part.span, stops=text.span.place() in stops)


def _is_wrong(text: Located[str], parameter: str = "") -> bool:
    """Return whether a text is the path of a file that is on one machine, or on none."""
    path = text.value
    is_file = parameter in _WITHOUT_SUFFIX or bool(_FILE.search(path))
    return is_file and (is_on_one_machine(path) or is_placeholder(path))


def _written_part(text: Located[str]) -> Located[str] | None:
    """Return the text itself, or the path or folder on the machine that it is made of."""
    if text.value in text.span.text:
        return text
    source = text.span.source
    if is_below_home(text.value):
        inside = text.value.partition("/")[2]
        start = source.text.find(inside)
        return text if start < 0 else Located(inside, Span(source, start, start + len(inside)))
    for found in _FOLDER.finditer(source.text):
        if text.value == found[1] or text.value.startswith(f"{found[1].rstrip('/')}/"):
            return Located(found[1], Span(source, *found.span(1)))
    return None


def _in_ros_2(launch: Ros2Launch) -> Iterator[tuple[str, Located[str]]]:
    """Yield the texts that may be the path of a file, each with what it is."""
    for graph in launch.entries:
        for argument in graph.arguments:
            if argument.default is not None and not is_written(argument.name):
                yield _ARGUMENT.format(argument.name), argument.default
        yield from _commanded(graph)
        for node in graph.nodes:
            for it in node.parameters:
                if isinstance(it, ParameterFile):
                    yield "the parameter file", Located(it.path, it.span)
                elif isinstance(it.value, str) and not is_written(it.name):
                    yield f"parameter {it.name}", Located(it.value, it.span)
                    yield from _opened(it.name, it.value, it.span)


def _in_environment(launch: Ros2Launch) -> Iterator[tuple[str, Located[str]]]:
    """Yield the folders on one machine that variables of the environment name."""
    for graph in launch.entries:
        for change in graph.environment:
            for part in change.value.value.split(":"):
                if is_on_one_machine(part):
                    yield f"a folder of {change.name}", Located(part, change.value.span)


def _opened(name: str, value: str, span: Span) -> Iterator[tuple[str, Located[str]]]:
    """Yield the files that the launch file opens, or has a command read, for a parameter."""
    if value.startswith(_OPENING):
        for word in value.replace(_HOME, "~").partition(" ")[2].rstrip(")").split():
            yield f"the file of parameter {name}", Located(word.strip("'\""), span)


def _stopping(ros_2: Sequence[LaunchGraph], ros_1: LaunchEntries) -> set[Place]:
    """Return the places of files without which the launch stops, unless an argument is given."""
    arguments = (it.default for graph in ros_2 for it in graph.arguments)
    defaults = [it.value for it in arguments if it is not None and "/" in it.value]
    own = {
        it.span.place()
        for graph in ros_2
        for node in graph.nodes
        if node.starts
        for it in node.parameters
        if isinstance(it, Parameter)
        if isinstance(it.value, str) and it.value.startswith(_OPENING)
        if not any(default in it.value for default in defaults)
    }
    return own | {it.span.place() for it in ros_1.graph.params if it.kind in _READ_AT_ONCE}


def _commanded(graph: LaunchGraph) -> Iterator[tuple[str, Located[str]]]:
    """Yield the files that commands and nodes are given to read."""
    for process in graph.processes:
        for word in filter(_is_read, (it for words in process.commands for it in words)):
            yield "a word of a command", word
    for node in graph.nodes:
        for word in filter(_is_read, node.arguments):
            yield _OF_COMMAND.format(node.executable.value), word


def _in_ros_1(launch: LaunchEntries) -> Iterator[tuple[str, Located[str]]]:
    graph = launch.graph
    for entry in launch.entries:
        for name, value in entry.graph.arguments.items():
            if not is_written(name):
                yield _ARGUMENT.format(name), value
    for param in graph.params:
        name = param.name.rpartition("/")[2]
        if param.kind != "command" and not is_written(name):
            yield (
                f"parameter {name}" if name else "the parameter file",
                Located(param.value, param.span),
            )
    for node in graph.nodes:
        for word in filter(_is_read, node.words):
            yield _OF_COMMAND.format(node.name), word


def _is_read(word: Located[str]) -> bool:
    return _READ.search(word.value) is not None


def _in_launch_file(
    package: Package, label: str, text: Located[str], place: Span, *, stops: bool
) -> Finding:
    own, name = own_path_on_machine(package, text.value), package.declared_name
    if not package.exists("package.xml"):  # nothing finds a loose folder by its name
        own = ""
    if text.span.source.file.endswith(".py"):
        here = f"os.path.join(get_package_share_directory({name!r}), {own!r})"
    else:
        here = f"$({'find-pkg-share' if is_ros2_only(package) else 'find'} {name})/{own}"
    cure = f"write {here}" if own else ""
    fails = stops and not (is_below_home(text.value) or container_with(package, text.value))
    severity = Severity.ERROR if fails else None
    return _finding(package, label, Located(text.value, place), cure, severity)


def _in_parameters(package: Package, label: str, name: str, text: Located[str]) -> Finding:
    own = own_path_on_machine(package, text.value)
    here = f"$(find-pkg-share {package.declared_name})/{own}"
    names = (name, _BY_LAUNCH.get(name, name))
    launch = package.workspace.launch_texts.values()
    replaced = any(f"{mark}{it}{mark}" in code for code in launch for it in names for mark in "'\"")
    cure = f"give {here} in the launch file" if own else ""
    return _finding(package, label, text, cure, Severity.INFO if replaced else None)


def _finding(
    package: Package,
    label: str,
    text: Located[str],
    cure: str,
    severity: Severity | None = None,
) -> Finding:
    return finding(
        text,
        f"{label} is {text.value}, {_where(package, text.value)}: "
        f"{cure or 'install the file with a package'}",
        severity=severity,
        key=text.value,
    )


def _where(package: Package, path: str) -> str:
    if is_placeholder(path):
        return "a placeholder that no machine has"
    if container := container_with(package, path):
        return f"found only in the container of {container}"
    if is_below_home(path):
        return "found only where the workspace has this name"
    return "on its author's machine, and is found on no other"


def _example(value: str, mark: str = "", name: str = "yaml_filename") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"map_server:\n  ros__parameters:\n    {name}: {value}{mark}\n",
    }


def _launched(content: str, **files: str) -> dict[str, object]:
    return {"@urdf": True, "launch/nav.launch": f"<launch>\n{content}\n</launch>\n", **files}


_HALL = "/home/ann/ws/src/arm/maps/hall.yaml"
_OF_ROS_1 = "  <!-- ^ WIR014 -->"
_MARK = "  # ^ WIR014"
GOOD = [
    _launched('<arg name="map" default="$(find acme_arm_description)/maps/hall.yaml"/>'),
    _launched('<arg name="output_file" default="/home/ann/run.csv"/>'),
    _launched('<arg name="map" default="$(env HOME)/maps/hall.yaml"/>'),
    _launched('<node name="log" pkg="rosbag" type="record" args="-O /home/ann/run.bag"/>'),
    {"@ros2": "        DeclareLaunchArgument('map', default_value='/opt/maps/hall.yaml'),"},
    _example("$(find-pkg-share acme_rover_bringup)/maps/hall.yaml"),
    _example("/home/ann/logs/run.csv", name="output_file"),
    _example("/path/to/log.txt", name="debug_out_file"),
    _example("/opt/ros/jazzy/share/nav2_bringup/maps/depot.yaml"),
    _example("/home/ann/maps"),
    _example("/map/image.raw", name="topic"),
]
_JOINED = """import os
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    share = "/home/ann/ws/install/arm/share/arm"  # ^ WIR014
    model = os.path.join(share, "mjcf", "arm.xml")
    node = Node(package="arm_sim", executable="sim", parameters=[{"model": model}])
    return LaunchDescription([node])
"""
_OPENED = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    path = "/home/ann/ws/src/arm/urdf/arm.urdf"  # ^ WIR014
    text = open(path).read()
    node = Node(package="arm_sim", executable="sim", parameters=[{"robot_description": text}])
    return LaunchDescription([node])
"""
_BELOW_HOME = """import os
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    path = os.path.join(os.getenv("HOME"), "ros2_ws/src/arm/urdf/arm.urdf")  # ^ WIR014
    with open(path) as file:
        text = file.read()
    node = Node(package="arm_sim", executable="sim", parameters=[{"robot_description": text}])
    return LaunchDescription([node])
"""
_FOLDERS = """from launch import LaunchDescription
from launch.actions import SetEnvironmentVariable


def generate_launch_description():
    models = "/home/ann/gazebo_models"  # ^ WIR014
    return LaunchDescription([
        SetEnvironmentVariable("GZ_SIM_RESOURCE_PATH", "/opt/models:" + models)])
"""
BAD = [
    {"@ros2": True, "launch/sim.launch.py": _FOLDERS},
    {"@ros2": True, "launch/sim.launch.py": _JOINED},
    {"@ros2": True, "launch/sim.launch.py": _OPENED},
    {"@ros2": True, "launch/sim.launch.py": _BELOW_HOME},
    {
        "@ros2": True,
        "launch/sim.launch.py": _BELOW_HOME.replace(
            """os.path.join(os.getenv("HOME"), "ros2_ws""", 'os.path.expanduser("~/ros2_ws'
        ),
    },
    _launched(f'<arg name="map" default="$(env HOME)/ws/src/arm/a.yaml"/>{_OF_ROS_1}'),
    {
        "@ros2": "        ExecuteProcess(cmd=['gzserver', '/home/ann/ws/src/arm/hall.world']),"
        "  # ^ WIR014"
    },
    _launched(f'<arg name="map" default="{_HALL}"/>{_OF_ROS_1}'),
    _launched(f'<param name="map" value="{_HALL}"/>{_OF_ROS_1}', **{"maps/hall.yaml": "image: a"}),
    _launched(f'<node name="view" pkg="rviz" type="rviz" args="-d /root/a.rviz"/>{_OF_ROS_1}'),
    {"@ros2": f"        DeclareLaunchArgument('map', default_value='{_HALL}'),{_MARK}"},
    {"@ros2": f"        DeclareLaunchArgument('map', default_value='/path/to/a.yaml'),{_MARK}"},
    {"@ros2": f"        Node(package='p', executable='e', parameters=['{_HALL}']),{_MARK}"},
    _example("/home/ann/maps/hall.yaml", _MARK),
    _example("/home/ann/maps/hall", _MARK, "map_file_name"),
    {**_example("/ws/src/rover/hall.yaml", _MARK), "Dockerfile": "FROM ros:jazzy\nWORKDIR /ws\n"},
    {**_example("/home/ann/ws/src/rover/maps/hall.yaml", _MARK), "maps/hall.yaml": "image: a\n"},
    _example('"/rover_ws/install/rover/share/rover/tree.xml"', _MARK, "default_bt_xml"),
]
