"""The specification sheet as a whole: its sections, and the claims in them."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator
from functools import cached_property
from itertools import islice

from checker.base.record import Record
from checker.model.specification.mass_cost_endurance import durations, endurance, masses, total_mass
from checker.model.specification.motion import (
    Limit,
    MotionQuantity,
    limit_of,
    limits,
    turning_radii,
)
from checker.model.specification.proof import (
    MAX_LINKS,
    Proven,
    is_about,
    is_left_open,
    links_in_list,
    links_in_text,
)
from checker.model.specification.quantities import Quantity
from checker.model.specification.sensors import ListedSensor, listed_sensors
from checker.model.specification.sheet_text import LineReference, line_references
from checker.source.markdown import MAX_LENGTH, Markdown, Passage, PassageKind, read_markdown
from checker.source.text import SourceText, Span

_OTHER_SHEET = re.compile(r"\]\(([^()\s#]{1,200}\.md)[)#]", re.IGNORECASE)

_SECTIONS = {Proven.ENDURANCE: "endurance", Proven.SPEED: "motion"}
_REFERRED = re.compile(
    r"\b(?:see|refer\w*|same|identical)\b[^.\n]{0,100}?\b(\w{1,80}_sensor_config_\d{1,4})\b", re.I
)


class Section(Record, eq=False):
    """A heading and what is below it.

    Attributes:
        title: Visible text of the heading.
        level: 1 to 6.
        span: The heading's words.
        passages: All below it, sections of lower levels with their headings among them.
    """

    title: str
    level: int
    span: Span
    passages: tuple[Passage, ...]

    @property
    def text(self) -> str:
        """Visible text of the section."""
        return "\n".join(passage.words for passage in self.passages)

    @property
    def is_empty(self) -> bool:
        """True if only headings is below it."""
        return all(passage.kind is PassageKind.HEADING for passage in self.passages)


class Specification(Record, eq=False, dict=True):
    """A specification sheet.

    Attributes:
        source: The file.
        markdown: Its passages.
    """

    source: SourceText
    markdown: Markdown

    @cached_property
    def sections(self) -> tuple[Section, ...]:
        """All sections, in order of their headings."""
        return tuple(_sections(self.markdown.passages))

    @property
    def title(self) -> str:
        """The first heading; empty if there is none."""
        return self.sections[0].title if self.sections else ""

    def section(self, words: str) -> Section | None:
        """Return the section whose heading is `words`, else the first that contains them."""
        wanted = words.casefold()
        titles = [(section.title.casefold(), section) for section in self.sections]
        exact = (section for title, section in titles if title == wanted)
        containing = (section for title, section in titles if _contains(title, wanted))
        return next(exact, None) or next(containing, None)

    def _passages_of(self, word: str) -> tuple[Passage, ...]:
        section = self.section(word)
        return section.passages if section else ()

    @cached_property
    def sensors(self) -> tuple[ListedSensor, ...]:
        """Sensors and payloads in the list of the section "Sensors"."""
        return tuple(listed_sensors(self._passages_of("sensors")))

    @cached_property
    def other_sensors(self) -> str:
        """Path of the sheet that the section "Sensors" links to for others; empty without one."""
        section = self.section("sensors")
        match = _OTHER_SHEET.search(self.stretch_of(section).text) if section else None
        return match.group(1) if match else ""

    @cached_property
    def masses(self) -> tuple[Quantity, ...]:
        """All masses."""
        return tuple(masses(self.markdown.passages))

    @cached_property
    def total_mass(self) -> Quantity | None:
        """Mass of the robot in kg; None if the sheet gives none or several."""
        return total_mass(self.masses)

    @cached_property
    def durations(self) -> tuple[Quantity, ...]:
        """Durations of the endurance section that state how long the robot runs."""
        return tuple(durations(self._passages_of("endurance")))

    @cached_property
    def endurance(self) -> Quantity | None:
        """Stated run time of the model, s; None if the sheet is not clear."""
        return endurance(self.durations)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        """Limits of the motion section."""
        return tuple(limits(self._passages_of("motion")))

    def limit(self, quantity: MotionQuantity, axis: str) -> Limit | None:
        """Return the limit for an axis (`x`, `y`, `z`); None if there is none or several."""
        return limit_of(self.limits, quantity, axis)

    @cached_property
    def turning_radii(self) -> tuple[Quantity, ...]:
        """Turning radii of the motion section, in m."""
        return tuple(turning_radii(self._passages_of("motion")))

    @cached_property
    def validation_links(self) -> tuple[Span, ...]:
        """Links to measurements of the real robot in the section on validation."""
        section = self.section("validation")
        if section is None:
            return ()
        stretch = self.stretch_of(section)
        return tuple(islice(links_in_list(self.source, stretch.start, stretch.end), MAX_LINKS))

    def proves(self, what: Proven) -> bool:
        """Return whether the sheet links to a measurement, in its section or on validation.

        It does not if it states that the test was not made or is still planned.
        """
        validation, about = self.section("validation"), self.section(_SECTIONS[what])
        if about is not None and is_left_open(about.text, what, alone=True):
            return False
        if any(is_about(link, what) for link in self.validation_links):
            return True
        if validation is not None and is_left_open(validation.text, what, alone=False):
            return False
        linked = self.validation_links or self.other_validation
        return bool(linked) or (about is not None and self._links_to_video(about))

    def _links_to_video(self, section: Section) -> bool:
        stretch = self.stretch_of(section)
        return any(links_in_text(self.source, stretch.start, stretch.end))

    @cached_property
    def other_validation(self) -> str:
        """The sheet that the section on validation links to, or the package that it refers to.

        Empty where it does neither.
        """
        section = self.section("validation")
        if section is None:
            return ""
        text = self.stretch_of(section).text
        match = _OTHER_SHEET.search(text) or _REFERRED.search(text)
        return match.group(1) if match else ""

    @property
    def unread(self) -> str:
        """Reason why its end is not known, as the end of a sentence; empty if all of it is read."""
        if len(self.source.text) <= MAX_LENGTH:
            return ""
        return f"{self.source.file} is read only up to character {MAX_LENGTH:,}"

    def stretch_of(self, section: Section) -> Span:
        """Return a section from its heading to the next one of its level or above."""
        return Span(self.source, section.span.start, self._ends[section.span.start])

    @cached_property
    def _ends(self) -> dict[int, int]:
        """End of each section, by the offset of its heading."""
        ends, by_start = [len(self.source.text)] * 7, {}
        for section in reversed(self.sections):
            start = section.span.start
            by_start[start] = ends[section.level]
            ends[section.level :] = [start] * (7 - section.level)
        return by_start

    def says_nothing(self, section: Section) -> bool:
        """Return whether a section contains neither text nor fenced code."""
        if not section.is_empty:
            return False
        stretch, fences = self.stretch_of(section), self.markdown.fences
        code = bisect_left(fences, stretch.start, key=lambda fence: fence.start)
        return code == len(fences) or fences[code].start >= stretch.end

    @cached_property
    def line_references(self) -> tuple[LineReference, ...]:
        """Claims about lines of files."""
        return tuple(line_references(self.markdown.passages))


def read_specification(source: SourceText) -> Specification:
    """Read a specification sheet."""
    return Specification(source, read_markdown(source))


def _contains(title: str, wanted: str) -> bool:
    return f" {wanted} " in f" {title} "


def _sections(passages: tuple[Passage, ...]) -> Iterator[Section]:
    headings = [i for i, passage in enumerate(passages) if passage.kind is PassageKind.HEADING]
    # From the back, so that the end of each level is known when a heading is met.
    ends = [len(passages)] * 7
    sections = []
    for index in reversed(headings):
        heading = passages[index]
        below = passages[index + 1 : ends[heading.level]]
        sections.append(Section(heading.words, heading.level, heading.span, below))
        ends[heading.level :] = [index] * (7 - heading.level)
    yield from reversed(sections)
