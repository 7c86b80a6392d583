"""The process that reads an upload: `python -m checker.jobs.checking_child PARENT`.

It loads what a check needs, then waits on its standard input for the folder to work in, which
`checker.jobs.layout` lays out. `checker.jobs.children` starts it. When there is nothing to do for a
while, a process that reads meshes waits beside it.
"""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from select import select
from typing import Any

from checker.confined import Child
from checker.jobs.isolation import StageLimits, isolate, limit
from checker.jobs.layout import ANSWER, MADE, OUT_OF_MEMORY, REQUEST, settle
from checker.jobs.port import Stage
from checker.mesh.early import mesh_child
from checker.report.report import Report

_NEEDED = ("checker.judging", "checker.report.artefacts", "markdown_it", "pinocchio")
"""What nearly every check loads; some of it starts threads."""
_IDLE = 0.5
"""Seconds without a check, after which the next one is taken for that of a new upload: of one that
has waited, and of the second stage, the meshes are mostly known."""


def main(parent: int) -> None:
    """Get ready for a check, and do it when it comes; the standard input may end without one."""
    try:
        isolate(parent)
    except ProcessLookupError:
        return
    _load()
    meshes = None if select([sys.stdin], [], [], _IDLE)[0] else mesh_child()
    if place := sys.stdin.readline():
        check(Path(json.loads(place)), meshes)


def _load() -> None:
    """Load what a check needs; what cannot be loaded is told by the check that misses it."""
    from importlib import import_module

    from checker.discovery import all_rules
    from checker.errors import CheckerError
    from checker.recall import program_parts

    for name in _NEEDED:
        with suppress(ImportError):
            import_module(name)
    with suppress(CheckerError):
        all_rules()
    # Reports are remembered as those of the program that is loaded, not of a newer one on the disk.
    program_parts()


def check(place: Path, meshes: Child | None = None) -> None:
    """Check what lies in the working folder; leave artefacts and an answer.

    Args:
        place: The folder.
        meshes: A child that waits for the meshes of the first package; who checks ends it.
    """
    request = json.loads((place / REQUEST).read_text(encoding="utf-8"))
    settle(place)
    limits = StageLimits(**request["limits"])
    limit(limits)
    waiting = [meshes] if meshes is not None and _limited(meshes, limits) else []
    answer = _answer(request, place, lambda: waiting.pop() if waiting else mesh_child())
    (place / ANSWER).write_text(json.dumps(answer), encoding="utf-8")


def _limited(child: Child, limits: StageLimits) -> bool:
    """Hold a child that waits to the limits of a check; False, and it is ended, if that fails."""
    with suppress(OSError, ValueError):  # it has died, or sets its own at this very moment
        limit(limits, child.pid)
        if child.alive:
            return True
    child.stop()
    return False


def _answer(
    request: Mapping[str, Any], place: Path, mesh_child: Callable[[], Child]
) -> dict[str, Any]:
    """Return why the upload is refused, or the summary of the result that was written."""
    from checker.check import check_paths
    from checker.errors import InvalidSettings, UnreadableInput
    from checker.jobs.neutral import without_folder
    from checker.jobs.summary import summary
    from checker.profiles import profile_names
    from checker.report.wording import shortened

    if request["profile"] not in ("", *profile_names()):
        known = ", ".join(profile_names())
        return {"refused": f"there is no profile {request['profile']!r}; choose one of {known}"}
    stage, name = Stage(request["stage"]), str(request["name"])
    wishes = {
        "profile": request["profile"] or None,
        "trial": False if stage is Stage.STATIC else None,
        "display": stage is not Stage.STATIC,
    }
    try:
        # Relative, so that no report shows where this machine keeps it.
        report = without_folder(check_paths([Path(name)], wishes, mesh_child=mesh_child), place)
    except (InvalidSettings, UnreadableInput) as error:
        return {"refused": shortened(str(error), 1_000)}
    if not report.packages:
        reasons = (f"{each.path} {each.reason}" for each in report.not_opened)
        return {"refused": shortened(". ".join(reasons), 1_000)}
    _write(report, stage, request, place / MADE)
    return summary(report)


def _write(report: Report, stage: Stage, request: Mapping[str, Any], made: Path) -> None:
    """Write the result: of the static stage the JSON alone, since the trial's follows soon."""
    from checker.report.artefacts import artefacts
    from checker.report.formats import FORMATS
    from checker.report.manner import Manner
    from checker.report.palette import Palette

    profile = ("--profile", request["profile"]) if request["profile"] else ()
    command = shlex.join(("subt-check", request["name"], *profile))
    manner = Manner(Palette(enabled=False), "/", command)
    early = [("report.json", FORMATS["json"](report, manner))]
    for name, content in early if stage is Stage.STATIC else artefacts(report, manner):
        path = made / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)


if __name__ == "__main__":
    try:
        main(int(sys.argv[1]))
    except MemoryError:
        os._exit(OUT_OF_MEMORY)
