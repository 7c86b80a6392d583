"""Settings: what to check and how strictly, from files and from the command line.

A package's settings stand in `subt-check.toml`, or below `[tool.subt-check]` in `pyproject.toml`,
in its own folder or in the nearest folder above that has one.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from checker.errors import InvalidSettings
from checker.finding import Severity
from checker.profiles import profile_names
from checker.rule import Rule

FILE_NAME = "subt-check.toml"


@dataclass(frozen=True)
class Settings:
    """What to check and how strictly.

    Attributes:
        profile: Name of the profile that judges.
        select: Rule ids or groups to run; empty for all of the profile.
        ignore: Rule ids or groups to leave out.
        fail_on: Findings at or above this severity make the exit code 1.
        severity: Severity by rule id, where the user wants another.
        options: Options by rule id.
        source: The file they were read from; None for the defaults.
    """

    profile: str = "subt"
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    fail_on: Severity = Severity.ERROR
    severity: Mapping[str, Severity] = field(default_factory=dict)
    options: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    source: Path | None = None

    def selects(self, rule: Rule) -> bool:
        """Whether the user wants this rule to run."""
        chosen = not self.select or _names(self.select, rule)
        return chosen and not _names(self.ignore, rule)

    def overridden(self, **changes: Any) -> Settings:
        """Return settings in which those that are not None replace these."""
        return replace(self, **{key: value for key, value in changes.items() if value is not None})


def _names(patterns: Sequence[str], rule: Rule) -> bool:
    return any(pattern in (rule.id, rule.group, rule.name) for pattern in patterns)


def find_settings(folder: Path) -> Settings:
    """Return the settings of the nearest file in a folder or above it; else the defaults.

    Raises:
        InvalidSettings: The file is no TOML or holds what settings do not know.
    """
    for place in (folder, *folder.parents):
        own = place / FILE_NAME
        if own.is_file():
            return parse_settings(_read_toml(own), own)
        shared = place / "pyproject.toml"
        if shared.is_file():
            section = _read_toml(shared).get("tool", {}).get("subt-check")
            if section is not None:
                return parse_settings(section, shared)
    return Settings()


def _read_toml(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise InvalidSettings(path, f"cannot be read: {error}") from None


_KEYS = {
    "profile": "profile",
    "select": "select",
    "ignore": "ignore",
    "fail-on": "fail_on",
    "severity": "severity",
    "rules": "options",
}
"""Keys of the file, and the fields they set."""


def parse_settings(content: Mapping[str, Any], path: Path) -> Settings:
    """Turn the content of a settings file into settings.

    Raises:
        InvalidSettings: A key is unknown or a value has the wrong type.
    """
    values: dict[str, Any] = {}
    for key, value in content.items():
        if key not in _KEYS:
            raise InvalidSettings(path, f"unknown key {key!r}; known are {_list(_KEYS)}")
        values[_KEYS[key]] = _convert(key, value, path)
    return replace(Settings(), **values, source=path)


def _convert(key: str, value: Any, path: Path) -> Any:
    match key:
        case "profile":
            return _one_of(key, value, profile_names(), path)
        case "fail-on":
            return Severity(_one_of(key, value, ("error", "warning"), path))
        case "select" | "ignore":
            if not isinstance(value, list) or not all(isinstance(v, str) for v in value):
                raise InvalidSettings(path, f"{key} is {value!r}, expected a list of rule ids")
            return tuple(value)
        case "severity":
            levels = [str(level) for level in Severity]
            return {
                rule: Severity(_one_of(f"severity.{rule}", level, levels, path))
                for rule, level in _table(key, value, path).items()
            }
        case _:
            return {
                rule: _table(f"rules.{rule}", options, path)
                for rule, options in _table(key, value, path).items()
            }


def _one_of(key: str, value: Any, choices: Sequence[str], path: Path) -> str:
    if value not in choices:
        raise InvalidSettings(path, f"{key} is {value!r}, expected one of {_list(choices)}")
    return str(value)


def _table(key: str, value: Any, path: Path) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InvalidSettings(path, f"{key} is {value!r}, expected a table")
    return value


def _list(words: Sequence[str] | Mapping[str, str]) -> str:
    return ", ".join(words)


def check_against_rules(settings: Settings, rules: Sequence[Rule]) -> None:
    """Make sure that every rule and option that the settings name exists.

    Raises:
        InvalidSettings: One does not; the message names the nearest that does.
    """
    by_id = {rule.id: rule for rule in rules}
    known = set(by_id) | {rule.group for rule in rules} | {rule.name for rule in rules}
    for name in (*settings.select, *settings.ignore):
        if name not in known:
            raise InvalidSettings(settings.source, f"there is no rule {name}{_hint(name, known)}")
    for id in (*settings.severity, *settings.options):
        if id not in by_id:
            raise InvalidSettings(settings.source, f"there is no rule {id}{_hint(id, set(by_id))}")
    for id, options in settings.options.items():
        for option, value in options.items():
            _check_option(settings, by_id[id], option, value)


def _check_option(settings: Settings, rule: Rule, option: str, value: Any) -> None:
    defaults = rule.options
    if option not in defaults:
        known = _list(list(defaults)) or "none"
        problem = f"{rule.id} has no option {option!r}; it has {known}"
        raise InvalidSettings(settings.source, problem)
    default = defaults[option]
    fits = isinstance(value, type(default)) and isinstance(value, bool) == isinstance(default, bool)
    if isinstance(default, float) and isinstance(value, int) and not isinstance(value, bool):
        fits = True
    if isinstance(default, tuple) and isinstance(value, list):
        fits = True
    if not fits:
        expected = "list" if isinstance(default, tuple) else type(default).__name__
        problem = f"{rule.id}: {option} is {value!r}, expected a {expected}"
        raise InvalidSettings(settings.source, problem)


def _hint(name: str, known: set[str]) -> str:
    near = get_close_matches(name.upper(), known, n=1)
    return f"; did you mean {near[0]}?" if near else "; `subt-check rules` lists them"
