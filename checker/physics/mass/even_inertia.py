"""Inertia that a link has if its mass is spread evenly over its shapes, and the fixes of it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from checker.finding import Edit, Fix, Safety
from checker.formats.corrections import is_shared, number_text, rewrite
from checker.model.components import Collision, Link, Visual
from checker.model.geometry.bodies import Body, together
from checker.model.geometry.solids import solid_of
from checker.model.robot import Robot
from checker.physics.mass.link_geometry import solid
from checker.source.xml import Element
from checker.source.xml_insertion import append_to

DENSITY = 1000.0
"""kg/m³, which SDFormat 1.11 takes for `<inertial auto="true">`: water."""

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_NOISE = 1e-4
"""Share of the largest moment: a smaller product is what the rounding of an angle left."""


def even_body(robot: Robot, link: Link) -> Body | None:
    """Return the volume of a link's collisions, else of its visuals, in the link's frame.

    None if one of them is not known.
    """
    return _filled(robot, link, link.collisions) or _filled(robot, link, link.visuals)


def _filled(robot: Robot, link: Link, shapes: Iterable[Collision | Visual]) -> Body | None:
    bodies = []
    for shape in solid(shapes):
        pose = robot.pose_in_link(link, shape.pose)
        body = solid_of(shape.geometry, robot.scaled_meshes)
        if pose is None or body is None or not body.amount > 0.0:
            return None
        bodies.append(body.placed(pose))
    return together(bodies)


def even_moments(robot: Robot, link: Link) -> tuple[float, ...] | None:
    """Return ixx, ixy, ixz, iyy, iyz, izz of a link's mass, in the axes of its `<inertial>`."""
    body = even_body(robot, link)
    if body is None or link.inertial is None or not link.mass > 0.0:
        return None
    moments = body.placed(link.inertial.pose.transform.inverse).moments(link.mass)
    return _without_noise(moments)


def _without_noise(moments: Sequence[float]) -> tuple[float, ...]:
    least = _NOISE * max(moments)
    return tuple(moment if abs(moment) > least else 0.0 for moment in moments)


def moments_fix(robot: Robot, link: Link) -> Fix | None:
    """Return the fix that writes the moments of the link's shapes at its mass.

    None if a shape is not known, and where links that share the text need different moments.
    """
    fixes = [_moments_fix(robot, each) for each in robot.links if _same_text(each, link)]
    texts = {tuple(edit.replacement for edit in fix.edits) if fix else () for fix in fixes}
    return fixes[0] if len(texts) == 1 else None


def _same_text(one: Link, other: Link) -> bool:
    if one.inertial is None or other.inertial is None:
        return False
    return is_shared(one.inertial.span, other.inertial.span)


def _moments_fix(robot: Robot, link: Link) -> Fix | None:
    moments = even_moments(robot, link)
    if link.inertial is None or moments is None:
        return None
    pairs = list(zip(link.inertial.moments, moments, strict=True))
    # Products that are left out are 0, and the moments are possible without them.
    return rewrite(pair for pair in pairs if pair[0].stated or pair[0].value)


def centre_fix(robot: Robot, link: Link) -> Fix | None:
    """Return the fix that puts the centre of mass into the middle of the link's shapes."""
    body = even_body(robot, link)
    if body is None or link.inertial is None or not link.inertial.pose.numbers:
        return None
    stated = link.inertial.pose.numbers[:3]
    return rewrite(zip(stated, map(_to_nanometres, body.centre), strict=True))


def _to_nanometres(length: float) -> float:
    return round(length, 9) + 0.0


def inertial_fix(robot: Robot, link: Link) -> Fix | None:
    """Return the fix that gives a link what it lacks of mass, centre and moments.

    A link without `<inertial>` is taken for as dense as water. None as for `moments_fix`.
    """
    written = link.element.written
    # A macro makes several.
    links = [each for each in robot.links if each.element.written is written]
    edits = {_inertial_edit(robot, each, written) for each in links}
    edit = edits.pop() if len(edits) == 1 else None
    return Fix(Safety.UNSAFE, (edit,)) if edit else None


def _inertial_edit(robot: Robot, link: Link, written: Element) -> Edit | None:
    body = even_body(robot, link)
    urdf = robot.conventions.is_urdf
    inertial, moments = written.child("inertial"), even_moments(robot, link)
    if body is not None and inertial is None:
        return append_to(written, _inertial_lines(body, urdf=urdf))
    if moments is not None and inertial is not None and inertial.child("inertia") is None:
        return append_to(inertial, _inertia_lines(moments, urdf=urdf))
    return None


def _inertial_lines(body: Body, *, urdf: bool) -> list[str]:
    mass, at = number_text(DENSITY * body.amount), map(_to_nanometres, body.centre)
    centre = " ".join(map(number_text, at))
    moments = body.moments(float(mass))
    inside = [f'<origin xyz="{centre}"/>', f'<mass value="{mass}"/>']
    if not urdf:
        inside = [f"<pose>{centre} 0 0 0</pose>", f"<mass>{mass}</mass>"]
    inside += _inertia_lines(moments, urdf=urdf)
    return ["<inertial>", *(f"  {line}" for line in inside), "</inertial>"]


def _inertia_lines(moments: Sequence[float], *, urdf: bool) -> list[str]:
    pairs = list(zip(_MOMENTS, map(number_text, _without_noise(moments)), strict=True))
    if urdf:
        attributes = " ".join(f'{name}="{text}"' for name, text in pairs)
        return [f"<inertia {attributes}/>"]
    return ["<inertia>", *(f"  <{name}>{text}</{name}>" for name, text in pairs), "</inertia>"]
