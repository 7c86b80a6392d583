"""Input that is no package, and advice what to pass instead."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Mapping
from itertools import islice
from pathlib import Path

from checker.base.record import Record
from checker.package.unchecked_models import unchecked_models

_FILES_LIMIT = 5_000
"""Files that are read, by their names."""
_SHOWN = 200
_OTHER_ARCHIVES = (".zip", ".tar.gz", ".tgz", ".tar", ".tar.xz", ".tar.bz2", ".7z", ".rar")
MESHES = (".stl", ".dae", ".obj", ".glb", ".gltf", ".ply")
_CAD = (".step", ".stp", ".iges", ".sldasm", ".sldprt", ".f3d", ".blend", ".fcstd", ".ipt", ".iam")
_OTHER_MODELS = (".wbt", ".proto")
CHECKED_FORMATS = "give the robot as URDF, xacro, SDF or MJCF"
_ADVICE: Mapping[tuple[str, ...], tuple[str, str]] = {
    _OTHER_ARCHIVES: (
        "an archive that is not read",
        "give the package in it, as a folder, .zip or .tar.gz",
    ),
    _OTHER_MODELS: (
        "a model for another simulator",
        f"{CHECKED_FORMATS}; other formats are not checked yet",
    ),
    MESHES: (
        "a mesh",
        "give the model that uses it, a .urdf, .xacro or .sdf file, best with its whole package",
    ),
    _CAD: ("a CAD file", "export the robot as URDF or SDF, and give that with its meshes"),
}
"""Kinds of files by the ends of their names, the kind that explains most first."""
WHAT_TO_GIVE = "give a package folder, a .zip or .tar.gz archive, or a model file"


class Instead(Record):
    """File or folder that was passed instead of a package.

    Attributes:
        kind: Its kind: `a mesh`.
        advice: What to pass, in the imperative.
        name: The name of the file.
    """

    kind: str
    advice: str
    name: str


def reason_not_checked(name: str) -> tuple[str, str]:
    """Return why a file that is neither archive nor model is not checked, and what to give."""
    if found_models := unchecked_models([name]):
        return found_models[0].removeprefix(f"{name} "), CHECKED_FORMATS
    found = _instead([name])
    if found is None:
        return "is not a package, archive or model file", WHAT_TO_GIVE
    return f"is {found.kind}, not a package, archive or model file", found.advice


def models_of(folder: Path, without: Collection[Path] = ()) -> str:
    """Return what the models are that a folder contains and no rule reads; empty without any.

    Args:
        folder: The folder.
        without: Folders in it that are left out.
    """
    files = islice(_files(folder, without), _FILES_LIMIT)
    paths = (path.relative_to(folder).as_posix() for path in files)
    return "; ".join(unchecked_models(paths))


def content_of(folder: Path) -> Instead | None:
    """Return what a folder without a package contains; None if its names do not show it."""
    return _instead([file.name for file in islice(_files(folder), _FILES_LIMIT)])


def _instead(names: list[str]) -> Instead | None:
    for endings, (kind, advice) in _ADVICE.items():
        for name in names:
            if name.lower().endswith(endings):
                return Instead(kind, advice, name[:_SHOWN])
    return None


def _files(folder: Path, without: Collection[Path] = ()) -> Iterator[Path]:
    """Yield the files, those of hidden folders left out."""
    for place, folders, files in os.walk(folder):
        folders[:] = [
            name
            for name in sorted(folders)
            if not name.startswith((".", "__MACOSX")) and Path(place, name) not in without
        ]
        yield from (Path(place, name) for name in sorted(files) if not name.startswith("."))
