"""An SDF file before the checker and before libsdformat: differences without a known reason."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from tests.oracle.checked import Checked, checked
from tests.oracle.known import READ_OTHERWISE, REFUSED_BY_THEM, REFUSED_BY_US, explained
from tests.oracle.libsdformat import Loaded
from tests.oracle.robots import EXACT, differences

OF_MERGED = 1e-5
"""libsdformat 12 writes the pose of a merged model with six digits, and reads it again."""


def unexplained(file: Path, theirs: Loaded) -> list[str]:
    """Return differences that are not among the known ones."""
    ours = checked(file)
    if ours.errors and not theirs.errors:
        return [
            f"only the checker refuses: {each}" for each in explained(ours.errors, REFUSED_BY_US)
        ]
    if theirs.errors and not ours.errors:
        reasons = explained([theirs.reason], REFUSED_BY_THEM)
        return [f"only libsdformat refuses: {each}" for each in reasons]
    return [] if theirs.errors else explained(_robots(ours, theirs), READ_OTHERWISE)


def _robots(ours: Checked, theirs: Loaded) -> Iterator[str]:
    loaded = {robot["name"]: robot for robot in theirs.robots}
    for name in ours.robots.keys() - loaded.keys():
        yield f"robots: ours {name!r}, theirs {sorted(loaded)}"
    if not ours.more and loaded.keys() - ours.robots.keys():
        yield f"robots: ours {sorted(ours.robots)}, theirs {sorted(loaded)}"
    tolerance = OF_MERGED if ours.merges else EXACT
    for name, robot in ours.robots.items():
        if name in loaded:
            yield from differences(robot, loaded[name], tolerance)
