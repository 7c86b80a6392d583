"""Findings in robots that no launch file loads: they weigh less than those of the loaded one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from checker.finding import Place, Severity
from checker.rule import Finding, Unchecked

Said = Finding | Unchecked


def unloaded_in(arguments: Mapping[str, Any]) -> str:
    """Return the clause that no launch file loads the robot that a rule looks at; else empty."""
    for value in arguments.values():
        clause = getattr(value, "unloaded", "") or getattr(
            getattr(value, "robot", None), "unloaded", ""
        )
        if clause:
            return str(clause)
    return ""


def less_of_unloaded(
    said: Sequence[tuple[str, Sequence[Said]]], severity: Severity
) -> Iterator[Said]:
    """Yield what a rule states: of loaded robots first, and of others no errors.

    What is in a file that a loaded robot shares is stated once, of that one.

    Args:
        said: For each robot the clause that nothing loads it, or nothing, and what is stated.
        severity: The severity of the rule.
    """
    of_loaded = [item for clause, items in said if not clause for item in items]
    yield from of_loaded
    known = {_spot(item) for item in of_loaded if isinstance(item, Finding)}
    for clause, items in said:
        for item in items if clause else ():
            if isinstance(item, Unchecked):
                yield replace(item, severity=Severity.WARNING)
            elif _spot(item) not in known:
                yield _lessened(item, clause, severity)


def _spot(item: Finding) -> tuple[Place, str]:
    return item.places[0], item.message


def _lessened(item: Finding, clause: str, severity: Severity) -> Finding:
    if (item.severity or severity) is not Severity.ERROR:
        return item
    return replace(item, severity=Severity.WARNING, message=f"{item.message} ({clause})")
