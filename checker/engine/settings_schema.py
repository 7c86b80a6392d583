"""The JSON schema of `subt-check.toml`, by which editors complete and check it.

It knows what `checker.settings` reads, the rules that there are, and their options.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from checker.finding import Severity
from checker.rule import Rule
from checker.rulebook.discovery import all_rules
from checker.rulebook.options import option_texts
from checker.rulebook.pages import parse_page
from checker.rulebook.profiles import distro_names, profile_names
from checker.rulebook.suppression.entries import ENTRIES_LIMIT, PATTERN_LIMIT, REASON_LIMIT
from checker.settings import DEVICES_LIMIT

ID = "urn:subt-check:settings:1"
"""Names no place: each installation writes its own. The number changes with the meaning."""
_Json = dict[str, Any]
_TEXTS: _Json = {"type": "array", "items": {"type": "string"}}
_TYPES: Mapping[type, str] = {bool: "boolean", int: "integer", float: "number", str: "string"}


def settings_schema() -> _Json:
    """Return the schema."""
    rules = all_rules()
    selectors = {name for rule in rules for name in rule.selectors}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": ID,
        "title": "Settings of subt-check",
        "description": "subt-check.toml, or [tool.subt-check] in pyproject.toml",
        "type": "object",
        "additionalProperties": False,
        "properties": _keys(rules),
        "$defs": {
            "severity": {"enum": list(map(str, Severity))},
            "rule": _name_of({name for rule in rules for name in rule.names}),
            "rules": {"type": "array", "items": _name_of(selectors)},
        },
    }


def _keys(rules: Sequence[Rule]) -> dict[str, _Json]:
    return {
        "profile": _described({"enum": list(profile_names())}, "set of rules, and their target"),
        "distro": _described({"enum": list(distro_names())}, "ROS 2 distribution to check for"),
        "select": _described(
            {"$ref": "#/$defs/rules"}, "run only these rules, groups, or concern:robot"
        ),
        "ignore": _described({"$ref": "#/$defs/rules"}, "do not run these"),
        "fail-on": _described({"enum": ["error", "warning"]}, "lowest severity that fails"),
        "severity": _severity(rules),
        "rules": _options(rules),
        "trial": _described({"type": "boolean"}, "whether robots are driven"),
        "thorough": _described(
            {"type": "boolean"},
            "drive them again at half the time step, and read URDF with a second library",
        ),
        "devices": _described(
            {"type": "array", "maxItems": DEVICES_LIMIT, "items": {"type": "object"}},
            "sensor devices of your own, in the form of devices.json",
        ),
        "package-path": _described(_TEXTS, "folders in which further packages are found"),
        "xacro-args": _described(
            {"type": "object", "additionalProperties": {"type": ["string", "number", "boolean"]}},
            "arguments for xacro files",
        ),
        "payload": _described(
            {"type": "number", "minimum": 0}, "mass that an arm is to carry at its end, kg"
        ),
        "suppress": _suppress(),
        "baseline": _described({"type": "string"}, "file with findings that do not count"),
    }


def _described(form: _Json, words: str) -> _Json:
    return {"description": words, **form}


def _name_of(names: Iterable[str]) -> _Json:
    """Return the form of a name: editors offer ours, and rules of others have more."""
    return {"anyOf": [{"enum": sorted(names)}, {"type": "string"}]}


def _severity(rules: Iterable[Rule]) -> _Json:
    levels = {"$ref": "#/$defs/severity"}
    by_rule = {rule.id: _described(levels, parse_page(rule.page).title) for rule in rules}
    form = {"type": "object", "properties": by_rule, "additionalProperties": levels}
    return _described(form, "severity of rules, by id")


def _options(rules: Iterable[Rule]) -> _Json:
    by_rule = {rule.id: _options_of(rule) for rule in rules if rule.options}
    form = {"type": "object", "properties": by_rule, "additionalProperties": {"type": "object"}}
    return _described(form, "options of rules, by id")


def _options_of(rule: Rule) -> _Json:
    words = option_texts(rule)
    options = {
        name: {"default": _as_json(default), **_described(_form(default), words.get(name, name))}
        for name, default in rule.options.items()
    }
    return _described(
        {"type": "object", "properties": options, "additionalProperties": False},
        parse_page(rule.page).title,
    )


def _form(default: Any) -> _Json:
    """Return the form of an option (see `checker.engine.options`)."""
    if isinstance(default, tuple):
        return {"type": "array", "items": _form(default[0] if default else "")}
    form: _Json = {"type": _TYPES[type(default)]}
    if type(default) in (int, float) and default > 0:
        form["minimum"] = 0
    return form


def _as_json(default: Any) -> Any:
    return list(default) if isinstance(default, tuple) else default


def _suppress() -> _Json:
    entry = {
        "type": "object",
        "required": ["rule", "reason"],
        "additionalProperties": False,
        "properties": {
            "rule": _described({"$ref": "#/$defs/rule", "pattern": r"\S"}, "id or name of a rule"),
            "reason": _described(
                {"type": "string", "pattern": r"\S", "maxLength": REASON_LIMIT},
                "why its findings do not count",
            ),
            "file": _described(
                {"type": "string", "maxLength": PATTERN_LIMIT},
                "pattern of files, relative to the package",
            ),
            "element": _described(
                {"type": "string", "maxLength": PATTERN_LIMIT},
                "part of the path of the element, such as link[base]",
            ),
        },
    }
    form = {"type": "array", "maxItems": ENTRIES_LIMIT, "items": entry}
    return _described(form, "findings that do not count, each with a reason")
