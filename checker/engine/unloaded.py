"""Findings in robots that no launch file loads, or no simulator gets: they weigh less."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from checker.finding import Place, Severity
from checker.rule import Finding, Unchecked, lessened

Said = Finding | Unchecked


_OF_SIMULATION = (
    *("GEO002", "GEO003", "GEO009", "GEO010", "GEO011", "KIN006"),
    *("INE", "PLG", "SEN", "TRI"),
)
"""Rules, and groups of rules, about what a simulator alone reads, and what it makes of it."""


OF_COPIES = ("PKG015", "INE006", "INE007")
"""Rules whose findings in a copied repository weigh less: its users would not mend them."""


def unloaded_in(arguments: Mapping[str, Any], rule: str) -> str:
    """Return the clause that nothing reads what a rule looks at; else empty.

    Args:
        arguments: What the rule is given: robots, or parts with a robot.
        rule: The id of the rule.
    """
    for value in arguments.values():
        for holder in (value, getattr(value, "robot", None)):
            clause = getattr(holder, "unloaded", "")
            if rule.startswith(_OF_SIMULATION):
                clause = clause or getattr(holder, "never_simulated", "")
            if clause:
                return str(clause)
    return ""


def less_of_unloaded(
    said: Sequence[tuple[str, Sequence[Said]]], severity: Severity
) -> Iterator[Said]:
    """Yield what a rule states: of loaded robots first, and of others as less severe.

    What is in a file that a loaded robot shares is stated once, of that one.

    Args:
        said: For each robot the clause that nothing loads it, or nothing, and what is stated.
        severity: The severity of the rule.
    """
    of_loaded = [item for clause, items in said if not clause for item in items]
    yield from of_loaded
    is_one_loaded = not all(clause for clause, _ in said)
    known = {_spot(item) for item in of_loaded if isinstance(item, Finding)}
    for clause, items in said:
        for item in items if clause else ():
            if isinstance(item, Unchecked):
                yield replace(item, severity=Severity.WARNING)
            elif _spot(item) not in known and not (is_one_loaded and _is_parameter(item)):
                is_info = (item.severity or severity) is Severity.INFO
                yield item if is_info else lessened(item, clause, severity)


def _is_parameter(item: Finding) -> bool:
    """Return whether a finding is in a file of parameters, which is that of the loaded robot."""
    return item.places[0].file.endswith((".yaml", ".yml"))


def _spot(item: Finding) -> tuple[Place, str]:
    return item.places[0], item.message
