"""Progress of a check in words and steps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from functools import lru_cache
from pathlib import Path
from typing import Any

from checker.base.record import Record
from checker.base.words import and_list, count, plain, shortened
from checker.report.importance import importance
from checker.report.json_report import report_from_json
from checker.report.report import ReportedFinding, VerdictKind
from checker.report.summary import FILES, what_is_ready
from checker.service.jobs.port import Event, Stage, State
from checker.service.store.store import Store
from checker.service.web.answers.refusal import sentence
from checker.service.web.api.views import address_of

# What a stored report says at a glance: a verdict for each package, and the most severe findings.


SHOWN = 20
"""Findings at a glance; the report shows all."""
SIZE_LIMIT = 20_000_000
"""Bytes of a report that is read for a glance; a larger one takes seconds."""
_SUMMARY_LIMIT = 300


class FirstFinding(Record):
    """A finding in a line.

    Attributes:
        package: Its name.
        where: `model.sdf:12:3`, or the package's folder, and how many more places.
    """

    severity: str
    rule: str
    name: str
    message: str
    where: str
    package: str


class Glance(Record):
    """The beginning of a report.

    Attributes:
        findings: The most severe ones, at most `SHOWN`.
        more: The number of others.
    """

    findings: tuple[FirstFinding, ...] = ()
    more: int = 0


def glance(store: Store, key: str) -> Glance | None:
    """Return the beginning of a stored report; None if it is not there or too large to read."""
    path = store.file(key, "report.json") if key else None
    try:
        return _read(path) if path is not None else None
    except OSError:
        return None


@lru_cache(maxsize=64)
def _read(path: Path) -> Glance | None:
    """Read a report; what is under a key never changes."""
    try:
        if path.stat().st_size > SIZE_LIMIT:
            return None
        report = report_from_json(path.read_text("utf-8"))
    except ValueError:
        return None
    findings = [
        (package.name, finding) for package in report.packages for finding in package.findings
    ]
    findings.sort(key=lambda pair: importance(pair[1]))
    first_findings = tuple(_first(name, finding) for name, finding in findings[:SHOWN])
    return Glance(first_findings, len(findings) - len(first_findings))


def _first(package: str, finding: ReportedFinding) -> FirstFinding:
    place, *others = finding.places
    where = f"{place.file}:{place.line}:{place.column}" if place.file else "the package's folder"
    where += f" and {count(len(others), 'more place')}" if others else ""
    return FirstFinding(
        str(finding.severity),
        *map(_short, (finding.rule, finding.name, finding.message, where, package)),
    )


def _short(text: str) -> str:
    return plain(shortened(text, _SUMMARY_LIMIT))


STEPS = {
    Stage.QUEUED: "Waiting",
    Stage.STATIC: "Rules",
    Stage.TRIAL: "Trial",
    Stage.DONE: "Report",
}
"""The stages of a check without faults."""
_AGAIN = "Send the package again; if it happens again, tell the operator of this service."
_TEXT_LIMIT = 600


class Step(Record):
    """One step of a check.

    Attributes:
        stands: `done`, `now`, `next`, `stopped` or `skipped`.
        words: About it; may be empty.
    """

    name: str
    stands: str
    words: str = ""


class Headline(Record):
    """Headline of a check.

    Attributes:
        lead: A word or two.
        rest: The text after a colon; may be empty.
        mood: The verdict by which it is coloured, or empty.
        advice: What to do; may be empty.
    """

    lead: str
    rest: str = ""
    mood: str = ""
    advice: str = ""


class PackageLine(Record):
    """A package of a check.

    Attributes:
        lead: The verdict.
        page: Address of its report; empty as long as there is none.
        model: Address of the robot in 3D; empty if there is none.
    """

    name: str
    kind: str
    verdict: str
    lead: str
    errors: int
    warnings: int
    infos: int
    page: str = ""
    model: str = ""

    @property
    def is_file(self) -> bool:
        """True if it is not a package, but a world or another single file."""
        return self.kind in FILES


def steps_of(state: State, events: Sequence[Event]) -> tuple[Step, ...]:
    """Return the steps of a check, the one under way or where it stopped marked.

    Args:
        state: The state of the check.
        events: Tell how far a check came that ended before its report.
    """
    order = list(STEPS)
    ended_early = state.stage not in STEPS
    went = [event.stage for event in events if event.stage in STEPS]
    at = order.index((went or [Stage.QUEUED])[-1] if ended_early else state.stage)
    here, after = ("stopped", "skipped") if ended_early else ("now", "next")
    if state.stage is Stage.DONE:
        here = "done"
    stands = ["done"] * at + [here] + [after] * (len(order) - at - 1)
    waits = "" if at == 0 or ended_early else _ahead(state)
    return tuple(
        Step(STEPS[stage], how, waits if how == "now" else "")
        for stage, how in zip(order, stands, strict=True)
    )


def _ahead(state: State) -> str:
    return f"{count(state.ahead, 'check')} ahead" if state.ahead else ""


def main_package(packages: Sequence[PackageLine]) -> PackageLine | None:
    """Return the only one, or the only package besides worlds and other files; None without one."""
    found = [each for each in packages if not each.is_file or len(packages) == 1]
    return found[0] if len(found) == 1 else None


def title(state: State, packages: Sequence[PackageLine]) -> str:
    """Return what a check is called: as its package; the uploaded file until that is known."""
    main = main_package(packages)
    return main.name if main else plain(state.order.name)


def headline(state: State, packages: Sequence[PackageLine]) -> Headline:
    """State in a sentence where a check stands.

    Args:
        state: The state of the check.
        packages: What is known of them so far.
    """
    words = shortened(plain(state.words), _TEXT_LIMIT).rstrip(".")
    match state.stage:
        case Stage.REFUSED:
            reason, _, advice = words.rpartition("; ")
            if not reason:
                reason, advice = words, "correct this and send it again"
            return Headline("Not checked", reason, "not_ready", sentence(advice))
        case Stage.FAILED:
            return Headline("Not checked", words, "not_ready", _AGAIN)
        case Stage.CANCELLED:
            return Headline("Cancelled", "", "incomplete", "Send the package again to check it.")
        case Stage.DONE:
            return _verdict(words, packages)
        case Stage.QUEUED:
            ahead = _ahead(state) or "it starts in a moment"
            return Headline("Waiting", ahead)
        case _:
            found = _so_far(packages)
            doing = sentence(words) if found and words else ""
            return Headline("Checking", found or words, "", doing)


def _verdict(words: str, packages: Sequence[PackageLine]) -> Headline:
    """Return the verdict on the only package, or how many of several are ready."""
    if len(packages) == 1:
        (only,) = packages
        return Headline(only.lead, words.removeprefix(only.lead).lstrip(": "), only.verdict)
    all_ready = bool(packages) and all(package.verdict == "ready" for package in packages)
    lead = what_is_ready((package.kind, package.verdict) for package in packages)
    return Headline(lead, _found(packages), "ready" if all_ready else "not_ready")


def _so_far(packages: Sequence[PackageLine]) -> str:
    if not packages:
        return ""
    return f"{_found(packages) or 'nothing to fix'} so far"


def _found(packages: Sequence[PackageLine]) -> str:
    """Return how many errors and warnings there are; empty for none."""
    numbers = {
        "error": sum(package.errors for package in packages),
        "warning": sum(package.warnings for package in packages),
    }
    return and_list([count(number, noun) for noun, number in numbers.items() if number])


def package_lines(state: State, names: Sequence[str]) -> tuple[PackageLine, ...]:
    """Return the packages of a check, those to work on first, worlds and other files last.

    Args:
        state: The state of the check.
        names: The names of the files of its result.
    """
    lines = [_line(state, package, names) for package in state.packages]
    return tuple(sorted(lines, key=lambda line: (line.is_file, line.verdict == "ready")))


def _line(state: State, package: Mapping[str, Any], names: Sequence[str]) -> PackageLine:
    folder = str(package["folder"])
    page, model = (f"{folder}/{name}".lstrip("/") for name in ("report.html", "robot.glb"))
    verdict = str(package["verdict"])
    return PackageLine(
        name=plain(shortened(str(package["name"]), _TEXT_LIMIT)),
        kind=str(package.get("kind", "")),  # older checks do not say it
        verdict=verdict,
        lead=VerdictKind(verdict).lead,
        errors=int(package["errors"]),
        warnings=int(package["warnings"]),
        infos=int(package["infos"]),
        page=address_of(state.id, page) if page in names else "",
        model=address_of(state.id, model) if model in names else "",
    )


class Moment(Record):
    """A moment, for people and for programs."""

    words: str
    iso: str


def moment(seconds: float) -> Moment:
    """Return a moment given in seconds since the epoch, in UTC."""
    at = datetime.fromtimestamp(seconds, UTC)
    return Moment(f"{at.day} {at:%B %Y, %H:%M} UTC", at.isoformat(timespec="seconds"))
