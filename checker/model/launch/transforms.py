"""Who publishes the transforms of TF: which nodes and bridges of a launch graph."""

from __future__ import annotations

import re

from checker.model.launch.bridge import Bridge
from checker.model.launch.graph import LaunchGraph, Node

BROADCASTER = "pose_tf_broadcaster"
"""The node of subt_ros that makes TF of the bridged poses."""

STATE_PUBLISHER = "robot_state_publisher"
_STATIC = (STATE_PUBLISHER, "static_transform_publisher")
_BY_NAME = re.compile(r"(?:\A|[_-])(?:tf2?|transforms?|state)(?:[_.-]|\Z)")
"""What programs that publish transforms are called: `pose_tf_broadcaster`, `odom_to_tf.py`."""

_PUBLISHES_NONE = re.compile(
    r"(?:ros1?_ign_|ros_gz_)\w+|subt_ros|topic_tools|joy|ps3joy|teleop_\w+|rviz|twist_mux"
    r"|joint_state_publisher\w*"
)
"""Packages whose nodes publish no transforms, unless their names say so."""


def publishes_transforms(node: Node) -> bool:
    """Whether a node's program is one that publishes transforms, by its name."""
    return bool(_BY_NAME.search(node.type))


def may_publish_transforms(node: Node) -> bool:
    """Whether a node may publish transforms, for all that is known of its package."""
    return not _PUBLISHES_NONE.fullmatch(node.package)


def carries_transforms(bridge: Bridge) -> bool:
    """Whether a bridge passes transforms to TF itself."""
    return bridge.ros_topic in ("/tf", "/tf_static")


def static_transforms(launch: LaunchGraph) -> bool:
    """Whether transforms that do not change reach ROS: bridged, or published by a node."""
    topics = ("/pose_static", "/tf_static")
    return any(
        bridge.ign_topic.endswith(topics) or bridge.ros_topic.endswith(topics)
        for bridge in launch.bridges
    ) or any(node.type in _STATIC for node in launch.nodes)


def state_publishers(launch: LaunchGraph) -> list[Node]:
    """Return the nodes that publish what the description fixes."""
    return [node for node in launch.nodes if node.type in _STATIC]
