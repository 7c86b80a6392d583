"""Settings of a camera: of colours, depth or heat."""

from __future__ import annotations

import math

from checker.base.record import Record
from checker.model.sensing.noise import Noise, read_noise
from checker.model.values import ValueReader
from checker.source.text import Located, Span
from checker.source.xml import Element, Tagged


class Pinhole(Record):
    """Pinhole projection of a camera: focal lengths and principal point, pixels."""

    fx: float
    fy: float
    cx: float
    cy: float

    def agrees(self, other: Pinhole, share: float, pixels: float) -> bool:
        """Return whether focal lengths agree within a share, and principal points within pixels."""
        return (
            math.isclose(self.fx, other.fx, rel_tol=share)
            and math.isclose(self.fy, other.fy, rel_tol=share)
            and abs(self.cx - other.cx) <= pixels
            and abs(self.cy - other.cy) <= pixels
        )


DEFAULT_PINHOLE = Pinhole(277.0, 277.0, 160.0, 120.0)
"""SDFormat's own: right for 320 × 240 pixels and a horizontal field of view of 60°."""


class Intrinsics(Tagged, Record, eq=False):
    """A `<lens><intrinsics>`: focal lengths, principal point and skew, pixels."""

    fx: Located[float]
    fy: Located[float]
    cx: Located[float]
    cy: Located[float]
    skew: Located[float]
    element: Element

    @property
    def are_measured(self) -> bool:
        """True if they look calibrated: computed ones have a centre on half a pixel."""
        return any(math.isfinite(c.value) and 2.0 * c.value % 1.0 for c in (self.cx, self.cy))


class Clip(Record, eq=False):
    """Metres from which, and up to which, a camera sees; `span` is the start tag."""

    near: Located[float]
    far: Located[float]
    span: Span


class Camera(Tagged, Record, eq=False):
    """A `<camera>`.

    Attributes:
        width: Pixels.
        height: Pixels.
        horizontal_fov: Radians.
        format: The format of the pixels, such as `R8G8B8`.
        clip: The clip distances of the picture.
        depth_clip: The clip distances of the depth image; None if the file states none.
        intrinsics: None if the file states none.
        distortion: Coefficients k1, k2, k3, p1, p2 that the file states.
        noise: The noise of the pixels, as a share of white.
        element: The `<camera>`.
    """

    width: Located[float]
    height: Located[float]
    horizontal_fov: Located[float]
    format: Located[str]
    clip: Clip
    depth_clip: Clip | None
    intrinsics: Intrinsics | None
    distortion: dict[str, Located[float]]
    noise: Noise | None
    element: Element

    @property
    def pixels(self) -> float:
        """Pixels of a picture."""
        return self.width.value * self.height.value

    @property
    def pinhole(self) -> Pinhole | None:
        """Projection of the rendered image, from its size and `horizontal_fov`.

        None if no pinhole sees that far around, and for a picture without pixels.
        """
        width, height, angle = self.width.value, self.height.value, self.horizontal_fov.value
        if not (0.0 < width < math.inf and 0.0 < height < math.inf and 0.0 < angle < math.pi):
            return None
        # tan of the smallest angles makes lengths that overflow.
        focal = width / max(2.0 * math.tan(angle / 2.0), _LEAST_TANGENT)
        return Pinhole(focal, focal, (width - 1.0) / 2.0, (height - 1.0) / 2.0)

    @property
    def depth_near(self) -> Located[float]:
        """Metres from which it measures distances: those of the picture unless stated apart."""
        apart = self.depth_clip.near if self.depth_clip is not None else None
        return apart if apart is not None and apart.stated else self.clip.near

    @property
    def depth_far(self) -> Located[float]:
        """Metres up to which it measures distances: those of the picture unless stated apart."""
        apart = self.depth_clip.far if self.depth_clip is not None else None
        return apart if apart is not None and apart.stated else self.clip.far


_LEAST_TANGENT = 1e-9


def read_camera(sensor: Element) -> Camera | None:
    """Read the `<camera>` of a sensor; None if it has none. Defaults are SDFormat's."""
    element = sensor.child("camera")
    if element is None:
        return None
    values = ValueReader()
    image = element.child("image") or element
    depth = element.child("depth_camera")
    depth_clip = depth.child("clip") if depth is not None else None
    lens = element.child("lens")
    intrinsics = lens.child("intrinsics") if lens is not None else None
    return Camera(
        values.number(image, "width", 320.0),
        values.number(image, "height", 240.0),
        values.number(element, "horizontal_fov", 1.047),
        values.text(image, "format", "R8G8B8"),
        _read_clip(element.child("clip") or element, 100.0),
        _read_clip(depth_clip, 10.0) if depth_clip is not None else None,
        _read_intrinsics(intrinsics) if intrinsics is not None else None,
        _read_distortion(element.child("distortion")),
        read_noise(element),
        element,
    )


def _read_clip(element: Element, far: float) -> Clip:
    values = ValueReader()
    return Clip(
        values.number(element, "near", 0.1), values.number(element, "far", far), element.span
    )


def _read_intrinsics(element: Element) -> Intrinsics:
    values = ValueReader()
    return Intrinsics(
        values.number(element, "fx", DEFAULT_PINHOLE.fx),
        values.number(element, "fy", DEFAULT_PINHOLE.fy),
        values.number(element, "cx", DEFAULT_PINHOLE.cx),
        values.number(element, "cy", DEFAULT_PINHOLE.cy),
        values.number(element, "s", 0.0),
        element,
    )


def _read_distortion(element: Element | None) -> dict[str, Located[float]]:
    if element is None:
        return {}
    values = ValueReader()
    read = {name: values.number(element, name, 0.0) for name in ("k1", "k2", "k3", "p1", "p2")}
    return {name: number for name, number in read.items() if number.stated}
