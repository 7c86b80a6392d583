"""Links, shapes, joints and frames of SDF."""

from __future__ import annotations

import math
from collections.abc import Mapping

from msgspec.structs import replace

from checker.formats.sdf.auto_inertia import automatic_inertial, is_automatic
from checker.formats.sdf.scope import Scope
from checker.model.components import (
    UNLIMITED,
    Axis,
    Collision,
    Frame,
    Inertial,
    Joint,
    Light,
    Link,
    Plugin,
    Sensor,
    Visual,
)
from checker.model.faults import FaultKind
from checker.model.frames import MODEL_FRAME, FrameNode
from checker.model.geometry.shapes import Geometry, Material
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

# Shapes and materials of SDF.


_ONE = (1.0,)
_ONES = (1.0, 1.0, 1.0)

SIZES: Mapping[str, Mapping[str, tuple[float, ...]]] = {
    "box": {"size": _ONES},
    "sphere": {"radius": _ONE},
    "cylinder": {"radius": _ONE, "length": _ONE},
    "capsule": {"radius": (0.5,), "length": _ONE},
    "cone": {"radius": (0.5,), "length": _ONE},
    "ellipsoid": {"radii": _ONES},
    "plane": {"normal": (0.0, 0.0, 1.0), "size": (1.0, 1.0)},
    "mesh": {"scale": _ONES},
    "heightmap": {"size": _ONES},
    "image": {"scale": _ONE, "height": _ONE},
    "polyline": {"height": _ONE},
    "empty": {},
}
"""The lengths of each shape with SDFormat's defaults, metres."""

_COLOURS = ("ambient", "diffuse", "specular", "emissive")
_PBR_MAPS = (
    "albedo_map", "roughness_map", "metalness_map", "environment_map",
    "ambient_occlusion_map", "normal_map", "emissive_map", "light_map",
    "glossiness_map", "specular_map",
)  # fmt: skip


def read_geometry(parent: Element, values: ValueReader) -> Geometry:
    """Read the `<geometry>` below a collision or visual; shape is empty if there is none."""
    geometry = parent.child("geometry") or parent
    shape = next((child for child in geometry.children if child.tag in SIZES), None)
    if shape is None or geometry is parent:
        return Geometry("", {}, None, geometry)
    sizes = {name: values.numbers(shape, name, d) for name, d in SIZES[shape.tag].items()}
    uri = shape.child("uri")
    return Geometry(shape.tag, sizes, uri.text if uri is not None else None, shape)


def read_material(parent: Element, values: ValueReader) -> Material | None:
    """Read the `<material>` below a visual."""
    element = parent.child("material")
    if element is None:
        return None
    colours = {
        child.tag: values.numbers_in(child.text)
        for child in element.children
        if child.tag in _COLOURS
    }
    return Material(element, colours, _textures(element), _scripts(element))


def _textures(material: Element) -> tuple[Located[str], ...]:
    pbr = material.child("pbr")
    if pbr is None:
        return ()
    return tuple(e.text for e in pbr.descendants() if e.tag in _PBR_MAPS and e.text.stated)


def _scripts(material: Element) -> tuple[Located[str], ...]:
    script = material.child("script")
    if script is None:
        return ()
    return tuple(uri.text for uri in script.all("uri") if uri.text.stated)


_MOMENTS = {"ixx": 1.0, "ixy": 0.0, "ixz": 0.0, "iyy": 1.0, "iyz": 0.0, "izz": 1.0}
"""SDFormat's defaults, kg·m²."""


def read_link(element: Element, scope: Scope) -> Link:
    """Read a `<link>` and enter its frame into the graph."""
    name = scope.name(element)
    pose = scope.pose(element)
    scoped_name = scope.scoped(name.value)
    scope.graph.add(
        scoped_name,
        FrameNode(
            pose.relative_to or scope.model_frame, pose.transform, pose.span, f"link '{name.value}'"
        ),
    )
    collisions = tuple(_read_collision(child, scope) for child in element.all("collision"))
    return Link(
        name,
        element,
        scoped_name,
        pose,
        _read_inertial(element, scoped_name, scope, collisions),
        collisions,
        tuple(_read_visual(child, scope) for child in element.all("visual")),
        tuple(read_sensor(child, scoped_name, scope) for child in element.all("sensor")),
        tuple(_read_light(child, scoped_name, scope) for child in element.all("light")),
        scope.values.boolean(element, "gravity", True),
        scope.values.boolean(element, "kinematic", False),
    )


def _read_inertial(
    link: Element, frame: str, scope: Scope, collisions: tuple[Collision, ...]
) -> Inertial | None:
    """Read where a link has how much mass: always in the link's own frame."""
    element = link.child("inertial")
    if element is None:
        return None
    if is_automatic(element):
        return automatic_inertial(element, collisions)
    inertia = element.child("inertia") or element
    moments = tuple(
        scope.values.number(inertia, name, default) for name, default in _MOMENTS.items()
    )
    mass = scope.values.number(element, "mass", 1.0)
    pose = scope.pose(element)
    if pose.relative_to not in ("", frame):
        message = f"the inertial of link {frame!r} is posed relative to {pose.relative_to!r}"
        message += ", but simulators read it in the link's frame"
        scope.values.fault(FaultKind.FRAME, pose.span, message)
    return Inertial(replace(pose, relative_to=""), mass, moments, element.span)


def _read_collision(element: Element, scope: Scope) -> Collision:
    geometry = read_geometry(element, scope.values)
    return Collision(scope.values.name(element), element, scope.pose(element), geometry)


def _read_visual(element: Element, scope: Scope) -> Visual:
    return Visual(
        scope.values.name(element),
        element,
        scope.pose(element),
        read_geometry(element, scope.values),
        read_material(element, scope.values),
    )


def read_sensor(element: Element, owner: str, scope: Scope) -> Sensor:
    """Read a `<sensor>` of a link or joint."""
    name = scope.values.name(element)
    return Sensor(
        name,
        element,
        element.attribute("type") or Located("", element.span, stated=False),
        owner,
        scope.pose(element),
        scope.values.text(element, "topic"),
        tuple(read_plugin(child, owner=name.value) for child in element.all("plugin")),
    )


def _read_light(element: Element, link: str, scope: Scope) -> Light:
    name = scope.values.name(element)
    return Light(name, element, element.get("type") or "", link, scope.pose(element))


def read_plugin(element: Element, nested_in: str = "", owner: str = "") -> Plugin:
    """Read a `<plugin>` of a model or sensor."""
    name = element.attribute("name") or Located("", element.span, stated=False)
    filename = element.attribute("filename") or Located("", element.span, stated=False)
    return Plugin(name, element, filename, owner, nested_in)


# Joints and frames of SDF.


def read_joint(element: Element, scope: Scope) -> Joint:
    """Read a `<joint>` and enter its frame into the graph: posed in its child by default."""
    name = scope.name(element)
    scoped_name = scope.scoped(name.value)
    child = _end(element, "child", scope)
    pose = scope.pose(element)
    scope.graph.add(
        scoped_name,
        FrameNode(
            pose.relative_to or scope.scoped(child.value),
            pose.transform,
            pose.span,
            f"joint '{name.value}'",
        ),
    )
    return Joint(
        name,
        element,
        scoped_name,
        scope.prefix,
        element.attribute("type") or Located("", element.span, stated=False),
        _end(element, "parent", scope),
        child,
        pose,
        tuple(_read_axis(axis, scope) for tag in _AXES if (axis := element.child(tag)) is not None),
        tuple(read_sensor(sensor, scoped_name, scope) for sensor in element.all("sensor")),
    )


_AXES = ("axis", "axis2")


def _end(joint: Element, tag: str, scope: Scope) -> Located[str]:
    """Read `<parent>` or `<child>`; SDF before 1.3 had the name in an attribute `link`."""
    child = joint.child(tag)
    if child is not None and not child.text.stated and (link := child.attribute("link")):
        return link
    return scope.values.text(joint, tag)


def _read_axis(element: Element, scope: Scope) -> Axis:
    values = scope.values
    limit = element.child("limit") or element
    dynamics = element.child("dynamics") or element
    return Axis(
        values.numbers(element, "xyz", (0.0, 0.0, 1.0)),
        _expressed_in(element, scope),
        _bound(values.number(limit, "lower", -math.inf)),
        _bound(values.number(limit, "upper", math.inf)),
        _maximum(values.number(limit, "effort", -1.0)),
        _maximum(values.number(limit, "velocity", -1.0)),
        values.number(dynamics, "damping", 0.0),
        values.number(dynamics, "friction", 0.0),
        values.number(dynamics, "spring_stiffness", 0.0),
        values.number(dynamics, "spring_reference", 0.0),
        values.number(element, "initial_position", 0.0),
        element.span,
    )


def _expressed_in(axis: Element, scope: Scope) -> str:
    """Return the frame of the axis: empty for the joint's own.

    `expressed_in` counts in any version: libsdformat reads old files as if they were new. Before
    SDF 1.7 `use_parent_model_frame` comes first, which is true by default up to 1.4.
    """
    if scope.version < (1, 7):
        of_model = scope.values.boolean(axis, "use_parent_model_frame", scope.version <= (1, 4))
        if of_model.value:
            return scope.scoped(MODEL_FRAME)
    xyz = axis.child("xyz")
    written = (xyz.get("expressed_in") or "").strip() if xyz is not None else ""
    return scope.scoped(written) if written else ""


def _bound(limit: Located[float]) -> Located[float]:
    if abs(limit.value) < UNLIMITED:
        return limit
    return Located(math.copysign(math.inf, limit.value), limit.span, limit.stated)


def _maximum(limit: Located[float]) -> Located[float]:
    """Effort and velocity: −1 (any negative number) and huge ones mean without limit."""
    if 0.0 <= limit.value < UNLIMITED:
        return limit
    return Located(math.inf, limit.span, limit.stated)


def read_frame(element: Element, scope: Scope) -> Frame:
    """Read a `<frame>`: posed in the frame it is attached to by default."""
    name = scope.name(element)
    attached = (element.get("attached_to") or "").strip()
    pose = scope.pose(element)
    scope.graph.add(
        scope.scoped(name.value),
        FrameNode(
            pose.relative_to or scope.scoped(attached),
            pose.transform,
            pose.span,
            f"frame '{name.value}'",
        ),
    )
    return Frame(name, element, scope.scoped(name.value), attached, pose)
