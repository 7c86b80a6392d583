"""The formats of a report by name; each loads its own modules."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from msgspec.structs import replace

from checker.report.render_settings import RenderSettings
from checker.report.report import Report


def _text(report: Report, manner: RenderSettings) -> str:
    from checker.report.text_report import to_text

    return to_text(report, manner)


def _concise(report: Report, manner: RenderSettings) -> str:
    return _text(report, replace(manner, concise=True))


def _json(report: Report, _: RenderSettings) -> str:
    from checker.report.json_report import to_json

    return to_json(report)


def _sarif(report: Report, manner: RenderSettings) -> str:
    from checker.report.sarif import to_sarif

    return to_sarif(report, manner.folder)


def _github(report: Report, _: RenderSettings) -> str:
    from checker.report.ci_formats import to_github

    return to_github(report)


def _junit(report: Report, _: RenderSettings) -> str:
    from checker.report.ci_formats import to_junit

    return to_junit(report)


def _markdown(report: Report, _: RenderSettings) -> str:
    from checker.report.markdown import to_markdown

    return to_markdown(report)


def _html(report: Report, manner: RenderSettings) -> str:
    """Return the page of the one package, or a list of all."""
    from checker.report.html.page import to_html, to_index

    if len(report.packages) != 1:
        return to_index(report, ())
    return to_html(report.packages[0], report, manner)


FORMATS: Mapping[str, Callable[[Report, RenderSettings], str]] = {
    "text": _text,
    "concise": _concise,
    "json": _json,
    "sarif": _sarif,
    "github": _github,
    "junit": _junit,
    "markdown": _markdown,
    "html": _html,
}
