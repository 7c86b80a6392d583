"""A package's report as one HTML file: no outside requests, readable without JavaScript."""

from __future__ import annotations

import hashlib
import shlex
from base64 import b64encode
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import chain, repeat
from typing import TYPE_CHECKING, Any

from checker.finding import Severity
from checker.report.fact_words import facts_in_words
from checker.report.figures import rows_of
from checker.report.html.findings import groups_of
from checker.report.html.plots import plots_of, spans_of
from checker.report.html.unchecked import reasons_of, suppressed_of
from checker.report.json_report import to_json
from checker.report.report import PackageReport, Report, VerdictKind
from checker.report.sarif import to_sarif
from checker.report.verdict import sentence
from checker.report.wording import count, plain
from checker.resources import templates

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup

SCRIPTS = ("findings.js", "plots.js", "stage.js")
"""The page's own behaviour, in the order of their dependence."""
VIEWER = "viewer.js"
"""The 3D viewer, built from `templates/viewer`; a page without it shows pictures."""
DOWNLOAD_LIMIT = 3_000_000
"""Bytes of JSON that a page carries along; more is had by `--format json`."""


def to_html(package: PackageReport, versions: Mapping[str, str], folder: str) -> str:
    """Return the page of one package.

    Args:
        package: What was found out.
        versions: Of the program and its libraries, by name.
        folder: Where the command was run, absolute; the SARIF file's paths start there.
    """
    script = _script(with_viewer=package.display is not None)
    return environment().get_template("report.html.j2").render(
        package=package,
        sentence=sentence(package),
        groups=groups_of(package.findings),
        counts=[(level, package.count(level)) for level in Severity],
        facts=[(plain(fact.name), plain(fact.value)) for fact in facts_in_words(package.facts)],
        reasons=reasons_of(package.not_checked),
        suppressed=suppressed_of(package.suppressed),
        trial=package.trial,
        rows=rows_of(package.trial["measurements"]) if package.trial else [],
        plots=plots_of(package.trial) if package.trial else [],
        spans=spans_of(package.trial["course"]) if package.trial else [],
        downloads=_downloads(Report((package,), versions), folder),
        has_viewer=package.display is not None and has_viewer(),
        versions=versions,
        style=text_of("report.css"),
        script=script,
        script_hash=_hash(script),
    )  # fmt: skip


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

    made = Environment(
        loader=FunctionLoader(text_of),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["plain"] = plain
    made.filters["count"] = count
    made.filters["data_url"] = data_url
    made.filters["quoted"] = shlex.quote
    made.filters["with_code"] = with_code
    return made


def with_code(text: str) -> Markup:
    """Return text of a rule's page with what stands in backticks as code."""
    from markupsafe import Markup, escape

    pieces = text.split("`")
    if len(pieces) % 2 == 0:
        return escape(text)
    shown = (f"<code>{escape(p)}</code>" if n % 2 else escape(p) for n, p in enumerate(pieces))
    return Markup("").join(map(Markup, shown))


def data_url(content: bytes, kind: str) -> str:
    """Return an address that holds the content itself."""
    return f"data:{kind};base64,{b64encode(content).decode('ascii')}"


def to_index(report: Report, links: Sequence[str]) -> str:
    """Return a page that lists the packages of a run.

    Args:
        report: Of all packages.
        links: Address of each package's own page, relative to this one; none where it is empty.
    """
    return environment().get_template("index.html.j2").render(
        report=report,
        entries=[
            (each, sentence(each), link)
            for each, link in zip(report.packages, chain(links, repeat("")), strict=False)
        ],
        levels=list(Severity),
        ready=sum(each.verdict is VerdictKind.READY for each in report.packages),
        style=text_of("report.css"),
    )  # fmt: skip


def _script(*, with_viewer: bool) -> str:
    """Return all JavaScript of a page; an end tag inside a text ends no script."""
    names = (VIEWER, *SCRIPTS) if with_viewer and has_viewer() else SCRIPTS
    return "\n".join(text_of(name) for name in names).replace("</script", "<\\/script")


def _hash(script: str) -> str:
    return b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")


def _downloads(report: Report, folder: str) -> list[dict[str, Any]]:
    """Return the files that a page carries along."""
    made = [
        ("report.json", "application/json", to_json(report).encode()),
        ("report.sarif", "application/json", to_sarif(report, folder).encode()),
        ("fixes.patch", "text/plain", report.packages[0].patch.encode()),
    ]
    return [
        {"name": name, "url": data_url(content, kind)}
        for name, kind, content in made
        if 0 < len(content) <= DOWNLOAD_LIMIT
    ]
