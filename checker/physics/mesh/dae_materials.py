"""The materials of a COLLADA file.

Only diffuse colours, diffuse pictures and transparency are read (COLLADA 1.4.1, FX elements
of profile_COMMON): the light of the display is not that of the file.
"""

from __future__ import annotations

import math
from typing import Any

from lxml import etree

from checker.physics.mesh.content import Material
from checker.physics.mesh.surface import GREY, Colour

_FAINTEST = 0.02
"""Alpha below which a material counts as opaque: exporters that mix up 0 and 1 are common."""


def places_in_picture(triangles: Any) -> Any:
    """Return where corners are in a picture, by the first set that the file has of it."""
    import numpy as np

    if not triangles.texcoordset:
        return None
    sets, numbers = triangles.texcoordset[0], triangles.texcoord_indexset[0]
    sound = numbers.shape == triangles.vertex_index.shape and sets.shape[1:] >= (2,)
    if not sound or numbers.min(initial=0) < 0 or numbers.max(initial=-1) >= len(sets):
        return None
    return np.asarray(sets, np.float64)[:, :2][numbers]


class DaeMaterials:
    """The materials of a document; read before they are taken out."""

    def __init__(self, root: etree._Element) -> None:
        """Read them."""
        self._bound = _bound(root)
        images = {_id(image): _text(image, "init_from") for image in root.iter("{*}image")}
        effects = {_id(effect): _material(effect, images) for effect in root.iter("{*}effect")}
        self._materials = {
            _id(material): effects.get(
                _target(material.find("{*}instance_effect"), "url"), Material()
            )
            for material in root.iter("{*}material")
        }

    def material_of(self, geometry: str, symbol: str) -> Material:
        """Return the material of triangles of a geometry that name a symbol."""
        return self._materials.get(self._bound.get((geometry, symbol), symbol), Material())


def _bound(root: etree._Element) -> dict[tuple[str, str], str]:
    """Return the id of the material that each symbol of a geometry represents."""
    return {
        (_target(shown, "url"), bound.get("symbol", "")): _target(bound, "target")
        for shown in root.iter("{*}instance_geometry")
        for bound in shown.iter("{*}instance_material")
    }


def _material(effect: etree._Element, images: dict[str, str]) -> Material:
    shading = effect.find("{*}profile_COMMON/{*}technique/*")
    for kind in ("phong", "lambert", "blinn", "constant"):
        node = effect.find(f"{{*}}profile_COMMON/{{*}}technique/{{*}}{kind}")
        shading = node if node is not None else shading
    if shading is None:
        return Material()
    shows = "emission" if local_name(shading) == "constant" else "diffuse"
    texture = shading.find(f"{{*}}{shows}/{{*}}texture")
    picture = _picture(effect, images, texture.get("texture", "")) if texture is not None else ""
    red, green, blue, _ = _colour(shading, shows) or GREY
    return Material((red, green, blue, _alpha(shading)), picture)


def _picture(effect: etree._Element, images: dict[str, str], name: str) -> str:
    """Return the file behind a texture: a sampler names a surface, which names an image."""
    parameters = {parameter.get("sid", ""): parameter for parameter in effect.iter("{*}newparam")}
    for inside in ("sampler2D/{*}source", "surface/{*}init_from"):
        if name in parameters:
            name = _text(parameters[name], inside) or name
    return images.get(name, "")


def _alpha(shading: etree._Element) -> float:
    """Return how opaque a material is, by the modes A_ONE (the default) and RGB_ZERO."""
    transparent = shading.find("{*}transparent")
    if transparent is None:
        return 1.0
    share = _number(_text(shading, "transparency/{*}float") or "1")
    red, green, blue, alpha = _colour(shading, "transparent") or (0.0, 0.0, 0.0, 1.0)
    if transparent.get("opaque", "A_ONE") == "RGB_ZERO":
        # Weights of luminance, as the specification has them.
        opaque = 1.0 - share * (0.212671 * red + 0.71516 * green + 0.072169 * blue)
    else:
        opaque = share * alpha
    return min(opaque, 1.0) if opaque > _FAINTEST else 1.0


def _colour(shading: etree._Element, name: str) -> Colour | None:
    written = _text(shading, f"{name}/{{*}}color").split()
    numbers = [min(max(_number(word), 0.0), 1.0) for word in written[:4]]
    if len(numbers) < 3 or not all(map(math.isfinite, numbers)):
        return None
    red, green, blue, alpha = (*numbers, 1.0)[:4]
    return (red, green, blue, alpha)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _text(element: etree._Element, path: str) -> str:
    node = element.find(f"{{*}}{path}")
    return (node.text or "").strip() if node is not None else ""


def _id(element: etree._Element) -> str:
    return element.get("id", "")


def _target(element: etree._Element | None, name: str) -> str:
    return element.get(name, "").lstrip("#") if element is not None else ""


def local_name(element: etree._Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rpartition("}")[2]
