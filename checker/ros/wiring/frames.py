"""Transforms of the robot's joints, and those that static_transform_publisher is given."""

from __future__ import annotations

from collections.abc import Iterator

from checker.launch.ros2.graph import Node, NodeKind, is_known
from checker.model.robot import Robot
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.transforms import Transform

STATE_PUBLISHER = "robot_state_publisher/robot_state_publisher"
_STATIC_PUBLISHER = "tf2_ros/static_transform_publisher"
_STATIC, _SUFFIX = "/tf_static", "_static"
_PREFIX = "frame_prefix"
_DESCRIPTIONS = ("robot_description", "description_from_topic")
_OPTIONS = ("--frame-id", "--child-frame-id")
_POSITIONAL = (8, 9)
"""Words of the form without options: a place, an attitude of three or four numbers, two frames."""


def may_get_description(node: Node) -> bool:
    """Return whether a robot_state_publisher may get a robot: one is given, or not all is known."""
    return bool(
        node.kind is NodeKind.INCLUDED
        or node.unread
        or node.arguments
        or node.parameter_files
        or any(node.parameter(name) for name in _DESCRIPTIONS)
    )


def joint_transforms(node: WiredNode, robot: Robot) -> Iterator[Transform]:
    """Yield the transforms of a robot's joints.

    Args:
        node: The robot_state_publisher.
        robot: The robot that it gets.
    """
    prefix = node.fill_in(f"{{{_PREFIX}}}") if _PREFIX in node.settings else ""
    topics = {True: _tree(node, _STATIC), False: node.resolve("/tf")}
    if prefix is None or not node.knows_parameters or robot.format != "urdf":
        return
    children = {joint.child.value for joint in robot.joints}
    roots = [link.name.value for link in robot.links if link.name.value not in children]
    root = prefix + roots[0] if len(roots) == 1 else ""
    cure = f"name {root}, the root of the robot, there" if root else ""
    for joint in robot.joints:
        parent, child = (_frame(prefix + end.value) for end in (joint.parent, joint.child))
        if topic := topics[joint.type.value == "fixed"]:
            by = f"joint {joint.name.value!r}"
            yield Transform(parent, child, topic, joint.span, by, cure, joint, root=root)


def static_transforms(node: WiredNode) -> Iterator[Transform]:
    """Yield the transform that a static_transform_publisher is given."""
    topic = _tree(node, _STATIC) if node.program == _STATIC_PUBLISHER else ""
    words = [word.value for word in node.node.arguments]
    words = words[: words.index("--ros-args")] if "--ros-args" in words else words
    if not topic or not all(map(is_known, words)):
        return
    frames = [words[words.index(option) + 1] for option in _OPTIONS if option in words[:-1]]
    if len(words) in _POSITIONAL and not any(word.startswith("--") for word in words):
        frames = words[-2:]
    if len(frames) == len(_OPTIONS):
        parent, child = map(_frame, frames)
        span, cure = node.node.span, f"remove {node.label}"
        word = node.node.arguments[-1]
        if word.span.source.file.endswith(".srdf"):
            # MoveIt's launch file starts one for each virtual joint.
            span, cure = word.span, f"remove <virtual_joint> from {word.span.source.file}"
        yield Transform(parent, child, topic, span, node.label, cure, node)


def is_static(transform: Transform) -> bool:
    """Return whether a static_transform_publisher publishes a transform."""
    source = transform.source
    return isinstance(source, WiredNode) and source.program == _STATIC_PUBLISHER


def _tree(node: WiredNode, topic: str) -> str:
    """Return the topic of the moving transforms that go with a topic of static ones."""
    return node.resolve(topic).removesuffix(_SUFFIX)


def _frame(name: str) -> str:
    return name.removeprefix("/")
