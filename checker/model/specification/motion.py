"""Limits of velocity and acceleration, and the turning radius."""

from __future__ import annotations

import enum
import math
import re
from collections.abc import Iterable, Iterator, Sequence

from checker.base.record import Record
from checker.model.specification.quantities import (
    NUMBER,
    Quantity,
    QuantityKind,
    Sentence,
    configurations_in,
    is_approximate,
    number_of,
    resolution_of,
    sentences,
)
from checker.source.markdown import Passage
from checker.source.text import Span


class MotionQuantity(enum.Enum):
    """Quantity that a motion limit bounds, with its SI unit."""

    LINEAR_VELOCITY = "linear velocity, m/s"
    LINEAR_ACCELERATION = "linear acceleration, m/s²"
    ANGULAR_VELOCITY = "angular velocity, rad/s"
    ANGULAR_ACCELERATION = "angular acceleration, rad/s²"

    @property
    def is_acceleration(self) -> bool:
        """True if it is the change of a velocity."""
        return self.name.endswith("ACCELERATION")


class Limit(Record, eq=False):
    """A motion limit of the sheet.

    Attributes:
        quantity: What is bounded.
        axes: Letters among `xyz`; empty if the sheet names none.
        minimum: The minimum in SI units; None if the sheet gives only the greatest amount.
        maximum: The maximum in SI units.
        modeled: Whether the sheet states that the model has this limit, other than the robot.
        approximate: Whether the text states `about`, `~` or the like.
        span: The numbers and their units.
    """

    quantity: MotionQuantity
    axes: str
    minimum: float | None
    maximum: float
    modeled: bool
    approximate: bool
    span: Span


_SQUARED = r"s\s{0,10}(?:\^\s{0,3}2|2\b|²|/\s?s\b)|\(\s?s\s?\*\s?s\s?\)|sec(?:ond)?\s?\^\s?2"
_SECOND = r"\s?(?:/\s?s(?:ec(?:ond)?)?\b|per\s+second\b)"
_TURN = r"(?P<turn>rad(?:ian)?s?|deg(?:ree)?s?|°)"
_UNIT = (
    rf"(?:m\s?/\s?(?P<acceleration>{_SQUARED})"
    rf"|{_TURN}(?:\s?/\s?(?P<turn_acceleration>{_SQUARED})|{_SECOND})"
    rf"|(?P<kmh>km\s?/\s?h(?:(?:ou)?r)?\b|kph\b)"
    rf"|(?:m|met(?:er|re)s?){_SECOND})"
)
_SIGNED = rf"(?:[-+\N{{MINUS SIGN}}]\s?)?(?:{NUMBER})"
_ANY_UNIT = re.sub(r"\?P<\w+>", "?:", _UNIT)
_STATEMENT = re.compile(
    rf"(?<![\w.])(?:(?P<plusminus>\+\s?/?\s?-|±)\s?(?P<both>{NUMBER})"
    rf"|(?P<low>{_SIGNED})\s{{0,5}}(?:{_ANY_UNIT})?\s{{0,20}}(?:to|and|\.\.\.?|-)\s{{0,20}}"
    rf"(?P<high>{_SIGNED})"
    rf"|(?P<single>{_SIGNED}))\s{{0,5}}{_UNIT}",
    re.IGNORECASE,
)
_MAXIMUM = re.compile(r"\b(?:max(?:imum|imal)?|top|limit\w*|capped)\b", re.IGNORECASE)
_MODELED = re.compile(r"\b(?:modell?ed|simulated)\s+(?:as|with|by)\b", re.IGNORECASE)
_ACCELERATION = re.compile(r"\bacceler\w*", re.IGNORECASE)
_VELOCITY = re.compile(r"\b(?:velocit\w*|speeds?|rates?)\b", re.IGNORECASE)
_PART = re.compile(
    r"\b(?:flippers?|lasers?|lidars?|gimbals?|arms?|each|wheels?|motors?|rotors?|joints?|cameras?"
    r"|pan|tilt|turrets?|manipulators?|physical|real|hardware|manufacturer\w*)\b",
    re.IGNORECASE,
)
_AXIS = re.compile(r"\b([xyz])\b", re.IGNORECASE)
_AXIS_WORDS = (
    (re.compile(r"\b(?:forward|longitudinal)\b", re.IGNORECASE), "x"),
    (re.compile(r"\b(?:lateral|sideways)\b", re.IGNORECASE), "y"),
    (re.compile(r"\b(?:vertical|climb\w*|turn\w*|yaw)\b", re.IGNORECASE), "z"),
)
_RADIUS = re.compile(
    rf"\bturning\s+radius\s+(?:of|is|=|:)\s{{0,5}}(?:about\s|approximately\s|~)?\s{{0,5}}({NUMBER})"
    r"(?!\s?[\w%]*\d)(?:\s{0,5}(m|met(?:er|re)s?|cm)\b)?",
    re.IGNORECASE,
)


def limits(passages: Iterable[Passage]) -> Iterator[Limit]:
    """Yield the limits of a motion section."""
    for passage in passages:
        for sentence in sentences(passage):
            if not configurations_in(sentence.text):
                yield from _limits_of(sentence)


def _limits_of(sentence: Sentence) -> Iterator[Limit]:
    last = 0
    before_this: Limit | None = None
    for match in _STATEMENT.finditer(sentence.text):
        clause = sentence.text[last : match.start()]
        last = match.end()
        limit = _limit(sentence, match, clause, before_this)
        if limit is not None:
            before_this = limit
            yield limit


def _limit(
    sentence: Sentence, match: re.Match[str], clause: str, before: Limit | None
) -> Limit | None:
    quantity, factor = _dimension(match)
    if _PART.search(clause) or _contradicts(clause, quantity):
        return None
    modeled = bool(_MODELED.search(clause))
    axes = _axes(clause)
    if modeled and not axes and before is not None and before.quantity is quantity:
        axes = before.axes
    if match["single"]:
        if not _MAXIMUM.search(clause) and not modeled:
            return None
        minimum, maximum = None, number_of(match["single"]) * factor
    elif match["both"]:
        maximum = number_of(match["both"]) * factor
        minimum = -maximum
    else:
        minimum, maximum = number_of(match["low"]) * factor, number_of(match["high"]) * factor
    span = sentence.part(*match.span())
    return Limit(quantity, axes, minimum, maximum, modeled, is_approximate(clause), span)


def _dimension(match: re.Match[str]) -> tuple[MotionQuantity, float]:
    """Return what the unit measures and its worth in SI units."""
    if match["turn"]:
        factor = 1.0 if match["turn"].lower().startswith("rad") else math.pi / 180
        if match["turn_acceleration"]:
            return MotionQuantity.ANGULAR_ACCELERATION, factor
        return MotionQuantity.ANGULAR_VELOCITY, factor
    if match["acceleration"]:
        return MotionQuantity.LINEAR_ACCELERATION, 1.0
    return MotionQuantity.LINEAR_VELOCITY, 1 / 3.6 if match["kmh"] else 1.0


def _contradicts(clause: str, quantity: MotionQuantity) -> bool:
    """Return whether the words mean a velocity and the unit an acceleration, or vice versa."""
    if quantity.is_acceleration:
        return bool(_VELOCITY.search(clause)) and not _ACCELERATION.search(clause)
    return bool(_ACCELERATION.search(clause)) and not _VELOCITY.search(clause)


def _axes(clause: str) -> str:
    named = {axis.lower() for axis in _AXIS.findall(clause)}
    if not named:
        named = {axis for words, axis in _AXIS_WORDS if words.search(clause)}
    return "".join(sorted(named))


def limit_of(stated: Sequence[Limit], quantity: MotionQuantity, axis: str) -> Limit | None:
    """Return the limit that the sheet gives for an axis; None if it gives none or several.

    What the model is said to have counts more than what the robot reaches. A limit without an axis
    is meant for every axis.
    """
    fitting = [
        limit
        for limit in stated
        if limit.quantity is quantity and (axis in limit.axes or not limit.axes)
    ]
    best = [limit for limit in fitting if limit.modeled] or fitting
    agree = all(
        (limit.minimum, limit.maximum) == (best[0].minimum, best[0].maximum) for limit in best
    )
    return best[0] if best and agree else None


def turning_radii(passages: Iterable[Passage]) -> Iterator[Quantity]:
    """Yield the turning radii of a motion section; a number without unit must be zero."""
    for passage in passages:
        for sentence in sentences(passage):
            for match in _RADIUS.finditer(sentence.text):
                number, unit = match.group(1), match.group(2) or ""
                factor = 0.01 if unit.lower() == "cm" else 1.0
                if not unit and number_of(number) != 0:
                    continue
                yield Quantity(
                    QuantityKind.TURNING_RADIUS,
                    number_of(number) * factor,
                    resolution_of(number) * factor,
                    unit,
                    is_approximate(match.group()),
                    configurations_in(sentence.text),
                    sentence.part(match.start(1), match.end()),
                )
