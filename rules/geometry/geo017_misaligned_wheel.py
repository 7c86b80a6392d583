"""A wheel is farther out than its neighbour, but not on the other side of the robot.

The robot is not symmetric: a number of this wheel's pose is probably wrong. The wheels of one side
may have different distances from the middle if those of the other side have the same. No robot that
we checked, among those accepted and published, shows this. It is measured across the robot: that
an axle is turned by a few degrees does not count.

Fix: correct the pose of the wheel's joint or link, or the pose of its collision.
Source: geometry of the collisions that the drive's wheels roll on.
"""

from checker.model.locomotion.wheel_tracks import wheels_out_of_line
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ball_wheel


@rule("GEO017", "misaligned-wheel", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, step: float = 0.02) -> Findings:
    """Report wheels of a drive that stand out on one side alone.

    Options:
        step: Metres by which two wheels of one side may be farther apart across the robot than
            those of the other side.
    """
    for found in wheels_out_of_line(robot, step):
        yield finding(
            found.wheel.link.pose,
            f"wheel {found.wheel.link.name.value!r} is {found.step * 1e3:.3g} mm farther out "
            f"than {found.neighbour.link.name.value!r}, but the one on the other side "
            f"{found.other_step * 1e3:.3g} mm: expected the same",
            related=[(found.neighbour.link, "the neighbour")],
        )


def _rover(front_left: float, front_right: float, mark: str = "") -> str:
    places = {
        "front_left": (0.3, front_left),
        "front_right": (0.3, front_right),
        "rear_left": (-0.3, 0.2),
        "rear_right": (-0.3, -0.2),
    }
    wheels = "".join(
        ball_wheel(name, *place, mark if name == "front_left" else "")
        for name, place in places.items()
    )
    joints = "".join(
        f"<{name.rpartition('_')[2]}_joint>{name}_axle</{name.rpartition('_')[2]}_joint>"
        for name in places
    )
    return f"""{wheels}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">{joints}</plugin>
"""


def _turned() -> str:
    """Return a rover whose front axles are turned by 0.08 rad, as in the pose of a drawing."""
    text = _rover(0.2, -0.2)
    for y in (0.2, -0.2):
        text = text.replace(f"<pose>0.3 {y} 0 0 0 0<", f"<pose>0.3 {y} 0 0 0 0.08<")
    return text


_MARK = "  <!-- ^ GEO017 -->"
GOOD = [_rover(0.2, -0.2), _rover(0.3, -0.3), _rover(0.21, -0.2), _turned()]
BAD = [_rover(0.3, -0.2, _MARK), _rover(0.3, -0.25, _MARK)]
