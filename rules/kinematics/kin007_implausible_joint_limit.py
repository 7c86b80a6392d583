"""An effort or velocity limit that no motor has, or a driven joint without limits.

A driven joint with a limit of zero does not move: its plugin cannot apply a force, or reach any
speed. The limiter of ros2_control, enabled by default from Kilted on, does the same for joints with
a command interface. DART, the default physics engine of Gazebo Sim, locks a joint whose velocity
limit is zero, including passive wheels. gazebo_ros_control of ROS 1 cuts the efforts, speeds and
steps of its controllers to the limits of the URDF, zero included; the drive plugins of Gazebo
Classic turn their wheels with a motor of the physics engine, past these limits. The SolidWorks
exporter writes `effort="0" velocity="0"` by default.

With a limit of 1e9 N·m a wheel never stalls on any slope, and one collision can throw the robot
away; it is an info in a URDF beside models of MuJoCo, which alone are simulated. Without a limit,
the rules cannot check whether the motor is strong enough. Rotors need none: their plugin limits the
thrust.

Fix: write the motor's stall torque (N·m) as `effort` and its no-load speed (rad/s) as `velocity`,
both after the gear.
Source: SDFormat specification, axis/limit: "-1" and no value mean unlimited; gz-physics 9,
dartsim/src/SDFFeatures.cc: zero is a limit. gazebo-classic 11, `Joint::CheckAndTruncateForce`: so
it is there, and a negative limit is none; ros_control, joint_limits_interface: saturation handles.
"""

import math
from collections.abc import Iterator

from checker.formats.urdf.description import motor_interfaces
from checker.model.components import Axis, Joint, Plugin
from checker.model.plugin_library import library_stem
from checker.model.robot import MUJOCO_SIMULATED, Robot
from checker.ros.ros2_control.distributions import distribution_of, is_from, is_of_gazebo
from checker.ros.ros2_control.hardware import Hardware, read_hardware
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked

_MOTORS = (
    *("DiffDrive", "AckermannSteering", "MecanumDrive"),
    *("JointController", "JointPositionController", "JointTrajectoryController"),
)
"""Systems of Gazebo that keep to the limits of a joint."""
_MANAGER = "gazebo_ros_control"
_ROTORS = ("MulticopterMotorModel", "MulticopterVelocityControl", "Thruster")


@rule("KIN007", "implausible-joint-limit", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot,
    context: Context,
    *,
    highest_effort: float = 1e5,
    highest_velocity: float = 1e3,
) -> Findings:
    """Report finite limits of effort and velocity that no motor has.

    A missing limit of a driven joint is an info, one of zero is an error; of a joint of
    ros2_control it is a warning before Kilted, unless Gazebo moves it by a force, and of any other
    joint of a URDF that may use an effort, or that Gazebo holds. One whose position limits are
    equal has no motor: it is KIN009's.

    Options:
        highest_effort: Effort in N·m (sliding joints: N); a finite limit above it is a warning.
        highest_velocity: Velocity in rad/s (sliding joints: m/s); a finite limit above it is a
            warning.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    highest = {"effort": highest_effort, "velocity": highest_velocity}
    commanded, stated = _commanded_joints(robot), robot.conventions.states_devices
    managed = _managed_joints(robot)
    placeholder = Severity.INFO if robot.shown_only == MUJOCO_SIMULATED else None
    for joint in robot.joints:
        driver = robot.driven_joints.get(joint.scoped_name)
        for axis in joint.axes:
            yield from _too_high(joint, axis, highest, placeholder)
            yield from _cut_to_zero(joint, axis, managed.get(joint.name.value, set()))
            if driver is not None and driver.class_name not in _ROTORS:
                yield from _missing(joint, axis)
                yield from _zero(joint, axis, driver)
            elif (hardware := commanded.get(joint.scoped_name)) is not None:
                yield from _missing(joint, axis)
                yield from _zero_limits(joint, axis, hardware, context)
            elif driver is None and not (stated or joint.immovable or joint.name.value in managed):
                held = context.is_gazebo_sim and robot.is_for_gazebo
                yield from _still(joint, axis, held=held)


def _too_high(
    joint: Joint, axis: Axis, highest: dict[str, float], severity: Severity | None
) -> Iterator[Finding]:
    for kind, limit in (("effort", axis.effort), ("velocity", axis.velocity)):
        if highest[kind] < limit.value < math.inf:
            yield finding(
                limit,
                f"joint {joint.name.value!r} has the {kind} limit {limit.value:g} "
                f"{_unit(joint)[kind]}, expected at most {highest[kind]:g}",
                severity=severity,
                key=f"{kind} {limit.value:g}",
            )


def _zero(joint: Joint, axis: Axis, driver: Plugin) -> Iterator[Finding]:
    for kind, limit in (("effort", axis.effort), ("velocity", axis.velocity)):
        if limit.stated and limit.value == 0.0 and driver.class_name in _MOTORS:
            yield finding(
                limit,
                f"joint {joint.name.value!r} has the {kind} limit 0, so {driver.class_name} cannot "
                "move it",
                severity=Severity.ERROR,
                key="zero",
            )


def _managed_joints(robot: Robot) -> dict[str, set[str]]:
    """Return the joints that gazebo_ros_control of ROS 1 commands, each with its interfaces."""
    loaded = any(library_stem(plugin.filename.value) == _MANAGER for plugin in robot.plugins)
    return motor_interfaces(robot) if loaded else {}


def _cut_to_zero(joint: Joint, axis: Axis, interfaces: set[str]) -> Iterator[Finding]:
    """Report limits of zero to which gazebo_ros_control cuts what controllers command."""
    for kind, limit in (("effort", axis.effort), ("velocity", axis.velocity)):
        cut = interfaces if kind == "velocity" else interfaces & {"effort", "velocity"}
        if limit.stated and limit.value == 0.0 and cut:
            yield finding(
                limit,
                f"joint {joint.name.value!r} has the {kind} limit 0, to which {_MANAGER} cuts what "
                "controllers command, so they cannot move it",
                key="zero",
            )


def _commanded_joints(robot: Robot) -> dict[str, Hardware]:
    """Return the joints that ros2_control commands, each with its hardware."""
    return {
        joint.name.value: hardware
        for hardware in read_hardware(robot.element)
        for joint in hardware.joints
        if joint.commands
    }


def _zero_limits(
    joint: Joint, axis: Axis, hardware: Hardware, context: Context
) -> Iterator[Finding]:
    commands = hardware.joints_by_name[joint.name.value].commands
    pushed = any(command.name.value == "effort" for command in commands)
    # Gazebo Classic sets positions and velocities without any force.
    forced = is_of_gazebo(hardware.plugin.value) and (pushed or not context.is_classic)
    certain = forced or is_from(distribution_of(context), "kilted")
    for kind, limit in (("effort", axis.effort), ("velocity", axis.velocity)):
        if limit.stated and limit.value == 0.0 and (kind == "velocity" or forced or pushed):
            yield finding(
                limit,
                f"joint {joint.name.value!r} has the {kind} limit 0, but <ros2_control> "
                f"{hardware.name.value!r} commands it",
                severity=Severity.ERROR if certain else None,
                key="zero",
            )


def _still(joint: Joint, axis: Axis, *, held: bool) -> Iterator[Finding]:
    """Report a joint that nothing commands and that may not turn, as exporters of CAD write it."""
    if not axis.velocity.stated or axis.velocity.value != 0.0 or axis.effort.value == math.inf:
        return
    moves = (
        "Gazebo does not let it move"
        if held
        else "controllers that respect the limit do not move the joint"
    )
    yield finding(
        axis.velocity,
        f"joint {joint.name.value!r} has the effort limit {axis.effort.value:g} "
        f"{_unit(joint)['effort']} and the velocity limit 0: {moves}",
        severity=None if held or axis.effort.value > 0.0 else Severity.INFO,
        key="zero",
    )


def _missing(joint: Joint, axis: Axis) -> Iterator[Finding]:
    limits = {"effort": axis.effort, "velocity": axis.velocity}
    missing = [kind for kind, limit in limits.items() if math.isinf(limit.value)]
    if missing:
        names = " and ".join(missing)
        yield finding(
            limits[missing[0]],
            f"driven joint {joint.name.value!r} has no limit of {names}",
            severity=Severity.INFO,
            key=names,
        )


def _unit(joint: Joint) -> dict[str, str]:
    if joint.type.value == "prismatic":
        return {"effort": "N", "velocity": "m/s"}
    return {"effort": "N·m", "velocity": "rad/s"}


def _driven(limit: str, plugin: str = "JointController") -> str:
    return f"""
<link name="arm"/>
<joint name="elbow" type="revolute">
  <parent>base_link</parent>
  <child>arm</child>
  <axis>
    <xyz>0 0 1</xyz>
    {limit}
  </axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::{plugin}">
  <joint_name>elbow</joint_name>
</plugin>
"""


def _controlled(
    limit: str, hardware: str = "mock_components/GenericSystem", joint: str = "wrist"
) -> dict[str, str]:
    return {
        "@urdf": f"""
<link name="hand"/>
<joint name="wrist" type="revolute">
  <parent link="upper_arm"/>
  <child link="hand"/>
  {limit}
</joint>
<ros2_control name="arm" type="system">
  <hardware><plugin>{hardware}</plugin></hardware>
  <joint name="{joint}"><command_interface name="position"/></joint>
</ros2_control>
"""
    }


def _managed(limit: str, interface: str = "Effort") -> dict[str, str]:
    """Return a wheel of ros_control in ROS 1, which a drive plugin turns as well."""
    wheel = f"""
<link name="hub"/>
<joint name="spin" type="continuous">
  <parent link="upper_arm"/><child link="hub"/>
  {limit}
</joint>
<transmission name="t">
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="spin">
    <hardwareInterface>hardware_interface/{interface}JointInterface</hardwareInterface>
  </joint>
  <actuator name="motor"/>
</transmission>
<gazebo>
  <plugin name="control" filename="libgazebo_ros_control.so"/>
  <plugin name="drive" filename="libgazebo_ros_diff_drive.so"><leftJoint>spin</leftJoint></plugin>
</gazebo>
"""
    return {"@urdf": wheel, "@profile": "urdf"}


_STEADY = '<limit lower="-1" upper="1" effort="5" velocity="1"/>'
_HELD = '<limit lower="-1" upper="1" effort="5" velocity="0"/>'


def _passive(velocity: str, mark: str = "") -> dict[str, str]:
    roller = f"""
<link name="roller"/>
<joint name="roll" type="continuous">
  <parent link="upper_arm"/><child link="roller"/>
  <limit effort="0" velocity="{velocity}"/>{mark}
</joint>
<gazebo/>
"""
    return {"@urdf": roller, "@profile": "ros2"}


GOOD = [
    _managed('<limit effort="2" velocity="30"/>'),
    _managed('<limit effort="0" velocity="30"/>', "Position"),
    _passive("10"),
    _controlled('<limit lower="0" upper="0" effort="5" velocity="0"/>', joint="shoulder"),
    _driven("<limit><effort>20</effort><velocity>3</velocity></limit>"),
    _driven("", "JointStatePublisher"),
    _driven("<limit><effort>0</effort><velocity>0</velocity></limit>", "JointStatePublisher"),
    _controlled(_STEADY),
    _controlled('<limit lower="-1" upper="1" effort="0" velocity="1"/>'),
]
BAD = [
    _managed('<limit effort="0.0" velocity="0.0"/>  <!-- ^ KIN007 --><!-- ^ KIN007 -->'),
    _managed('<limit effort="0" velocity="30"/>  <!-- ^ KIN007 -->'),
    _passive("0", "  <!-- ^ KIN007 -->"),
    _driven("<limit><effort>1e9</effort><velocity>3</velocity></limit>  <!-- ^ KIN007 -->"),
    _driven("<limit><effort>20</effort><velocity>50000</velocity></limit>  <!-- ^ KIN007 -->"),
    _driven("<limit><effort>-1</effort><velocity>3</velocity></limit>  <!-- ^ KIN007 -->"),
    _driven("<limit><effort>0</effort><velocity>3</velocity></limit>  <!-- ^ KIN007 -->"),
    _controlled(f"{_HELD}  <!-- ^ KIN007 -->"),
    _controlled(f"{_HELD}  <!-- ^ KIN007 -->", joint="shoulder"),
    _controlled(f"{_HELD}  <!-- ^ KIN007 -->", "gz_ros2_control/GazeboSimSystem"),
]
