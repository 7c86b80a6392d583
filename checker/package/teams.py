"""Teams in running text: the team in a title or a description."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from checker.base.record import Record
from checker.base.resources import table
from checker.package.submissions import NAME

TEAM_OF = re.compile(r"\b(?:of|by)\s+(?:the\s+)?(?:team\s+)?([A-Z]\w+)(?:'s)?\s+team\b", re.I)
"""Words that state outright whose robot it is: `of the Acme team`."""

_CONFIGURED = (
    r"(?=\W{1,4}(?:[A-Z0-9][\w-]{0,40}\W{1,4}){0,3}?(?:with\W{1,4})?[Ss]ensor\W{1,4}[Cc]onfig)"
)
_ORIGIN = re.compile(
    r"\b(?:adapted|based|cop(?:y|ied)|courtesy|derived|identical|inherits|modified|originally"
    r"|provided|similar|thanks)\b[^.]{0,80}\Z"
    r"|\b(?:as|from|like|than|uses|using|version|with)\W+(?:[\w']+\W+){0,2}\Z",
    re.I,
)
_SENTENCE = re.compile(r"(?:[^.]|\.(?!\s)){1,2000}\.?")
_LOOK_BACK = 100


class Team(Record):
    """A team, as `teams.json` describes it.

    Attributes:
        prefix: The prefix of the names of its packages.
        name: Its name in running text.
        owners: Prefixes of packages in whose texts its name is right: its own and its partners'.
    """

    prefix: str
    name: re.Pattern[str]
    owners: tuple[str, ...]


@cache
def teams() -> tuple[Team, ...]:
    """Return all teams that are known."""
    return tuple(
        Team(
            entry["prefix"],
            _common(entry["match"], entry.get("known_as"))
            if entry.get("common_word")
            else _pattern(entry["match"]),
            (entry["prefix"], *entry.get("partners", ())),
        )
        for entry in table("teams")["teams"]
    )


def _pattern(name: str) -> re.Pattern[str]:
    return _name_pattern(f"(?i:{name.replace(' ', '[ _-]{1,4}')})")


def _common(name: str, known_as: str | None) -> re.Pattern[str]:
    """Return the pattern for a name that is a common word: it counts where it is plainly a name."""
    word = name.capitalize()
    forms = [
        name.upper(),
        f"(?<=[Tt]eam ){word}",
        rf"{word}(?=\s[Tt]eam\b|'s\s)",
        rf"\A{word}(?=\s-\s)",
        f"{word}{_CONFIGURED}",
        *([known_as] if known_as else []),
    ]
    return _name_pattern(f"(?:{'|'.join(forms)})")


def _name_pattern(name: str) -> re.Pattern[str]:
    return re.compile(rf"(?<![\w/.@-]){name}(?![^\W_]|[/.@]\w)")


def other_teams(text: str, package: str) -> Iterator[re.Match[str]]:
    """Yield where a text names a robot of another team than the package's.

    A sentence that names the package's own team as well names both on purpose, and words such
    as `based on` state where a robot comes from. Names of packages are no names of teams.
    """
    own = f"{package.casefold()}_"
    blanked = NAME.sub(lambda match: " " * len(match.group()), text).replace("\n", " ")
    for sentence in _SENTENCE.finditer(blanked):
        named = [
            (team, match)
            for team in teams()
            for match in team.name.finditer(blanked, *sentence.span())
        ]
        if any(own.startswith(f"{prefix}_") for team, _ in named for prefix in team.owners):
            continue
        for _, match in named:
            start = max(sentence.start(), match.start() - _LOOK_BACK)
            if _ORIGIN.search(blanked, start, match.start()) is None:
                yield match
