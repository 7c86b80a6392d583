"""A skid-steer robot without the WheelSlip plugin.

The wheels of such a robot must slip sideways in a turn. Without the plugin they grip the ground:
the robot hops, turns in jerks or does not turn. Wheels count over all DiffDrive plugins: one for
the front and one for the rear wheels make a skid-steer robot, too. No accepted package that we
checked has this fault.

Fix: add WheelSlip to what the spawner emits, with a `<wheel>` for each wheel:
`slip_compliance_lateral` above zero, `wheel_normal_force` m·g/n in N and `wheel_radius` in m.
Source: SubT maintainers require it in their reviews of skid-steer robots.
"""

from collections.abc import Sequence

from checker.model.locomotion.locomotion import Side, WheelDrive
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
    drives = [drive for drive in moves.wheel_drives if drive.plugin.class_name == "DiffDrive"]
    alone = [drive for drive in drives if _most([drive]) > 1]
    together = 0 if alone else _most(drives)
    for drive in alone or drives:
        most = together or _most([drive])
        who = "DiffDrive turns" if alone else f"{len(drives)} DiffDrive plugins turn"
        if most > 1:
            yield finding(
                drive.plugin,
                f"{who} {most} wheels on a side, but there is no WheelSlip: skid-steer wheels "
                "must slip sideways in a turn",
            )


def _most(drives: Sequence[WheelDrive]) -> int:
    """Return how many wheels drives turn on the side that has more, each counted once."""
    sides = ({wheel.joint for drive in drives for wheel in drive.wheels_on(side)} for side in Side)
    return max(map(len, sides))


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


def _twice(second: int, mark: str = "") -> str:
    """Return a robot of four wheels with a drive for the front ones, and one for others."""
    rover = _rover(4, drive="AckermannSteering")
    bare = rover[: rover.index("<plugin")]
    return bare + _drive(0, mark) + _drive(second, mark)


def _drive(first: int, mark: str) -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">{mark}
  <left_joint>axle_{first}</left_joint><right_joint>axle_{first + 1}</right_joint>
</plugin>"""


_MARK = "  <!-- ^ DRV007 -->"
GOOD = [
    _twice(0),
    _rover(2),
    _rover(4, '<plugin filename="libw.so" name="ignition::gazebo::systems::WheelSlip"/>'),
    _rover(4, drive="AckermannSteering"),
    _rover(4, '<plugin filename="libt.so" name="gz::sim::systems::TrackedVehicle"/>'),
]
BAD = [
    _rover(4, mark=_MARK),
    _rover(6, mark=_MARK).replace("ignition::gazebo", "gz::sim"),
    _twice(2, _MARK),
]
