"""The publishers of TF's transforms: nodes and bridges of a launch graph."""

from __future__ import annotations

import re
from collections.abc import Iterable

from checker.base.record import Record
from checker.launch.ros1.bridge import Bridge
from checker.launch.ros1.graph import LaunchGraph, Node, resolve_name

# optical_frame_publisher: the node that gives a camera's pictures out in its optical frame.
#
# Gazebo's cameras look along x, ROS's image programs expect z. The node of subt_ros takes
# `input/image` and `input/camera_info` and gives `output/image` and `output/camera_info`, all by
# remaps; started with the argument `depth` it does without camera_info.


PROGRAM = "optical_frame_publisher"
IMAGES = ("input/image", "output/image")
INFOS = ("input/camera_info", "output/camera_info")


class OpticalFrame(Record, eq=False):
    """One optical_frame_publisher.

    Attributes:
        node: The node.
        needed: The names that it must have remaps of.
        remapped: Those of its names that have one, each with the absolute topic it represents.
    """

    node: Node
    needed: tuple[str, ...]
    remapped: dict[str, str]

    @property
    def input_image(self) -> str:
        """The absolute topic that it takes pictures from; empty if no remap names it."""
        return self.remapped.get("input/image", "")


def optical_frames(nodes: Iterable[Node]) -> tuple[OpticalFrame, ...]:
    """Return the optical_frame_publishers among some nodes."""
    return tuple(_optical_frame(node) for node in nodes if node.type == PROGRAM)


def _optical_frame(node: Node) -> OpticalFrame:
    sources = {resolve_name(remap.source, node.namespace, node.name) for remap in node.remaps}
    names = [
        name
        for name in (*IMAGES, *INFOS)
        if resolve_name(name, node.namespace, node.name) in sources
    ]
    needed = IMAGES if "depth" in node.args.split() else (*IMAGES, *INFOS)
    return OpticalFrame(node, needed, {name: node.resolve(name) for name in names})


BROADCASTER = "pose_tf_broadcaster"
"""The node of subt_ros that makes TF of the bridged poses."""

STATE_PUBLISHER = "robot_state_publisher"
_STATIC = (STATE_PUBLISHER, "static_transform_publisher")
_BY_NAME = re.compile(r"(?:\A|[_-])(?:tf2?|transforms?|state)(?:[_.-]|\Z)")
"""Names of programs that publish transforms: `pose_tf_broadcaster`, `odom_to_tf.py`."""

_PUBLISHES_NONE = re.compile(
    r"(?:ros1?_ign_|ros_gz_)\w+|subt_ros|topic_tools|joy|ps3joy|teleop_\w+|rviz|twist_mux"
    r"|joint_state_publisher\w*"
)
"""Packages whose nodes publish no transforms, unless their names state it."""


def publishes_transforms(node: Node) -> bool:
    """Return whether a node's program is one that publishes transforms, by its name."""
    return bool(_BY_NAME.search(node.type))


def may_publish_transforms(node: Node) -> bool:
    """Return whether a node may publish transforms, as far as its package is known."""
    return not _PUBLISHES_NONE.fullmatch(node.package)


def carries_transforms(bridge: Bridge) -> bool:
    """Return whether a bridge passes transforms to TF itself."""
    return bridge.ros_topic in ("/tf", "/tf_static")


def static_transforms(launch: LaunchGraph) -> bool:
    """Return whether static transforms reach ROS: bridged, or published by a node."""
    topics = ("/pose_static", "/tf_static")
    return any(
        bridge.ign_topic.endswith(topics) or bridge.ros_topic.endswith(topics)
        for bridge in launch.bridges
    ) or any(node.type in _STATIC for node in launch.nodes)


def state_publishers(launch: LaunchGraph) -> list[Node]:
    """Return the nodes that publish what the description fixes."""
    return [node for node in launch.nodes if node.type in _STATIC]
