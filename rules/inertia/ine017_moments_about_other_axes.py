"""Moments of inertia that fit the shape of the link about other axes.

The numbers are those of the shape, in another order: a wheel whose largest moment is about its x
axis, where its axle is y, tips and steers otherwise than the real one. Often the formula of a
cylinder along z was used for one that a pose turns, or width and length were exchanged.

Fix: write the moments in the order of the axes of `<inertial>`, or turn that by its pose as the
shape is turned.
Source: the moments of solids; URDF and SDFormat state moments about the axes of `<inertial>`.
"""

from collections.abc import Iterator

from checker.model.components import Link
from checker.model.locomotion.wheels import angle_to_axle, tread
from checker.model.robot import Robot
from checker.physics.mass.even_inertia import even_moments, moments_fix
from checker.physics.mass.mass_properties import MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule

_DIAGONAL, _PRODUCTS = (0, 3, 5), (1, 2, 4)
_ASKEW = 0.1
"""Radians between the axis of a wheel's shape and its axle."""
_FLAT = 0.01
"""Share of the largest moment up to which a product of inertia counts as zero."""


@rule("INE017", "moments-about-other-axes", Severity.WARNING, Concern.ROBOT)
def check(
    masses: MassProperties, *, near: float = 0.03, apart: float = 0.2, share: float = 0.01
) -> Findings:
    """Compare the stated moments with those of the link's shapes at its mass, in any order.

    Options:
        near: Share by which a moment may differ from that of the shapes and still be the same.
        apart: Share of the larger one by which the moments about one axis differ at least.
        share: Share of the robot's mass; a link with no more is left out.
    """
    if masses.robot.is_static:
        return
    turned = set(_across_their_axles(masses.robot))
    for name, inertia in masses.weighed.items():
        inertial, expected = inertia.link.inertial, even_moments(masses.robot, inertia.link)
        if inertial is None or expected is None or masses.share(name) <= share:
            continue
        if inertia.link in turned:
            continue
        stated = [moment.value for moment in inertial.moments]
        if not all(inertial.moments[number].stated for number in _DIAGONAL):
            continue
        if any(_is_skew(moments) for moments in (stated, expected)):
            continue
        own, fitting = ([moments[n] for n in _DIAGONAL] for moments in (stated, expected))
        pairs = zip(sorted(own), sorted(fitting), strict=True)
        same = all(abs(one - other) <= near * other for one, other in pairs)
        off = max(abs(a - b) / max(a, b) for a, b in zip(own, fitting, strict=True) if max(a, b))
        if same and off >= apart:
            numbers = (", ".join(f"{moment:.4g}" for moment in it) for it in (own, fitting))
            yield finding(
                inertia.moments_span,
                "ixx, iyy, izz of link {!r} are {}: they fit its shapes about other axes, expected "
                "{} kg·m²".format(inertia.link.name.value, *numbers),
                key="order",
                fix=moments_fix(masses.robot, inertia.link),
            )


def _across_their_axles(robot: Robot) -> Iterator[Link]:
    """Yield the wheels whose shape is turned wrong, not their moments: GEO003 reports them."""
    for wheel in (*robot.locomotion.wheels, *robot.locomotion.undriven):
        rolls = tread(robot, wheel)
        if rolls is not None and (angle_to_axle(wheel, rolls) or 0.0) > _ASKEW:
            yield wheel.link


def _is_skew(moments: list[float] | tuple[float, ...]) -> bool:
    largest = max(abs(moments[number]) for number in _DIAGONAL)
    return any(abs(moments[number]) > _FLAT * largest for number in _PRODUCTS)


def _wheel(moments: str, pose: str = "", mark: str = "") -> str:
    ixx, iyy, izz = moments.split()
    return f"""
<link name="wheel">
  <inertial>{pose}
    <mass>2</mass>
    <inertia>{mark}
      <ixx>{ixx}</ixx>
      <iyy>{iyy}</iyy>
      <izz>{izz}</izz>
    </inertia>
  </inertial>
  <collision name="c">
    <pose>0 0 0 1.5707963267948966 0 0</pose>
    <geometry><cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry>
  </collision>
</link>
"""


# m/12·(3r² + h²) across, m/2·r² about the axle.
_ACROSS, _ALONG = "0.0052667", "0.01"
GOOD = [
    _wheel(f"{_ACROSS} {_ALONG} {_ACROSS}"),
    _wheel(f"{_ACROSS} {_ACROSS} {_ALONG}", "<pose>0 0 0 1.5707963267948966 0 0</pose>"),
    _wheel("0.004 0.004 0.006"),
]
BAD = [
    _wheel(f"{_ACROSS} {_ACROSS} {_ALONG}", mark="  <!-- ^ INE017 -->"),
    _wheel(f"{_ALONG} {_ACROSS} {_ACROSS}", mark="  <!-- ^ INE017 -->"),
]
