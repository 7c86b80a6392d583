"""The part of a rule's examples that its page shows: files, cut to what matters in them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise, takewhile
from textwrap import dedent

from checker.base.record import Record
from checker.rule import Rule
from checker.rulebook.example_files import (
    Example,
    ExamplePackage,
    example_package,
    minimal_package,
)

_WHOLE = 16
"""Lines of a file that is shown whole."""
_PART = 20
"""Lines that are shown of a longer one."""
_AROUND = 3
"""Lines that are shown before and after one that matters."""
_MADE_OF_FRAGMENTS = (
    "model.sdf",
    "urdf/arm.urdf",
    "launch/arm.launch.py",
    "launch/rover.launch.py",
)
"""Files of which an example has a part only; the rest is that of the minimal package."""
_MARKERS = r"(?:\^ [A-Z0-9]{3}\d+ *)+"
_MARKER = re.compile(rf"[ \t]*<!-- *{_MARKERS}-->|[ \t]*# *{_MARKERS}$", re.MULTILINE)


class ShownFile(Record):
    """A file of an example, as a page shows it.

    Attributes:
        path: Relative to the package.
        text: Lines of it; empty if `note` states all.
        note: What there is to state about a file without text.
    """

    path: str
    text: str
    note: str = ""


class ShownExamples(Record):
    """Examples of a rule that a page shows.

    Attributes:
        bad: Files in which the rule reports something.
        good: The same files if it does not, or the correct files.
    """

    bad: tuple[ShownFile, ...]
    good: tuple[ShownFile, ...]


class _Package(Record):
    """The package of an example.

    Attributes:
        example: What makes it.
        made: Its files.
        base: The minimal package that the example changes.
    """

    example: Example
    made: ExamplePackage
    base: ExamplePackage

    @property
    def changed(self) -> list[str]:
        """Paths of the files that the example adds, changes or removes."""
        made, base = self.made.files, self.base.files
        return [path for path in {**made, **base} if made.get(path) != base.get(path)]

    @property
    def shown(self) -> list[str]:
        """Paths of the files that a page shows: those that are reported if nothing is changed."""
        return self.changed or [path for path in self.reported if path in self.made.files]

    @property
    def reported(self) -> dict[str, int]:
        """Lines that must be reported where no marker can be, by path, counted from 0."""
        places = {} if isinstance(self.example, str) else self.example.get("@reported", ())
        pairs = (place.rpartition(":") for place in places)
        return {path: int(line) - 1 for path, _, line in pairs}

    def lines(self, path: str) -> list[str]:
        """Return the lines of a file without markers; of one that is no text all its bytes."""
        content = self.made.files.get(path, "")
        return [content.hex()] if isinstance(content, bytes) else _unmarked(content)

    def own_lines(self, path: str) -> range:
        """Return which lines of a file are those of the example."""
        lines, base = self.lines(path), _unmarked(str(self.base.files.get(path, "")))
        if path in self.example or path not in _MADE_OF_FRAGMENTS or lines == base:
            return range(len(lines))
        first = _common(lines, base)
        return range(first, len(lines) - _common(lines[first:][::-1], base[first:][::-1]))


def shown_examples(rule: Rule) -> ShownExamples | None:
    """Return what the page of a rule shows: its first bad example, and the closest good one.

    Args:
        rule: The rule with its examples; one of an index has none.
    """
    if not rule.bad or not rule.good:
        return None
    bad = _package(rule.bad[0])
    good = max(map(_package, rule.good), key=lambda good: _likeness(bad, good))
    different = _different(bad, good)
    return ShownExamples(
        (*_notes(bad, good), *(_shown(path, bad, good, rule) for path in bad.shown)),
        (*_notes(good, bad), *(_shown(path, good, bad, rule) for path in different)),
    )


def _package(example: Example) -> _Package:
    return _Package(example, example_package(example), minimal_package(example))


def _different(bad: _Package, good: _Package) -> list[str]:
    """Return the paths of files that differ between two packages."""
    paths = dict.fromkeys([*bad.changed, *good.changed])
    return [path for path in paths if bad.lines(path) != good.lines(path)]


def _likeness(bad: _Package, good: _Package) -> float:
    """Return the share of words in common of the files that `bad` changes; 0 if nothing differs."""
    if not _different(bad, good):
        return 0
    first, second = (
        {(path, word) for path in bad.changed for line in it.lines(path) for word in line.split()}
        for it in (bad, good)
    )
    return len(first & second) / max(len(first | second), 1)


def _notes(package: _Package, other: _Package) -> Iterator[ShownFile]:
    """Yield what the example states about the folder's name and of links in it."""
    named = "@name" in package.example or "@name" in other.example
    if named and package.made.name != other.made.name:
        yield ShownFile(".", "", f"is a folder named {package.made.name!r}")
    for path, target in package.made.links.items():
        yield ShownFile(path, "", f"is a link to {target!r}")


def _shown(path: str, package: _Package, other: _Package, rule: Rule) -> ShownFile:
    """Show a file where it is marked, or differs from that of the other package."""
    match package.made.files.get(path):
        case None:
            return ShownFile(path, "", "does not exist")
        case bytes() as content:
            return ShownFile(path, "", f"is a file of {len(content)} bytes")
        case "":
            return ShownFile(path, "", "is an empty file")
        case str() as content:
            reported = package.reported.get(path)
            marked = [
                number
                for number, line in enumerate(content.splitlines())
                if f"^ {rule.id}" in line or number == reported
            ]
            lines, others = package.lines(path), set(other.lines(path))
            different = [n for n, line in enumerate(lines) if line not in others]
            shown = _kept(package.own_lines(path), (*marked, *different))
            return ShownFile(path, _text(lines, shown))


def _kept(lines: range, focus: Sequence[int]) -> list[int]:
    """Return which lines to show: all if they are few, else those around lines that matter."""
    if len(lines) <= _WHOLE:
        return list(lines)
    kept: set[int] = set()
    for line in focus or lines[:1]:
        kept |= {*range(line - _AROUND, line + _AROUND + 1)} & {*lines}
        if len(kept) > _PART - _AROUND:
            break
    return sorted(kept)


def _text(lines: Sequence[str], shown: Sequence[int]) -> str:
    """Return some lines of a text, with a mark where others are left out."""
    gaps = (["…"] if after - before > 1 else [] for before, after in pairwise(shown))
    pieces = zip(([lines[number]] for number in shown), (*gaps, []), strict=True)
    return dedent("\n".join(line for pair in pieces for part in pair for line in part)).strip("\n")


def _unmarked(text: str) -> list[str]:
    return _MARKER.sub("", text).splitlines()


def _common(first: Sequence[str], second: Sequence[str]) -> int:
    """Return how many lines two texts have in common at their start."""
    pairs = zip(first, second, strict=False)
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
