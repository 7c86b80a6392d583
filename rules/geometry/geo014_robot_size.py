"""The whole robot is far too small, large, light or heavy.

A robot of 400 m was drawn in millimetres, one of 4 mm was scaled twice; masses become wrong when
grams are taken for kilograms. Contacts and controllers are made for robots of real size. No
accepted package that we checked has this fault. Outside of SubT, only models that drive or have
wheels are checked: others may be a sensor, a tool or scenery.

Fix: write lengths in metres and masses in kilograms, and correct the `<scale>` of meshes.
Source: SDFormat and URDF use SI units; ground and air robots from 5 cm and 50 g to lorries of
25 m and 50 t.
"""

from checker.base.words import beyond
from checker.model.geometry.placed_shapes import all_shapes, union
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked


@rule("GEO014", "robot-size", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot,
    context: Context,
    *,
    smallest: float = 0.05,
    largest: float = 25.0,
    lightest: float = 0.05,
    heaviest: float = 50_000.0,
) -> Findings:
    """Compare the longest side of the box around all shapes, and the mass, with real robots.

    Options:
        smallest: Longest side of the box around the robot, metres; less is reported.
        largest: Longest side of the box around the robot, metres; more is reported.
        lightest: Mass of all links of the robot, kilograms; less is reported.
        heaviest: Mass of all links of the robot, kilograms; more is reported.
    """
    if robot.is_static or not (robot.drives or context.is_subt):
        return
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    shapes, unknown = all_shapes(robot)
    box = union(piece.box for piece in shapes)
    if box is not None:
        side = max(high - low for low, high in zip(box.low, box.high, strict=True))
        if side < smallest and unknown:
            yield unchecked(f"the size of {unknown[0].name.value!r} is not known")
        elif not smallest <= side <= largest:
            yield finding(
                robot,
                f"the robot measures {beyond(side, smallest, largest, digits=3)} m, expected "
                f"{smallest:g} to {largest:g} m",
            )
    if robot.unweighed:
        yield unchecked(robot.unweighed)
    elif box is not None and robot.mass and not lightest <= robot.mass <= heaviest:
        yield finding(
            robot,
            f"the robot weighs {beyond(robot.mass, lightest, heaviest, digits=3)} kg, expected "
            f"{lightest:g} to {heaviest:g} kg",
        )


def _robot(size: str, mass: str, mark: str = "") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">{mark}
<link name="base_link">
  <inertial><mass>{mass}</mass></inertial>
  <collision name="c"><geometry><box><size>{size}</size></box></geometry></collision>
</link>
</model>
</sdf>
"""


_MARK = "  <!-- ^ GEO014 -->"
GOOD = [_robot("12 2.5 3", "18000"), _robot("0.5 0.3 0.01", "12"), "<frame name='no_shapes'/>"]
BAD = [
    _robot("500 300 10", "12", _MARK),
    _robot("0.005 0.003 0.001", "12", _MARK),
    _robot("0.5 0.3 0.1", "0.012", _MARK),
    _robot("0.5 0.3 0.1", "120000", _MARK),
]
