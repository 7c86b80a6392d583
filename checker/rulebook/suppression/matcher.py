"""Decides which findings do not count: because of a comment, a settings file or the baseline."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TypeVar

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.base.words import Suggestions
from checker.finding import Place
from checker.package.package import Package
from checker.report.report import IN_BASELINE, SuppressedBy
from checker.rule import Finding, Rule
from checker.rulebook.suppression.baseline import BaselineEntry
from checker.rulebook.suppression.baseline_match import Held
from checker.rulebook.suppression.comments import (
    STEM,
    Comment,
    comments_of,
    has_comments,
)
from checker.rulebook.suppression.entries import SettingsEntry
from checker.rulebook.suppression.finding_places import Spot
from checker.rulebook.suppression.parts import (
    Suppressions,
    UnknownName,
    UnusedComment,
    UnusedEntries,
)
from checker.source.text_file import TEXT_LIMIT

F = TypeVar("F", bound=Finding)

SEARCHED_LIMIT = 100_000_000
"""Bytes of a package's own files in which comments are looked for before findings point there."""
COMMENTS_LIMIT = 2_000
"""Greatest number in a package and the siblings that its findings point at."""

_STEMS = tuple(STEM.encode(encoding) for encoding in ("utf-8", "utf-16-le", "utf-16-be"))
_Line = tuple[str, int, str]
"""A file, a line of it, and the id of a rule that is not to count there."""


class Suppression(Record):
    """Reason why a finding does not count.

    Attributes:
        place: The place of the comment with the reason; None for other sources.
    """

    by: SuppressedBy
    reason: str
    place: Place | None = None


class SuppressionMatcher:
    """The suppressions of one package, and which of them had an effect.

    Attributes:
        held: The entries of the baseline for the package.
    """

    def __init__(
        self,
        package: Package,
        entries: Sequence[SettingsEntry],
        rules: Iterable[Rule],
        baseline: Iterable[BaselineEntry] = (),
    ) -> None:
        self.held = Held(baseline)
        self._package = package
        self._ids = {name: rule.id for rule in rules for name in rule.names}
        self._entries: dict[str, list[SettingsEntry]] = {}
        for entry in entries:
            self._entries.setdefault(self._id(entry.rule), []).append(entry)
        self._files: set[str] = set()
        self._comments: dict[_Line, Comment] = {}
        self._used_lines: set[_Line] = set()
        self._used_entries: set[SettingsEntry] = set()
        self._comments_left = COMMENTS_LIMIT
        self._own = tuple(self._own_comments())

    def matches(
        self, rule: str, findings: Sequence[F], spot_of: Callable[[F], Spot]
    ) -> list[Suppression | None]:
        """Return why each finding of a rule does not count; None for those that do.

        Args:
            rule: Its id.
            findings: All that it found.
            spot_of: Returns how the baseline knows a finding.
        """
        matches = [self._by_wish(rule, finding.places[0]) for finding in findings]
        if not self.held.knows(rule):
            return matches
        # A place that is reported twice in the same words is one place of the finding.
        spots = {
            at: (finding.places[0], spot_of(finding))
            for at, finding in enumerate(findings)
            if matches[at] is None
        }
        distinct = list(dict.fromkeys(spots.values()))
        entries = self.held.entries_of(rule, [spot for _, spot in distinct])
        held = dict(zip(distinct, entries, strict=True))
        for at, spot in spots.items():
            if entry := held[spot]:
                matches[at] = Suppression(SuppressedBy.BASELINE, entry.reason or IN_BASELINE)
        return matches

    def _by_wish(self, rule: str, place: Place) -> Suppression | None:
        """Return the comment or the entry of the settings that is about a place."""
        comment = self._comment_at(rule, place)
        entries = [entry for entry in self._entries.get(rule, ()) if entry.covers(place)]
        self._used_entries.update(entries)
        if comment:
            return Suppression(SuppressedBy.COMMENT, comment.reason, comment.place)
        return Suppression(SuppressedBy.SETTINGS, entries[0].reason) if entries else None

    def suppressions(self, looked: Collection[str], settings: Path | None) -> Suppressions:
        """Return the effect of the suppressions.

        Args:
            looked: Ids of the rules that ran on complete data.
            settings: The settings file.
        """
        suggestions = Suggestions(self._ids)
        unknown = [
            UnknownName(comment, name, suggestions.hint(name.upper()) or suggestions.hint(name))
            for comment in self._own
            for name in comment.names
            if not self._id(name)
        ]
        unused = [
            UnusedComment(comment, rule)
            for comment in self._own
            for rule in self._ids_of(comment)
            if comment.reason and rule in looked and not self._was_used(comment, rule)
        ]
        idle = [
            entry
            for rule, entries in self._entries.items()
            for entry in entries
            if rule in looked and entry not in self._used_entries
        ]
        unused_entries = self._placed(tuple(idle), settings)
        return Suppressions(self._own, tuple(unknown), tuple(unused), unused_entries)

    def _placed(self, entries: tuple[SettingsEntry, ...], settings: Path | None) -> UnusedEntries:
        root = self._package.root
        if settings is None or not settings.is_relative_to(root):
            return UnusedEntries(entries, Place(""), settings.name if settings else "", own=False)
        path = settings.relative_to(root).as_posix()
        return UnusedEntries(entries, Place(path), path, own=True)

    def _was_used(self, comment: Comment, rule: str) -> bool:
        file = comment.place.file
        return any((file, line, rule) in self._used_lines for line in comment.lines)

    def _id(self, name: str) -> str:
        """Return the id of a rule by its id or name; empty if there is no such rule."""
        return self._ids.get(name.upper()) or self._ids.get(name.lower()) or ""

    def _ids_of(self, comment: Comment) -> Iterator[str]:
        yield from dict.fromkeys(filter(None, map(self._id, comment.names)))

    def _comment_at(self, rule: str, place: Place) -> Comment | None:
        if place.file not in self._files:
            self._keep(place.file, self._comments_in(place.file))
        line = (place.file, place.line, rule)
        comment = self._comments.get(line)
        if comment:
            self._used_lines.add(line)
        return comment

    def _own_comments(self) -> Iterator[Comment]:
        """Find the comments in the package's own files; a file that has none costs a search."""
        budget = SEARCHED_LIMIT
        for entry in self._package.index.files:
            if entry.target_state is not None or not has_comments(entry.path):
                continue
            budget -= entry.size
            if budget < 0:
                return
            marked = self._is_marked(entry.path)
            yield from self._keep(entry.path, self._comments_in(entry.path) if marked else ())

    def _is_marked(self, path: str) -> bool:
        data = self._package.read_bytes(path, TEXT_LIMIT)
        return not isinstance(data, NotReadable) and any(stem in data.lower() for stem in _STEMS)

    def _comments_in(self, path: str) -> tuple[Comment, ...]:
        if not has_comments(path):
            return ()
        source = self._package.read(path)
        if isinstance(source, NotReadable) or STEM not in source.text.lower():
            return ()
        comments = comments_of(source)[: self._comments_left]
        self._comments_left -= len(comments)
        return comments

    def _keep(self, path: str, comments: tuple[Comment, ...]) -> tuple[Comment, ...]:
        """Enter the comments of a file by the lines that they are about."""
        self._files.add(path)
        for comment in comments:
            for rule in self._ids_of(comment) if comment.reason else ():
                for line in comment.lines:
                    self._comments.setdefault((path, line, rule), comment)
        return comments


def split_suppressed(
    rule: str,
    findings: Sequence[F],
    matcher: SuppressionMatcher | None,
    spot_of: Callable[[F], Spot],
) -> dict[Suppression | None, list[F]]:
    """Group the findings of a rule by why they do not count; those that count have None."""
    nothing = [None] * len(findings)
    matches = matcher.matches(rule, findings, spot_of) if matcher else nothing
    parts: dict[Suppression | None, list[F]] = {}
    for finding, suppression in zip(findings, matches, strict=True):
        parts.setdefault(suppression, []).append(finding)
    return parts
