"""A fast robot whose specifications.md links no measurement.

Above 1 m/s on the ground and 4 m/s in the air, the organisers require proof from the real robot: a
video or a recording, with a link in specifications.md. Datasheets of sensors prove nothing
about speed, and neither do placeholders such as `https://youtu.be/xxxx`. Of the accepted packages
that we checked, two show this: one links only datasheets, the other placeholders.

A link proves speed in the section "Validation and Specification Links" or in the one on motion,
unless its line is about a device. It does not where specifications.md says that the test was not
made or is planned.

Fix: link the video or the data in the section "Validation and Specification Links". Without a
measurement, lower the limits.
Source: SubT Model Preparation Guide; reviews limit robots to 1 m/s "until validation is completed".
"""

from checker.model.locomotion.motion_limits import (
    BoundedMotion,
    bounded_motions,
    is_unlimited,
)
from checker.model.robot import Robot
from checker.model.specification.motion import MotionQuantity
from checker.model.specification.proof import Proven
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Findings, HasSpan, Severity, finding, rule, unchecked
from checker.source.text import Located


@rule("DRV005", "unvalidated-speed", Severity.WARNING, Concern.PAPERWORK)
def check(
    robot: Robot, specification: Specification, *, ground: float = 1.0, air: float = 4.0
) -> Findings:
    """Report robots that may go faster than `ground` or `air` without validation links.

    Options:
        ground: Greatest speed, m/s, that a drive with wheels or tracks may allow without links to
            measurements.
        air: Greatest speed, m/s along any axis, that a multicopter's controller may allow without
            links to measurements.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    too_fast = [
        (speed, motion)
        for motion in bounded_motions(robot.locomotion)
        if motion.kind == "linear"
        for speed in motion.velocity
        if speed is not None
        and not is_unlimited(speed)
        and abs(speed.value) > (air if motion.flies else ground)
    ]
    if not too_fast or specification.proves(Proven.SPEED):
        return
    speed, motion = max(too_fast, key=lambda pair: abs(pair[0].value))
    allowed = air if motion.flies else ground
    yield finding(
        _place(specification, motion, speed),
        f"the drive allows {abs(speed.value):g} m/s, above {allowed:g} m/s: link a video or data "
        "that proves it in specifications.md",
        related=[(speed, "the limit of the model")],
    )


def _place(sheet: Specification, motion: BoundedMotion, speed: Located[float]) -> HasSpan:
    """Return where the sheet states the speed, else its section on motion, else the limit."""
    claim = sheet.limit(MotionQuantity.LINEAR_VELOCITY, motion.axis)
    return claim or sheet.section("motion") or speed


def _drive(speed: str, mark: str = "") -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <max_velocity>{speed}</max_velocity>{mark}
</plugin>
"""


_MARK = " <!-- ^ DRV005 -->"
_COPTER = """
<plugin filename="libp.so" name="ignition::gazebo::systems::MulticopterVelocityControl">
  <maximumLinearVelocity>5 4 3</maximumLinearVelocity>
</plugin>
"""
_LINKS = "## Validation and Specification Links\n"
_VIDEO = "https://youtu.be/H15Kpvpepv4"


def _sheet(motion: str, validation: str = "", more: str = "") -> dict[str, str]:
    return {
        "@fragment": _drive("2"),
        "specifications.md": f"# Rover\n{more}\n## Motion {motion}\n{_LINKS}{validation}\n",
    }


GOOD = [
    _drive("1"),
    _COPTER.replace("5 4 3", "4 4 3"),
    _drive("1.79769e308"),
    {
        "@fragment": _drive("2"),
        "specifications.md": f"# Rover\n{_LINKS}* Speed test - https://youtu.be/H15Kpvpepv4\n",
    },
    {
        "@fragment": _COPTER,
        "specifications.md": f"# Rover\n{_LINKS}* [Validation data](https://acme.com/flights.bag)\n",
    },
    _sheet(f"\nIt drives 2 m/s: {_VIDEO}"),
    _sheet("\nIt drives 2 m/s.", f"* Speed: {_VIDEO}\n* Maximum angular speed: TBD"),
    _sheet("\nThe turning radius was not measured.", f"* {_VIDEO}"),
]
BAD = [
    _drive("2", _MARK),
    {
        "@fragment": _drive("2"),
        "specifications.md": f"# Rover\n## Motion\n_x_ velocity range from -2 m/s to 2 m/s{_MARK}\n"
        f"{_LINKS}* [Lidar datasheet](https://www.sick.com/lms1xx)\n",
    },
    {
        "@fragment": _COPTER,
        "specifications.md": f"# Rover\n## Motion{_MARK}\nIt flies.\n"
        f"{_LINKS}* [Validation video](https://youtu.be/xxxxxxxxx/)\n",
    },
    _sheet(f"{_MARK}\nIt drives 2 m/s.", f"* Camera: {_VIDEO}"),
    _sheet(f"{_MARK}\nIt drives 2 m/s.", more=f"## Sensors\n* Ouster OS1: {_VIDEO}"),
    _sheet(f"{_MARK}\nThe speed was not tested yet.", f"* {_VIDEO}"),
    _sheet(f"{_MARK}\nIt drives 2 m/s.", f"* {_VIDEO}\n* Maximum linear speed: to be measured"),
]
