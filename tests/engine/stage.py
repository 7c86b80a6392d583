"""Rules and parts made up for tests of the engine."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from msgspec.structs import replace

from checker.base.parts import NotAvailable, type_name
from checker.engine.judge import Judge
from checker.engine.run import Outcome, run_rules
from checker.finding import Place
from checker.rule import Concern, Finding, Findings, Rule, Severity
from checker.rulebook.profiles import Profile, profile
from checker.settings import Settings


class Wheel:
    """A part that a rule asks for; one that is not an answer to `part` is not available."""

    def __init__(self, line: int = 1) -> None:
        self.place = Place("model.sdf", line, 1, line, 5, element=f"wheel[{line}]")


class Parts:
    def __init__(self, *wheels: Wheel, missing: NotAvailable | None = None) -> None:
        self.answer: Sequence[object] | NotAvailable = missing or wheels

    def part(self, kind: str) -> Sequence[object] | NotAvailable:
        assert kind == type_name(Wheel)
        return self.answer


def at(line: int, element: str = "", file: str = "model.sdf") -> Place:
    return Place(file, line, 1, line, 2, element=element)


def rule_saying(*found: Finding, id: str = "TST001", severity: Severity = Severity.ERROR) -> Rule:
    def check(_: Wheel) -> Findings:
        yield from found

    return Rule(
        id, f"fault-{id.lower()}", severity, Concern.ROBOT, check, "Something.\n\nIt matters."
    )


def run(
    *rules: Rule,
    parts: Parts | None = None,
    profile: Profile | None = None,
    **settings: Any,
) -> Outcome:
    return run_rules(rules, parts or Parts(Wheel()), Judge(profile or subt(), Settings(**settings)))


def subt(**changes: Any) -> Profile:
    return replace(profile("subt"), **changes)


def reported(outcome: Outcome) -> list[str]:
    return [each.rule for each in outcome.findings]


def fingerprints(found: Iterable[Finding]) -> list[str]:
    return [each.fingerprint for each in run(rule_saying(*found)).findings]
