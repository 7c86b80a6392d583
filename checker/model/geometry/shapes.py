"""Geometry and material of collisions and visuals."""

from __future__ import annotations

from checker.base.record import Record
from checker.source.text import Located, Span
from checker.source.xml import Element


class Geometry(Record, eq=False):
    """The shape of a collision or visual.

    Attributes:
        shape: Tag of the shape (`box`, `cylinder`, `mesh`, …); empty when there is none.
        sizes: The shape's lengths in metres by name: `size` (3 numbers), `radius`, `length`,
            `radii`, `normal`, `scale`.
        uri: Mesh, heightmap or image file as written.
        span: The shape's element.
    """

    shape: str
    sizes: dict[str, tuple[Located[float], ...]]
    uri: Located[str] | None
    element: Element

    @property
    def span(self) -> Span:
        """The shape's start tag."""
        return self.element.span


class Material(Record, eq=False):
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

    @property
    def span(self) -> Span:
        """The material's start tag."""
        return self.element.span
