"""Devices that a specification sheet names outside its list of sensors: remarks, links, costs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Set

from checker.base.record import Record
from checker.model.devices.devices import Device
from checker.model.devices.known import TEXT_LIMIT, KnownDevices
from checker.model.specification.quantities import configurations_in
from checker.model.specification.sensors import NOT_MODELED
from checker.model.specification.sheet import Specification
from checker.source.markdown import PassageKind
from checker.source.text import Located, Span

_LINES_LIMIT = 500
_LINE = re.compile(rf"\S[^\n]{{0,{TEXT_LIMIT - 1}}}")
_HEADING = re.compile(r"#{1,6}\s")


class NamedDevice(Record, eq=False):
    """A device and the first line that names it."""

    device: Device
    words: Located[str]


def devices_in_other_lines(
    sheet: Specification, known: KnownDevices, configurations: Set[int]
) -> tuple[NamedDevice, ...]:
    """Return the devices that lines outside the list of sensors name, in their links too.

    Args:
        sheet: Its first 500 lines are read.
        known: Devices to look for.
        configurations: Lines, and sections by their headings, about others are left out.
    """
    named: dict[str, NamedDevice] = {}
    for words in _lines(sheet, configurations):
        for device in known.find_all_in_text(words.value):
            named.setdefault(device.id, NamedDevice(device, words))
    return tuple(named.values())


def _lines(sheet: Specification, configurations: Set[int]) -> Iterator[Located[str]]:
    listed = [(span.start, span.end) for span in _listed(sheet, configurations)]
    of_section = frozenset[int]()
    for number, match in enumerate(_LINE.finditer(sheet.markdown.text)):
        if number == _LINES_LIMIT:
            return
        line = match.group()
        spoken_of = configurations_in(line)
        if _HEADING.match(line):
            of_section = spoken_of
        spoken_of = spoken_of or of_section
        if spoken_of and not spoken_of & configurations:
            continue
        if NOT_MODELED.search(line) or any(
            s < match.end() and match.start() < e for s, e in listed
        ):
            continue
        yield Located(line, Span(sheet.source, *match.span()))


def _listed(sheet: Specification, configurations: Set[int]) -> Iterator[Span]:
    """Yield the items of the list of sensors, and of those left out what is below them."""
    section = sheet.section("sensors")
    lead = frozenset[int]()
    left_out = False
    for passage in section.passages if section is not None else ():
        if passage.kind is not PassageKind.ITEM:
            lead = configurations_in(passage.words)
            continue
        if passage.level == 1:
            meant = configurations_in(passage.words) or lead
            others = bool(meant) and not meant & configurations
            left_out = others or NOT_MODELED.search(passage.text) is not None
        if passage.level == 1 or left_out:
            yield passage.span
