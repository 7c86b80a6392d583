"""The folder that a worker and its checking child share, and what the child knows besides."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from dataclasses import asdict
from pathlib import Path

from checker.confined import module_path
from checker.jobs.isolation import StageLimits
from checker.jobs.port import Order, Stage

MADE, REQUEST, ANSWER, SAID = "made", "request.json", "answer.json", "said"
"""The result; what the worker asks for; what the child answers; what it writes to its streams."""
GIVEN = "given/upload"
"""The folder of the upload, in which the child runs; reports show neither."""
TEMPORARY = "temporary"
"""The folder of what the child unpacks and its children work with."""
OUT_OF_MEMORY = 71
"""Exit code of the child, EX_OSERR of sysexits.h."""


def lay_out(place: Path, upload: Path, order: Order, stage: Stage, limits: StageLimits) -> None:
    """Lay out what the child works with in an empty folder."""
    given = place / GIVEN
    (place / SAID).touch()
    for folder in (given, place / MADE, place / TEMPORARY):
        folder.mkdir(parents=True)
    # The search for settings ends at the root of a repository: none of this machine's shall judge.
    (given.parent / ".git").touch()
    try:
        os.link(upload, given / order.name)
    except OSError:  # a file system without links
        shutil.copyfile(upload, given / order.name)
    request = {
        "name": order.name,
        "profile": order.profile,
        "stage": stage,
        "limits": asdict(limits),
    }
    (place / REQUEST).write_text(json.dumps(request), encoding="utf-8")


_PASSED_ON = {"HOME", "LANG", "LD_LIBRARY_PATH", "MUJOCO_GL", "PATH", "SUBT_CHECK_DEBUG", "TZ"}
_FAMILIES = ("EGL_", "GALLIUM_", "LC_", "LIBGL_", "LP_", "MESA_", "PYTHON", "__EGL_")


def environment(cache: Path) -> dict[str, str]:
    """Return what the child shall know of our environment: no token, no password, no address.

    Args:
        cache: Where results of parts are kept, for all children.
    """
    known = {
        name: value
        for name, value in os.environ.items()
        if name in _PASSED_ON or name.startswith(_FAMILIES)
    }
    return {**known, "SUBT_CHECK_CACHE": str(cache), "PYTHONPATH": module_path()}


def settle(place: Path) -> None:
    """Have this process work in a folder that is laid out, and speak into it."""
    os.chdir(place / GIVEN)
    os.environ["TMPDIR"] = str(place / TEMPORARY)
    tempfile.tempdir = None  # a library may have asked for it before
    with (place / SAID).open("wb") as said:
        for stream in (1, 2):
            os.dup2(said.fileno(), stream)
