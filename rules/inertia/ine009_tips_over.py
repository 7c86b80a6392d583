"""The robot stands unsafely: a small tilt of the ground tips it over.

The tip angle is the tilt at which the centre of mass stands above the nearest edge of what the
robot stands on. Below 10° the robot falls at the first stone; SubT courses have ramps beyond 25°.
The ground is taken as flat, below the lowest collision shape; shapes within 10 mm of it stand on
it, meshes by their convex hull.

Fix: check the centre of mass of the heaviest link (the pose of its `<inertial>`) and the places of
wheels or feet; a part far out, or a chassis lower than the wheels, shows here as well.
Source: statics: tip angle = atan(distance to the edge / height of the centre of mass).
"""

import math

from checker.model.components import Link
from checker.physics.mass.mass_properties import MassProperties
from checker.rule import Findings, Severity, finding, rule, unchecked


@rule("INE009", "tips-over", Severity.ERROR)
def check(
    masses: MassProperties,
    *,
    error_below_degrees: float = 10.0,
    warning_below_degrees: float = 25.0,
) -> Findings:
    """Report a small tip angle at the inertial of the heaviest link.

    Options:
        error_below_degrees: Degrees that the ground must be tilted for the robot to tip over; less
            is an error.
        warning_below_degrees: Degrees that the ground must be tilted for the robot to tip over;
            less is a warning at least.
    """
    if masses.robot.is_static:
        return
    unknown = masses.robot.missing_parts or masses.support_unknown
    if unknown:
        yield unchecked(unknown)
        return
    angle, centre, ground = masses.tip_angle, masses.centre, masses.support_height
    if angle is None or centre is None or ground is None:
        return
    degrees = math.degrees(angle)
    if degrees >= warning_below_degrees:
        return
    at = ", ".join(f"{part:.3f}" for part in centre[:2])
    height = f"{centre[2] - ground:.3g} m above the ground"
    standing = "tips over where it stands" if degrees < 0 else f"tips over at {degrees:.1f}°"
    heaviest = _heaviest(masses)
    yield finding(
        heaviest.inertial.pose if heaviest.inertial is not None else heaviest,
        f"the robot {standing}, expected {warning_below_degrees:g}° or more: its centre of mass is "
        f"at x, y = {at} m, {height}; most of it is in link {heaviest.name.value!r}",
        severity=Severity.ERROR if degrees < error_below_degrees else Severity.WARNING,
    )


def _heaviest(masses: MassProperties) -> Link:
    return max(masses.links.values(), key=lambda inertia: inertia.mass).link


def _rover(x: float, z: float = 0.0, mark: str = "") -> str:
    wheels = "".join(
        f"""
<collision name="wheel_{number}">
  <pose>{wheel_x} {wheel_y} -0.1 1.5707963267948966 0 0</pose>
  <geometry><cylinder><radius>0.1</radius><length>0.05</length></cylinder></geometry>
</collision>
"""
        for number, (wheel_x, wheel_y) in enumerate(
            ((0.2, 0.2), (0.2, -0.2), (-0.2, 0.2), (-0.2, -0.2))
        )
    )
    return f"""
<inertial>
  <pose>{x} 0 {z} 0 0 0</pose>{mark}
  <mass>12</mass>
  <inertia><ixx>0.1</ixx><iyy>0.26</iyy><izz>0.34</izz></inertia>
</inertial>
{wheels}
"""


_MARK = "  <!-- ^ INE009 -->"
GOOD = [_rover(0), _rover(0.05)]
BAD = [_rover(0.35, mark=_MARK), _rover(0.17, mark=_MARK), _rover(0, 0.3, mark=_MARK)]
