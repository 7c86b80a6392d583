"""Looks at what makes reports quicker or richer: the cache, OpenGL, the 3D viewer."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from checker.cache import SIZE_LIMIT, cache_folder
from checker.confined import Died, Limits, ask
from checker.doctor.result import Result, State
from checker.report.wording import plain
from checker.resources import templates

_ENTRIES_LIMIT = 100_000
_LIMITS = Limits(10.0, 16_000_000_000, draws=True)
"""Software renderers map far more memory than they use."""


def surroundings() -> Iterator[Result]:
    """Yield what the checker can do without, and would like to have."""
    yield _cache(cache_folder())
    yield _drawing()
    yield _viewer()


def _cache(folder: Path) -> Result:
    place = f"cache {plain(str(folder))}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        what = f"{place} cannot be written to ({error.strerror}), so the cache is not used"
        return Result(State.NOTE, what, "set SUBT_CHECK_CACHE to a writable folder")
    sizes = [_size(path) for path in islice(folder.glob("*/??/*.json"), _ENTRIES_LIMIT)]
    used = f"{len(sizes)} entries, {sum(sizes) / 1e6:.1f} of {SIZE_LIMIT / 1e6:.0f} MB"
    return Result(State.OK, f"{place}: {used}")


def _size(path: Path) -> int:
    try:
        return os.lstat(path).st_size
    except OSError:
        return 0


def _drawing() -> Result:
    said = ask("checker.doctor.drawing", b"", _LIMITS)
    if not isinstance(said, Died) and said != b"none":
        return Result(State.OK, f"pictures: MuJoCo draws with {said.decode()}")
    reason = f"the process that draws {said.reason}" if isinstance(said, Died) else "no OpenGL"
    packages = "libegl1, libopengl0 and libgl1-mesa-dri, or libosmesa6"
    advice = f"install EGL or OSMesa (Debian: {packages}) for reports with pictures"
    return Result(State.NOTE, f"pictures: {reason}", advice)


def _viewer() -> Result:
    if templates("report").joinpath("viewer.js").is_file():
        return Result(State.OK, "3D viewer for reports is built")
    advice = "reports show pictures instead"
    return Result(State.NOTE, "3D viewer for reports is not built", advice)
