"""Opening the input: a package, a folder of packages, an archive, or one model file."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from checker.base.errors import UnreadableInput
from checker.base.record import Record
from checker.base.words import Suggestions, count
from checker.package.formats import single_file_suffixes
from checker.package.kind import (
    enclosing_package,
    holds_loose_models,
    looks_like_package,
)
from checker.package.no_package import (
    CHECKED_FORMATS,
    WHAT_TO_GIVE,
    content_of,
    models_of,
    reason_not_checked,
)
from checker.package.package import Package
from checker.package.repository import MAX_FOLDERS, Unit, Units, homes_of, units_below
from checker.package.workspace import Workspace

if TYPE_CHECKING:
    from checker.package.archives.index import ArchiveLimits

ARCHIVE_SUFFIXES = (".zip", ".tar.gz", ".tgz")
SUBMISSIONS = "submitted_models"
# A file in a package may lie deep: `robots/NAME/urdf/NAME.urdf`.
FILE_LEVELS = 6
# Archives of a repository wrap everything in a folder, sometimes in two.
MAX_WRAPPERS = 3


class Skipped(Record):
    """A subfolder that was not read, and the reason."""

    name: str
    reason: str


class Opened(Record):
    """Packages of the user's input, ready to be checked.

    Attributes:
        workspace: The workspace in which siblings are looked up.
        packages: The requested packages, by name.
        skipped: Other subfolders that are no packages, or links.
    """

    workspace: Workspace
    packages: tuple[Package, ...]
    skipped: tuple[Skipped, ...] = ()


@contextmanager
def open_input(
    path: Path,
    *,
    name: str = "",
    limits: ArchiveLimits | None = None,
) -> Iterator[Opened]:
    """Open a package folder, a folder of packages, an archive or a single model file.

    An archive is unpacked into a private folder, which is removed at the end.

    Args:
        path: What the user gave.
        name: The file's name as the user knows it, when it is stored under another.
        limits: Limits for the content of an archive.

    Raises:
        UnreadableInput: There is no package in it, or it cannot be read.
    """
    real = _resolved(path)
    shown = name or path.name
    if real.is_dir():
        yield _open_folder(path, real)
    elif shown.lower().endswith(ARCHIVE_SUFFIXES):
        import tempfile

        with tempfile.TemporaryDirectory(prefix="subt-check-", ignore_cleanup_errors=True) as own:
            target = Path(own).resolve() / _archive_stem(shown)
            target.mkdir()
            _unpack(path, real, target, shown, limits)
            yield _open_folder(path, _unwrapped(target), target)
    elif real.is_file() and shown.lower().endswith(single_file_suffixes()):
        yield _open_single(path, real)
    else:
        raise UnreadableInput(path, *reason_not_checked(shown))


_ADDRESSES = ("http:", "https:", "ssh:", "git:", "git@")
_NAMES_LIMIT = 1000
"""Names beside a path that are compared with it."""


def _near(path: Path) -> str:
    """Return the advice about a path that does not exist."""
    if str(path).startswith(_ADDRESSES):
        return "nothing is fetched: `git clone` it first and check the folder"
    try:
        names = [entry.name for entry in islice(path.parent.iterdir(), _NAMES_LIMIT)]
    except OSError:
        names = []
    near = Suggestions(names).closest(path.name)
    return f"did you mean {path.with_name(near)}?" if near else "check the spelling"


def _resolved(path: Path) -> Path:
    try:
        real = path.resolve(strict=True)
        real.stat()
    except FileNotFoundError:
        raise UnreadableInput(path, "does not exist", _near(path)) from None
    except (OSError, RuntimeError, ValueError) as error:
        reason = f"cannot be opened: {getattr(error, 'strerror', None) or error}"
        raise UnreadableInput(path, reason, "check its permissions and links") from None
    return real


def _unpack(path: Path, real: Path, target: Path, shown: str, limits: ArchiveLimits | None) -> None:
    if not real.is_file():
        raise UnreadableInput(path, "is not a regular file", WHAT_TO_GIVE)
    from checker.package.archives.archive import unpack_archive

    try:
        unpack_archive(real, target, shown, limits)
    except UnreadableInput as error:
        error.path = path
        raise


def _archive_stem(shown: str) -> str:
    """Return the name of a package whose files are at the top of an archive."""
    lower = shown.lower()
    suffix = next(suffix for suffix in ARCHIVE_SUFFIXES if lower.endswith(suffix))
    stem = Path(shown[: -len(suffix)]).name
    usable = stem.isprintable() and stem.strip(". ") and len(stem.encode()) <= 255
    return stem if usable and "\\" not in stem else "package"


def _unwrapped(folder: Path) -> Path:
    """Go down through folders that contain only one folder, which is no package."""
    for _ in range(MAX_WRAPPERS):
        inner = _subfolders(folder)
        if looks_like_package(folder) or len(inner) != 1 or looks_like_package(inner[0]):
            break
        if holds_loose_models(folder) or holds_loose_models(inner[0]):
            break
        folder = inner[0]
    return folder


def _open_folder(path: Path, folder: Path, within: Path | None = None) -> Opened:
    try:
        if not any(folder.iterdir()):
            raise UnreadableInput(path, "is an empty folder", WHAT_TO_GIVE)
    except OSError as error:
        reason = f"cannot be listed: {error.strerror}"
        raise UnreadableInput(path, reason, "check its permissions") from None
    submissions = folder / SUBMISSIONS
    if not looks_like_package(folder) and any(map(looks_like_package, _subfolders(submissions))):
        return _open_folder(path, submissions, within)
    found = units_below(folder)
    if found.units:
        around = () if folder == found.units[0].folder else found.units
        skipped = (*(_skipped(folder, found) if around else ()), *_nested(folder, found))
        return _opened(found, folder, skipped, within)
    enclosing = enclosing_package(folder)
    advice = f"give the package folder {enclosing}" if enclosing else WHAT_TO_GIVE
    missing = "contains no package (no package.xml, model.config, model.sdf or launch/spawner.rb)"
    if found.built:
        what = found.built[0].relative_to(folder)
        missing = f"contains no package except what colcon built in {what.as_posix()}"
        advice = f"give the sources, or {path / what}"
    elif found.ignored:
        missing, advice = _ignored_packages(path, folder, found.ignored)
    elif models := models_of(folder):
        missing, advice = f"contains no package; {models}", CHECKED_FORMATS
    elif not enclosing and (instead := content_of(folder)) is not None:
        missing = f"contains no package, but {instead.kind} ({instead.name})"
        advice = instead.advice
    raise UnreadableInput(path, missing, advice)


def _ignored_packages(path: Path, folder: Path, marks: Sequence[Path]) -> tuple[str, str]:
    """Return what is there instead of packages, and what to do, if marks exclude the others."""
    below = {mark: units_below(mark.parent).units for mark in marks}
    mark = next((mark for mark, units in below.items() if units), marks[0])
    number, where = count(len(below[mark]), "package"), mark.relative_to(folder)
    missing = f"contains no package except {number} that {where.as_posix()} excludes"
    return missing, f"give {path / where.parent}"


def _opened(
    found: Units, folder: Path, skipped: tuple[Skipped, ...], within: Path | None
) -> Opened:
    """Open units; those with one home share a workspace, in which the nearest sibling counts."""
    if not found.complete:
        reason = f"contains more than {MAX_FOLDERS} folders; the rest is not searched"
        skipped = (*skipped, Skipped("", reason))
    beside = (*found.units, *_siblings(folder, within))
    # Once for all packages, however many there are.
    built = {unit.folder: found.built for unit in found.units if found.built and not unit.only}
    built = dict(islice(built.items(), 1))
    spaces: dict[Path, Workspace] = {}
    packages = []
    for unit in found.units:
        if unit.home not in spaces:
            spaces[unit.home] = Workspace(
                homes_of(beside, unit.folder), within, given=folder, built=built
            )
        space = spaces[unit.home]
        whole = space.at(unit.folder) if not unit.only else None
        packages.append(whole or Package(unit.folder, space, only=unit.only))
    return Opened(next(iter(spaces.values())), tuple(packages), skipped)


def _siblings(folder: Path, within: Path | None) -> tuple[Unit, ...]:
    """Return what the package around a model folder or a file contains: its models' siblings."""
    enclosing = enclosing_package(folder.parent, FILE_LEVELS)
    if enclosing is None or (within is not None and not enclosing.is_relative_to(within)):
        return ()
    return units_below(enclosing).units


def _skipped(folder: Path, found: Units) -> Iterator[Skipped]:
    """Yield the subfolders of a folder of packages that contain none, and models beside these."""
    seen = {unit.folder for unit in found.units if not unit.only}
    seen.update((*found.built, *(mark.parent for mark in found.ignored)))
    for place in sorted(folder.iterdir()):
        if place.name.startswith(".") or place.name == "__MACOSX" or not _is_folder(place):
            continue
        if place.is_symlink():
            yield Skipped(place.name, "is a link; give the folder to which it leads")
        elif not os.access(place, os.R_OK | os.X_OK):
            yield Skipped(place.name, "cannot be read: permission denied")
        elif not any(unit.folder.is_relative_to(place) for unit in found.units):
            marks = [mark.name for mark in found.ignored if mark.is_relative_to(place)]
            is_built = place in found.built
            why = f"is excluded by {marks[0]}" if marks else "contains no package"
            why = "is what colcon built" if is_built else why
            models = "" if marks or is_built else models_of(place)
            seen.add(place)
            yield Skipped(place.name, f"{why}; {models}" if models else why)
    if models := models_of(folder, seen):
        yield Skipped("", f"contains models outside its packages: {models}")


def _nested(folder: Path, found: Units) -> Iterator[Skipped]:
    """Yield the packages in other packages."""
    for place, around in found.nested:
        home = around.name if around == folder else around.relative_to(folder).as_posix()
        why = f"is inside package {home}, where colcon and catkin look for no other package"
        yield Skipped(place.relative_to(folder).as_posix(), why)


def _open_single(path: Path, file: Path) -> Opened:
    if not os.access(file, os.R_OK):
        raise UnreadableInput(path, "cannot be read: permission denied", "check its permissions")
    beside = _siblings(file, None)
    workspace = Workspace(homes_of(beside, file.parent))
    return Opened(workspace, (Package(file.parent, workspace, only=file.name),))


def with_package_path(package: Package, folders: Sequence[Path]) -> Package:
    """Return a package that also finds the packages in further folders.

    Args:
        package: The package as it was opened.
        folders: Each contains packages, or is one.

    Raises:
        UnreadableInput: One of them is no folder.
    """
    known = package.workspace.directories
    homes = tuple(home for home in dict.fromkeys(map(_home, folders)) if home not in known)
    if not homes:
        return package
    space = package.workspace
    wider = Workspace((*known, *homes), space.within, given=space.given, built=space.built)
    return Package(package.root, wider, package.only)


def _home(folder: Path) -> Path:
    real = _resolved(folder)
    if not real.is_dir():
        raise UnreadableInput(folder, "is not a folder", "give a folder of packages, or a package")
    return real.parent if looks_like_package(real) else real


def _is_folder(place: Path) -> bool:
    try:
        return place.is_dir()
    except (OSError, RuntimeError):
        return False


def _subfolders(folder: Path) -> list[Path]:
    """Return the plain subfolders that may contain packages, sorted."""
    try:
        return sorted(
            place
            for place in folder.iterdir()
            if not place.name.startswith(".")
            and place.name != "__MACOSX"
            and not place.is_symlink()
            and _is_folder(place)
        )
    except OSError:
        return []
