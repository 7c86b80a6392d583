"""An SDF file as the rules on syntax and schema see it, and whether a text has its type."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, partial

from checker.base.record import Record
from checker.formats.sdf.schema import ElementType, walk
from checker.model.values import ValueReader, numbers_of_words
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument

# Whether a text reads as the type that the SDFormat schema gives it.
#
# Numbers are read as `checker.model.values` reads them everywhere.


_INTEGER = re.compile(r"[+-]?(?:0[xX][0-9a-fA-F]{1,16}|\d{1,400})\Z", re.ASCII)
_BOOLEANS = ("true", "false", "1", "0")
_INT32 = 2**31
_LIMIT = 40
_MOST = 3
"""Words of one value that are reported: a value may be as long as a file."""


class Misread(Record):
    """A text that does not read as its type.

    Attributes:
        span: The word at fault, or the whole text.
        problem: What is wrong; the end of a sentence that begins with the element.
        lossy: Whether readers take it anyway, and may lose a part.
    """

    span: Span
    problem: str
    lossy: bool = False


QUATERNION_POSE = "pose quat_xyzw"
"""The type of a pose whose `rotation_format` is `quat_xyzw`."""


def misread_values(text: Located[str], value_type: str) -> list[Misread]:
    """Return what is wrong with a text.

    Args:
        text: Without the blanks around it; not empty.
        value_type: The type as the schema calls it: `double`, `pose`, … A `string` always reads
            well.
    """
    read = _READERS.get(value_type)
    return list(read(text)) if read is not None else []


def values_out_of_bounds(text: Located[str], bounds: tuple[float, float]) -> list[Misread]:
    """Return which numbers of a text are outside what the schema allows."""
    low, high = bounds
    if (low, high) == (-math.inf, math.inf):
        return []
    limits = f"at least {low:g}" if high == math.inf else f"between {low:g} and {high:g}"
    numbers = ValueReader().numbers_in(text)
    outside = [number for number in numbers if not low <= number.value <= high]
    return [
        Misread(number.span, f"is {number.value:g}, expected {limits}")
        for number in outside[:_MOST]
    ]


def _numbers(
    text: Located[str], *, counts: tuple[int, ...], finite: bool = True
) -> Iterator[Misread]:
    values = numbers_of_words(text.value)
    well = [_reads_well(value, finite=finite) for value in values]
    if len(values) in counts and all(well):
        return
    separate = numbers_of_words(text.value.replace(",", " "))
    if len(separate) in counts and all(_reads_well(value, finite=finite) for value in separate):
        yield Misread(text.span, "has commas between its numbers, expected spaces")
        return
    # Parsers stop when they have enough.
    lossy = len(values) > counts[-1] and all(well[: counts[-1]])
    reader = ValueReader()
    numbers = reader.numbers_in(text)
    for fault in reader.faults[:_MOST]:
        problem = f"contains {_short(fault.span.text)}, which is not a number"
        yield Misread(fault.span, problem, lossy)
    if len(numbers) not in counts:
        expected = " or ".join(str(count) for count in counts)
        plural = "" if expected == "1" else "s"
        problem = f"contains {len(numbers)} words, expected {expected} number{plural}"
        yield Misread(text.span, problem, lossy)
    elif finite:
        infinite = (number for number in numbers if not math.isfinite(number.value))
        yield from (
            Misread(number.span, f"contains {number.value:g}, expected a finite number")
            for number in infinite
        )


def _reads_well(value: float | None, *, finite: bool) -> bool:
    return value is not None and not (finite and math.isinf(value))


def _integer(text: Located[str], *, least: int = -_INT32, most: int = _INT32 - 1) -> list[Misread]:
    written = _short(text.value)
    if _INTEGER.match(text.value):
        value = int(text.value, 16 if "x" in text.value.lower() else 10)
        if least <= value <= most:
            return []
        return [Misread(text.span, f"is {written}, expected {least} to {most}")]
    # Readers stop at the point: 10.0 is 10 to them anyway, 1e3 is 1.
    whole = re.fullmatch(r"[+-]?\d{1,9}\.0*", text.value, re.ASCII) is not None
    return [Misread(text.span, f"is {written}, expected a whole number", lossy=whole)]


def _boolean(text: Located[str]) -> list[Misread]:
    if text.value.lower() in _BOOLEANS:
        return []
    return [Misread(text.span, f"is {_short(text.value)}, expected true or false")]


def _time(text: Located[str]) -> list[Misread]:
    words = text.value.split()
    if len(words) == 2 and all(_INTEGER.match(word) for word in words):
        return []
    return [Misread(text.span, "is not a time, expected whole seconds and nanoseconds")]


def _short(text: str) -> str:
    return repr(text if len(text) <= _LIMIT else text[: _LIMIT - 3] + "...")


_Reader = Callable[[Located[str]], "Iterator[Misread] | list[Misread]"]

_scalar = partial(_numbers, counts=(1,), finite=False)

_READERS: Mapping[str, _Reader] = {
    "bool": _boolean,
    "int": _integer,
    "unsigned int": partial(_integer, least=0, most=2**32 - 1),
    "double": _scalar,
    "float": _scalar,
    "vector2d": partial(_numbers, counts=(2,)),
    "vector3": partial(_numbers, counts=(3,)),
    "color": partial(_numbers, counts=(3, 4)),
    "pose": partial(_numbers, counts=(6,)),
    QUATERNION_POSE: partial(_numbers, counts=(7,)),
    "time": _time,
}


# The SDF version of a file: one reading of it for everything that depends on it.


FALLBACK = (1, 6)
"""Version that is assumed for a file without a readable version."""

_VERSION = re.compile(r"\s*(\d{1,4})\.(\d{1,4})\s*", re.ASCII)


def sdf_version(document: XmlDocument) -> tuple[int, int]:
    """Return the version that `<sdf>` states, as (1, 6); (1, 6) when it cannot be read."""
    return parse_version(document.root.get("version") or "") or FALLBACK


def parse_version(text: str) -> tuple[int, int] | None:
    """Read `1.6`, blanks around it aside; None for anything else."""
    match = _VERSION.fullmatch(text)
    return (int(match[1]), int(match[2])) if match else None


class SdfDocument(Record, eq=False, dict=True):
    """A well-formed SDF file.

    Attributes:
        document: Its XML.
        version: The version that `<sdf>` states; empty if it states none.
        unloaded: That no launch file loads it, as a clause, where one loads another; else empty.
    """

    document: XmlDocument
    version: str
    unloaded: str = ""

    @property
    def root(self) -> Element:
        """The `<sdf>` element."""
        return self.document.root

    @cached_property
    def typed_elements(self) -> list[tuple[Element, ElementType | None]]:
        """Each element with its type in the schema; see `checker.formats.sdf.schema.walk`."""
        return self.typed_as("")

    def typed_as(self, reads: str) -> list[tuple[Element, ElementType | None]]:
        """Return the same, with what only the version knows that the target reads the file as."""
        if reads not in self._typed:
            self._typed[reads] = list(walk(self.root, self.version, reads))
        return self._typed[reads]

    @cached_property
    def _typed(self) -> dict[str, list[tuple[Element, ElementType | None]]]:
        """Results of `typed_as`: most rules on syntax need the same ones."""
        return {}

    def elements(self) -> Iterator[Element]:
        """Yield the elements that the schema knows, in document order."""
        for element, kind in self.typed_elements:
            if kind is not None:
                yield element
