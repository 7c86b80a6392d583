"""A joint_state_publisher next to another publisher of the same joint states.

joint_state_publisher publishes positions of all joints that nothing measures: zero, or those of its
sliders. Where a joint_state_broadcaster or Gazebo publishes the measured ones on the same topic,
robot_state_publisher gets both in turn: in RViz the joints jump to and fro, and MoveIt plans from
wrong positions. It often remains from a launch file that shows a robot without controllers.

It is reported for nodes that start with the defaults of all arguments, and one robot. With
`source_list`, joint_state_publisher collects what others publish: then nothing is reported.

Fix: remove joint_state_publisher, or start it where nothing else publishes the joints.
Source: joint_state_publisher; ros2_controllers, joint_state_broadcaster.
"""

from collections.abc import Iterator

from checker.ros.wiring.endpoints import Endpoint
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_PROGRAMS = (
    "joint_state_publisher/joint_state_publisher",
    "joint_state_publisher_gui/joint_state_publisher_gui",
)
_STATES = "sensor_msgs/msg/JointState"
_COLLECTS = "source_list"
_DEFAULTS = "publish_default_positions"


@rule("WIR016", "two-joint-state-publishers", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report each joint_state_publisher whose topic something else publishes as well."""
    before: list[Endpoint] = []
    for each in wiring.endpoints if len(wiring.described) <= 1 else ():
        if not (each.publishes and each.certain and _STATES in each.types):
            continue
        node = each.owner
        if not isinstance(node, WiredNode) or node.program not in _PROGRAMS:
            continue
        if not _invents(node):
            continue
        others = [it for it in _known(wiring) if it.topic == each.topic]
        others += [it for it in before if it.topic == each.topic]
        before.append(each)
        if others:
            yield finding(
                node.node.executable,
                f"{each.by} and {others[0].by} both publish {each.topic}: the joints jump between "
                f"two positions; remove {node.node.executable.value}",
                key=each.topic,
                related=[(it.span, f"{it.by} publishes {it.topic}") for it in others],
            )


def _invents(node: WiredNode) -> bool:
    """Return whether a joint_state_publisher certainly publishes what nothing measures."""
    switch = node.settings.get(_DEFAULTS)
    on = switch is None or switch.text == "true"
    return node.knows_parameters and on and _COLLECTS not in node.settings


def _known(wiring: Wiring) -> Iterator[Endpoint]:
    """Yield what certainly publishes measured positions: controllers, and plugins in Gazebo."""
    for each in wiring.endpoints:
        behind = not each.by.startswith("a bridge") and not isinstance(each.owner, WiredNode)
        if behind and each.publishes and each.certain and _STATES in each.types:
            yield each


_HEAD = "LaunchDescription([\n"
_IMPORTS = "from launch_ros.actions import Node\n"
_CONDITION = "from launch.conditions import IfCondition\n"
_NODES = """LaunchDescription([
        Node(package="controller_manager", executable="ros2_control_node",
             parameters=[os.path.join(HERE, "config", "base.yaml")]),
        Node(package="controller_manager", executable="spawner", arguments=["states"]),
        Node(package="joint_state_publisher", executable="joint_state_publisher",@),
"""
_CONTROLLERS = """controller_manager:
  ros__parameters:
    states: {type: joint_state_broadcaster/JointStateBroadcaster}
"""


def _beside(more: str) -> dict[str, object]:
    """Return a rover whose joints are measured, in addition to a joint_state_publisher."""
    return {
        "@bridge": True,
        "@launch": {_HEAD: _NODES.replace("@", more), _IMPORTS: _CONDITION + _IMPORTS},
        "config/base.yaml": _CONTROLLERS,
    }


_MARK = "  # ^ WIR016\n             "
GOOD = [
    _beside(' parameters=[{"source_list": ["arm/joint_states"]}]'),
    _beside(' parameters=[{"publish_default_positions": False}]'),
    _beside(' remappings=[("joint_states", "shown_states")]'),
    _beside(' condition=IfCondition("false")'),
]
BAD = [_beside(_MARK), _beside(f'{_MARK}parameters=[{{"rate": 30}}]')]
