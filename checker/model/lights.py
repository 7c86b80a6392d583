"""How a light grows weaker with distance."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.values import ValueReader
from checker.source.text import Located, Span
from checker.source.xml import Element


class Attenuation(Record, eq=False):
    """An `<attenuation>`: at distance d, light is divided by constant + linear·d + quadratic·d².

    Attributes:
        range: Metres up to which it shines.
        constant: Share of 1.
        linear: 1/m.
        quadratic: 1/m².
        element: The `<attenuation>`.
    """

    range: Located[float]
    constant: Located[float]
    linear: Located[float]
    quadratic: Located[float]
    element: Element

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.element.span

    @property
    def is_stated(self) -> bool:
        """Whether the file spells out how the light weakens, and not only how far it shines."""
        return any(factor.stated for factor in (self.constant, self.linear, self.quadratic))

    def divisor(self, distance: float) -> float:
        """Return by what the light is divided at a distance, metres."""
        return (
            self.constant.value
            + self.linear.value * distance
            + self.quadratic.value * distance * distance
        )


def read_attenuation(light: Element) -> Attenuation | None:
    """Read the `<attenuation>` of a light; None when it has none. Defaults are SDFormat's."""
    element = light.child("attenuation")
    if element is None:
        return None
    values = ValueReader()
    return Attenuation(
        values.number(element, "range", 10.0),
        values.number(element, "constant", 1.0),
        values.number(element, "linear", 1.0),
        values.number(element, "quadratic", 0.0),
        element,
    )
