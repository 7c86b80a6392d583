"""Descriptions that no simulator gets: RViz shows them, a library of dynamics reads them."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterable, Mapping, Sequence

from checker.formats.xacro.files import local_path
from checker.launch.ros2.descriptions import LoadedDescription, loaded_descriptions
from checker.launch.ros2.graph import LaunchGraph, Node, Process
from checker.launch.ros2.package_launch import launches_naming
from checker.model.robot import MUJOCO_SIMULATED, OTHERS_SIMULATED, UNDRIVEN
from checker.package.mjcf_files import mjcf_files
from checker.package.package import Package
from checker.robots.world_robots import names_world_with_robot
from checker.source.text import SourceText, without_comments
from checker.source.xml import Element, XmlDocument

_OTHERS = re.compile(
    r"gazebo|gzserver|(?<![a-z])gz(?![a-z])|(?<![a-z])ign(?:ition)?(?![a-z])|spawn_entity"
    r"|spawn_model|webots|isaac|coppelia|v-?rep\b|bullet|\bunity|stage_ros",
    re.IGNORECASE,
)
"""What a launch file contains that starts a simulator other than MuJoCo."""
_SIMULATORS = re.compile(rf"{_OTHERS.pattern}|mujoco|simulat", re.IGNORECASE)
"""What a launch file contains that starts a simulator, or may."""
_LOADS_MUJOCO = re.compile(
    r"^\s{0,40}(?:import|from)\s+mujoco\b|#\s{0,8}include\s{0,8}[<\"]mujoco/", re.MULTILINE
)
_PROGRAMS = (".py", ".cpp", ".cc", ".h", ".hpp")
_DESCRIPTION = re.compile(r"\w\.(?:urdf|xacro|sdf)\b")
_CLOCK = re.compile(
    r"simulat(?:ion|ed|or)\s{1,4}(?:\(gazebo\)\s{1,4})?(?:clock|time)\b", re.IGNORECASE
)
"""The usual description of `use_sim_time`, which starts none."""
_SIMULATED = frozenset({"plugin", "sensor"})
"""Children of a `<gazebo>` that no other program reads."""
_FOR_RVIZ = re.compile(r"<!--[^<>]{0,300}\bfor rviz\b", re.IGNORECASE)
SPAWNS = frozenset({"create", "spawn_entity.py", "spawn_entity", "spawn_model"})
_PUBLISHER = "robot_state_publisher"
_FROM_ROS = frozenset({"-topic", "-param", "-string"})
"""Options by which a spawner gets what other nodes are given, or what is not known."""


def shown_only(
    package: Package, path: str, document: XmlDocument, own: Iterable[LaunchGraph]
) -> str:
    """Return why no simulator gets a description, as a clause; empty if one may.

    A description with an element for Gazebo is for a simulator, whatever starts it, unless a
    simulator is given another one, or the launch files that load it start none, and nothing would
    drive its wheels there. Gazebo's controllers may take theirs from it, where the world that a
    launch file starts has the robot itself, and nothing spawns another. In a package that runs
    MuJoCo with models of its own, and where no launch file starts another simulator, it takes a
    plugin or a sensor. So may be a package whose launch files are in another one. In a folder
    without package.xml and launch files, of which no other launch file names the description, it
    takes more than friction or colours: a plugin or a sensor.

    Args:
        package: The package being checked.
        path: The path of the description as the package lists it.
        document: The description.
        own: What the launch files of ROS 2 of the package start.
    """
    root = document.root
    if package.only:
        return ""
    if _is_of_world(package, path, own):
        return OTHERS_SIMULATED
    return "" if _has_simulated_hardware(root) else _left(package, path, root, own)


def _left(package: Package, path: str, root: Element, own: Iterable[LaunchGraph]) -> str:
    """Return the clause for a description that may be for a simulator by its text; else empty."""
    launch, name = package.workspace.launch_texts, package.declared_name
    texts = _starting(launch, posixpath.basename(path))
    if others := _others_simulated(package, root, texts, launch.values()):
        return others
    loose = not (package.exists("package.xml") or package.launch_texts)
    loose = loose and not package.workspace.launches_file(posixpath.basename(path))
    if _is_for_gazebo(root, loose=loose):
        idle = texts and not _is_driven(root) and not _starts_simulator(launch.values(), name)
        return UNDRIVEN if idle else ""
    if _is_for_rviz(package, path):
        return "a comment says that it is for RViz"
    if loose:
        return "no launch file of the workspace loads it"
    return _unstarted(texts or [*launch.values()], name) or (
        OTHERS_SIMULATED if _get_others(package, own, path) else ""
    )


def _others_simulated(
    package: Package, root: Element, texts: list[str], launch: Collection[str]
) -> str:
    """Return the clause that simulators get other models; else empty.

    Args:
        package: The package being checked.
        root: The description.
        texts: The launch files that load it.
        launch: All launch files of the workspace.
    """
    name = package.declared_name
    if texts and not _starts_simulator(texts, name) and _spawns_another(launch, name):
        return OTHERS_SIMULATED
    alone = not _is_for_gazebo(root, loose=True) and _runs_mujoco_alone(package, launch)
    return MUJOCO_SIMULATED if alone else ""


def _is_of_world(package: Package, path: str, own: Iterable[LaunchGraph]) -> bool:
    """Return whether the world that a launch file starts has a robot, and nothing spawns a file.

    Args:
        package: The package being checked.
        path: The path of the description, which the same launch file loads.
        own: What the launch files of ROS 2 of the package start.
    """
    launch = package.workspace.launch_texts
    if any(option in text for text in launch.values() for option in _FROM_ROS):
        return False
    written = {file: without_comments(file, text) for file, text in launch.items()}
    texts = _starting(written, posixpath.basename(path))
    return names_world_with_robot(package, texts, beyond=True) and _get_others(package, own, path)


def _runs_mujoco_alone(package: Package, launch: Iterable[str]) -> bool:
    """Return whether a package runs MuJoCo with models of its own, and launch files nothing else.

    MuJoCo reads URDF too: none of the programs that load it names a URDF.

    Args:
        package: The package.
        launch: The launch files of the workspace.
    """
    texts = [_CLOCK.sub("", text) for text in launch]
    if not texts or any(map(_OTHERS.search, texts)) or package.simulator_signs:
        return False
    programs = (package.read(it.path) for it in package.index.with_suffix(*_PROGRAMS))
    texts = [it.text for it in programs if isinstance(it, SourceText)]
    loading = [text for text in texts if _LOADS_MUJOCO.search(text)]
    by_urdf = any(".urdf" in text for text in loading)
    return bool(loading) and not by_urdf and bool(mjcf_files(package))


def _is_for_gazebo(root: Element, *, loose: bool) -> bool:
    tags = (child.tag for tag in root.all("gazebo") for child in tag.children)
    return not _SIMULATED.isdisjoint(tags) if loose else root.child("gazebo") is not None


def _is_driven(root: Element) -> bool:
    """Return whether a plugin may move the wheels of a robot in Gazebo, or it has none."""
    turning = (joint.get("type") == "continuous" for joint in root.all("joint"))
    whole = (it for it in root.all("gazebo") if it.child("plugin") and not it.get("reference"))
    moving = (root.child(tag) for tag in ("ros2_control", "transmission"))
    return not any(turning) or any(whole) or any(moving)


def _unstarted(texts: Sequence[str], name: str) -> str:
    """Return the clause that launch files start no simulator; else empty."""
    if not texts or _starts_simulator(texts, name):
        return ""
    return "no launch file that loads it starts a simulator"


def _spawns_another(texts: Iterable[str], name: str) -> bool:
    """Return whether launch files give a simulator a description that they name, and no other."""
    starting = [text for text in texts if _starts_simulator([text], name)]
    own = [text for text in starting if _DESCRIPTION.search(text)]
    from_ros = (text for text in starting if any(option in text for option in _FROM_ROS))
    return bool(own) and all(text in own for text in from_ros)


def _starts_simulator(texts: Iterable[str], name: str) -> bool:
    """Return whether a launch file starts a simulator, or may.

    Args:
        texts: The launch files.
        name: The name of the package, which may be that of a simulator: `gazebo_sim`.
    """
    return any(_SIMULATORS.search(_CLOCK.sub("", text.replace(name, ""))) for text in texts)


def _has_simulated_hardware(root: Element) -> bool:
    """Return whether ros2_control of a robot may be that of a simulator: not all of it is known."""
    hardware = [part for tag in root.all("ros2_control") for part in tag.all("hardware")]
    plugins = [part.child("plugin") for part in hardware]
    return any(it is None or _SIMULATORS.search(it.value) for it in plugins)


def _is_for_rviz(package: Package, path: str) -> bool:
    """Return whether a comment in front of the robot says so."""
    source = package.read(path)
    text = source.text if isinstance(source, SourceText) else ""
    return _FOR_RVIZ.search(text[: text.find("<robot")]) is not None


def _starting(launch: Mapping[str, str], name: str) -> list[str]:
    """Return the texts of launch files that name a file, and of those that include one of them."""
    found: dict[str, str] = {}
    names = {name}
    while names:
        more = {
            file: text
            for file, text in launch.items()
            if file not in found and any(it in text for it in names)
        }
        found |= more
        names = {posixpath.basename(file) for file in more}
    return [*found.values()]


def _get_others(package: Package, own: Iterable[LaunchGraph], path: str) -> bool:
    """Return whether a launch file loads the description of a file, and none spawns it."""
    graphs = [*own, *(graph for _, graph in launches_naming(package))]
    loaded = (each for graph in graphs for each in loaded_descriptions(package, graph))
    named = any(local_path(package, each.load.path) == path for each in loaded)
    return named and spawns_others(package, graphs, path)


def spawns_others(package: Package, graphs: Iterable[LaunchGraph], path: str) -> bool:
    """Return whether all that is spawned is known, and none of it is the description of a file."""
    for graph in graphs:
        if graph.unread or any(_is_unknown(process) for process in graph.processes):
            return False
        loaded = [*loaded_descriptions(package, graph)]
        spawners = (it for it in graph.nodes_and_spawns if it.executable.value in SPAWNS)
        if any(_may_get(package, node, loaded, path) for node in spawners):
            return False
    return True


def _is_unknown(process: Process) -> bool:
    """Return whether a command may spawn, though not as a node that is known does."""
    return not process.spawns and any(word.value in SPAWNS for word in process.words)


def _may_get(package: Package, node: Node, loaded: list[LoadedDescription], path: str) -> bool:
    """Return whether a spawner gets the description of a file, or may.

    It gets one of its own, or what the same launch file publishes.
    """
    words = {word.value for word in node.arguments}
    published = [it for it in loaded if it.node.executable.value == _PUBLISHER]
    given = [it for it in loaded if it.node is node] or (published if "-topic" in words else [])
    if given:
        return any(local_path(package, it.load.path) == path for it in given)
    return not _FROM_ROS.isdisjoint(words) or "-file" not in words
