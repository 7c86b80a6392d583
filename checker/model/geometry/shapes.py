"""Geometry and material of collisions and visuals."""

from __future__ import annotations

from functools import cached_property

from checker.base.record import Record
from checker.source.text import Located
from checker.source.xml import Element, Tagged

LENGTHS = ("size", "radius", "length", "radii")
"""Names of lengths; a negative scale mirrors a mesh."""


class Geometry(Tagged, Record, eq=False, dict=True):
    """The shape of a collision or visual.

    Attributes:
        shape: Tag of the shape (`box`, `cylinder`, `mesh`, …); empty if there is none.
        sizes: The shape's lengths in metres by name: `size` (3 numbers), `radius`, `length`,
            `radii`, `normal`, `scale`.
        uri: Mesh, heightmap or image file as written.
        span: The shape's element.
    """

    shape: str
    sizes: dict[str, tuple[Located[float], ...]]
    uri: Located[str] | None
    element: Element

    @cached_property
    def has_size(self) -> bool:
        """True if all its lengths are above 0; GEO008 reports others."""
        lengths = (self.sizes.get(name, ()) for name in LENGTHS)
        return all(length.value > 0.0 for each in lengths for length in each)


class Material(Tagged, Record, eq=False):
    """Colours and textures.

    Attributes:
        colours: `ambient`, `diffuse`, `specular`, `emissive` by name, red to alpha in 0…1.
        textures: Files of `<pbr>` and, in URDF, `<texture>`.
        scripts: URIs of `<script>`.
    """

    element: Element
    colours: dict[str, tuple[Located[float], ...]]
    textures: tuple[Located[str], ...]
    scripts: tuple[Located[str], ...]
