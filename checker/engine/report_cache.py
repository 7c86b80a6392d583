"""Remembers reports: a package that did not change is not checked again.

The inputs of a report are hashed: the program, the settings, the package's content, README and
.gitignore above it, and which files are in the sibling packages (by size and time of change).
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import stat
from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Any

import msgspec
from msgspec.structs import replace

from checker.base.cache import Cache, code_hash, key_of
from checker.base.distributions import additions
from checker.base.extras import PHYSICS
from checker.base.resources import OWN_CODE, version_of
from checker.package.files_above import files_above
from checker.package.kind import looks_like_package
from checker.package.package import Package
from checker.package.references import PROVIDED
from checker.package.walk import SKIPPED_FOLDERS
from checker.report.report import PackageReport
from checker.settings import Settings
from checker.source.xml import elements_limit


def from_stored(members: Any, path: str) -> PackageReport:
    """Return the report that was stored as `msgspec.to_builtins` has it.

    Args:
        members: What the cache holds.
        path: The path of the package, as the user gives it this time.

    Raises:
        ValidationError: It is no stored report.
    """
    stored: PackageReport = msgspec.convert(members, PackageReport)
    return replace(stored, path=path)


KIND = "report"
_LIBRARIES = (
    *("fast-simplification", "lxml", "markdown-it-py", "mujoco", "numpy", "pillow", "pin"),
    *("pycollada", "pyelftools", "pyyaml", "scipy", "subt-check", "tree-sitter"),
    *("tree-sitter-ruby", "xacro", "yourdfpy"),
)
_AROUND = re.compile(r"/(?:(?:readme|licen[cs]e|copying)(?:\.\w{1,8})?|\.gitignore)\Z")
ENTRIES_LIMIT = 100_000
"""Files next to a package; with more of them, reading all takes longer than checking."""
ENTRIES_AROUND_A_FILE = 5_000
"""Files in the folder of a lone file and below: it may name any of them."""


def memory_key(package: Package, settings: Settings) -> str:
    """Return the key of a package's report; empty if it is not worth remembering."""
    resolved = replace(settings.for_package(package), commanded=())
    options = json.dumps(msgspec.to_builtins(resolved, enc_hook=str))
    parts: list[bytes | str] = [*program_parts(), options]
    parts += [str(package.root), str(package.workspace.given)]
    parts += map(str, package.workspace.built.get(package.root, ()))
    parts += [text.text for texts in files_above(package, _AROUND) for text in texts]
    parts += _content(package)
    limit = ENTRIES_AROUND_A_FILE if package.only else ENTRIES_LIMIT
    beside = list(islice(_beside(package), limit))
    return key_of(*parts, *beside) if len(beside) < limit else ""


def program_parts() -> list[str]:
    """Return what every report depends on, whatever is checked: the program, libraries, rules."""
    physics = f"physics {PHYSICS.is_installed}, {elements_limit()} elements"
    libraries = map(version_of, _LIBRARIES)
    return [code_hash(*OWN_CODE), physics, *libraries, *additions()]


def recall_report(cache: Cache, key: str, shown: str) -> PackageReport | None:
    """Return the report that was remembered under a key; None if there is none."""
    data = cache.get(KIND, key) if key else None
    if data is None:
        return None
    try:
        return from_stored(data, shown)
    except (KeyError, TypeError, ValueError):
        return None


def remember(cache: Cache, key: str, report: PackageReport) -> None:
    """Keep a report, unless it may be another the next time.

    It may where a process or the system failed, a rule crashed or nothing could be drawn. A sibling
    that was not found is no reason: the key holds which files are next to the package.
    """
    undrawn = report.display is not None and not report.display.pictures
    lasts = cache.is_whole and not report.crashed and not report.disturbed
    if key and lasts and not undrawn:
        cache.put(KIND, key, msgspec.to_builtins(report, enc_hook=str))


def _content(package: Package) -> Iterator[bytes | str]:
    for entry in package.index.entries.values():
        yield f"{entry.path} {entry.kind} {entry.target} {entry.target_state}"
        if entry.is_file:
            with suppress(OSError), entry.location.open("rb") as file:
                yield hashlib.file_digest(file, "sha256").digest()


def _beside(package: Package) -> Iterator[str]:
    """Yield what can be seen of the other packages without opening their files."""
    if package.only:
        yield from _below(package.root)
    for directory in package.workspace.directories:
        for folder in _folders(directory):
            yield str(folder)
            # A loose folder of models may use what is in any folder beside it.
            if folder != package.root and (package.is_loose or looks_like_package(folder)):
                yield from _below(folder)
    for other in map(package.workspace.package, sorted(PROVIDED)):
        if other is not None and other.root.parent not in package.workspace.directories:
            yield from _below(other.root)


def _folders(directory: Path) -> list[Path]:
    try:
        return sorted(Path(item.path) for item in os.scandir(directory) if item.is_dir())
    except OSError:
        return []


def _below(folder: Path) -> Iterator[str]:
    waiting = [folder]
    while waiting:
        with suppress(OSError), os.scandir(waiting.pop()) as items:
            for item in sorted(items, key=lambda item: item.name):
                status = item.stat(follow_symlinks=item.is_symlink() and item.is_file())
                yield f"{item.path} {status.st_mode} {status.st_size} {status.st_mtime_ns}"
                if stat.S_ISDIR(status.st_mode) and item.name not in SKIPPED_FOLDERS:
                    waiting.append(Path(item.path))
