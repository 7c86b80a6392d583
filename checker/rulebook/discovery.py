"""Finds the rules: those in the folder `rules/`, and those that other distributions register.

Other people's rules come through the entry-point group `subt_check.rules`; an entry point names
a module or a package of rule modules.
"""

from __future__ import annotations

import gc
import importlib
import pkgutil
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from itertools import chain
from types import ModuleType

from msgspec.structs import replace

from checker.base.errors import CheckerError
from checker.base.resources import RULES, metadata_folders
from checker.rule import Rule

ENTRY_POINT_GROUP = "subt_check.rules"


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


@cache
def rules_of_others() -> tuple[str, ...]:
    """Return the distributions that bring further rules, with what each says of itself."""
    found = []
    for folder in metadata_folders():
        with suppress(OSError):
            text = (folder / "entry_points.txt").read_text("utf-8", "replace")
            if f"[{ENTRY_POINT_GROUP}]" in text:
                found.append(f"{folder.name} {text}")
    return tuple(sorted(found))


def _registered_rules() -> Iterator[Rule]:
    if not rules_of_others():
        return
    # Loaded where there are any: it takes as long as a small check.
    from importlib.metadata import entry_points

    for entry_point in entry_points(group=ENTRY_POINT_GROUP):
        try:
            yield from list(_rules_below(entry_point.load()))
        except Exception as error:
            problem = f"the rules of {entry_point.value} cannot be loaded: {error}"
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
