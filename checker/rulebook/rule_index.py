"""Index of all rules, which does not load them, kept by the hash of their code.

Loading three hundred rules takes longer than running those for a small package. A rule of the index
loads its module when it is first run; most packages lack the parts that many rules need.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib import import_module
from typing import Any

import msgspec

from checker.base.cache import Cache, code_hash, key_of
from checker.base.distributions import additions
from checker.base.record import Record
from checker.base.resources import OWN_CODE
from checker.finding import Concern, Severity
from checker.rule import Findings, Rule
from checker.rulebook.discovery import all_rules

_KIND = "rules"


class IndexedRule(Record):
    """A rule, and where it is defined.

    Attributes:
        id: The id as in `Rule`; `name`, `severity`, `concern` and `page` likewise.
        module: The module that contains it.
        needs: Names of the types of the parts that it needs, by parameter.
        optional_parts: Parameters for parts that it can do without.
        options: Their defaults; lists represent tuples.
        judges: Figures of the trial that it judges.
    """

    id: str
    name: str
    severity: Severity
    concern: Concern
    page: str
    module: str
    needs: dict[str, str]
    optional_parts: frozenset[str]
    options: dict[str, Any]
    judges: tuple[str, ...]


def rules(cache: Cache) -> tuple[Rule, ...]:
    """Return all rules, sorted by id; those from the index have no examples.

    Args:
        cache: The cache of the index; without one all rules are loaded.

    Raises:
        CheckerError: Rules of another distribution cannot be loaded, or two rules have one id.
    """
    if cache.folder is None:
        return all_rules()
    key = key_of(sys.version, code_hash(*OWN_CODE), *additions())
    try:
        known = msgspec.convert(cache.get(_KIND, key), list[IndexedRule])
    except msgspec.ValidationError:
        loaded = all_rules()
        cache.put(_KIND, key, msgspec.to_builtins(list(map(_indexed, loaded))))
        return loaded
    return tuple(map(_rule, known))


def _indexed(rule: Rule) -> IndexedRule:
    return IndexedRule(
        rule.id,
        rule.name,
        rule.severity,
        rule.concern,
        rule.page,
        rule.check.__module__,
        rule.needs,
        rule.optional_parts,
        rule.options,
        rule.judges,
    )


def _rule(known: IndexedRule) -> Rule:
    """Return a rule that loads its module when it is run."""
    check = _later(known.module, known.id)
    rule = Rule(
        known.id,
        known.name,
        known.severity,
        known.concern,
        check,
        known.page,
        judges=known.judges,
    )
    options = {name: _as_tuple(value) for name, value in known.options.items()}
    # What is otherwise read from the function's signature.
    vars(rule).update(needs=known.needs, optional_parts=known.optional_parts, options=options)
    return rule


def _later(module: str, id: str) -> Callable[..., Findings]:
    def check(**arguments: Any) -> Findings:
        values = vars(import_module(module)).values()
        (found,) = (it for it in values if isinstance(it, Rule) and it.id == id)
        return found.check(**arguments)

    check.__module__ = module
    return check


def _as_tuple(value: Any) -> Any:
    return tuple(map(_as_tuple, value)) if isinstance(value, list) else value
