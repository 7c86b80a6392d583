"""The robot is unstable: a small tilt of the ground tips it over.

The tip angle is the tilt at which the centre of mass is above the nearest edge of the support.
Below 10° the robot falls at the first stone; SubT courses have ramps beyond 25°. The rule assumes
flat ground below the lowest collision. A caster or foot that is drawn there and has no collision is
named instead of the centre of mass. A robot that leans between 5° and 15° until it rests on casters
that do not reach the ground does not tip over: a warning names them. Shapes within 10 mm of the
ground support the robot, meshes with their convex hull. A robot on wheels of two sizes leans a
little, and stands on both. A robot of URDF that stands on legs is not judged, nor is one whose name
says that it balances or that has two wheels on one axle and nothing else near the ground: a
controller decides how it stands. Nor is one that sliding or planar joints carry, from the world or
from a link without mass and collision: it does not stand. For a description that no simulator gets,
such as one for transforms alone, it is an info.

Fix: give each caster and foot a `<collision>` that reaches the ground: lower a part that is too
high by its joint, or give it a greater radius. Else check the centre of mass of the heaviest link
(the pose of its `<inertial>`) and the places of wheels or feet. Also check for a part far outside,
or a chassis lower than the wheels.
Source: statics: tip angle = atan(distance to the edge / height of the centre of mass).
"""

import math
from collections.abc import Iterator, Mapping

from checker.base.words import and_list
from checker.model.components import Link, Pose
from checker.model.geometry.placed_shapes import place_shapes
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.tree import Tie
from checker.physics.mass.leaning import HighParts, high_parts
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.mechanism import spanning_tree_of
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_NEAR_GROUND = 0.01
"""Metres."""
_HINGES = 3
"""Hinges of a leg, such as two at the hip and one at the knee; a rocker-bogie has two."""
_SLIDES = ("prismatic", "planar")
_UPRIGHT = 0.5
"""Part along z of an axis that is nearer to upright than to level."""


@rule("INE009", "tips-over", Severity.ERROR, Concern.ROBOT)
def check(
    masses: MassProperties,
    context: Context,
    *,
    error_below_degrees: float = 10.0,
    warning_below_degrees: float = 25.0,
    indoors_below_degrees: float = 20.0,
) -> Findings:
    """Report a small tip angle; the place is the inertial of the heaviest link.

    Options:
        error_below_degrees: Tilt of the ground, degrees, at which the robot tips over; less is an
            error.
        warning_below_degrees: Tilt of the ground, degrees, at which a robot for SubT tips over;
            less is at least a warning.
        indoors_below_degrees: The same for other robots; an error only for those that tip over on
            flat ground.
    """
    robot = masses.robot
    if (
        robot.balances
        or robot.is_static
        or not (robot.drives or (robot.stands_alone and context.is_subt))
    ):
        return
    if robot.flies and not context.is_subt:
        return  # It stands on level ground, on an undercarriage as narrow as that of a plane.
    if masses.unbalanced:
        yield unchecked(masses.unbalanced)
        return
    on_legs = not robot.conventions.states_start and _stands_on_legs(masses)
    if on_legs or _is_carried(robot):
        return  # Its controller decides how it stands, or it does not stand.
    angle, centre, ground = masses.tip_angle, masses.centre, masses.support_height
    if angle is None or centre is None or ground is None:
        return
    degrees = math.degrees(angle)
    least = warning_below_degrees if context.is_subt else indoors_below_degrees
    grave = degrees < (error_below_degrees if context.is_subt else 0.0)
    if degrees >= least:
        return
    standing = "tips over on flat ground" if degrees < 0 else f"tips over at {degrees:.1f}°"
    severity = Severity.ERROR if grave else Severity.WARNING
    place, cause = _bodiless(robot, ground) or _top_heavy(masses, centre, ground, least)
    message = f"the robot {standing}{cause}"
    parts = _high_parts(masses, centre, ground)
    if parts is not None and parts.tip_angle > max(angle, 0.0):
        at = math.degrees(parts.tip_angle)
        grave = context.is_subt and at < error_below_degrees
        severity = Severity.ERROR if grave else Severity.WARNING
        place, message = _leaning(robot, parts, least)
    yield finding(
        place,
        message,
        severity=Severity.INFO if robot.shown_only else severity,
    )


def _top_heavy(
    masses: MassProperties, centre: Vector, ground: float, least: float
) -> tuple[Link | Pose, str]:
    """Return the inertial of the heaviest link, and where the centre of mass is, as the cause."""
    heaviest = max(masses.links.values(), key=lambda inertia: inertia.mass).link
    at = ", ".join(f"{part:.3f}" for part in centre[:2])
    height = f"{centre[2] - ground:.3g} m above the ground"
    return (
        heaviest.inertial.pose if heaviest.inertial is not None else heaviest,
        f", expected {least:g}° or more: its centre of mass is at x, y = {at} m, {height}; "
        f"the heaviest link is {heaviest.name.value!r}",
    )


def _high_parts(masses: MassProperties, centre: Vector, ground: float) -> HighParts | None:
    """Return the parts that a robot leans onto; None if it lies on its heaviest link."""
    parts = high_parts(masses.robot, centre, ground)
    heaviest = max(masses.links, key=lambda name: masses.links[name].mass)
    return None if parts is None or heaviest in parts.gaps else parts


def _leaning(robot: Robot, parts: HighParts, least: float) -> tuple[Link, str]:
    """Return the first part that a robot rests on once it leans, and what to say of it."""
    links = {robot.tree.links[name]: gap for name, gap in parts.gaps.items()}
    high = [f"{link.name.value!r} is {gap:.3f} m" for link, gap in links.items()]
    at = math.degrees(parts.tip_angle)
    tips = f"; on it, it tips over at {at:.1f}°, expected {least:g}° or more" if at < least else ""
    return next(iter(links)), (
        f"the robot leans up to {math.degrees(parts.lean):.1f}° until it rests on what does not "
        f"reach the ground: {and_list(high)} above it{tips}"
    )


def _bodiless(robot: Robot, ground: float) -> tuple[Link, str] | None:
    """Return what is drawn on the ground and supports nothing, such as a caster, as the cause."""
    drawn = _drawn_on_ground(robot, ground)
    names = " and ".join(repr(link.name.value) for link in drawn)
    supports = "supports" if len(drawn) == 1 else "support"
    return (drawn[0], f": without <collision>, {names} {supports} nothing") if drawn else None


def _drawn_on_ground(robot: Robot, ground: float) -> list[Link]:
    """Return links without collision whose visuals reach the ground, such as a caster."""
    return [
        link
        for link in robot.links
        if not link.collisions
        and any(
            abs(placed.box.low[2] - ground) < _NEAR_GROUND
            for placed in place_shapes(robot, link, link.visuals)
        )
    ]


def _stands_on_legs(masses: MassProperties) -> bool:
    """Return whether each part on the ground has as many hinges to the base as a leg."""
    above = spanning_tree_of(masses.robot).by
    return bool(masses.standing) and all(
        sum(_bends(masses.robot, tie) for tie in _chain(above, name)) >= _HINGES
        for name in masses.standing
    )


def _chain(above: Mapping[str, Tie], name: str) -> Iterator[Tie]:
    while (tie := above.get(name)) is not None:
        yield tie
        name = tie.parent


def _is_carried(robot: Robot) -> bool:
    """Return whether a slide moves the robot over the ground: nothing above it has a body."""
    above = spanning_tree_of(robot).by
    slides = [tie for tie in robot.tree.ties if tie.joint.type.value in _SLIDES]
    return any(
        not any(_has_body(robot, it.parent) for it in (tie, *_chain(above, tie.parent)))
        for tie in slides
    )


def _has_body(robot: Robot, name: str) -> bool:
    """Return whether a link, or one that is fixed to it, has a mass or a collision."""
    bodies = robot.tree.rigid_bodies
    names = bodies.links[bodies.of_link[name]] if name in bodies.of_link else []
    links = [robot.tree.links[it] for it in names if it in robot.tree.links]
    return any(link.mass or link.collisions for link in links)


def _bends(robot: Robot, tie: Tie) -> bool:
    """Return whether a joint is a hinge that is not upright, as a steering joint is."""
    axes = tie.joint.axes if tie.joint.type.value == "revolute" else ()
    axis = robot.axis_in_model(tie.joint, axes[0]) if axes else None
    return axis is not None and abs(axis[2]) < _UPRIGHT


def _rover(x: float, z: float = 0.0, mark: str = "", front: float = 0.1) -> str:
    wheels = "".join(
        f"""
<collision name="wheel_{number}">
  <pose>{wheel_x} {wheel_y} -0.1 1.5707963267948966 0 0</pose>
  <geometry>
    <cylinder><radius>{front if wheel_x > 0 else 0.1}</radius><length>0.05</length></cylinder>
  </geometry>
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
_CASTER = f"""
</link>
<joint name="caster_joint" type="fixed"><parent>base_link</parent><child>caster</child></joint>
<link name="caster">{_MARK}
  <pose>0.2 0 -0.15 0 0 0</pose>
  <visual name="v"><geometry><sphere><radius>0.05</radius></sphere></geometry></visual>
"""


def _on_two_wheels(height: float, mark: str = "") -> str:
    """Return a robot on an axle in the middle, between two casters above the ground."""
    casters = "".join(
        f"""
</link>
<joint name="{name}_joint" type="fixed"><parent>base_link</parent><child>{name}</child></joint>
<link name="{name}">{mark if name == "front" else ""}
  <pose>{x} 0 {height - 0.15} 0 0 0</pose>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
"""
        for name, x in (("front", 0.3), ("rear", -0.3))
    )
    return _rover(0).replace("<pose>0.2", "<pose>0.0").replace("<pose>-0.2", "<pose>0.0") + casters


def _beside(root: str, mark: str = "") -> dict[str, object]:
    """Return a rover of URDF with its mass in front of its wheels, on a slide below a root."""
    inertia = '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>'
    wheels = "".join(
        f"""
<joint name="turn_{number}" type="continuous">
  <parent link="rover"/><child link="wheel_{number}"/>
  <origin xyz="{x} {y} 0" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/>
</joint>
<link name="wheel_{number}">
  <inertial><mass value="1"/>{inertia}</inertial>
  <collision><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision>
</link>"""
        for number, (x, y) in enumerate(((0.2, 0.2), (0.2, -0.2), (-0.2, 0.2), (-0.2, -0.2)))
    )
    return {
        "@urdf": True,
        "urdf/arm.urdf": f"""<robot name="rover">
<link name="rail">{root}</link>
<joint name="slide" type="prismatic">
  <parent link="rail"/><child link="rover"/><axis xyz="1 0 0"/>
  <limit lower="-5" upper="5" effort="1" velocity="1"/>
</joint>
<link name="rover">
  <inertial>
    <origin xyz="0.5 0 0"/>{mark}
    <mass value="12"/>{inertia}
  </inertial>
</link>{wheels}
</robot>
""",
    }


_BALLAST = """<inertial><mass value="0.1"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>"""
GOOD = [
    _beside(""),
    _on_two_wheels(0.01),
    _rover(0),
    _rover(0.05),
    _rover(0, front=0.08),
]
BAD = [
    _beside(_BALLAST, _MARK),
    _rover(0.35, mark=_MARK),
    _rover(0.17, mark=_MARK),
    _rover(0, 0.3, mark=_MARK),
    _rover(0, mark=_MARK, front=0.05),
    _rover(0, front=0.05) + _CASTER,
    _on_two_wheels(0.05, _MARK),
]
