"""Reads an upload and checks it: the work of a process in the sandbox (`checker.base.sandbox`).

It loads what a check needs, then waits for the upload. When there is nothing to do for a while, a
process that reads meshes waits as well. Its results go back as requested, in one file
without a name; nothing that it writes elsewhere is read.
"""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from functools import cache as once
from itertools import chain
from pathlib import Path
from select import select
from typing import Any

from msgspec.structs import asdict, replace

from checker.base.child_server import Server
from checker.base.record import Record
from checker.base.resources import PACKAGE
from checker.base.sandbox.files import Content, Files
from checker.base.sandbox.task import INPUT, Answer
from checker.physics.mesh.process import mesh_server
from checker.report.report import Report
from checker.service.jobs.exchange import GIVEN, TEMPORARY, StageLimits, limit, new_parts, settle
from checker.service.jobs.port import Stage

# Reports that do not show where on this machine an upload lay while it was checked.


def without_folder(report: Report, place: Path) -> Report:
    """Return a report in which paths begin below the folder of work in progress.

    Messages may contain paths: of settings that cannot be used, of rules that crashed.

    Args:
        report: The report of the check.
        place: The folder, laid out by `checker.service.jobs.exchange`.
    """
    folders = "|".join(re.escape(str(folder)) for folder in {place, place.resolve()})
    unpacked = rf"{TEMPORARY}/[^/\s]+|{re.escape(GIVEN)}"
    pattern = re.compile(rf"(?:{folders})(?:/(?:{unpacked}))?/?")
    changed: Report = _changed(report, lambda text: pattern.sub("", text))
    return changed


def _changed(value: Any, change: Callable[[str], str]) -> Any:
    """Return a value with all the texts in it changed."""
    match value:
        case str() if type(value) is str:
            return change(value)
        case tuple():
            return tuple(_changed(item, change) for item in value)
        case list():
            return [_changed(item, change) for item in value]
        case Mapping():
            return {_changed(key, change): _changed(item, change) for key, item in value.items()}
        case Record():
            members = {name: _changed(part, change) for name, part in asdict(value).items()}
            return replace(value, **members)
    return value


_NEEDED = (f"{PACKAGE}.engine.review", f"{PACKAGE}.report.files", "markdown_it", "pinocchio")
"""Modules that nearly every check loads; some of them start threads."""
_IDLE = 0.5
"""Seconds without a check, after which the next one counts as that of a new upload: of one that
has waited, and of the second stage, the meshes are usually known."""


def prepare() -> None:
    """Load what a check needs; what cannot be loaded is reported by the check that needs it."""
    from importlib import import_module

    from checker.base.errors import CheckerError
    from checker.engine.report_cache import program_parts
    from checker.rulebook.discovery import all_rules

    for name in _NEEDED:
        with suppress(ImportError):
            import_module(name)
    with suppress(CheckerError):
        all_rules()
    # Reports are remembered as those of the program that is loaded, not of a newer one on the disk.
    program_parts()
    _waiting()


@once
def _waiting() -> list[Server]:
    """Return the process that reads meshes, if the check lets it come first."""
    return [] if select([INPUT], [], [], _IDLE)[0] else [mesh_server().start()]


def answer(request: bytes, files: Files) -> Answer:
    """Check an upload.

    Args:
        request: JSON: `name` of the uploaded file, `profile`, `stage` and `limits`.
        files: The upload, and parts of an earlier check of it; see `checker.service.jobs.exchange`.

    Returns:
        JSON: why the upload is `refused`, why the check is `disturbed`, or the summary of the
        result; and the files of the result, with parts for the next stage.
    """
    job = json.loads(request)
    place = Path.cwd()
    settle(place, job["name"], files)
    limit(StageLimits(**job["limits"]))
    summary, written = _checked(job, place)
    return json.dumps(summary).encode(), chain(written, new_parts(place, files.names))


def _meshes() -> Server:
    """Return a process that waits for meshes: the one that is there, the first time."""
    waiting = _waiting()
    if waiting and waiting[0].alive:
        return waiting.pop()
    return mesh_server()


def _checked(
    job: Mapping[str, Any], place: Path
) -> tuple[dict[str, Any], Iterator[tuple[str, Content]]]:
    """Return the answer, and the files of the result."""
    from checker.base.errors import InvalidSettings, UnreadableInput
    from checker.base.words import plain, shortened
    from checker.pipeline import check_paths
    from checker.rulebook.profiles import profile_names
    from checker.service.jobs.exchange import summary

    if job["profile"] not in ("", *profile_names()):
        known = ", ".join(profile_names())
        return _refused(f"there is no profile {job['profile']!r}; choose one of {known}")
    stage, name = Stage(job["stage"]), str(job["name"])
    options = {
        "profile": job["profile"] or None,
        "trial": False if stage is Stage.STATIC else None,
        "display": stage is not Stage.STATIC,
    }
    try:
        # Relative, so that no report shows where this machine keeps it.
        report = without_folder(check_paths([Path(name)], options, mesh_server=_meshes), place)
    except (InvalidSettings, UnreadableInput) as error:
        return _refused(shortened(str(error), 1_000))
    if reason := _disturbance(report):
        return {"disturbed": shortened(plain(reason), 1_000)}, iter(())
    if not report.packages:
        reasons = (f"{item.path} {item.reason}" for item in report.not_opened)
        return _refused(shortened(". ".join(reasons), 1_000))
    return summary(report), _files(report, stage, job)


def _disturbance(report: Report) -> str:
    """Return why something is missing that may be there the next time; empty if nothing is."""
    unopened = (item.disturbed for item in report.not_opened)
    reasons = (
        *(f"the system of the service says: {cause}" for cause in unopened if cause),
        *(package.disturbed for package in report.packages),
    )
    return next(filter(None, reasons), "")


def _refused(reason: str) -> tuple[dict[str, Any], Iterator[tuple[str, Content]]]:
    return {"refused": reason}, iter(())


def _files(report: Report, stage: Stage, job: Mapping[str, Any]) -> Iterator[tuple[str, Content]]:
    """Yield the result: of the static stage the JSON alone, since the trial's follows soon."""
    from checker.report.files import artefacts
    from checker.report.formats import FORMATS
    from checker.report.render_settings import Palette, RenderSettings

    profile = ("--profile", job["profile"]) if job["profile"] else ()
    command = shlex.join(("subt-check", job["name"], *profile))
    manner = RenderSettings(Palette(enabled=False), "/", command)
    early = [("report.json", FORMATS["json"](report, manner))]
    for name, content in early if stage is Stage.STATIC else artefacts(report, manner):
        yield name, content.encode("utf-8") if isinstance(content, str) else content
