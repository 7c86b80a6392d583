"""What is known of a robot, in words: figures with units, parts counted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from checker.record import record
from checker.report.wording import count

UNITS = {"kg": "kg", "m": "m", "deg": "°", "s": "s"}
"""Units by the ends of the names of facts: `mass_kg`."""


@record()
class Fact:
    """Something known.

    Attributes:
        name: `mass`.
        value: With its unit: `18.5 kg`.
        phrase: Both together as one says it: `mass 18.5 kg`, `8 joints`.
    """

    name: str
    value: str
    phrase: str


def facts_in_words(facts: Mapping[str, Any]) -> Iterator[Fact]:
    """Yield the facts of a report that can be said in a few words."""
    for name, value in facts.items():
        words, _, unit = name.rpartition("_")
        if unit in UNITS and isinstance(value, float | list):
            yield _stated(words.replace("_", " "), f"{_quantity(words, value)} {UNITS[unit]}")
        elif isinstance(value, float):
            yield _stated(name.replace("_", " "), f"{value:.3g}")
        elif isinstance(value, int):
            noun = name.replace("_", " ")
            yield Fact(noun, str(value), count(value, noun.removesuffix("s")))
        elif isinstance(value, str):
            yield _stated(name.replace("_", " "), value)


def _stated(name: str, value: str) -> Fact:
    return Fact(name, value, f"{name} {value}")


def _quantity(name: str, value: float | list[float]) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    numbers = [f"{round(each, 3) + 0.0:g}" for each in value]
    return " × ".join(numbers) if name == "size" else f"({', '.join(numbers)})"
