"""What fixing changes, as a patch that `git apply` and `patch -p1` understand."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from difflib import unified_diff

from checker.patching.rounds import FixedFile
from checker.report.wording import plain

_NO_NEWLINE = "\\ No newline at end of file\n"


def patch(files: Iterable[FixedFile], folder: str = "") -> str:
    """Return the changes as a unified diff.

    Args:
        files: What changes; those whose names would break the patch are left out.
        folder: What to put in front of the paths, such as the package's name.
    """
    named = (file for file in files if plain(file.path) == file.path)
    return "".join(line for file in named for line in _diff(file, folder))


def _diff(file: FixedFile, folder: str) -> Iterator[str]:
    path = f"{folder}/{file.path}" if folder else file.path
    before = _lines(file.before.text)
    after = _lines(file.after)
    for line in unified_diff(before, after, f"a/{path}", f"b/{path}"):
        yield line if line.endswith("\n") else f"{line}\n{_NO_NEWLINE}"


def _lines(text: str) -> list[str]:
    # Not splitlines(): a form feed or a lone carriage return ends no line for patch.
    lines = text.split("\n")
    return [f"{line}\n" for line in lines[:-1]] + [line for line in lines[-1:] if line]
