"""Output of `subt-check check` while it runs, and the files that it writes at the end."""

from __future__ import annotations

import argparse
import shlex
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from checker.base.output import current_folder, empty_of, say_progress, show, write
from checker.base.progress import ProgressLine
from checker.base.resources import processors
from checker.base.words import plain, shortened
from checker.pipeline import Checked, Task, check_tasks, join_reports, tasks_of
from checker.report.files import INDEX, PAGE, STALE, artefacts
from checker.report.formats import FORMATS
from checker.report.render_settings import RenderSettings, palette_for
from checker.report.report import NotOpened, PackageReport, Report
from checker.report.summary import statistics_text
from checker.report.text_report import TextReport, closing_text

_LINES = ("text", "concise")
"""Formats that are printed while packages are checked."""


def check_and_print(
    paths: Sequence[Path], wishes: Mapping[str, Any], options: argparse.Namespace
) -> Report:
    """Check packages; a report in text is printed as it grows.

    Args:
        paths: What to check.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        options: The options of the command line.

    Raises:
        InvalidSettings: The settings name what does not exist.
    """
    progress = ProgressLine()
    tasks = tasks_of(paths, wishes, progress.say)
    progress.total = len(tasks)
    jobs = min(options.jobs or processors(), len(tasks))
    is_printed = options.format in _LINES and not (options.output or options.write_baseline)
    settings = _render_settings(options)
    text = TextReport(settings, [task.display_path for task in tasks])
    done: list[Checked] = []
    for task, checked in zip(tasks, _watched(tasks, jobs, progress), strict=True):
        done.append(checked)
        _complain(checked)
        packages = [item for item in checked if isinstance(item, PackageReport)]
        for block in text.add(packages, task.display_path) if is_printed else ():
            show(block)
    report = join_reports(done)
    if is_printed:
        show("".join((*text.deferred_lines(), closing_text(report, settings))))
    return report


def _watched(tasks: Sequence[Task], jobs: int, progress: ProgressLine) -> Iterator[Checked]:
    """Yield the result of each task; in between, the progress is shown."""
    for checked in check_tasks(tasks, jobs):
        progress.clear()
        yield checked
        progress.advance()
    progress.clear()


def _complain(checked: Checked) -> None:
    for item in checked:
        if isinstance(item, NotOpened) and item.failed:
            path = plain(shortened(item.path, 300))
            print(f"subt-check: {path} {plain(item.reason)}", file=sys.stderr)


def _render_settings(options: argparse.Namespace) -> RenderSettings:
    return RenderSettings(
        palette_for(options.color, None if options.output else sys.stdout),
        str(current_folder()),
        shlex.join(("subt-check", *options.words)),
        options.info,
        options.quiet,
        options.format == "concise",
        options.full,
    )


def _name_page(page: Path, options: argparse.Namespace) -> None:
    """State where the HTML report is, and open it if that is requested."""
    if options.format in _LINES and not (options.quiet or options.output):
        show(f"report: {page}\n")
    else:
        say_progress(f"report: {page}")
    if options.open:
        import webbrowser

        webbrowser.open(page.resolve().as_uri())


def write_results(report: Report, options: argparse.Namespace) -> None:
    """Write the report in all requested forms other than text on standard output."""
    settings = _render_settings(options)
    if options.output:
        write(Path(options.output), FORMATS[options.format](report, settings))
    elif options.format not in _LINES:
        show(FORMATS[options.format](report, settings))
    if options.report:
        folder = empty_of(Path(options.report), STALE)
        for name, content in artefacts(report, settings):
            write(folder / name, content)
        _name_page(folder / (PAGE if len(report.packages) == 1 else INDEX), options)
    if options.statistics:
        # Behind another format's report it would spoil it.
        tell = show if options.output or options.format == "text" else say_progress
        tell("\n" + statistics_text(report))
