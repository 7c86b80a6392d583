"""Settings of renderers: colours of a terminal, and addresses."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import TextIO

from checker.base.record import Record
from checker.finding import Severity
from checker.report.report import PackageReport, ReportedFinding, VerdictKind

# Terminal colours, which only ever repeat what a word says.


_SEVERITY = {Severity.ERROR: "1;31", Severity.WARNING: "33", Severity.INFO: "36"}
_VERDICT = {
    VerdictKind.READY: "1;32",
    VerdictKind.PAPERWORK: "1;33",
    VerdictKind.NOT_READY: "1;31",
    VerdictKind.INCOMPLETE: "1;33",
}


class Palette(Record):
    """Colours text, or leaves it as it is."""

    enabled: bool

    def _paint(self, code: str, text: str) -> str:
        return f"\x1b[{code}m{text}\x1b[0m" if self.enabled else text

    def severity(self, severity: Severity) -> str:
        """Return the severity's word."""
        return self._paint(_SEVERITY[severity], str(severity))

    def verdict(self, verdict: VerdictKind, text: str) -> str:
        """Colour a text by a verdict."""
        return self._paint(_VERDICT[verdict], text)

    def bold(self, text: str) -> str:
        """Return bold text."""
        return self._paint("1", text)

    def dim(self, text: str) -> str:
        """Return text that steps back."""
        return self._paint("2", text)


def choose_palette(wish: str, stream: TextIO | None, environment: Mapping[str, str]) -> Palette:
    """Decide on colours: `always`, `never`, or `auto` by NO_COLOR, FORCE_COLOR and terminal.

    Args:
        wish: The user's options.
        stream: The output stream; None for a file.
        environment: The process's variables.
    """
    if wish != "auto" or stream is None:
        return Palette(wish == "always")
    if environment.get("NO_COLOR"):
        return Palette(enabled=False)
    if environment.get("FORCE_COLOR"):
        return Palette(enabled=True)
    return Palette(stream.isatty() and environment.get("TERM") != "dumb")


def palette_for(wish: str, stream: TextIO | None) -> Palette:
    """Decide on colours in this process's environment."""
    return choose_palette(wish, stream, os.environ)


class RenderSettings(Record):
    """The settings for rendering a report.

    Attributes:
        palette: Colours for a terminal.
        folder: The folder in which the command was run, absolute; paths of the report start there.
        command: What was run, as a shell takes it; empty if there was no command.
        infos: Whether the report for a terminal shows infos, and what does not apply.
        quiet: Whether it shows findings alone.
        concise: Whether it has one line a finding.
        full: Whether it shows source lines and reasons, too.
    """

    palette: Palette
    folder: str = ""
    command: str = ""
    infos: bool = False
    quiet: bool = False
    concise: bool = False
    full: bool = False


def is_shown(finding: ReportedFinding, settings: RenderSettings) -> bool:
    """Return whether the report for a terminal shows a finding."""
    return settings.infos or finding.severity is not Severity.INFO


def shown_findings(package: PackageReport, settings: RenderSettings) -> Iterator[ReportedFinding]:
    """Yield the findings of a package that the report for a terminal shows."""
    return (finding for finding in package.findings if is_shown(finding, settings))
