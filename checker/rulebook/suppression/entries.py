"""Entries of a settings file that set findings aside: tables below `[[suppress]]`."""

from __future__ import annotations

from fnmatch import fnmatchcase

from checker.base.record import Record
from checker.finding import Place

ENTRIES_LIMIT = 200
REASON_LIMIT = 1_000
"""Characters; every finding repeats it."""
PATTERN_LIMIT = 1_000
"""Characters of a file or an element."""
_KEYS = ("rule", "file", "element", "reason")
_LIMITS = {"file": PATTERN_LIMIT, "element": PATTERN_LIMIT, "reason": REASON_LIMIT}


class SettingsEntry(Record):
    """Findings of a rule that do not count.

    Attributes:
        rule: Id or name.
        reason: The reason why they do not.
        file: Pattern of their files, relative to the package; `.` is its folder.
            Empty for all.
        element: A part of the path of their element, such as `link[base]`. Empty for all.
    """

    rule: str
    reason: str
    file: str = ""
    element: str = ""

    def covers(self, place: Place) -> bool:
        """Return whether it applies to a finding at this place."""
        meant = not self.file or fnmatchcase(place.file or ".", self.file)
        return meant and self.element in place.element

    def __str__(self) -> str:
        """Name the rule, and where it is not to count."""
        return " in ".join(filter(None, (self.rule, self.element, self.file)))


def entries_of(value: object) -> tuple[SettingsEntry, ...]:
    """Return the entries that a settings file contains.

    Raises:
        ValueError: One is of another form; the text is a sentence that states which.
    """
    if not isinstance(value, list) or len(value) > ENTRIES_LIMIT:
        raise ValueError(f"suppress is not a list of at most {ENTRIES_LIMIT} tables")
    return tuple(_entry(number, item) for number, item in enumerate(value, 1))


def _entry(number: int, value: object) -> SettingsEntry:
    if not isinstance(value, dict):
        raise ValueError(f"suppress {number} is not a table")
    for key, text in value.items():
        if key not in _KEYS:
            raise ValueError(f"suppress {number} has {key!r}, expected {', '.join(_KEYS)}")
        if not isinstance(text, str):
            raise ValueError(f"suppress {number} has {key} = {text!r}, expected a string")
    for key, limit in _LIMITS.items():
        if len(value.get(key, "")) > limit:
            raise ValueError(f"suppress {number} has {key} of more than {limit} characters")
    for key in ("rule", "reason"):
        if not value.get(key, "").strip():
            raise ValueError(f"suppress {number} has no {key}, expected one")
    return SettingsEntry(**value)
