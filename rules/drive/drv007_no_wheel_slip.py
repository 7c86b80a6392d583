"""A skid-steer robot without the WheelSlip plugin.

The wheels of such a robot must slip sideways in a turn. Without the plugin they grip the ground:
the robot hops, turns in jerks or does not turn. None of the accepted packages that we checked shows
this.

Fix: add WheelSlip to what the spawner emits, with a `<wheel>` for each wheel:
`slip_compliance_lateral` above zero, `wheel_normal_force` m·g/n in N and `wheel_radius` in m.
Source: SubT maintainers ask for it in their reviews of skid-steer robots.
"""

from checker.model.locomotion.locomotion import Side
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("DRV007", "no-wheel-slip", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report DiffDrive plugins with several wheels on a side; tracks need no slip."""
    reason = robot.unread_plugins or robot.missing_parts
    if reason:
        yield unchecked(reason)
        return
    moves = robot.locomotion
    slips = any(plugin.class_name == "WheelSlip" for plugin in robot.all_plugins)
    if slips or moves.tracks or moves.tracked_drives:
        return
    for drive in moves.wheel_drives:
        most = max(len(drive.on(side)) for side in Side)
        if drive.plugin.class_name == "DiffDrive" and most > 1:
            yield finding(
                drive.plugin,
                f"DiffDrive turns {most} wheels on a side, but there is no WheelSlip: skid-steer "
                "wheels must slip sideways in a turn",
            )


def _rover(wheels: int, more: str = "", drive: str = "DiffDrive", mark: str = "") -> str:
    links = "".join(
        f"""
<link name="wheel_{n}"/>
<joint name="axle_{n}" type="revolute"><parent>base_link</parent><child>wheel_{n}</child></joint>"""
        for n in range(wheels)
    )
    sides = ("left_joint", "right_joint")
    joints = "".join(f"<{sides[n % 2]}>axle_{n}</{sides[n % 2]}>" for n in range(wheels))
    return f"""{links}
<plugin filename="libp.so" name="ignition::gazebo::systems::{drive}">{mark}
  {joints}
</plugin>
{more}
"""


_MARK = "  <!-- ^ DRV007 -->"
GOOD = [
    _rover(2),
    _rover(4, '<plugin filename="libw.so" name="ignition::gazebo::systems::WheelSlip"/>'),
    _rover(4, drive="AckermannSteering"),
    _rover(4, '<plugin filename="libt.so" name="gz::sim::systems::TrackedVehicle"/>'),
]
BAD = [_rover(4, mark=_MARK), _rover(6, mark=_MARK).replace("ignition::gazebo", "gz::sim")]
