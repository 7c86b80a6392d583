"""A file that does not belong in a package.

Backups, caches, editor settings and CAD sources are uploaded and installed with the robot. With a
second model file, a reader does not know which of the two is the robot.

Fix: delete it; `.gitignore` keeps it out.
Source: common practice; the Model Migration Guide, step 7, shows the files of a package.
"""

import posixpath
from collections.abc import Iterator
from fnmatch import fnmatchcase

from checker.package.inheritance import Found
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

FILES = {
    **dict.fromkeys(("*~", "*.bak", "*.orig", "*.rej", "*(copy)*"), "a backup file"),
    **dict.fromkeys(("*.swp", "*.swo", "*.tmp"), "a temporary file of an editor"),
    **dict.fromkeys((".ds_store", "thumbs.db", "desktop.ini"), "a file of a file manager"),
    "*.pyc": "compiled Python",
    "cmakecache.txt": "what CMake writes in a build folder",
    **dict.fromkeys(("*.step", "*.stp", "*.iges", "*.igs"), "the source of a mesh, for CAD"),
    **dict.fromkeys(("*.sldprt", "*.sldasm", "*.f3d", "*.fcstd"), "the source of a mesh, for CAD"),
}
"""Kinds of files by their names in lower case; the guide's own `rover.orig.urdf` is not junk."""

FOLDERS = {
    **dict.fromkeys((".vscode", ".idea", ".vs"), "settings of an editor"),
    **dict.fromkeys(("__pycache__", ".pytest_cache"), "a cache of Python"),
    "__macosx": "what macOS adds to archives",
}


@rule("PKG011", "junk-file", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report files by their names, whole folders, and model files that nothing names."""
    reported: tuple[str, ...] = ()
    for path, entry in package.index.entries.items():
        if path.startswith(reported):
            continue
        name = posixpath.basename(path).lower()
        known = FOLDERS.get(name) if entry.is_folder else _file(name)
        if known is not None:
            reported += (f"{path}/",) if entry.is_folder else ()
            yield finding(package.place(path), f"{path} is {known}: delete it", key=known)
    if package.kind is not PackageKind.SINGLE_FILE:
        yield from _second_models(package)


def _file(name: str) -> str | None:
    return next((what for pattern, what in FILES.items() if fnmatchcase(name, pattern)), None)


def _second_models(package: Package) -> Iterator[Finding]:
    """Report SDF models at the top of the package next to the one that is loaded."""
    model = package.model_path
    if not isinstance(model, Found) or model.is_inherited:
        return
    for file in package.index.with_suffix(".sdf"):
        if "/" in file.path or file.path == model.path or "world" in file.path.lower():
            continue
        if file.path.casefold() not in package.mentioned_names:
            yield finding(
                package.place(file.path),
                f"{file.path} is a second model next to {model.path}, but nothing names it: "
                "delete it",
            )


GOOD = [{"urdf/rover.orig.urdf": "<robot name='rover'/>", "meshes/wheel.dae": "<COLLADA/>"}]
BAD = [
    {
        "launch/spawner.rb~": "",
        "meshes/Wheel.STEP": "",
        "@reported": ["launch/spawner.rb~:1", "meshes/Wheel.STEP:1"],
    },
    {".vscode/settings.json": "{}", "@reported": [".vscode:1"]},
    {"model_old.sdf": "<sdf version='1.6'/>", "@reported": ["model_old.sdf:1"]},
]
