"""Two nodes robot_state_publisher of one name in one launch.

Both publish `robot_description` and the transforms of all joints. Which description other nodes get
is chance: if only one of them knows the controllers or the prefix, RViz, the controller manager or
MoveIt gets the other at times. Parameters that are set by the node's name reach one of them.

Usually a launch file starts one, and includes another that starts one as well. It is reported for
nodes that start with the defaults of all arguments; one that gets no description ends by itself
(WIR027).

Fix: remove one, or give the included launch file an argument that leaves it out.
Source: ROS 2, node names: each node of a graph needs a name of its own; robot_state_publisher.
"""

from checker.ros.wiring.frames import STATE_PUBLISHER, may_get_description
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WIR011", "two-state-publishers", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report each further robot_state_publisher of one full name."""
    first: dict[str, WiredNode] = {}
    for node in wiring.nodes:
        publishes = node.program == STATE_PUBLISHER and may_get_description(node.node)
        if not publishes or not node.full_name:
            continue
        before = first.setdefault(node.full_name, node)
        if before is not node:
            yield finding(
                node.node.executable,
                f"two nodes {node.full_name} start: both publish robot_description and the same "
                "transforms; remove one",
                related=[(before.node.executable, "the first one")],
            )


_NODE = """
        Node(package="robot_state_publisher", executable="robot_state_publisher",{}
             parameters=[{{"robot_description": "<robot name='rover'/>"}}]),
"""
_HEAD = "LaunchDescription([\n"
_OWN = 'executable="robot_state_publisher",\n             parameters=[{"robot_description": desc'


def _example(name: str, mark: str = "") -> dict[str, object]:
    own = {_OWN: _OWN.replace(",\n", f",{mark}\n")}
    return {"@bridge": True, "@launch": {_HEAD: _HEAD + _NODE.format(name), **own}}


_ENDING = 'LaunchDescription([\n        Node(package="robot_state_publisher", executable="@"),\n'

GOOD = [
    _example(' namespace="second",'),
    {"@bridge": True, "@launch": {_HEAD: _ENDING.replace("@", "robot_state_publisher")}},
]
BAD = [_example("", "  # ^ WIR011")]
