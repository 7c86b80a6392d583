"""Profiles: what is judged, for which target. They are data (`checker/data/profiles.json`)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from checker.base.record import Record
from checker.base.resources import table
from checker.finding import Severity
from checker.rule import Context, Rule


class Profile(Record):
    """What is judged, for which target.

    Attributes:
        rules: Groups (`SDF`) or ids (`SEN001`) that belong to it.
        without: Ids left out of them.
        severity: Where it differs from the rule's own.
    """

    name: str
    title: str
    context: Context
    rules: tuple[str, ...]
    without: tuple[str, ...]
    severity: Mapping[str, Severity]

    def includes(self, rule: Rule) -> bool:
        """Whether a rule belongs to this profile; other people's groups belong to all."""
        if rule.id in self.without:
            return False
        return rule.group in self.rules or rule.id in self.rules or rule.group not in _groups()


@cache
def _groups() -> frozenset[str]:
    names = [name for profile in profile_names() for name in table("profiles")[profile]["rules"]]
    return frozenset(name.rstrip("0123456789") for name in names)


def profile_names() -> tuple[str, ...]:
    """Return the names of all profiles; the first is the default."""
    return tuple(name for name in table("profiles") if not name.startswith("_"))


def profile(name: str) -> Profile:
    """Return a profile.

    Raises:
        KeyError: There is no profile of that name.
    """
    entry = table("profiles")[name]
    return Profile(
        name,
        entry["title"],
        Context(name, entry["release"], entry["sdf_version"], entry["reads"]),
        tuple(entry["rules"]),
        tuple(entry["without"]),
        {rule: Severity(level) for rule, level in entry["severity"].items()},
    )
