"""A joint_state_publisher beside a simulated robot whose joint states Gazebo does not publish.

joint_state_publisher measures nothing: it publishes zero for each joint, or the positions of its
sliders. Gazebo moves the joints, and the transforms stay: in RViz wheels do not turn and arms stand
straight, and points from sensors on moving links are in wrong places. The node often remains from a
launch file that shows the robot in RViz alone.

It is reported for nodes that start with the defaults of all arguments, one robot with joints that
move, and no controller manager: a `<ros2_control>` tag alone starts none. WIR016 reports two
publishers of the same joint states. With `source_list`, joint_state_publisher collects what others
publish: then nothing is reported.

Fix: let Gazebo publish the joint states, and remove joint_state_publisher. In Gazebo Classic that
is the plugin libgazebo_ros_joint_state_publisher.so; in Gazebo Sim the system JointStatePublisher
and a bridge of its topic.
Source: joint_state_publisher; gazebo_plugins, gazebo_ros_joint_state_publisher.
"""

from checker.base.words import and_list, count
from checker.model.robot import Robot
from checker.model.ros_parameters import MANAGER
from checker.ros.ros2_control.robot_control import runs_manager
from checker.ros.unread import unread_files
from checker.ros.wiring.joint_states import JOINT_STATE, PROGRAMS, invented
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import gazebo_control, ros2_control

_NAMED = 3


@rule("LCH027", "joint-states-not-simulated", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report each joint_state_publisher beside a robot in Gazebo, where nothing else publishes."""
    robots = _simulated(wiring)
    if len(robots) != 1 or len(wiring.described) > 1 or _may_publish(wiring, robots[0]):
        return
    moving = [f"{it.scoped_name!r}" for it in robots[0].joints if it.type.value != "fixed"]
    more = [count(len(moving) - _NAMED, "other joint")] if len(moving) > _NAMED else []
    for each, node in invented(wiring) if moving else ():
        yield finding(
            node.node.executable,
            f"{each.by} publishes {each.topic} and measures nothing, and Gazebo publishes no joint "
            f"states: the transforms of {and_list([*moving[:_NAMED], *more])} do not follow the "
            "simulation",
            key=each.topic,
        )


def _simulated(wiring: Wiring) -> list[Robot]:
    """Return the robots that a launch file certainly puts into Gazebo."""
    spawned = [it.robot for it in wiring.spawned if it.node.starts is True]
    return spawned or [*wiring.in_classic]


def _may_publish(wiring: Wiring, robot: Robot) -> bool:
    """Return whether anything else may publish the joint states of a robot in Gazebo."""
    bridges = wiring.simulation.bridges.unread if wiring.simulation is not None else ()
    managers = (it.node.package.value == MANAGER for it in wiring.every_node)
    has_tag = robot.element.child("ros2_control") is not None
    controlled = (has_tag and any(managers)) or any(map(runs_manager, robot.plugins))
    others = (
        each
        for each in wiring.endpoints
        if each.publishes
        and {JOINT_STATE, "*"}.intersection(each.types)
        and not (isinstance(each.owner, WiredNode) and each.owner.program in PROGRAMS)
    )
    unread = any(True for _ in unread_files(wiring.graph))
    return bool(unread or bridges or controlled or any(True for _ in others))


_HEAD = "LaunchDescription([\n"
_IMPORTS = "from launch_ros.actions import Node\n"
_CONDITION = "from launch.conditions import IfCondition\n"
_NODE = """LaunchDescription([
        Node(package="joint_state_publisher", executable="joint_state_publisher",@),
"""
_ROVER = """<robot name="rover">
  <link name="base_link"/>
  <link name="wheel"/>
  <joint name="axle" type="continuous"><parent link="base_link"/><child link="wheel"/></joint>
@</robot>
"""
_SYSTEM = """<gazebo>
  <plugin filename="gz-sim-joint-state-publisher-system"
    name="gz::sim::systems::JointStatePublisher"><topic>joint_states</topic></plugin>
</gazebo>
"""
_BRIDGE = """- topic_name: joint_states
  ros_type_name: sensor_msgs/msg/JointState
  gz_type_name: gz.msgs.Model
  direction: GZ_TO_ROS
"""


def _rover(more: str, parts: str = "", kind: str = "continuous") -> dict[str, object]:
    """Return a rover in Gazebo, in addition to a joint_state_publisher."""
    return {
        "@bridge": True,
        "@launch": {_HEAD: _NODE.replace("@", more), _IMPORTS: _CONDITION + _IMPORTS},
        "urdf/rover.urdf": _ROVER.replace("@", parts).replace("continuous", kind),
    }


_MANAGER = '        Node(package="controller_manager", executable="ros2_control_node"'
_MARK = "  # ^ LCH027\n             "
GOOD = [
    _rover("", kind="fixed"),
    _rover("", ros2_control() + gazebo_control("")),
    _rover(f"),\n{_MANAGER}", ros2_control()),
    _rover(' parameters=[{"source_list": ["rover/joint_states"]}]'),
    _rover(' condition=IfCondition("false")'),
    {**_rover("", _SYSTEM), "@bridge": _BRIDGE},
]
BAD = [
    _rover(_MARK),
    _rover(_MARK, _SYSTEM),
    _rover(_MARK, ros2_control()),
    _rover(f'{_MARK}parameters=[{{"rate": 30}}]'),
]
