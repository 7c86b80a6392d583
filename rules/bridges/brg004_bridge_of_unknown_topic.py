"""A bridge for a topic that does not exist in Gazebo.

The bridge starts, but no message ever arrives. A `<topic>` of a sensor is used as written; other
topics begin with the names of the world and the model in Gazebo. The argument `-name` of the
spawning program sets the name of the model.

The rule needs all robots that the launch file spawns. It reports a topic if everything that the
launch file starts is known, or if the robot has a topic with this message that is not bridged,
whatever models of the world and parts of the robot are not available. Topics in the robot's files
that an argument switches off are skipped. Where another node publishes joint states or, for a robot
without a drive, the transforms of the same topic, nothing is missing: it is an info. So it is where
a controller gets the command, itself or by a node that passes it on, and where the robot has the
topic in another launch file, which gives it other arguments.

Fix: write the topic of the sensor or system; `gz topic -l` lists them.
Source: gz-sensors and Gazebo's systems, their default topics.
"""

import posixpath
import re
from collections.abc import Iterable, Iterator

from checker.base.resources import table
from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.bridges.entry import BridgeEntry
from checker.model.controllers import Controller
from checker.model.locomotion.locomotion import DriveKind
from checker.package.package import Package
from checker.ros.simulated_topics import SimulatedTopic
from checker.ros.simulation import Simulation, Simulations
from checker.ros.spawned import SpawnedRobot
from checker.ros.topics import comparable
from checker.ros.wiring.joint_states import JOINT_STATE
from checker.ros.wiring.wiring import Wiring, Wirings
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_OF_THE_WORLD = re.compile(r"/(?:clock|stats|gui|keyboard|marker|world/[^/]*/(?!model/))")
_CLOCK = "Clock"
_TRANSFORMS = "tf2_msgs/msg/TFMessage"
_FILES_LIMIT = 100
_SEVERAL = 2
_OF_THE_USER = ("Twist", "Joy", "Double", "Boolean", "StringMsg", "Int32", "Empty")
"""Messages that windows of Gazebo publish too, on topics that the user chooses."""


@rule("BRG004", "bridge-of-unknown-topic", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, simulations: Simulations, wirings: Wirings | None) -> Findings:
    """Report topics that no robot, model or world has, if all of them are known.

    It is an error if several bridges, and no other ones, are for the robot's topics, and for the
    clock of another world.
    """
    for simulation in simulations.launched:
        missing = simulation.missing_parts
        if simulation.unknown_topics and not missing:
            continue
        entries = [it for it in simulation.entries if it.gz_topic and it.counts]
        own = [it for it in entries if not _OF_THE_WORLD.match(it.gz_topic)]
        faults = [(it, fault) for it in own if (fault := _fault(package, simulation, it))]
        in_vain = len(faults) == len(own) >= _SEVERAL and not missing
        if missing:
            certain = [(it, fault) for it, fault in faults if _is_certain(simulation, it)]
            if len(certain) < len(faults):
                yield unchecked(missing)
            faults = certain
        for entry, fault in (*faults, *_of_other_worlds(simulation, entries)):
            is_grave = in_vain or entry.gz_name == _CLOCK
            severity, other = Severity.ERROR if is_grave else None, ""
            if publisher := _given_otherwise(simulation, wirings, entry):
                severity, other = Severity.INFO, f" ({publisher} in ROS)"
            elif topic := _switched_off(simulations, simulation, entry):
                severity, other = Severity.INFO, f" (with other arguments, the robot has {topic})"
            yield finding(entry.passed.gz_topic, f"{fault}{other}", severity=severity)


def _is_certain(simulation: Simulation, entry: BridgeEntry) -> bool:
    """Return whether what is read of the robots tells what is wrong, whatever is not available."""
    return bool(simulation.topics_of(entry) or _instead(simulation, entry))


def _switched_off(simulations: Simulations, simulation: Simulation, entry: BridgeEntry) -> str:
    """Return the topic that the same robot has in another launch file, and in this one not."""

    def ends(launched: Simulation) -> set[str]:
        topics = (topic for found in launched.topics.values() for topic in found)
        fitting = (it.topic for it in topics if entry.gz_name in it.messages)
        return {topic for topic in fitting if entry.gz_topic.endswith(topic)}

    own = ends(simulation)
    for other in simulations.launched:
        if not _files(other).isdisjoint(_files(simulation)) and not own:
            for topic in sorted(ends(other)):
                return topic
    return ""


def _files(simulation: Simulation) -> set[str]:
    return {spawned.robot.document.source.file for spawned in simulation.robots}


def _given_otherwise(simulation: Simulation, wirings: Wirings | None, entry: BridgeEntry) -> str:
    """Return who else in ROS does what a bridge should, as a clause; empty if none does."""
    message = entry.passed.ros_type.value
    if entry.direction is Direction.TO_IGN:
        return next(filter(None, (_taken(it, entry) for it in _wired(simulation, wirings))), "")
    if message not in (JOINT_STATE, _TRANSFORMS):
        return ""
    if message == _TRANSFORMS and any(map(_drives, simulation.robots)):
        return ""  # nothing else publishes where the robot is
    ends = [it for each in _wired(simulation, wirings) for it in each.endpoints]
    is_read = any(it.topic == entry.ros_topic and not it.publishes for it in ends)
    for each in ends:
        publishes = each.publishes and each.certain and each.owner not in simulation.entries
        same = each.topic == entry.ros_topic or (message == JOINT_STATE and not is_read)
        if publishes and same and message in each.types:
            return f"{each.by} publishes {each.topic}"
    return ""


def _taken(wiring: Wiring, entry: BridgeEntry) -> str:
    """Return how a controller gets the command that a bridge should pass; empty if it does not."""
    wanted = {
        it.topic: it.by
        for it in wiring.endpoints
        if not it.publishes and isinstance(it.owner, Controller)
    }
    if entry.ros_topic in wanted:
        return f"{wanted[entry.ros_topic]} reads {entry.ros_topic}"
    for node in wiring.every_node:
        named = [word.value for word in node.node.arguments]
        named += [remap.target for remap in node.node.remaps]
        topics = {node.resolve(name) for name in named if not name.startswith("-")}
        if entry.ros_topic in topics and node.node.starts is not False:
            for topic in sorted(topics & wanted.keys()):
                return f"{node.label} passes {entry.ros_topic} on to {wanted[topic]}"
    return ""


def _wired(simulation: Simulation, wirings: Wirings | None) -> Iterator[Wiring]:
    for each in wirings.all if wirings is not None else ():
        if each.simulation is simulation:
            yield each


def _drives(spawned: SpawnedRobot) -> bool:
    return spawned.robot.locomotion.kind is not DriveKind.NONE


def _of_other_worlds(
    simulation: Simulation, entries: Iterable[BridgeEntry]
) -> Iterator[tuple[BridgeEntry, str]]:
    """Yield the bridges of topics of a world that the launch file does not load."""
    for entry in entries:
        missing = simulation.missing_world(entry.gz_topic)
        if missing and _OF_THE_WORLD.match(entry.gz_topic):
            worlds = ", ".join(sorted(simulation.world_names))
            yield entry, f"{entry.gz_topic}: there is no world {missing!r}; expected {worlds}"


def _fault(package: Package, simulation: Simulation, entry: BridgeEntry) -> str:
    """Return what is wrong with the topic of a bridge; empty if that is nothing, or not known."""
    behind = simulation.topics_of(entry)
    if behind:
        fault = _other_name(simulation, entry, behind) if simulation.is_whole else ""
        return f"{entry.gz_topic}: {fault}" if fault else ""
    if _may_be_of_user(entry) or _is_written(package, simulation, entry):
        return ""
    hint = _instead(simulation, entry)
    whole = simulation.is_whole and simulation.knows_world
    if not hint and not (simulation.robots and whole):
        return ""
    which = "that is available" if simulation.missing_parts else "in Gazebo"
    rest = hint or _lacking(entry)
    return f"no sensor or system {which} has the topic {entry.gz_topic}{rest}"


def _is_written(package: Package, simulation: Simulation, entry: BridgeEntry) -> bool:
    """Return whether an argument may set the topic: the file of the robot or of macros has it."""
    files = package.index.with_suffix(".xacro", ".urdf", ".sdf")[:_FILES_LIMIT]
    own = {spawned.robot.document.source.file for spawned in simulation.robots}
    written = entry.gz_topic.strip("/") + "</"
    for path in (file.path for file in files):
        source, document = package.read(path), package.xml(path)
        if not isinstance(source, SourceText) or written not in source.text:
            continue
        root = document.root if isinstance(document, XmlDocument) else None
        is_part = root is None or (root.tag == "robot" and not root.get("name"))
        if path in own or (is_part and _is_included(package, path)):
            return True
    return False


def _is_included(package: Package, path: str) -> bool:
    """Return whether a xacro file includes this one."""
    documents = (package.xml(it.path) for it in package.index.with_suffix(".xacro", ".urdf"))
    return any(
        posixpath.basename(include.get("filename") or "") == posixpath.basename(path)
        for document in documents
        if isinstance(document, XmlDocument)
        for include in document.root.descendants("xacro:include")
    )


def _may_be_of_user(entry: BridgeEntry) -> bool:
    return entry.direction is not Direction.TO_IGN and entry.gz_name in _OF_THE_USER


def _instead(simulation: Simulation, entry: BridgeEntry) -> str:
    """Return a topic of this message that nothing bridges yet, if there is one."""
    bridged = {topic.key for other in simulation.entries for topic in simulation.topics_of(other)}
    for key, topics in simulation.topics.items():
        for topic in topics:
            fits = topic.direction is entry.direction or entry.direction is Direction.BOTH
            if key not in bridged and fits and entry.gz_name in topic.messages:
                return f"; {topic.owner_name} has {topic.topic}"
    return ""


def _lacking(entry: BridgeEntry) -> str:
    """Return the system that has such a topic, if only one does: the robot lacks it."""
    last = posixpath.basename(entry.gz_topic)
    systems = [
        f"{system} would have {_named(topic, entry)}"
        for system, topics in table("simulated_topics")["plugins"].items()
        for topic, _, messages, _ in topics
        if posixpath.basename(topic) == last and entry.gz_name in messages
    ]
    return f"; the system {systems[0]}" if len(systems) == 1 else ""


def _named(topic: str, entry: BridgeEntry) -> str:
    """Return a topic with W for the name of the world and M for that of the model."""
    if comparable(topic) == comparable(entry.gz_topic):
        return "it"
    return topic.replace("/world/*", "/world/W").replace("/model/*", "/model/M")


def _other_name(
    simulation: Simulation, entry: BridgeEntry, behind: Iterable[SimulatedTopic]
) -> str:
    """Return the model or world that does not exist; nothing if one of the topics fits."""
    models, worlds = simulation.model_names, simulation.world_names
    fault = ""
    for topic in behind:
        fault = _difference(topic.topic.split("/"), entry.gz_topic.split("/"), models, worlds)
        if not fault:
            return ""
    return fault


def _difference(
    parts: list[str], written: list[str], models: frozenset[str], worlds: frozenset[str]
) -> str:
    for before, part, name in zip(["", *parts], parts, written, strict=False):
        known = {"model": models, "world": worlds}.get(before, frozenset())
        if part == "*" and known and name not in known:
            return f"there is no {before} {name!r}; expected {', '.join(sorted(known))}"
        if part not in ("*", name):
            return f"the topic is {'/'.join(parts)}"
    return ""


def _entry(topic: str, ros: str, gz: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": f"- topic_name: {topic}{mark}\n  ros_type_name: {ros}\n  gz_type_name: {gz}\n"
        "  direction: GZ_TO_ROS\n"
    }


_SCAN = ("sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan")
_ODOMETRY = ("nav_msgs/msg/Odometry", "gz.msgs.Odometry")
_MARK = "  # ^ BRG004"
_STATES = ("sensor_msgs/msg/JointState", "gz.msgs.Model")
_FUEL = {
    "@launch": {'("gz_args", "-r empty.sdf")': '("gz_args", ["-r ", HERE, "/yard.sdf"])'},
    "yard.sdf": """<sdf version="1.9"><world name="yard"><include>
  <uri>https://fuel.gazebosim.org/1.0/acme/models/Barrel</uri>
</include></world></sdf>""",
}
_MAST = "<robot><sensor><topic>${ns}/lidar</topic></sensor></robot>"
_INCLUDE = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="mast.xacro"/>
</robot>
"""
GOOD = [
    {"@bridge": True},
    _entry("/model/rover/odometry", *_ODOMETRY),
    {**_entry("/lidar", *_SCAN), "urdf/mast.xacro": _MAST, "urdf/all.xacro": _INCLUDE},
    {
        **_entry("/lidar", *_SCAN),
        "@launch": {'"rover", "-file", URDF': '"rover", "-file", "/somewhere/rover.sdf"'},
    },
    {
        **_entry("/model/other/odometry", *_ODOMETRY),
        "@launch": {'"-name", "rover"': '"-name", LaunchConfiguration("name")'},
    },
    {**_entry("/barrel/weight", "geometry_msgs/msg/Wrench", "gz.msgs.Wrench"), **_FUEL},
]
BAD = [
    _entry("/lidar", *_SCAN, _MARK),
    _entry("/world/yard/clock", "rosgraph_msgs/msg/Clock", "gz.msgs.Clock", _MARK),
    {**_entry("/lidar", *_SCAN, _MARK), "urdf/mast.xacro": _MAST},
    _entry("/odom", *_ODOMETRY, _MARK),
    _entry("/model/my_rover/odometry", *_ODOMETRY, _MARK),
    _entry("/world/empty/model/rover/joint_state", *_STATES, _MARK),
    {**_entry("/lidar", *_SCAN, _MARK), **_FUEL},
]
