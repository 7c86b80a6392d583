"""`--fix` and `--diff`: apply fixes or show them."""

from __future__ import annotations

import os
import posixpath
import tempfile
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from glob import escape
from pathlib import Path
from typing import Any

from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.base.errors import CheckerError, UnreadableInput
from checker.base.output import EXIT_CLEAN, EXIT_FINDINGS, say_progress, show, write
from checker.base.record import Record
from checker.base.words import and_list, count, plain
from checker.engine.review import findings_of
from checker.finding import Safety
from checker.fix.rounds import FindingsOf, Fixed, FixedFile, fix_package, patch
from checker.fix.uncommitted import uncommitted
from checker.package.inputs import open_input, with_package_path
from checker.package.package import Package
from checker.pipeline import Task
from checker.report.report import ReportedFinding
from checker.settings import Settings
from checker.source.text_file import NotText, decode, encode_like

# Writes fixed files: a whole file or nothing, never outside the package or through a link.


_SUFFIX = ".subt-check"


class NotWritten(CheckerError):
    """A fixed file could not be written."""


def write_files(package: Package, files: Iterable[FixedFile]) -> None:
    """Write files, each in one step.

    First all new contents are written next to the files, so that a full disk or a folder that
    cannot be written to leaves everything as it was; then each takes its file's place.

    Raises:
        NotWritten: A file is a link, is outside, changed meanwhile, or cannot be written.
    """
    prepared: list[tuple[Path, Path]] = []
    try:
        for file in files:
            target = _target(package, file)
            _tidy(target)
            prepared.append((_temporary_copy(target, _content(target, file)), target))
        while prepared:
            new, target = prepared[0]
            new.replace(target)
            prepared.pop(0)
            _sync_folder(target.parent)
    except OSError as error:
        raise NotWritten(
            f"{error.filename or package.name} cannot be written: {error.strerror}; no file is "
            "half written"
        ) from None
    finally:
        for new, _ in prepared:
            with suppress(OSError):
                new.unlink()


def _target(package: Package, file: FixedFile) -> Path:
    target = package.root / file.path
    if target.resolve() != target or not target.is_relative_to(package.root):
        raise NotWritten(
            f"{file.path} is reached through a link; the checker does not write through links"
        )
    return target


def _content(target: Path, file: FixedFile) -> bytes:
    """Return the new bytes of a file, made from those that are still there."""
    data = target.read_bytes()
    try:
        if decode(data) != file.before.text:
            raise NotWritten(f"{file.path} has changed since it was checked; run the command again")
        return encode_like(file.after, data)
    except (NotText, UnicodeError):
        raise NotWritten(f"{file.path} cannot be written in its own encoding") from None


def _tidy(target: Path) -> None:
    """Remove what a run left behind that was killed before it could."""
    for left in target.parent.glob(f".{escape(target.name)}.*{_SUFFIX}"):
        left.unlink()


def _temporary_copy(target: Path, content: bytes) -> Path:
    """Write the content into a new file in the same folder, with the same permissions."""
    number, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=_SUFFIX, dir=target.parent)
    new = Path(name)
    try:
        with os.fdopen(number, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        new.chmod(target.stat().st_mode & 0o7777)
    except OSError:
        new.unlink()
        raise
    return new


def _sync_folder(folder: Path) -> None:
    """Write the folder's new entry to the disk, where folders can be synchronised."""
    with suppress(OSError):
        number = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(number)
        finally:
            os.close(number)


# Fixes the packages that the user names: on disk, or only as a patch.


_NAMED = 8
"""Files that a message names."""
_ARCHIVES_STAY = "unpack it first; --diff shows what would change"


class FixedPackage(Record):
    """A package and the result of fixing it; `shown` is its path as the user would write it."""

    name: str
    shown: str
    fixed: Fixed


def fix_paths(
    paths: Sequence[Path],
    wishes: Mapping[str, Any],
    allowed: Collection[Safety],
    *,
    write: bool,
    dirty: bool = False,
    prove: bool = False,
) -> list[FixedPackage]:
    """Fix every package at the paths; files are written when all packages are fixed.

    Args:
        paths: What to fix.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        allowed: Fixes that may be made.
        write: Whether files are changed; else it is only found out what would change.
        dirty: Whether files may be changed that have changes which git does not know.
        prove: Whether a fix is kept only if no error is new after it, in the trial neither.

    Raises:
        UnreadableInput: There is nothing to fix at a path, or it is an archive; then nothing was
            written at any.
        NotWritten: A file cannot be written, or has uncommitted changes; in the latter case
            nothing was written.
        InvalidSettings: The settings name what does not exist.
    """
    for path in paths if write else ():
        _refuse_archives(path)
    tasks = [Task(path, wishes=wishes) for path in paths]
    found = [fixed for task in tasks for fixed in _fix_input(task, allowed, prove=prove)]
    if write and not dirty:
        _refuse_uncommitted(found)
    for package, fixed in found if write else ():
        write_files(package, fixed.fixed.files)
    return [fixed for _, fixed in found]


def _refuse_uncommitted(found: Sequence[tuple[Package, FixedPackage]]) -> None:
    """Raise where a fix would mix with changes that are not committed."""
    names = [
        posixpath.join(fixed.shown, path) if not package.only else fixed.shown
        for package, fixed in found
        for path in uncommitted(package.root, [file.path for file in fixed.fixed.files])
    ]
    if names:
        more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
        raise NotWritten(
            f"nothing is fixed, because {count(len(names), 'file')} to change "
            f"{'has' if len(names) == 1 else 'have'} uncommitted changes: "
            f"{', '.join(names[:_NAMED])}{more}; commit or stash them, or use --allow-dirty"
        )


def _refuse_archives(path: Path) -> None:
    """Raise for what cannot be fixed, before anything is."""
    with open_input(path) as opened:
        if path.is_file() and any(not package.only for package in opened.packages):
            raise UnreadableInput(path, "is an archive; archives are not changed", _ARCHIVES_STAY)


def _fix_input(
    task: Task, allowed: Collection[Safety], *, prove: bool
) -> Iterator[tuple[Package, FixedPackage]]:
    with open_input(task.path) as opened:
        for given in opened.packages:
            settings = task.settings_for(given)
            package = with_package_path(given, settings.package_path)
            # The trial corrects nothing, but it proves.
            judge = _judge(settings.with_overrides(trial=False, thorough=False))
            fixed = fix_package(package, judge, allowed, _judge(settings) if prove else None)
            yield package, FixedPackage(package.name, task.display_path_of(package), fixed)


def _judge(settings: Settings) -> FindingsOf:
    """Return how a package is checked between rounds."""
    cache = Cache(cache_folder()) if settings.cache else NO_CACHE
    return lambda package: findings_of(package, settings, cache)


def show_patch(
    paths: Sequence[Path],
    wishes: Mapping[str, Any],
    allowed: Collection[Safety],
    output: str = "",
    *,
    prove: bool = False,
) -> int:
    """Print what fixing would change, or write it to a file; return 1 when there is something."""
    packages = fix_paths(paths, wishes, allowed, write=False, prove=prove)
    text = "".join(patch(package.fixed.files, _folder(package, packages)) for package in packages)
    if output:
        write(Path(output), text)
    else:
        show(text)
    return EXIT_FINDINGS if text else EXIT_CLEAN


def _folder(package: FixedPackage, packages: Sequence[FixedPackage]) -> str:
    """Return a package's folder as seen from here: `git apply` finds its files from here.

    What is elsewhere is applied within the package, or within the folder of several.
    """
    shown = posixpath.normpath(Path(package.shown).as_posix())
    if shown == ".":
        return ""
    if shown.startswith(("/", "..")):
        return package.name if len(packages) > 1 else ""
    return shown


def apply_fixes(
    paths: Sequence[Path],
    wishes: Mapping[str, Any],
    allowed: Collection[Safety],
    *,
    dirty: bool = False,
    prove: bool = False,
) -> None:
    """Fix files, and state on the standard error what was done; the rest as in `fix_paths`."""
    for package in fix_paths(paths, wishes, allowed, write=True, dirty=dirty, prove=prove):
        for line in _summary(package):
            say_progress(f"{plain(package.shown)}: {line}")


def _summary(package: FixedPackage) -> Iterator[str]:
    fixed = package.fixed
    if fixed.findings:
        where = and_list([plain(file.path) for file in fixed.files])
        yield f"fixed {count(len(fixed.findings), 'finding')} in {where} ({_rules(fixed.findings)})"
    else:
        yield "nothing to fix"
    if fixed.left:
        yield f"could not fix {count(len(fixed.left), 'finding')} ({_rules(fixed.left)})"
    if fixed.unproven:
        findings, rules = count(len(fixed.unproven), "finding"), _rules(fixed.unproven)
        yield f"{findings} not fixed, because that would bring other errors ({rules})"
    if fixed.elsewhere:
        edits = [
            edit for reported in fixed.elsewhere if reported.fix for edit in reported.fix.edits
        ]
        files = sorted({plain(edit.place.file) for edit in edits})
        findings = count(len(fixed.elsewhere), "finding")
        yield f"{findings} to fix in {and_list(files)}: check the package that contains it"
    if fixed.withheld:
        findings = count(len(fixed.withheld), "finding")
        yield (
            f"{findings} not fixed, because the fix changes behaviour ({_rules(fixed.withheld)}): "
            "see --diff --unsafe"
        )


def _rules(findings: Sequence[ReportedFinding]) -> str:
    return ", ".join(sorted({finding.rule for finding in findings}))
