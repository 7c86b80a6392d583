"""The list of several packages: a row each, and the rules that find something in most of them."""

from __future__ import annotations

from collections.abc import Sequence

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.finding import Severity
from checker.report.html.findings import anchor_of, in_order
from checker.report.report import PackageReport, Picture, ReportedFinding, VerdictKind
from checker.report.robots import robots_of

_NAME_LIMIT = 120
_COMMON_SHOWN = 12
_ORDER = (
    VerdictKind.NOT_READY,
    VerdictKind.INCOMPLETE,
    VerdictKind.PAPERWORK,
    VerdictKind.READY,
)
"""Order of verdicts: packages that need most work first."""


class Entry(Record):
    """A package.

    Attributes:
        link: Address of its page; empty without.
        rank: The rank of its verdict, for sorting; 0 needs most work.
        counts: Findings by severity, the most severe first.
        trial: Its result, in words.
    """

    name: str
    link: str
    verdict: str
    lead: str
    aside: str
    rank: int
    counts: tuple[int, ...]
    suppressed: int
    drive: str
    trial: str
    picture: Picture | None


class Found(Record):
    """A package in which a rule found something, and the address of the first finding."""

    name: str
    link: str


class Common(Record):
    """A rule that found something in several packages."""

    rule: str
    title: str
    severity: str
    packages: tuple[Found, ...]


def entry_of(package: PackageReport, lead: str, aside: str, link: str) -> Entry:
    """Return the row of a package.

    Args:
        package: Its report.
        lead: Its verdict in words.
        aside: What the verdict leaves out.
        link: Address of its page; empty without one.
    """
    robot = robots_of(package)[0]
    pictures = package.display.pictures if package.display else ()
    return Entry(
        plain(shortened(package.name, _NAME_LIMIT)), link, str(package.verdict), lead, aside,
        _ORDER.index(package.verdict), tuple(map(package.count, Severity)),
        len(package.suppressed), plain(str(robot.facts.get("drive", "–"))), robot.verdict.word,
        pictures[0] if pictures else None,
    )  # fmt: skip


def common_problems(packages: Sequence[PackageReport], links: Sequence[str]) -> list[Common]:
    """Return the rules that found something in several packages; those in most of them first.

    Args:
        packages: The packages of a run.
        links: Address of each package's page.
    """
    by_rule: dict[str, list[tuple[ReportedFinding, Found]]] = {}
    for package, link in zip(packages, links, strict=True):
        firsts: dict[str, ReportedFinding] = {}
        for finding in in_order(package.findings):
            if finding.severity is not Severity.INFO:
                firsts.setdefault(finding.rule, finding)
        name = plain(shortened(package.name, _NAME_LIMIT))
        for rule, finding in firsts.items():
            to = f"{link}#{anchor_of(finding)}" if link else ""
            by_rule.setdefault(rule, []).append((finding, Found(name, to)))
    several = [(rule, each) for rule, each in by_rule.items() if len(each) > 1]
    several.sort(
        key=lambda item: (-len(item[1]), min(f.severity.rank for f, _ in item[1]), item[0])
    )
    return [_common(rule, each) for rule, each in several[:_COMMON_SHOWN]]


def _common(rule: str, found: list[tuple[ReportedFinding, Found]]) -> Common:
    worst = min((finding for finding, _ in found), key=lambda each: each.severity.rank)
    title = plain(worst.title or worst.name).rstrip(".")
    return Common(plain(rule), title, str(worst.severity), tuple(each for _, each in found))
