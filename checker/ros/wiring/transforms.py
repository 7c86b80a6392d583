"""The transforms of a launch: the frames and their publishers."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.launch.ros1.bridge import Direction
from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.ros.simulation import Simulation
from checker.ros.wiring.controllers import RunController
from checker.ros.wiring.endpoints import remap_texts
from checker.ros.wiring.nodes import WiredNode
from checker.source.text import Span

TOPIC = "/tf"
_FRAMES = {
    "AckermannSteering": ("frame_id", "child_frame_id"),
    "DiffDrive": ("frame_id", "child_frame_id"),
    "MecanumDrive": ("frame_id", "child_frame_id"),
    "TrackedVehicle": ("frame_id", "child_frame_id"),
    "OdometryPublisher": ("odom_frame", "robot_base_frame"),
}
"""Plugins of Gazebo that publish odometry: parameters for the parent and the child."""
_CONTROLLERS = ("DiffDriveController", "OmniWheelDriveController")
"""Those whose transforms go to /tf itself; others publish them on their own topic."""

_NOT_ZERO = "!0"
"""In the table of nodes: the number must be another one than 0."""
_CLASSIC = {
    "gazebo_ros_ackermann_drive": ("publish_odom_tf", "false", "base_footprint"),
    "gazebo_ros_diff_drive": ("publish_odom_tf", "false", "base_footprint"),
    "gazebo_ros_planar_move": ("publish_odom_tf", "true", "base_footprint"),
    "gazebo_ros_tricycle_drive": ("publish_odom", "false", "base_link"),
}
"""Drives of Gazebo Classic, by library: what makes them publish, its default, that of the child.

From gazebo_ros_pkgs, branch ros2 at d52f7c47, gazebo_plugins/src.
"""


class Transform(Record, eq=False):
    """A published transform.

    Attributes:
        parent: The frame that it starts from.
        child: The frame that it places.
        topic: Absolute: `/tf`, or what a remap makes of it.
        span: The place that causes its publication.
        by: The publisher, for a message.
        cure: The way to switch it off, for a message.
        source: The node, plugin or controller.
        names_child: The setting of the publisher that names the child, with `{}` for its name;
            empty if that is not known.
        root: Of a joint, the root of its robot, if that is known.
    """

    parent: str
    child: str
    topic: str
    span: Span
    by: str
    cure: str
    source: object
    names_child: str = ""
    root: str = ""

    def __str__(self) -> str:
        """Return it as messages write it."""
        return f"{self.parent} → {self.child}"


def transforms(
    nodes: tuple[WiredNode, ...],
    simulation: Simulation | None,
    in_classic: tuple[Robot, ...],
    controllers: tuple[RunController, ...],
) -> Iterator[Transform]:
    """Yield the transforms of odometry and localisation that a launch publishes for certain.

    Args:
        nodes: The nodes that are started.
        simulation: What the launch file simulates.
        in_classic: Robots that it puts into Gazebo Classic.
        controllers: The controllers that its controller managers may run.
    """
    for plugin in (plugin for robot in in_classic for plugin in robot.plugins):
        yield from _of_classic(plugin)
    if simulation is not None:
        yield from _bridged(simulation)
    for run in controllers:
        yield from _of_controller(run)
    for node in nodes:
        yield from _of_node(node)


def _bridged(simulation: Simulation) -> Iterator[Transform]:
    unsure = [robot.robot for robot in simulation.robots if robot.node.starts is not True]
    for entry in simulation.entries:
        if entry.direction is Direction.TO_IGN or entry.gz_name != "Pose_V" or not entry.ros_topic:
            continue
        owners = [it.owner for it in simulation.topics_of(entry) if "Pose_V" in it.messages]
        owner = owners[0] if len(owners) == 1 else None  # names do not identify one
        if not isinstance(owner, Plugin) or any(owner in robot.plugins for robot in unsure):
            continue
        frames = [
            next((t.value for t in owner.at(it)), "") for it in _FRAMES.get(owner.class_name, ())
        ]
        if frames and all(frames):
            parent, child = frames
            by = f"plugin {owner.class_name} by the bridge of {entry.ros_topic}"
            cure = f"remove the bridge of {entry.gz_topic}"
            span = entry.passed.gz_topic.span
            yield Transform(parent, child, entry.ros_topic, span, by, cure, owner)


def _of_classic(plugin: Plugin) -> Iterator[Transform]:
    library = library_stem(plugin.filename.value)
    if library not in _CLASSIC or any("tf" in text.value for text in remap_texts(plugin)):
        return
    switch, usual, child = _CLASSIC[library]
    stated = {
        name: next(plugin.at(name), None) for name in (switch, "odometry_frame", "robot_base_frame")
    }
    values = {name: text.value.strip() for name, text in stated.items() if text is not None}
    if values.get(switch, usual).lower() in ("1", "true"):
        parent, child = values.get("odometry_frame", "odom"), values.get("robot_base_frame", child)
        span = text.span if (text := stated[switch]) is not None else plugin.span
        by, cure = f"plugin {plugin.filename.value}", f"state `<{switch}>false</{switch}>`"
        names_child = "<robot_base_frame>{}</robot_base_frame>"
        yield Transform(parent, child, TOPIC, span, by, cure, plugin, names_child)


def _of_controller(run: RunController) -> Iterator[Transform]:
    controller, topic = run.controller, run.resolve(TOPIC)
    publishes = controller.class_name in _CONTROLLERS and run.started and topic
    prefixed = run.namespace != "/" or "tf_frame_prefix" in controller.parameters
    if not publishes or prefixed or not controller.flag("enable_odom_tf", default=True):
        return
    parent, child = (
        next((text.value for text in controller.texts(name)), default)
        for name, default in (("odom_frame_id", "odom"), ("base_frame_id", "base_link"))
    )
    cure = f"state `enable_odom_tf: false` for {controller.label}"
    by, names_child = controller.label, "base_frame_id: {}"
    yield Transform(parent, child, topic, controller.span, by, cure, controller, names_child)


def _of_node(node: WiredNode) -> Iterator[Transform]:
    if node.facts is None or not node.knows_parameters:
        return
    for parent, child, wanted in node.facts.transforms:
        if all(_is_so(node, name, value) for name, value in wanted.items()):
            frames, topic = (node.fill_in(parent), node.fill_in(child)), node.resolve(TOPIC)
            switch = next(iter(wanted))
            span = node.settings[switch].span if switch in node.settings else node.node.span
            if frames[0] and frames[1] and topic:
                off = "0.0" if wanted[switch] == _NOT_ZERO else "false"
                cure = f"state `{switch}: {off}` for {node.label}"
                named = f"{_naming(node, child)}: {{}}"
                by = node.label
                yield Transform(frames[0], frames[1], topic, span, by, cure, node, named)


def _naming(node: WiredNode, reference: str) -> str:
    """Return the parameter that decides a name; the default of one may be the value of another."""
    name = reference.strip("{}")
    default = node.facts.defaults.get(name, "") if node.facts is not None else ""
    is_another = default.startswith("{") and name not in node.settings
    return _naming(node, default) if is_another else name


def _is_so(node: WiredNode, parameter: str, wanted: str) -> bool:
    """Return whether a parameter is known to have the value that a transform needs."""
    value = node.fill_in(f"{{{parameter}}}")
    if wanted == _NOT_ZERO:
        return value is not None and parse_number(value) not in (None, 0.0)
    return value == node.fill_in(wanted)
