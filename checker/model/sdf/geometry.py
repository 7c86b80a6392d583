"""Shapes and materials of SDF."""

from __future__ import annotations

from collections.abc import Mapping

from checker.model.shapes import Geometry, Material
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

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
    """Read the `<geometry>` below a collision or visual; shape is empty when there is none."""
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
