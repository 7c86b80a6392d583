"""A package's report as one HTML file: no outside requests, readable without JavaScript."""

from __future__ import annotations

import hashlib
import shlex
from base64 import b64encode
from collections.abc import Sequence
from functools import cache
from itertools import chain, islice, repeat
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.base.resources import templates
from checker.base.words import and_list, count, plain, shortened
from checker.finding import Concern, Severity
from checker.report.html.findings import grades_of, rule_pages
from checker.report.html.index import common_problems, entry_of
from checker.report.html.launches import shown_launches
from checker.report.html.overview import first_tasks, trial_sentences
from checker.report.html.robots import ShownRobot, files_out_of_view, shown_robots
from checker.report.json_report import to_json
from checker.report.render_settings import RenderSettings
from checker.report.report import Cause, NotChecked, PackageReport, Report, Suppressed
from checker.report.sarif import to_sarif
from checker.report.summary import has_suppressed, sentence, what_is_ready
from checker.report.unseen import by_reason

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup


# What was not looked at and what was set aside, by reason.


_TEXT_LIMIT = 600
SHOWN = 300
"""Entries of a list; the rest is counted."""
_CAUSES = {
    Cause.CRASHED: "internal error",
    Cause.NOT_AT_HAND: "not available",
    Cause.NOT_SUPPORTED: "not supported",
    Cause.SWITCHED_OFF: "switched off",
    Cause.NOT_APPLICABLE: "not applicable",
}
"""In words, what keeps a package from being ready first."""


class Reason(Record):
    """A reason and the rules that did not look because of it."""

    cause: str
    reason: str
    rules: tuple[str, ...]


class SetAside(Record):
    """A finding that does not count: its message, its place, and the reason."""

    rule: str
    message: str
    where: str
    by: str
    reason: str


def reasons_of(not_checked: Sequence[NotChecked]) -> list[Reason]:
    """Join what has one reason; what keeps the package from being ready comes first."""
    order = list(_CAUSES)
    return [
        Reason(_CAUSES[unseen.cause], plain(shortened(unseen.reason, _TEXT_LIMIT)), unseen.rules)
        for unseen in sorted(by_reason(not_checked), key=lambda it: order.index(it.cause))
    ]


def suppressed_of(suppressed: Sequence[Suppressed]) -> list[SetAside]:
    """Return what was set aside, as far as the page shows it."""
    return [
        SetAside(
            plain(item.finding.rule),
            plain(shortened(item.finding.message, _TEXT_LIMIT)),
            plain(str(item.finding.places[0])),
            str(item.by),
            plain(shortened(item.reason, _TEXT_LIMIT)),
        )
        for item in suppressed[:SHOWN]
    ]


def why_not_driven(not_checked: Sequence[NotChecked]) -> str:
    """Return why the rules on the trial did not look; empty if they state nothing."""
    reasons = (skipped.reason for skipped in not_checked if skipped.rule.startswith("TRI"))
    return plain(shortened(next(reasons, ""), _TEXT_LIMIT))


_CONCERNS = list(Concern)
SCRIPTS = ("findings.js", "plots.js", "stage.js")
"""The page's own behaviour, in the order of their dependence."""
VIEWER = "viewer.js"
"""The 3D viewer, built from `templates/viewer`; a page without it shows pictures."""
DOWNLOADS_LIMIT = 1_500_000
"""Bytes of other reports that a page carries along; `--report` writes them next to it."""


def to_html(package: PackageReport, report: Report, manner: RenderSettings, index: str = "") -> str:
    """Return the page of one package.

    Args:
        package: What was found out.
        report: The report of the run that it belongs to.
        manner: The command, and the folder in which it was run.
        index: The address of the list of all packages, relative to this page; empty without.
    """
    robots, reasons = shown_robots(package), reasons_of(package.not_checked)
    driven = any(robot.trial for robot in robots)
    script = _script(SCRIPTS, with_viewer=driven or package.display is not None)
    return environment().get_template("report.html.j2").render(
        package=package,
        sentence=sentence(package),
        tasks=first_tasks(package),
        told=_trial_sentences(robots, why_not_driven(package.blind_spots)),
        grades=grades_of(package.findings, frozenset(files_out_of_view(robots))),
        rules=rule_pages(package.findings),
        concerns=sorted({finding.concern for finding in package.findings}, key=_CONCERNS.index),
        index=index,
        launches=shown_launches(package.launched[:SHOWN], package.findings),
        robots=robots,
        reasons=reasons[:SHOWN],
        more_reasons=max(0, len(reasons) - SHOWN),
        unchecked=len({skipped.rule for skipped in package.not_checked}),
        suppressed=suppressed_of(package.suppressed),
        more_suppressed=max(0, len(package.suppressed) - SHOWN),
        not_opened=() if index else report.not_opened,
        why_not_driven=why_not_driven(package.not_checked),
        downloads=_downloads(Report((package,), report.versions), manner.folder),
        has_viewer=package.display is not None and has_viewer(),
        command=manner.command,
        versions=report.versions,
        style=text_of("report.css"),
        script=script,
        script_hash=_hash(script),
    )  # fmt: skip


def _trial_sentences(robots: Sequence[ShownRobot], unseen: str) -> list[str]:
    """Return the result of the trial as sentences; of several robots, that of the first driven."""
    driven = next((robot for robot in robots if robot.trial), None)
    if driven is None or driven.trial is None:
        return []
    if len(robots) == 1:
        return trial_sentences(driven.trial, unseen=unseen)
    others = [each.name for each in robots if each is not driven and each.has_fault]
    also = [f"Faults in the trials of others: {and_list(others)}."] if others else []
    return [*trial_sentences(driven.trial, driven.name, unseen), *also]


def has_viewer() -> bool:
    """Return whether the 3D viewer was built."""
    return templates("report").joinpath(VIEWER).is_file()


def text_of(name: str) -> str:
    """Return a file of the page's parts."""
    return templates("report").joinpath(name).read_text("utf-8")


@cache
def environment() -> Environment:
    """Return what renders the templates; every text is escaped."""
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    jinja = Environment(
        loader=FunctionLoader(text_of),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    jinja.filters["plain"] = plain
    jinja.filters["count"] = count
    jinja.filters["data_url"] = data_url
    jinja.filters["quoted"] = shlex.quote
    jinja.filters["with_code"] = with_code
    return jinja


def with_code(text: str) -> Markup:
    """Return text of a rule's page with what is in backticks as code."""
    from markupsafe import Markup, escape

    pieces = text.split("`")
    if len(pieces) % 2 == 0:
        return escape(text)
    shown = (f"<code>{escape(p)}</code>" if n % 2 else escape(p) for n, p in enumerate(pieces))
    return Markup("").join(map(Markup, shown))


def data_url(content: bytes, kind: str) -> str:
    """Return an address that contains the content itself."""
    return f"data:{kind};base64,{b64encode(content).decode('ascii')}"


def to_index(report: Report, links: Sequence[str]) -> str:
    """Return a page that lists the packages of a run.

    Args:
        report: The report of all packages.
        links: Address of each package's own page, relative to this one; none if it is empty.
    """
    script = _script(("index.js",), with_viewer=False)
    sentences = map(sentence, report.packages)
    addresses = list(islice(chain(links, repeat("")), len(report.packages)))
    return environment().get_template("index.html.j2").render(
        report=report,
        entries=[
            entry_of(package, said.lead, said.aside, link)
            for package, said, link in zip(report.packages, sentences, addresses, strict=True)
        ],
        common=common_problems(report.packages, addresses),
        levels=list(Severity),
        with_suppressed=has_suppressed(report.packages),
        with_pictures=any(each.display and each.display.pictures for each in report.packages),
        ready=what_is_ready((package.kind, package.verdict) for package in report.packages),
        style=text_of("report.css"),
        script=script,
        script_hash=_hash(script),
    )  # fmt: skip


def _script(own: Sequence[str], *, with_viewer: bool) -> str:
    """Return all JavaScript of a page; an end tag inside a text ends no script."""
    names = (VIEWER, *own) if with_viewer and has_viewer() else own
    return "\n".join(text_of(name) for name in names).replace("</script", "<\\/script")


def _hash(script: str) -> str:
    return b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")


def _downloads(report: Report, folder: str) -> list[dict[str, Any]]:
    """Return the files that a page carries along, as many as there is room for."""
    files = [
        ("fixes.patch", "text/plain", report.packages[0].patch),
        ("report.json", "application/json", to_json(report)),
        ("report.sarif", "application/json", to_sarif(report, folder)),
    ]
    room = DOWNLOADS_LIMIT
    carried = []
    for name, kind, text in files:
        content = text.encode("utf-8", "surrogatepass")
        if 0 < len(content) <= room:
            room -= len(content)
            carried.append({"name": name, "url": data_url(content, kind)})
    return carried
