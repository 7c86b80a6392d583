"""Moments of inertia that are placeholders.

Exporters write the unit tensor by default: a hand-sized part with 1 kg·m² turns as if it weighed a
ton. If links of different mass or size share one tensor, it is copied and right for at most one of
them; if most of them are alike, for these, and only the others are reported. Of a model for Gazebo
without a sensor, a plugin or moving joints, such as a box in a world, it is an info; so is a unit
tensor that is within a factor of 3 of what the shapes of the link have at its mass.
In a package of a released repository, copied beside the user's own packages, that none of these
uses, it is one step less severe.

Fix: compute the moments of each link, with CAD or with the formula of the most similar solid.
Source: Model Migration Guide; review of exported models.
"""

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from checker.model.robot import Robot
from checker.physics.mass.even_inertia import even_moments, moments_fix
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_UNIT = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)
_ABOUT = 3.0
"""Factor by which the moments of a link differ from those of its mass spread evenly."""
_MORE_PRECISE = ("INE004", "INE013")
"""They state how far the same moments are off."""


@rule("INE007", "placeholder-inertia", Severity.WARNING, Concern.ROBOT)
def check(
    masses: MassProperties,
    context: Context,
    *,
    links: int = 3,
    share: float = 0.02,
    alike: float = 0.1,
) -> Findings:
    """Report unit tensors, and one tensor on several different links.

    Options:
        links: Number of links with the same tensor from which they are reported, unless all of them
            are similar.
        share: Share of the robot's mass; a link with no more is left out when tensors are compared,
            because frames of sensors are placeholders.
        alike: Share of the largest by which masses, and diagonals of the boxes around the links,
            may differ for links that count as similar.
    """
    if masses.robot.is_static:
        return
    light = _is_scenery(masses.robot) and not context.is_subt
    for found in _placeholders(masses, links, share, alike):
        yield replace(found, severity=Severity.INFO) if light else found


def _is_scenery(robot: Robot) -> bool:
    """Return whether a model for Gazebo has no sensor or plugin, and hardly a moving joint."""
    moving = sum(joint.type.value != "fixed" for joint in robot.joints)
    bare = not (robot.sensors or robot.plugins or robot.controllers)
    stiff = not moving or 2 * moving < len(robot.joints)
    return bare and stiff and robot.conventions.read_by_gazebo


def _placeholders(
    masses: MassProperties, links: int, share: float, alike: float
) -> Iterator[Finding]:
    by_tensor: dict[tuple[float, ...], list[LinkInertia]] = {}
    for name, inertia in masses.weighed.items():
        tensor = _stated_moments(inertia)
        if tensor == _UNIT:
            yield from _unit(masses.robot, inertia)
        elif any(tensor) and masses.share(name) > share:
            by_tensor.setdefault(tensor, []).append(inertia)
    for tensor, group in by_tensor.items():
        if len(group) < links or _alike(masses, group, alike):
            continue
        near = ([it for it in group if _alike(masses, (it, one), alike)] for one in group)
        owners = max(near, key=len)
        if 2 * len(owners) > len(group) and _is_own(masses.robot, owners[0], tensor):
            # The tensor is that of most of the links, and the others have a copy of it.
            copies = [it for it in group if it not in owners]
            yield from _copied_tensor(masses.robot, copies, owners[0], tensor)
        else:
            yield from _repeated_tensors(masses.robot, group, tensor)


def _stated_moments(inertia: LinkInertia) -> tuple[float, ...]:
    """Return the moments that the file states, without those that it leaves out."""
    inertial = inertia.link.inertial
    if inertial is None or not any(moment.stated for moment in inertial.moments):
        return ()
    return tuple(moment.value for moment in inertial.moments)


def _unit(robot: Robot, inertia: LinkInertia) -> Iterator[Finding]:
    if inertia.link.inertial is not None:
        yield finding(
            inertia.moments_span,
            f"link {inertia.link.name.value!r} of {inertia.mass:.4g} kg has the unit tensor "
            "of inertia, 1 kg·m² about each axis",
            severity=Severity.INFO if _is_own(robot, inertia, _UNIT) else None,
            key="unit",
            covered_by=_MORE_PRECISE,
            fix=moments_fix(robot, inertia.link),
        )


def _alike(masses: MassProperties, group: Sequence[LinkInertia], tolerance: float) -> bool:
    """Return whether links are of similar mass and size."""
    weights = [inertia.mass for inertia in group]
    if all(inertia.link in masses.robot.wheels for inertia in group):
        # Wheels of another size are a fault of their own.
        return _are_near(weights, tolerance)
    boxes = [masses.robot.own_box_of(inertia.link) for inertia in group]
    sizes = [box.diagonal for box in boxes if box is not None]
    return _are_near(weights, tolerance) and _are_near(sizes, tolerance)


def _are_near(values: Sequence[float], tolerance: float) -> bool:
    return not values or max(values) - min(values) <= tolerance * max(values)


def _repeated_tensors(
    robot: Robot, group: Sequence[LinkInertia], tensor: Sequence[float]
) -> Iterator[Finding]:
    moments = ", ".join(f"{tensor[i]:.4g}" for i in (0, 3, 5))
    first = group[0].link.name.value
    for inertia in group:
        if inertia.link.inertial is not None:
            yield finding(
                inertia.moments_span,
                f"link {inertia.link.name.value!r} and {len(group) - 1} more links of other mass "
                f"or size have the same inertia tensor (ixx, iyy, izz = {moments} kg·m²)",
                key=f"copied {first}",
                covered_by=_MORE_PRECISE,
                fix=moments_fix(robot, inertia.link),
            )


def _is_own(robot: Robot, inertia: LinkInertia, tensor: Sequence[float]) -> bool:
    """Return whether a tensor is about that of the shapes of a link, and no placeholder."""
    expected = even_moments(robot, inertia.link)
    return expected is not None and all(
        tensor[number] <= _ABOUT * expected[number] and expected[number] <= _ABOUT * tensor[number]
        for number in (0, 3, 5)
    )


def _copied_tensor(
    robot: Robot, copies: Sequence[LinkInertia], owner: LinkInertia, tensor: Sequence[float]
) -> Iterator[Finding]:
    moments = ", ".join(f"{tensor[i]:.4g}" for i in (0, 3, 5))
    for inertia in copies:
        yield finding(
            inertia.moments_span,
            f"link {inertia.link.name.value!r} has the inertia tensor of "
            f"{owner.link.name.value!r}, which has another mass or size (ixx, iyy, izz = "
            f"{moments} kg·m²)",
            key=f"copied {owner.link.name.value}",
            covered_by=_MORE_PRECISE,
            fix=moments_fix(robot, inertia.link),
        )


def _links(*parts: tuple[str, float, float], moments: str, marked: bool = False) -> str:
    mark = "  <!-- ^ INE007 -->" if marked else ""
    return "".join(
        f"""
<link name="{name}">
  <inertial>
    <mass>{mass}</mass>
    <inertia>{mark}
      <ixx>{moments}</ixx>
      <iyy>{moments}</iyy><izz>{moments}</izz>
    </inertia>
  </inertial>
  <collision name="c"><geometry><sphere><radius>{radius}</radius></sphere></geometry></collision>
</link>
"""
        for name, mass, radius in parts
    )


_WHEELS = (("left", 2.0, 0.1), ("right", 2.0, 0.1), ("rear", 2.0, 0.1))
GOOD = [
    _links(*_WHEELS, moments="0.008"),
    "".join(
        f"""
<link name="leg_{number}">
  <pose>0 0 0 0 0 {yaw}</pose>
  <inertial>
    <mass>2</mass>
    <inertia><ixx>0.01</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>1 0.1 0.1</size></box></geometry></collision>
</link>
"""
        for number, yaw in enumerate((0.0, 0.7, 1.5))
    ),
    _links(("body", 2.0, 0.1), ("camera", 0.01, 0.02), ("lidar", 0.02, 0.05), moments="0.01"),
]
BAD = [
    _links(("body", 2.0, 0.1), moments="1", marked=True),
    # The tensor is that of the wheels.
    _links(("body", 9.0, 0.3), moments="0.008", marked=True) + _links(*_WHEELS, moments="0.008"),
    _links(("body", 2.0, 0.3), moments="0.008", marked=True) + _links(*_WHEELS, moments="0.008"),
    _links(("body", 9.0, 0.3), ("arm", 2.0, 0.1), ("hand", 0.5, 0.1), moments="0.008", marked=True),
]
