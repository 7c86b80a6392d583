"""The layer of inertias: boxes that would turn as the links do."""

from __future__ import annotations

import math
from dataclasses import replace

from checker.display.notes import short
from checker.display.primitives import box
from checker.display.scene import Item, Layer
from checker.display.showing import Hung, Showing
from checker.display.surface import Colour
from checker.dynamics.inertia import moments_of
from checker.model.components import Link
from checker.model.transform import Rotation, Transform, Vector
from checker.trial.mjcf_text import FAR

_VIOLET: Colour = (0.6, 0.25, 0.9, 0.4)
_SLACK = 1e-9
_THINNEST = 1e-3
"""Share of its longest edge that an edge of a box keeps, so that rods and discs can be seen."""
_LARGEST = 4.0
"""Sizes of the robot beyond which a box would hide all the rest."""


def inertias(showing: Showing) -> Hung:
    """Yield a box for each link: of its mass, uniform, with its inertia.

    Inertias that no body can have are left out; rules tell of them. So are those of boxes that
    the robot would be lost in, with a note.
    """
    violet = replace(box(), colour=_VIOLET)
    for link in showing.links:
        place, found = showing.centre_in_link(link), _equal_box(link)
        if place is not None and found is not None:
            edges, axes = found
            if max(edges) > _LARGEST * showing.size:
                _say_how_large(showing, link, max(edges))
                continue
            pose = place @ Transform(axes)
            part = "inertial" if link.inertial is not None else "no inertial: the default is used"
            item = Item(Layer.INERTIA, part, showing.inertial_path(link), pose, (violet,), edges)
            yield link.scoped_name, item


def _say_how_large(showing: Showing, link: Link, edge: float) -> None:
    name = short(link.scoped_name)
    what = f"the inertia of link {name!r} is that of a box of {edge:.3g} m"
    showing.notes.say(f"{what}: it is not shown")


def _equal_box(link: Link) -> tuple[Vector, Rotation] | None:
    """Return the edges (metres) and axes of the uniform box of a link's mass and inertia.

    A box of mass m and edges a, b, c has the moment m (b² + c²) / 12 along a, and so on. None
    where no such box exists: then one moment is greater than the other two together.
    """
    import numpy as np

    moments = moments_of(link)
    if not (np.isfinite(moments).all() and 0.0 < link.mass < math.inf and np.abs(moments).max()):
        return None
    # Scaled, for the solver squares what it is given.
    scale = float(np.abs(moments).max())
    principal, axes = np.linalg.eigh(moments / scale)
    squares = 6.0 * (principal.sum() - 2.0 * principal)
    if principal.min() < -_SLACK or squares.min() < -_SLACK:
        return None
    if np.linalg.det(axes) < 0.0:
        axes[:, 0] *= -1.0
    longest = float(np.sqrt(squares.max()))
    unit = math.sqrt(scale) / math.sqrt(link.mass)
    x, y, z = (np.sqrt(np.maximum(squares, (_THINNEST * longest) ** 2)) * unit).tolist()
    first, second, third = ((a, b, c) for a, b, c in axes.tolist())
    return ((x, y, z), (first, second, third)) if 0.0 < max(x, y, z) <= FAR else None
