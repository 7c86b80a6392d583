"""Settings of a lidar."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.sensing.noise import Noise, read_noise
from checker.model.values import ValueReader
from checker.source.text import Located, Span
from checker.source.xml import Element, Tagged


class Scan(Record, eq=False):
    """Rays of one direction, horizontal or vertical.

    Attributes:
        samples: Rays that are measured.
        resolution: Points that are given for each of them.
        lower: Angle of the first ray, radians.
        upper: Angle of the last ray, radians.
        span: The start tag.
    """

    samples: Located[float]
    resolution: Located[float]
    lower: Located[float]
    upper: Located[float]
    span: Span

    @property
    def angle(self) -> float:
        """Radians from the first ray to the last."""
        return self.upper.value - self.lower.value

    @property
    def middle(self) -> float:
        """Angle half way between the first ray and the last, radians."""
        return (self.lower.value + self.upper.value) / 2.0


class Lidar(Tagged, Record, eq=False):
    """A `<lidar>` or `<ray>`.

    Attributes:
        horizontal: Rays of a row.
        vertical: Rows; one where the file states nothing.
        range_min: Metres; what a plugin of Gazebo Classic leaves out does not count.
        range_max: Metres; the same.
        range_resolution: Metres; 0 if the file states none.
        noise: The noise of the ranges, metres.
        element: The `<lidar>` or `<ray>`.
    """

    horizontal: Scan
    vertical: Scan
    range_min: Located[float]
    range_max: Located[float]
    range_resolution: Located[float]
    noise: Noise | None
    element: Element

    @property
    def rows(self) -> float:
        """Rows of rays."""
        return self.vertical.samples.value

    @property
    def rays(self) -> float:
        """Rays of a whole scan."""
        return self.horizontal.samples.value * self.vertical.samples.value


def read_lidar(sensor: Element) -> Lidar | None:
    """Read the `<lidar>` or `<ray>` of a sensor; None if it has none."""
    element = sensor.child("lidar") or sensor.child("ray")
    if element is None:
        return None
    values = ValueReader()
    scan = element.child("scan")
    range_ = element.child("range") or element
    plugins = sensor.all("plugin")
    nearest = [values.number(range_, "min", 0.0)]
    nearest += [values.number(plugin, "min_range", 0.0) for plugin in plugins]
    farthest = [values.number(range_, "max", 0.0)]
    farthest += [values.number(plugin, "max_range", 0.0) for plugin in plugins]
    return Lidar(
        _read_scan(scan, "horizontal", element, 640.0),
        _read_scan(scan, "vertical", element, 1.0),
        max(_stated(nearest), key=_value),
        min(_stated(farthest), key=_value),
        values.number(range_, "resolution", 0.0),
        read_noise(element),
        element,
    )


def _stated(numbers: list[Located[float]]) -> list[Located[float]]:
    """Return the numbers that the file states; the first, a default, where it states none."""
    return [number for number in numbers if number.stated] or numbers[:1]


def _value(number: Located[float]) -> float:
    return number.value


def _read_scan(scan: Element | None, tag: str, lidar: Element, samples: float) -> Scan:
    values = ValueReader()
    element = (scan.child(tag) if scan is not None else None) or lidar
    return Scan(
        values.number(element, "samples", samples),
        values.number(element, "resolution", 1.0),
        values.number(element, "min_angle", 0.0),
        values.number(element, "max_angle", 0.0),
        element.span,
    )
