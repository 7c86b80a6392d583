"""A launch file of ROS 1 that roslaunch refuses, or a program of a node that does not exist.

roslaunch reads all files before it starts anything, so nothing starts where a file uses an arg
that it does not declare before, where an included file does not exist, gets an arg that it does not
declare, or lacks one that it requires, where two nodes get one name with the defaults of all args,
also through an include, and where the file of a description or of parameters does not exist (a
warning if its path depends on an arg, which may be given). A node whose package has no program of
its `type` does not start, and roslaunch goes on without it; that CMakeLists.txt installs a script
does not help if the source has none, nor that it builds a library of this name. `state_publisher`
is not in Noetic any more. Programs without the ending `.py` are only reported if the package has
one of nearly the same name: CMake may build them. Packages of ROS 2 are not checked.

Fix: correct the path, the name of the arg or the `type`; pass an arg with
`<arg name="…" value="…"/>` inside the include.
Source: roslaunch XML specification, `<include>`, `<arg>` and `<node>`; roslaunch, `add_node`;
roslib, `find_node`; robot_state_publisher 1.15, changelog.
"""

import posixpath
import re
from collections.abc import Iterable, Iterator
from itertools import chain, pairwise

from checker.base.words import Suggestions
from checker.launch.ros1.graph import LaunchFault, LaunchFaultKind, Node
from checker.launch.ros1.package_launch import LaunchEntries
from checker.launch.ros1.substitution import is_known
from checker.launch.ros2.package_launch import is_ros2_only
from checker.package.distribution_sign import ros_1_sign
from checker.package.installed import GENERATES
from checker.package.package import Package
from checker.ros.control.controllers import ControlSystem
from checker.ros.control.system import missing_descriptions, missing_parameter_files
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import SourceText

_FATAL = (
    LaunchFaultKind.UNDECLARED_ARG,
    LaunchFaultKind.MISSING_ARG,
    LaunchFaultKind.UNKNOWN_ARG,
    LaunchFaultKind.MISSING_FILE,
    LaunchFaultKind.INCLUDE_LOOP,
)
_PASSES_ALL = "pass_all_args"
_WORD = re.compile(r"[\w.-]+")
_BUILD = ("CMakeLists.txt", "setup.py")
_NOT_PLAIN = re.compile(r"\bGLOB\b|\bforeach\b|\badd_subdirectory\b|add_executable\W{1,8}\$")
"""What may build programs whose names CMakeLists.txt does not state."""
_PROGRAM = re.compile(r"\.(?:py|sh|bash)\Z")
_OF_ITS_NAME = frozenset(
    {
        *("amcl", "move_base", "rviz", "rqt_graph"),
        *("joint_state_publisher", "joint_state_publisher_gui", "robot_state_publisher"),
    }
)
"""Released packages whose program has the name of the package."""
_REMOVED = frozenset({("robot_state_publisher", "state_publisher")})
"""Programs that Noetic does not have any more."""


@rule("LCH020", "broken-ros-1-launch-file", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, launch: LaunchEntries, control: ControlSystem | None) -> Findings:
    """Report what stops roslaunch, and nodes whose program an available package does not have."""
    if is_ros2_only(package):
        return
    for fault in launch.graph.faults:
        if fault.kind in _FATAL and not _may_be_given(package, fault):
            yield finding(fault, f"roslaunch stops: {fault.message}", key=fault.message)
    if control is None:  # CTL rules report those of a robot that is controlled or spawned
        for entry in launch.entries:
            for missing in chain(
                missing_descriptions(package, entry.graph),
                missing_parameter_files(package, entry.graph),
            ):
                given = "$(arg " in missing.span.text
                severity = Severity.WARNING if given else None
                yield finding(missing, missing.message, key=missing.message, severity=severity)
    for entry in launch.entries:
        yield from _of_one_name(entry.graph.nodes)
    sign = ros_1_sign(package)
    for node in launch.graph.nodes:
        if sign is not None and sign.distro == "noetic" and (node.package, node.type) in _REMOVED:
            yield _not_started(node, node.package)
        else:
            yield from _without_program(package, node)


def _may_be_given(package: Package, fault: LaunchFault) -> bool:
    """Return whether what starts or includes the file may give the arg that is missing.

    A person starts a file that lacks one; a file that gets all args need not declare them.
    """
    if fault.kind is LaunchFaultKind.UNDECLARED_ARG:
        return bool(package.workspace.launches_with(_PASSES_ALL))
    return fault.kind is LaunchFaultKind.MISSING_ARG and fault.span.text.startswith("<arg")


def _of_one_name(nodes: Iterable[Node]) -> Iterator[Finding]:
    """Report nodes that one launch starts under the name of another."""
    first: dict[str, Node] = {}
    for node in nodes:
        if not node.name or node.assumed_from or not is_known(node.full_name):
            continue
        other = first.setdefault(node.full_name, node)
        if other is not node:
            yield finding(
                node,
                f"roslaunch stops: it starts two nodes of the name {node.full_name}: "
                "remove one, or give it another name",
                key=node.full_name,
                related=[(other.span, "the other one")],
            )


def _without_program(package: Package, node: Node) -> Iterator[Finding]:
    holder = package.named(node.package) if is_known(node.package + node.type) else None
    if holder is None and node.package in _OF_ITS_NAME and node.type != node.package:
        near = Suggestions((node.package,)).correction(node.type) or ""
        yield from [_not_started(node, near)] if near else []
    if holder is None or not node.type or is_ros2_only(holder):
        return
    files = {posixpath.basename(file.path) for file in holder.index.files}
    build = _build_text(holder)
    words = _WORD.findall(build)
    made = {(kind, name) for kind, name in pairwise(words) if name == node.type}
    is_library = ("add_library", node.type) in made and ("add_executable", node.type) not in made
    is_named = node.type in words and not is_library and not _installs_script(holder, node.type)
    if node.type in files or is_named:
        return
    is_script = node.type.endswith(".py")
    if is_script or not _NOT_PLAIN.search(build):
        scripts = {_PROGRAM.sub("", file): file for file in files if _PROGRAM.search(file)}
        meant = Suggestions((*scripts, *scripts.values())).closest(node.type) or ""
        near = scripts.get(node.type) or scripts.get(meant, meant)
        if not (near or is_script or is_library):
            return
        yield _not_started(node, near)


def _installs_script(holder: Package, name: str) -> bool:
    """Return whether CMakeLists.txt installs a script of the source, and makes none of its own."""
    build = holder.build
    if build is None or not name.endswith(".py") or GENERATES.search(build.source.text):
        return False
    scripts = (install.items for install in build.installs if install.kind == "PROGRAMS")
    names = (item.value for item in chain.from_iterable(scripts) if "$" not in item.value)
    return name in map(posixpath.basename, names)


def _not_started(node: Node, near: str) -> Finding:
    hint = f"; did you mean {near!r}?" if near else ""
    return finding(
        node,
        f"node {node.name!r} does not start: {node.package} has no program {node.type!r}{hint}",
        key=f"{node.package}/{node.type}",
    )


def _build_text(holder: Package) -> str:
    """Return what builds and installs the programs of a package."""
    sources = [holder.read(name) for name in _BUILD if holder.exists(name)]
    text = "\n".join(it.text for it in sources if isinstance(it, SourceText))
    return text.replace("${PROJECT_NAME}", holder.declared_name)


def _launch(content: str, name: str = "launch/all.launch") -> dict[str, object]:
    return {"@urdf": True, name: f"<launch>\n{content}\n</launch>\n", "scripts/watch.py": ""}


def _include(inside: str, file: str = "one.launch", mark: str = "") -> dict[str, object]:
    path = f"$(find acme_arm_description)/launch/{file}"
    included = {"launch/one.launch": '<launch><arg name="arm"/></launch>'}
    return {**_launch(f'<include file="{path}">{mark}\n{inside}\n</include>'), **included}


def _node(program: str, mark: str = "", package: str = "acme_arm_description") -> dict[str, object]:
    return _launch(f'<node name="watch" pkg="{package}" type="{program}"/>{mark}')


def _two(second: str, mark: str = "", around: str = "") -> dict[str, object]:
    """Return a launch file with a node, after it includes a file that starts one."""
    path = "$(find acme_arm_description)/launch/one.launch"
    node = '<node name="states" pkg="robot_state_publisher" type="robot_state_publisher"@/>'
    included = {"launch/one.launch": f"<launch>{node.replace('@', '')}</launch>"}
    return {
        **_launch(f'<include file="{path}"{around}/>\n{node.replace("@", second)}{mark}'),
        **included,
    }


_MARK = "  <!-- ^ LCH020 -->"
_BUILD_OF = "project(acme_arm_description)\n{}(follower src/follower.cpp)\n"
_ARM = '<arg name="arm" value="1"/>'
_OWN = "$(find acme_arm_description)"
_LOAD = "$(find acme_arm_bringup)/urdf/$(arg model).xacro"
_BRINGUP = {
    "@name": "acme_arm_bringup",
    "package.xml": "<package><name>acme_arm_bringup</name></package>",
    "urdf/arm.urdf": None,
}
GOOD = [
    _include(_ARM),
    _include(_ARM, "$(env ARMS)/one.launch"),
    _launch('<arg name="arm"/>'),
    _node("watch.py"),
    _node("planner"),
    _node("wacth.py", package="acme_tools"),
    _node("state_publisher", package="robot_state_publisher"),
    {**_node("follower"), "CMakeLists.txt": _BUILD_OF.format("add_executable")},
    _launch('<node name="watch" pkg="acme_arm_description" type="wacth.py" if="false"/>'),
    _two(' ns="arm"'),
    _two(' if="false"'),
    _two("", around=' ns="arm"'),
    _launch('<arg name="rate" default="5"/>\n<param name="rate" value="$(arg rate)"/>'),
    _launch(
        """<arg name="file" default="$(env ARM)"/>
<arg if="$(eval file == '')" name="rate" value="1"/>
<arg unless="$(eval file == '')" name="rate" value="2"/>
<param name="rate" value="$(arg rate)"/>"""
    ),
]
BAD = [
    {
        **_node("follow.py", _MARK),
        "CMakeLists.txt": "project(acme_arm_description)\n"
        "install(PROGRAMS scripts/follow.py DESTINATION bin)\n",
    },
    {**_node("follower", _MARK), "CMakeLists.txt": _BUILD_OF.format("add_library")},
    {
        **_node("state_publisher", _MARK, package="robot_state_publisher"),
        "README.md": "# Arm of ROS Noetic\n",
    },
    _launch(f'<param name="rate" value="$(arg rate)"/>{_MARK}'),
    _two("", _MARK),
    _two(' ns="arm"', _MARK, ' ns="arm"'),
    _include("", mark=_MARK),
    _include(f'{_ARM}\n<arg name="ram" value="1"/>{_MARK}'),
    _include(_ARM, "two.launch", _MARK),
    _node("wacth.py", _MARK),
    _node("watch", _MARK),
    _node("joint_state_publihser", _MARK, package="joint_state_publisher"),
    {
        **_launch(
            f"""<param name="robot_description" textfile="{_OWN}/urdf/old.urdf"/>{_MARK}
<param name="tall" command="$(find xacro)/xacro '{_OWN}/urdf/tall.xacro'"/>{_MARK}
<rosparam file="{_OWN}/config/pid.yaml"/>{_MARK}"""
        ),
        "@urdf": "",
        "config/control.yaml": None,
        "launch/control.launch": None,
        "launch/spawn.launch": None,
    },
    {
        **_launch(
            f"""<arg name="model" default="tall"/>
<param name="robot_description" command="xacro '{_LOAD}'"/>{_MARK}"""
        ),
        **_BRINGUP,
        "launch/spawn.launch": None,
    },
    {
        **_launch(f'<rosparam file="$(find acme_arm_bringup)/config/pid.yaml"/>{_MARK}'),
        **_BRINGUP,
        "launch/spawn.launch": None,
    },
]
