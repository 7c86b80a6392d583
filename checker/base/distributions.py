"""Additions of other distributions to the checker, found by their entry points."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from functools import cache

from checker.base.errors import CheckerError
from checker.base.resources import metadata_folders


@cache
def additions() -> tuple[str, ...]:
    """Return the distributions that add something, with the entry points of each."""
    found = []
    for folder in metadata_folders():
        with suppress(OSError):
            text = (folder / "entry_points.txt").read_text("utf-8", "replace")
            if "[subt_check." in text:
                found.append(f"{folder.name} {text}")
    return tuple(sorted(found))


def load_entry_points(kind: str) -> Iterator[object]:
    """Yield what the entry points of a group name.

    Args:
        kind: What is added: `rules` for the group `subt_check.rules`.

    Raises:
        CheckerError: One cannot be loaded.
    """
    group = f"subt_check.{kind}"
    if not any(f"[{group}]" in text for text in additions()):
        return
    # Loaded where something is added: it takes as long as a small check.
    from importlib.metadata import entry_points

    for entry_point in entry_points(group=group):
        try:
            yield entry_point.load()
        except Exception as error:
            problem = f"the {kind} of {entry_point.value} cannot be loaded: {error}"
            raise CheckerError(problem) from error
