"""The files that `--report DIR` writes: the results of a run."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import chain
from urllib.parse import quote

from checker.report.formats import FORMATS
from checker.report.render_settings import RenderSettings
from checker.report.report import PackageReport, Report

Artefact = tuple[str, str | bytes]
"""Path of a file, relative to the folder, and what it contains."""

PAGE, INDEX, MODEL = "report.html", "index.html", "robot.glb"
ARTEFACT_NAME = re.compile(
    r"(?:[\w~-]{1,110}/)?(?:report\.(?:html|json|sarif)|robot\.glb)|index\.html"
)
"""For those that others made, a service or a child: nothing else of theirs is written or served."""
STALE = (PAGE, INDEX, MODEL)
"""Files of an earlier run that this one may not write again: they belong to another report."""


def _for_programs(report: Report, manner: RenderSettings) -> Iterator[Artefact]:
    yield "report.json", FORMATS["json"](report, manner)
    yield "report.sarif", FORMATS["sarif"](report, manner)


def _for_people(report: Report, manner: RenderSettings) -> Iterator[Artefact]:
    """Yield the page of one package; of several, a folder for each and a list of them."""
    if len(report.packages) == 1:
        yield from _package(report.packages[0], report, manner, "")
        return
    from checker.report.html.page import to_index

    folders = package_folders(report)
    for package, folder in zip(report.packages, folders, strict=True):
        yield from _package(package, report, manner, f"{folder}/")
    yield INDEX, to_index(report, [f"{quote(folder)}/{PAGE}" for folder in folders])


def _package(
    package: PackageReport, report: Report, manner: RenderSettings, prefix: str
) -> Iterator[Artefact]:
    from checker.report.html.page import to_html

    yield prefix + PAGE, to_html(package, report, manner, f"../{INDEX}" if prefix else "")
    if package.display is not None:
        yield prefix + MODEL, package.display.glb


def package_folders(report: Report) -> list[str]:
    """Name the folder of each package's files: "" for the only one, else after the package.

    Those of one name are numbered.
    """
    if len(report.packages) == 1:
        return [""]
    names: dict[str, int] = {}
    folders = []
    for package in report.packages:
        name = "".join(c if c.isalnum() or c in "-_" else "_" for c in package.name)[:60] or "_"
        names[name] = names.get(name, 0) + 1
        folders.append(f"{name}~{names[name]}" if names[name] > 1 else name)
    return folders


_MAKERS: tuple[Callable[[Report, RenderSettings], Iterator[Artefact]], ...] = (
    _for_programs,
    _for_people,
)


def artefacts(report: Report, manner: RenderSettings) -> Iterator[Artefact]:
    """Yield the files one after the other; each is made when it is requested."""
    return chain.from_iterable(maker(report, manner) for maker in _MAKERS)
