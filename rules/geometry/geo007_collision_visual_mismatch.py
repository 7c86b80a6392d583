"""Collision and visual of a link are in different places, or of different size.

The robot does not touch what it seems to touch: a wheel rolls next to its visual, a robot stops in
front of nothing or drives into walls. Usually one of the two has a wrong pose, scale or unit. No
accepted package that we checked has this fault.

Wheels of published robots differ by up to 0.25 of the diagonal, as a narrow disc in a wide tyre
does, and other links by up to 0.46.

The collision of a link may also cover the links that are fixed to it, such as a capsule around a
flange with its gripper: it is compared with the visuals of all of them, too. If a contact sensor
names all collisions of a link, only these may be meant to touch, such as the tip of a leg: a box,
cylinder or sphere in the middle of its visual or at an end of it is not compared.

The collision of a wheel may also be too far out or in along the axle. If the mesh of a wheel's
visual is not available, its pose and that of the joint give the position of the wheel. In 18
accepted packages the offset is at most 0.15 of the width.

Fix: give collision and visual the same pose and about the same size.
Source: geometry: boxes along the robot's axes around all collisions and all visuals of a link;
extents along the axle of a wheel.
"""

import math
from collections.abc import Iterator, Sequence

from checker.model.components import Collision, Link, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import place_shapes, union
from checker.model.locomotion.locomotion import Wheel
from checker.model.locomotion.wheels import is_misaligned, tread
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule


@rule("GEO007", "collision-visual-mismatch", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot,
    *,
    wheel_share: float = 0.25,
    other_share: float = 0.5,
    mass_share: float = 0.02,
    axle_share: float = 0.3,
) -> Findings:
    """Report links whose collisions and visuals fill boxes of different centres or sizes.

    Tilted wheels (GEO003), rotors and links with an unknown mesh are skipped. A sphere may stand
    for a narrower wheel of its diameter: it rolls alike.

    Options:
        wheel_share: Share of the larger box's diagonal by which centres or sizes may differ for a
            wheel; more is reported.
        other_share: Share of the larger box's diagonal by which centres or sizes may differ for any
            other link; more is reported.
        mass_share: Share of the robot's mass; links that weigh no more are skipped, except wheels.
        axle_share: Share of a wheel's width by which its collision may be off along the axle; more
            is reported.
    """
    wheels = {link.scoped_name for link in robot.wheels}
    exempt = {rotor.link.scoped_name for rotor in robot.locomotion.rotors if rotor.link}
    moved = robot.locomotion
    rolling = {wheel.link.scoped_name: wheel for wheel in (*moved.wheels, *moved.undriven)}
    exempt |= {name for name, wheel in rolling.items() if is_misaligned(robot, wheel)}
    least_mass = mass_share * robot.mass if not robot.unweighed else math.inf
    for link in robot.links:
        name = link.scoped_name
        if name in exempt or (name not in wheels and not link.mass > least_mass):
            continue
        touched, seen = _box(robot, link, link.collisions), _box(robot, link, link.visuals)
        share = wheel_share if name in wheels else other_share
        if seen is not None and name in wheels and _is_sphere(link):
            seen = _cube_around(seen)
        if (
            touched is not None
            and seen is not None
            and _difference(touched, seen) > share
            and not _fits_body(robot, link, touched, share)
            and not (name not in wheels and _is_tip(link, touched, seen))
        ):
            yield finding(link, _message(link, touched, seen, share))
        elif name in rolling:
            yield from _along_axle(robot, rolling[name], axle_share)


_SOLIDS = ("box", "cylinder", "capsule", "ellipsoid", "sphere")


def _is_sphere(link: Link) -> bool:
    return [collision.geometry.shape for collision in link.collisions] == ["sphere"]


def _cube_around(wheel: Box) -> Box:
    """Return the box of a sphere that has the diameter of a wheel."""
    x, y, z = wheel.centre
    radius = max(_size(wheel)) / 2
    return Box((x - radius, y - radius, z - radius), (x + radius, y + radius, z + radius))


def _is_tip(link: Link, touched: Box, seen: Box) -> bool:
    """Return whether all that touches is sensed, and is a smaller solid within the visual."""
    contacts = (contact for sensor in link.sensors for contact in sensor.element.all("contact"))
    sensed = {named.text.value for contact in contacts for named in contact.all("collision")}
    solids = {it.name.value for it in link.collisions if it.geometry.shape in _SOLIDS}
    if len(solids) != len(link.collisions) or not solids <= sensed:
        return False
    corners = zip(seen.low, touched.centre, seen.high, strict=True)
    return touched.diagonal < seen.diagonal and all(low <= at <= high for low, at, high in corners)


def _fits_body(robot: Robot, link: Link, touched: Box, share: float) -> bool:
    """Return whether a collision has the size of all that is fixed to the link."""
    bodies = robot.tree.rigid_bodies
    names = bodies.links[bodies.of_link[link.scoped_name]]
    boxes = (_box(robot, each, each.visuals) for each in map(robot.tree.links.__getitem__, names))
    seen = union(box for box in boxes if box is not None)
    return seen is not None and _difference(touched, seen) <= share


def _difference(touched: Box, seen: Box) -> float:
    """Return by how much centres or sizes differ, as a share of the larger box's diagonal."""
    beside = math.dist(touched.centre, seen.centre)
    larger = math.dist(_size(touched), _size(seen))
    diagonal = max(touched.diagonal, seen.diagonal)
    return max(beside, larger) / diagonal if diagonal > 0.0 else 0.0


def _along_axle(robot: Robot, wheel: Wheel, share: float) -> Iterator[Finding]:
    """Report a wheel whose collision is off along its axle."""
    rolls = tread(robot, wheel)
    collisions = [(link, shape) for link in wheel.body for shape in link.collisions]
    touched = _extent(robot, wheel, collisions)
    if rolls is None or touched is None:
        return
    width = touched[1] - touched[0]
    visuals = [(link, shape) for link in wheel.body for shape in link.visuals]
    seen = _extent(robot, wheel, visuals)
    if seen is not None:
        width = max(width, seen[1] - seen[0])
        off = abs(sum(touched) - sum(seen)) / 2
        inside = seen[0] <= touched[0] and touched[1] <= seen[1]
        off, where = (0.0 if inside else off), "its visual"
    else:
        places = _places(robot, wheel, visuals)
        off = min((abs(sum(touched) / 2 - place) for place in places), default=0.0)
        where = "its visual's pose and its joint"
    if off > share * width > 0.0:
        yield finding(
            rolls.shape.pose,
            f"the collision of wheel {wheel.link.name.value!r} is {off:.3g} m beside {where} along "
            f"its axle, {off / width:.0%} of its width, expected {share:.0%} or less",
            related=[(wheel.joint, "the joint")],
        )


def _extent(
    robot: Robot, wheel: Wheel, shapes: Sequence[tuple[Link, Collision | Visual]]
) -> tuple[float, float] | None:
    """Return from where to where shapes reach along a wheel's axis; None if one is not known."""
    known = [piece for link, shape in shapes for piece in place_shapes(robot, link, (shape,))]
    if wheel.axis is None or not known or len(known) < len(shapes):
        return None
    x, y, z = wheel.axis
    low = -max(piece.support(robot, (-x, -y, -z)) for piece in known)
    return low, max(piece.support(robot, (x, y, z)) for piece in known)


def _places(
    robot: Robot, wheel: Wheel, visuals: Sequence[tuple[Link, Collision | Visual]]
) -> list[float]:
    """Return where the joint and visuals of unknown extent are along a wheel's axis."""
    poses = [robot.pose_of_part(link, visual.pose) for link, visual in visuals]
    points = [pose.translation for pose in poses if pose is not None]
    axis, centre = wheel.axis, wheel.centre
    if axis is None or centre is None or not points:
        return []
    return [sum(a * b for a, b in zip(axis, point, strict=True)) for point in (centre, *points)]


def _message(link: Link, touched: Box, seen: Box, share: float) -> str:
    name = link.name.value
    expected = (
        f"{_difference(touched, seen):.1%} of the larger diagonal, expected {share:.0%} or less"
    )
    beside = math.dist(touched.centre, seen.centre)
    if beside > math.dist(_size(touched), _size(seen)):
        return (
            f"the centres of collision and visual of {name!r} are {beside:.3g} m apart, {expected}"
        )
    sizes = f"{_text(touched)}, but its visual measures {_text(seen)}"
    return f"the collision of {name!r} measures {sizes}: they differ by {expected}"


def _text(box: Box) -> str:
    return " × ".join(f"{length:.3g}" for length in _size(box)) + " m"


def _size(box: Box) -> list[float]:
    return [high - low for low, high in zip(box.low, box.high, strict=True)]


def _box(
    robot: Robot, link: Link, shapes: tuple[Collision, ...] | tuple[Visual, ...]
) -> Box | None:
    """Return the box around all shapes; None if one of them is not known."""
    with_shape = [shape for shape in shapes if shape.geometry.shape]
    known = list(place_shapes(robot, link, with_shape))
    return union(piece.box for piece in known) if len(known) == len(with_shape) else None


def _body(pose: str, size: str, mark: str = "", name: str = "body") -> str:
    return f"""
<link name="{name}">{mark}
  <collision name="c"><geometry><box><size>1 0.5 0.2</size></box></geometry></collision>
  <visual name="v">
    <pose>{pose} 0 0 0</pose>
    <geometry><box><size>{size}</size></box></geometry>
  </visual>
</link>
"""


def _wheel(
    collision: str, visual: str, length: float = 0.1, mesh: bool = False, mark: str = ""
) -> str:
    turned = "1.5707963267948966 0 0"
    cylinder = f"<cylinder><radius>0.2</radius><length>{length}</length></cylinder>"
    seen = "<mesh><uri>meshes/wheel.dae</uri></mesh>" if mesh else cylinder
    return f"""
<link name="wheel">
  <pose>0 0.5 0 0 0 0</pose>
  <collision name="c">
    <pose>0 {collision} 0 {turned}</pose>{mark}
    <geometry>{cylinder.replace(str(length), "0.1")}</geometry>
  </collision>
  <visual name="v"><pose>0 {visual} 0 {turned}</pose><geometry>{seen}</geometry></visual>
</link>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>wheel</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
"""


def _ball(radius: str, mark: str = "") -> str:
    return f"""
<link name="front_wheel">{mark}
  <collision name="c"><geometry><sphere><radius>{radius}</radius></sphere></geometry></collision>
  <visual name="v"><geometry><box><size>0.2 0.06 0.2</size></box></geometry></visual>
</link>
"""


def _flange(collision: str, mark: str = "") -> str:
    """Return a flange whose collision is around the gripper that is fixed to it too."""
    return f"""
<link name="flange">{mark}
  <collision name="c">
    <pose>0 0 0.15 0 0 0</pose>
    <geometry><box><size>{collision}</size></box></geometry>
  </collision>
  <visual name="v"><geometry><box><size>0.1 0.1 0.05</size></box></geometry></visual>
</link>
<link name="gripper">
  <pose>0 0 0.15 0 0 0</pose>
  <visual name="v"><geometry><box><size>0.1 0.1 0.25</size></box></geometry></visual>
</link>
<joint name="weld" type="fixed"><parent>flange</parent><child>gripper</child></joint>
"""


def _leg(tip: str, sensed: str, mark: str = "") -> str:
    """Return a leg of which only the tip touches."""
    return f"""
<link name="leg">{mark}
  <collision name="tip">
    <pose>0 0 {tip} 0 0 0</pose>
    <geometry><sphere><radius>0.02</radius></sphere></geometry>
  </collision>
  <visual name="v"><geometry><box><size>0.03 0.03 0.3</size></box></geometry></visual>
  <sensor name="touch" type="contact">
    <contact><collision>{sensed}</collision></contact>
  </sensor>
</link>
"""


_MARK = "  <!-- ^ GEO007 -->"
GOOD = [
    _body("0 0 0.1", "1 0.5 0.2"),
    _body("0 0 0", "1.2 0.5 0.5"),
    "<link name='ghost'><visual name='v'><geometry><box/></geometry></visual></link>",
    _wheel("0.02", "0"),
    # Both outside of the joint.
    _wheel("0.1", "0.1"),
    _wheel("0.05", "0.05", mesh=True),
    # Within a tyre that reaches inwards.
    _wheel("0", "-0.04", 0.19),
    _ball("0.1"),
    _flange("0.12 0.12 0.3"),
    _leg("-0.14", "tip"),
]
BAD = [
    _body("0 0 0.8", "1 0.5 0.2", _MARK),
    _body("0 0 0", "0.1 0.05 0.02", _MARK),
    _body("0 0 0", "1 0.5 0.6", _MARK, "front_wheel"),
    _wheel("0.04", "0", mark=_MARK),
    _wheel("0.04", "0", mesh=True, mark=_MARK),
    _ball("0.15", _MARK),
    _flange("0.12 0.12 0.9", _MARK),
    _leg("-0.4", "tip", _MARK),
    _leg("-0.14", "toe", _MARK),
]
