"""Parts for the rules about suppressions."""

from __future__ import annotations

from checker.base.record import Record
from checker.finding import Place
from checker.rulebook.suppression.comments import Comment
from checker.rulebook.suppression.entries import SettingsEntry


class UnknownName(Record):
    """A word of a comment that names no rule; the hint states which one may be meant."""

    comment: Comment
    name: str
    hint: str


class UnusedComment(Record):
    """A comment, and the id of a rule that ran and found nothing that it suppresses."""

    comment: Comment
    rule: str


class UnusedEntries(Record):
    """Entries of a settings file that suppress nothing.

    Attributes:
        place: The place of the settings file, or of the package folder when it is elsewhere.
        file: What to call the settings file.
        own: Whether it is in the package, so that it serves no other.
    """

    entries: tuple[SettingsEntry, ...]
    place: Place
    file: str
    own: bool


class Suppressions(Record):
    """Suppressions in the package's comments and the settings, and those without effect.

    Attributes:
        comments: The comments in the package's own files.
    """

    comments: tuple[Comment, ...]
    unknown: tuple[UnknownName, ...]
    unused: tuple[UnusedComment, ...]
    unused_entries: UnusedEntries


class StaleEntries(Record):
    """Findings of one rule in the baseline that are gone.

    Attributes:
        rules: Its id; those of all rules that do not exist, together.
        messages: What they stated.
        file: What to call the baseline's file.
        known: Whether the rule exists.
    """

    rules: tuple[str, ...]
    messages: tuple[str, ...]
    file: str
    known: bool = True


class BaselineUse(Record):
    """Stale entries of the baseline, rule by rule."""

    stale: tuple[StaleEntries, ...]
