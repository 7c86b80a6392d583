"""The packages that changed files belong to: hooks are told files, and packages are checked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from os.path import abspath
from pathlib import Path

from checker.base.errors import UnreadableInput
from checker.package.kind import looks_like_package


def changed_packages(files: Iterable[Path], here: Path) -> list[Path]:
    """Return the packages of changed files, each once, in the order of the files.

    A file belongs to the outermost package around it within its repository: the nested model
    `parts/guard/model.sdf` is a part of the robot, not a package. Files outside packages are passed
    over; those that are gone count for the package that they were in.

    Args:
        files: Relative to `here`, or absolute.
        here: Where the command runs, links resolved.

    Returns:
        Folders, relative to `here` where they lie below it.

    Raises:
        UnreadableInput: A file is a folder, or a link to a package.
    """
    by_folder: dict[Path, Path | None] = {}
    for file in files:
        _refuse_folder(file, here)
        # A changed link is a file as well: it is not followed.
        folder = Path(abspath(here / file)).parent  # noqa: PTH100
        if folder not in by_folder:
            by_folder[folder] = _outermost(folder)
    found = dict.fromkeys(package for package in by_folder.values() if package is not None)
    return [each.relative_to(here) if each.is_relative_to(here) else each for each in found]


def _refuse_folder(file: Path, here: Path) -> None:
    """Refuse what asks for a check of packages by their folders; other links count as files."""
    place = here / file
    try:
        is_folder = place.is_dir() and (not place.is_symlink() or looks_like_package(place))
    except (OSError, ValueError):
        return
    if is_folder:
        raise UnreadableInput(file, "is a folder", "leave out --files to check folders")


def _outermost(folder: Path) -> Path | None:
    packages = [place for place in _within_repository(folder) if looks_like_package(place)]
    return packages[-1] if packages else None


def _within_repository(folder: Path) -> Iterator[Path]:
    """Yield a folder and those above it, up to the root of the repository if there is one."""
    for place in (folder, *folder.parents):
        yield place
        if _holds_repository(place):
            return


def _holds_repository(folder: Path) -> bool:
    try:
        return (folder / ".git").exists()
    except OSError:
        return False
