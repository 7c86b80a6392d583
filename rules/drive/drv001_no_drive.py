"""A robot without a known drive plugin, or with rotors that nothing commands.

No known plugin moves the robot: the trial can only let it settle, and cannot show how it drives.

Fix: add the drive plugin to the spawner, such as DiffDrive; a robot with its own plugin needs no
other.
Source: the Gazebo systems that drive the robots of the SubT challenge.
"""

from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked


@rule("DRV001", "no-drive", Severity.INFO, Concern.ROBOT)
def check(package: Package, robot: Robot, context: Context) -> Findings:
    """Report robots that no known plugin drives; packages for others to build on need none.

    Rotors without a controller are a warning for submissions; elsewhere an autopilot may command
    them.
    """
    moved = robot.locomotion
    if package.kind is PackageKind.BASE_MODEL or moved.kind is not DriveKind.NONE:
        if moved.rotors and not moved.copters and context.is_subt:
            yield from _uncommanded_rotors(robot)
        return
    reason = robot.unread_plugins or robot.missing_parts
    if reason:
        yield unchecked(reason)
        return
    yield finding(
        robot,
        f"no known plugin drives {robot.name.value!r}: add a drive plugin to the spawner; the "
        "trial only lets the robot settle",
    )


def _uncommanded_rotors(robot: Robot) -> Findings:
    reason = robot.unread_plugins or robot.missing_parts
    if reason:
        yield unchecked(reason)
        return
    yield finding(
        robot.locomotion.rotors[0].plugin,
        "no plugin commands the rotors: add MulticopterVelocityControl to the spawner",
        severity=Severity.WARNING,
        key="rotors",
    )


GOOD = [
    """
<link name="wheel"/>
<joint name="axle" type="revolute"><parent>base_link</parent><child>wheel</child></joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>axle</left_joint>
</plugin>
""",
    '<plugin filename="libp.so" name="gz::sim::systems::MulticopterVelocityControl"/>',
    {"@name": "acme_rover_base", "launch/spawner.rb": None, "launch/vehicle_topics.launch": None},
]
BAD = [
    """
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">  <!-- ^ DRV001 -->
<link name="base_link"/>
<plugin filename="libp.so" name="ignition::gazebo::systems::PosePublisher"/>
</model>
</sdf>
""",
    """
<link name="rotor"/>
<joint name="shaft" type="revolute"><parent>base_link</parent><child>rotor</child></joint>
<plugin filename="libp.so"  name="ignition::gazebo::systems::MulticopterMotorModel"><!--^ DRV001-->
  <jointName>shaft</jointName><linkName>rotor</linkName>
  <motorConstant>1e-5</motorConstant><maxRotVelocity>800</maxRotVelocity>
</plugin>
""",
]
