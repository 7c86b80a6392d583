"""The values of a rule on real robots: parted by its numbers, and drawn as a page."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from jinja2 import Environment

from bench.measures import Measure

WIDTH, MARGIN, DOT, AXIS = 900, 30, 5, 24
"""Pixels."""
COLOURS = {"true": "#c0392b", "arguable": "#e08e0b", "false": "#2471a3", "": "#b4bcc2"}
"""Colours by verdict; without one, a value is not judged."""
_ORDER = tuple(COLOURS)


@dataclass(frozen=True)
class Value:
    """A value that was measured.

    Attributes:
        number: The value.
        verdict: The judgement of the finding at its place; empty without one.
        text: The place of the finding, and its message.
    """

    number: float
    verdict: str
    text: str


@dataclass(frozen=True)
class Distribution:
    """The values of one measure, ascending, and the numbers that they are compared with."""

    measure: Measure
    numbers: Mapping[str, float]
    values: tuple[Value, ...]

    def parted(self, name: str) -> tuple[list[Value], list[Value]]:
        """Return the values beyond a number and the others, each with the nearest to it first."""
        number = self.numbers[name]
        low = [value for value in self.values if value.number < number][::-1]
        high = [value for value in self.values if value.number > number]
        equal = [value for value in self.values if value.number == number]
        if name in self.measure.below:
            return low, equal + high
        return high, equal + low

    @cached_property
    def _place(self) -> Callable[[float], float]:
        """Function from a value to pixels from the left edge."""
        linear = self.measure.linear
        known = [value.number for value in self.values] + list(self.numbers.values())
        positive = [number for number in known if number > 0.0]
        least = min(known if linear else positive, default=1.0)

        def scaled(number: float) -> float:
            return number if linear else math.log10(max(number, least))

        low, high = scaled(least), scaled(max(known, default=1.0))
        width = (high - low) or 1.0
        return lambda number: MARGIN + (scaled(number) - low) / width * (WIDTH - 2 * MARGIN)

    def dots(self) -> Iterator[tuple[float, int, str, str]]:
        """Yield a dot for each value: x, how many are below it, colour and text."""
        below: Counter[int] = Counter()
        for value in sorted(self.values, key=lambda value: _ORDER.index(value.verdict)):
            column = round(self._place(value.number) / DOT)
            yield column * DOT, below[column], COLOURS[value.verdict], value.text
            below[column] += 1

    def lines(self) -> list[tuple[float, str]]:
        """Return the positions and names of the numbers."""
        return [(self._place(at), f"{name} = {at:g}") for name, at in self.numbers.items()]


_PAGE = """<!doctype html>
<meta charset="utf-8">
<title>{{ rule }}</title>
<style>
body { font: 14px sans-serif; margin: 2em; max-width: 60em }
svg { background: #fafafa } li { margin: .3em 0 } .judged { font-weight: bold }
</style>
<h1>{{ rule }}</h1>
<p>{% for verdict, colour in colours.items() %}
<span style="color: {{ colour }}">●</span> {{ verdict or "not judged" }}
{% endfor %}</p>
{% for one in found %}
{% set dots = one.dots() | list %}
{% set height = ((dots | map(attribute=1) | max if dots else 0) + 2) * dot + 90 %}
<h2>{{ one.measure.what }}: {{ one.values | length }} values</h2>
<svg width="{{ width }}" height="{{ height }}">
<line x1="0" x2="{{ width }}" y1="{{ height - axis }}" y2="{{ height - axis }}" stroke="#555"/>
{% for x, above, colour, text in dots %}
<circle cx="{{ x }}" cy="{{ height - axis - 4 - above * dot }}" r="2.4" fill="{{ colour }}">
<title>{{ text }}</title></circle>
{% endfor %}
{% for x, text in one.lines() %}
<line x1="{{ x }}" x2="{{ x }}" y1="{{ 18 + 16 * loop.index0 }}" y2="{{ height - axis }}"
 stroke="#111" stroke-dasharray="4 3"/>
<text x="{{ x }}" y="{{ 14 + 16 * loop.index0 }}"
 text-anchor="{{ 'end' if x > width / 2 else 'start' }}">{{ text }}</text>
{% endfor %}
{% if one.values %}
<text x="0" y="{{ height - 6 }}">{{ "%.3g" | format(one.values[0].number) }}</text>
<text x="{{ width }}" y="{{ height - 6 }}" text-anchor="end">
{{- "%.3g" | format(one.values[-1].number) }}</text>
{% endif %}
</svg>
{% for name in one.numbers %}
{% set beyond, within = one.parted(name) %}
{% for side, values in (("beyond", beyond), ("within", within)) %}
<h3>Nearest to {{ name }}, {{ side }} it ({{ values | length }})</h3>
<ol>{% for value in values[:nearest] %}
<li><span class="judged" style="color: {{ colours[value.verdict] }}">
{{- "%.3g" | format(value.number) }} {{ value.verdict }}</span> {{ value.text }}</li>
{% endfor %}</ol>
{% endfor %}
{% endfor %}
{% endfor %}
"""


def page(rule: str, found: Sequence[Distribution]) -> str:
    """Return the page of a rule as HTML."""
    template = Environment(autoescape=True).from_string(_PAGE)
    return template.render(
        rule=rule, found=found, colours=COLOURS, width=WIDTH, axis=AXIS, dot=DOT, nearest=25
    )
