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

import posixpath
from collections.abc import Iterator

from checker.launch.ros1.graph import resolve_name
from checker.model.controllers import Controller
from checker.ros.wiring.endpoints import Endpoint
from checker.ros.wiring.joint_states import JOINT_STATE, invented
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_LOCAL = "use_local_topics"
_USUAL_NAME = "joint_state_broadcaster"
"""A controller that is one by its name, where the file that states its type is not known."""


@rule("WIR016", "two-joint-state-publishers", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report each joint_state_publisher whose topic something else publishes as well."""
    before: list[Endpoint] = []
    for each, node in invented(wiring) if len(wiring.described) <= 1 else ():
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


def _known(wiring: Wiring) -> Iterator[Endpoint]:
    """Yield what certainly publishes measured positions: controllers, and plugins in Gazebo."""
    for each in wiring.endpoints:
        behind = not each.by.startswith("a bridge") and not isinstance(each.owner, WiredNode)
        local = isinstance(each.owner, Controller) and each.owner.flag(_LOCAL, default=False)
        if behind and not local and each.publishes and each.certain and JOINT_STATE in each.types:
            yield each
    configured = {run.controller.name for run in wiring.controllers}
    for spawner in filter(None, (node.spawner for node in wiring.nodes)):
        for name in spawner.names if spawner.manager else ():
            if name.value == _USUAL_NAME and name.value not in configured:
                topic = resolve_name("joint_states", posixpath.dirname(spawner.manager))
                by = f"controller {name.value!r}"
                yield Endpoint(topic, (JOINT_STATE,), True, by, name.span, spawner, certain=True)


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


def _beside(more: str, parameters: str = "", name: str = "states") -> dict[str, object]:
    """Return a rover whose joints are measured, in addition to a joint_state_publisher."""
    nodes = _NODES.replace("@", more).replace('"states"', f'"{name}"')
    return {
        "@bridge": True,
        "@launch": {_HEAD: nodes, _IMPORTS: _CONDITION + _IMPORTS},
        "config/base.yaml": _CONTROLLERS + parameters,
    }


_MARK = "  # ^ WIR016\n             "
_LOCALLY = "states:\n  ros__parameters: {use_local_topics: true}\n"
GOOD = [
    _beside("", _LOCALLY),
    _beside(' parameters=[{"source_list": ["arm/joint_states"]}]'),
    _beside(' parameters=[{"publish_default_positions": False}]'),
    _beside(' remappings=[("joint_states", "shown_states")]'),
    _beside(' condition=IfCondition("false")'),
]
BAD = [
    _beside(_MARK),
    _beside(f'{_MARK}parameters=[{{"rate": 30}}]'),
    _beside(_MARK, name="joint_state_broadcaster"),
]
