"""Finds the rules: those in the folder `rules/`, and those that other distributions register.

Other people's rules come through the entry-point group `subt_check.rules`; an entry point names
a module or a package of rule modules.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from importlib.metadata import entry_points
from types import ModuleType

from checker.rule import Rule

ENTRY_POINT_GROUP = "subt_check.rules"


@cache
def all_rules() -> tuple[Rule, ...]:
    """Return every rule, sorted by id.

    Raises:
        ValueError: Two rules have one id.
    """
    found: dict[str, Rule] = {}
    for package in _rule_packages():
        for module in _modules(package):
            for rule in _rules_in(module):
                if found.setdefault(rule.id, rule) is not rule:
                    raise ValueError(f"two rules have the id {rule.id}")
    return tuple(found[id] for id in sorted(found))


def _rule_packages() -> Iterator[ModuleType]:
    yield importlib.import_module("rules")
    for entry_point in entry_points(group=ENTRY_POINT_GROUP):
        yield entry_point.load()


def _modules(package: ModuleType) -> Iterator[ModuleType]:
    yield package
    for info in pkgutil.walk_packages(getattr(package, "__path__", []), package.__name__ + "."):
        yield importlib.import_module(info.name)


def _rules_in(module: ModuleType) -> Iterator[Rule]:
    """Yield the rules that a module defines, with its examples."""
    for value in vars(module).values():
        if isinstance(value, Rule) and value.check.__module__ == module.__name__:
            good, bad = getattr(module, "GOOD", ()), getattr(module, "BAD", ())
            yield replace(value, good=tuple(good), bad=tuple(bad))
