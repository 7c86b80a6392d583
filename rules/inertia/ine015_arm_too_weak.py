"""A joint whose effort limit is too low to hold its load in every pose.

In the pose with the largest load, such as a stretched arm, gravity needs more torque than the
joint's effort limit. There the arm drops, and a controller cannot move it through such poses. With
`--payload KG`, or `payload` in the settings, the arm also carries that mass at the origin of the
last link that is not a finger. Joints above parts that are on the ground are skipped, and so are
the six of a floating base, which stays upright. Poses in which parts collide are included.

Fix: write the motor's stall torque (after its gear) as the effort limit, correct the masses of the
parts that the joint carries, or restrict the joints to poses that the robot can hold.
Source: statics; generalized gravity of Pinocchio, maximized over one joint after another.
"""

from checker.physics.mass.arm_loads import ArmLoads
from checker.physics.mass.pose_search import JointLoad
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_SHOWN = 4
"""Joints of the pose in a message."""


@rule("INE015", "arm-too-weak", Severity.WARNING, Concern.ROBOT)
def check(arms: ArmLoads, context: Context, *, warning_above: float = 1.5) -> Findings:
    """Report driven joints that cannot hold their load in every pose.

    Options:
        warning_above: Multiple of the effort limit; more is a warning, and less, above the limit,
            is an info.
    """
    robot = arms.masses.robot
    if robot.is_static or not arms.joints:
        return
    if arms.unknown:
        yield unchecked(arms.unknown)
        return
    payload = context.payload
    stated = robot.conventions.states_devices
    for load in arms.loads(payload):
        limit = load.joint.axes[0].effort
        driven = not stated or load.joint.scoped_name in robot.driven_joints
        if driven and load.effort > limit.value:
            weak = load.effort > warning_above * limit.value
            yield finding(
                limit,
                _message(load, robot.other_gravity, arms.tool if payload else "", payload),
                severity=Severity.WARNING if weak else Severity.INFO,
                covered_by=("INE010",),
            )


def _message(load: JointLoad, gravity: str, tool: str, payload: float) -> str:
    joint = load.joint
    unit = "N" if joint.type.value == "prismatic" else "N·m"
    pose = ", ".join(f"{name} at {at:.3g}" for name, at in list(load.pose.items())[:_SHOWN])
    carried = f" with {payload:g} kg at {tool!r}" if tool else ""
    return (
        f"joint {joint.name.value!r} has to hold {load.effort:.3g} {unit} against gravity"
        f"{gravity}{carried} in a pose that its limits allow ({pose}), but its effort "
        f"limit is {joint.axes[0].effort.value:.3g} {unit}"
    )


def _arm(effort: str, mark: str = "", upper: str = "1.6") -> str:
    """An arm that hangs down at 0, of 2 kg whose centre is 0.5 m from the shoulder."""
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <inertial><mass>20</mass></inertial>
  <collision name="c"><geometry><box><size>1 1 0.2</size></box></geometry></collision>
</link>
<link name="arm">
  <pose>0 0 0.9 0 0 0</pose>
  <inertial><pose>0 0 -0.5 0 0 0</pose><mass>2</mass></inertial>
</link>
<joint name="shoulder" type="revolute">
  <parent>base_link</parent>
  <child>arm</child>
  <axis>
    <xyz>0 1 0</xyz>
    <limit><lower>-0.1</lower><upper>{upper}</upper>
      <effort>{effort}</effort>{mark}
    </limit>
  </axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::JointPositionController">
  <joint_name>shoulder</joint_name>
</plugin>
</model>
</sdf>
"""


GOOD = [_arm("12"), _arm("4", upper="0.3")]
BAD = [_arm("8", "  <!-- ^ INE015 -->"), _arm("4", "  <!-- ^ INE015 -->")]
