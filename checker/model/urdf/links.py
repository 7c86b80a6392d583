"""Links of URDF: the same parts as in SDF, written as attributes."""

from __future__ import annotations

from collections.abc import Mapping

from checker.model.components import Collision, Inertial, Link, Pose, Visual
from checker.model.geometry.shapes import Geometry, Material
from checker.model.geometry.transform import Transform, Vector
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_ZERO = (0.0, 0.0, 0.0)
_ONES = (1.0, 1.0, 1.0)
_SIZES: Mapping[str, Mapping[str, tuple[float, ...]]] = {
    "box": {"size": _ONES},
    "cylinder": {"radius": (1.0,), "length": (1.0,)},
    "sphere": {"radius": (1.0,)},
    "capsule": {"radius": (1.0,), "length": (1.0,)},
    "mesh": {"scale": _ONES},
}


def read_link(element: Element, values: ValueReader) -> Link:
    """Read a `<link>`."""
    name = values.name(element)
    return Link(
        name,
        element,
        name.value,
        Pose(Transform(), "", (), element.span),
        _read_inertial(element, values),
        tuple(_read_collision(child, values) for child in element.all("collision")),
        tuple(_read_visual(child, values) for child in element.all("visual")),
        (),
        (),
        Located(True, element.span, stated=False),
        Located(False, element.span, stated=False),
        default_mass=0.0,
    )


def read_origin(parent: Element, values: ValueReader) -> Pose:
    """Read the `<origin xyz rpy>` below an element; zeros when it has none."""
    origin = parent.child("origin")
    if origin is None:
        numbers = tuple(Located(0.0, parent.span, stated=False) for _ in range(6))
        return Pose(Transform(), "", numbers, parent.span)
    xyz = values.finite(values.attribute_numbers(origin, "xyz", _ZERO))
    rpy = values.finite(values.attribute_numbers(origin, "rpy", _ZERO))
    transform = Transform.from_xyz_rpy(_vector(xyz), _vector(rpy))
    return Pose(transform, "", (*xyz, *rpy), origin.span)


def _vector(numbers: tuple[Located[float], ...]) -> Vector:
    return (numbers[0].value, numbers[1].value, numbers[2].value)


def _read_inertial(link: Element, values: ValueReader) -> Inertial | None:
    element = link.child("inertial")
    if element is None:
        return None
    mass = element.child("mass") or element
    inertia = element.child("inertia") or element
    return Inertial(
        read_origin(element, values),
        values.attribute_numbers(mass, "value", (0.0,))[0],
        tuple(values.attribute_numbers(inertia, name, (0.0,))[0] for name in _MOMENTS),
        element.span,
    )


def _read_collision(element: Element, values: ValueReader) -> Collision:
    return Collision(
        values.name(element), element, read_origin(element, values), _geometry(element, values)
    )


def _read_visual(element: Element, values: ValueReader) -> Visual:
    return Visual(
        values.name(element),
        element,
        read_origin(element, values),
        _geometry(element, values),
        _material(element, values),
    )


def _geometry(parent: Element, values: ValueReader) -> Geometry:
    geometry = parent.child("geometry") or parent
    shape = next((child for child in geometry.children if child.tag in _SIZES), None)
    if shape is None or geometry is parent:
        return Geometry("", {}, None, geometry)
    sizes = {
        name: values.attribute_numbers(shape, name, default)
        for name, default in _SIZES[shape.tag].items()
    }
    return Geometry(shape.tag, sizes, shape.attribute("filename"), shape)


def _material(parent: Element, values: ValueReader) -> Material | None:
    element = parent.child("material")
    if element is None:
        return None
    colour, texture = element.child("color"), element.child("texture")
    colours = {}
    if colour is not None:
        colours["diffuse"] = values.attribute_numbers(colour, "rgba", (0.0, 0.0, 0.0, 1.0))
    file = texture.attribute("filename") if texture is not None else None
    return Material(element, colours, (file,) if file is not None else (), ())
