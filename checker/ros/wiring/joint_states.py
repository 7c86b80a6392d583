"""Publishers of joint states that nothing measures."""

from __future__ import annotations

from collections.abc import Iterator

from checker.ros.wiring.endpoints import Endpoint
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring

JOINT_STATE = "sensor_msgs/msg/JointState"
PROGRAMS = (
    "joint_state_publisher/joint_state_publisher",
    "joint_state_publisher_gui/joint_state_publisher_gui",
)
_COLLECTS = "source_list"
_DEFAULTS = "publish_default_positions"


def invented(wiring: Wiring) -> Iterator[tuple[Endpoint, WiredNode]]:
    """Yield what certainly publishes positions that nothing measures, each with its node."""
    for each in wiring.endpoints:
        node = each.owner
        if not (each.publishes and each.certain and JOINT_STATE in each.types):
            continue
        if isinstance(node, WiredNode) and node.program in PROGRAMS and _invents(node):
            yield each, node


def _invents(node: WiredNode) -> bool:
    """Return whether a joint_state_publisher certainly publishes what nothing measures."""
    switch = node.settings.get(_DEFAULTS)
    on = switch is None or switch.text == "true"
    return node.knows_parameters and on and _COLLECTS not in node.settings
