"""Validation of the rules and options in settings."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from typing import Any

from checker.base.errors import InvalidSettings
from checker.rule import Rule
from checker.settings import Settings


def check_against_rules(settings: Settings, rules: Sequence[Rule]) -> None:
    """Make sure that every rule and option that the settings name exists.

    Raises:
        InvalidSettings: One does not; the message names the nearest that does. Or the baseline
            that they name cannot be used.
    """
    by_id = {rule.id: rule for rule in rules}
    known = {name for rule in rules for name in rule.selectors}
    for field, names in (("select", settings.select), ("ignore", settings.ignore)):
        for name in names:
            if name not in known:
                raise settings.problem(field, no_such_rule(name, known))
    for id in (*settings.severity, *settings.options):
        if id not in by_id:
            raise InvalidSettings(settings.source, no_such_rule(id, by_id))
    _check_entries(settings, rules)
    if settings.baseline.fault:
        raise InvalidSettings(settings.baseline.path, settings.baseline.fault)
    for id in settings.options:
        options_of(by_id[id], settings)
    if rules and not any(map(settings.selects, rules)):
        field = "ignore" if settings.ignore else "select"
        raise settings.problem(field, "select and ignore leave no rules to run")


def _check_entries(settings: Settings, rules: Sequence[Rule]) -> None:
    """Make sure that entries of `[[suppress]]` name single rules."""
    groups = {rule.group for rule in rules}
    single = {name for rule in rules for name in rule.names}
    for entry in settings.suppress:
        if entry.rule.upper() in groups:
            problem = f"suppress names the group {entry.rule!r}; expected a single rule"
            raise InvalidSettings(settings.source, problem)
        if entry.rule.upper() not in single and entry.rule.lower() not in single:
            raise InvalidSettings(settings.source, no_such_rule(entry.rule, single))


_NAMED = 10
"""Rules whose ids start with the requested text, for a message."""


def no_such_rule(name: str, known: Iterable[str]) -> str:
    """Return the message that there is no such rule, and which one may be meant."""
    names = sorted(known)
    begun = [known for known in names if known.startswith(name.upper())] if name else []
    near = get_close_matches(name.upper(), names, 1) or get_close_matches(name.lower(), names, 1)
    if 1 < len(begun) <= _NAMED:
        hint = f"did you mean {', '.join(begun[:-1])} or {begun[-1]}?"
    else:
        hint = f"did you mean {near[0]}?" if near else "`subt-check rules` lists them"
    return f"there is no rule {name!r}; {hint}"


def options_of(rule: Rule, settings: Settings) -> dict[str, Any]:
    """Return the options that the user sets for a rule, in the types of their defaults.

    Raises:
        InvalidSettings: The rule has no such option, or the value has another type.
    """
    defaults = rule.options
    options = {}
    for name, value in settings.options.get(rule.id, {}).items():
        if name not in defaults:
            known = ", ".join(defaults) or "none"
            problem = f"rules.{rule.id} has no option {name!r}, expected one of: {known}"
            raise InvalidSettings(settings.source, problem)
        options[name] = _typed(value, defaults[name])
        if options[name] is None:
            problem = f"rules.{rule.id}.{name} is {value!r}, expected {_kind(defaults[name])}"
            raise InvalidSettings(settings.source, problem)
    return options


def _typed(value: object, default: object) -> object:
    """Return a value of TOML in the type of a default; None if it has another, or makes no sense.

    Options are sizes, counts, shares: where the default is above 0, nothing is negative.
    """
    if isinstance(default, tuple) and isinstance(value, list):
        elements = tuple(_typed(item, _element(default)) for item in value)
        return None if None in elements else elements
    typed = _finite(value) if isinstance(default, float) and type(value) in (int, float) else value
    return typed if type(typed) is type(default) and _is_allowed(typed, default) else None


def _element(default: tuple[Any, ...]) -> Any:
    """Return an element of a list; one that is empty as a rule has it contains texts."""
    return default[0] if default else ""


def _is_allowed(value: Any, default: Any) -> bool:
    return type(default) not in (int, float) or default <= 0 or value >= 0


def _finite(value: Any) -> float | None:
    """Return a number as a float; None for infinity, NaN and what no float holds."""
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def _kind(default: Any) -> str:
    if isinstance(default, tuple):
        return f"a list in which each is {_kind(_element(default))}"
    names = {bool: "true or false", int: "a whole number", float: "a number", str: "a string"}
    kind = names.get(type(default), type(default).__name__)
    return kind if _is_allowed(-1, default) else f"{kind}, 0 or more"
