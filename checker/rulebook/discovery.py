"""Finds the rules: those in the folder `rules/`, and those that other distributions register.

Other people's rules come through the entry-point group `subt_check.rules`; an entry point names
a module or a package of rule modules.
"""

from __future__ import annotations

import gc
import importlib
import pkgutil
from collections.abc import Iterator
from functools import cache
from itertools import chain
from types import ModuleType
from typing import cast

from msgspec.structs import replace

from checker.base.distributions import load_entry_points
from checker.base.errors import CheckerError
from checker.base.resources import RULES
from checker.rule import Rule


@cache
def all_rules() -> tuple[Rule, ...]:
    """Return every rule, sorted by id.

    Raises:
        CheckerError: Rules of another distribution cannot be loaded, or two rules have one id.
    """
    rules: dict[str, Rule] = {}
    for rule in chain(_rules_below(importlib.import_module(RULES)), _registered_rules()):
        if rules.setdefault(rule.id, rule) is not rule:
            modules = f"{rules[rule.id].check.__module__} and {rule.check.__module__}"
            raise CheckerError(f"two rules have the id {rule.id}: {modules}")
    # Modules live as long as the process: the collection need not look through them ever again.
    gc.freeze()
    return tuple(rules[id] for id in sorted(rules))


def rules_in(package: str) -> tuple[Rule, ...]:
    """Return the rules of a module or package by its name, sorted by id."""
    return tuple(sorted(_rules_below(importlib.import_module(package)), key=lambda rule: rule.id))


def _registered_rules() -> Iterator[Rule]:
    for module in load_entry_points("rules"):
        package = cast("ModuleType", module)
        try:
            yield from list(_rules_below(package))
        except Exception as error:
            problem = f"the rules of {package.__name__} cannot be loaded: {error}"
            raise CheckerError(problem) from error


def _rules_below(package: ModuleType) -> Iterator[Rule]:
    for module in _modules(package):
        yield from _rules_in(module)


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
