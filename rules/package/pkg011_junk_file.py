"""A file that does not belong in a package.

Backups, caches, editor settings, folders that colcon built and CAD sources are uploaded and
installed with the robot. With a second model file, it is not clear which of the two is the robot. A
CMakeLists.txt or package.xml in a subfolder builds nothing unless a CMakeLists.txt adds the folder:
catkin does not search for packages within a package.

Fix: delete it, and add it to `.gitignore`.
Source: common practice; the Model Migration Guide, step 7, shows the files of a package.
"""

import posixpath
import re
from collections.abc import Iterator
from fnmatch import fnmatchcase

from checker.package.inheritance import Found
from checker.package.kind import BUILT
from checker.package.package import Package
from checker.package.target import names_mentioned_around
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.cmake import read_cmake
from checker.source.text import SourceText

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

BUILD_FILES = ("CMakeLists.txt", "package.xml")
_ADDING = ("add_subdirectory", "subdirs", "externalproject_add", "fetchcontent_declare")
_RUNNING = ("add_custom_command", "add_custom_target", "execute_process")
_HERE = re.compile(r"\$\{(?:CMAKE_(?:CURRENT_)?|PROJECT_)(?:SOURCE|LIST)_DIR\}/?")


@rule("PKG011", "junk-file", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report files by their names, whole folders, and model files that nothing names."""
    reported: tuple[str, ...] = ()
    for path, entry in package.index.entries.items():
        if path.startswith(reported):
            continue
        name = posixpath.basename(path).lower()
        known = _folder(package, path, name) if entry.is_folder else _file(name)
        if known is not None:
            reported += (f"{path}/",) if entry.is_folder else ()
            message = f"{path} is {known}: delete it"
            yield finding(package.place(path), message, key=known, covered_by=("PKG029",))
    if not package.only:
        yield from _second_models(package)
        yield from _build_files(package)


def _folder(package: Package, path: str, name: str) -> str | None:
    if name in BUILT and package.exists(f"{path}/COLCON_IGNORE"):
        return "what colcon built, and is not checked"
    return FOLDERS.get(name)


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
        if file.path.casefold() not in names_mentioned_around(package):
            yield finding(
                package.place(file.path),
                f"{file.path} is a second model next to {model.path}, but no file refers to it: "
                "delete it",
            )


def _build_files(package: Package) -> Iterator[Finding]:
    """Report build files in subfolders that no CMakeLists.txt of the package adds."""
    if not all(package.exists(name) for name in BUILD_FILES):
        return
    below = [file.path for file in package.index.files if "/" in file.path]
    dead = [path for path in below if posixpath.basename(path) in BUILD_FILES]
    if not dead:
        return
    added = set(_added_folders(package))
    for path in dead:
        folder = posixpath.dirname(path)
        if None not in added and folder not in added:
            message = f"{path} builds nothing, since no CMakeLists.txt adds {folder}: delete it"
            yield finding(package.place(path), message, key=f"build files of {folder}")


def _added_folders(package: Package) -> Iterator[str | None]:
    """Yield the folders that CMake files add or build; None for one that they compute."""
    for file in package.index.with_suffix("cmakelists.txt", ".cmake"):
        source = package.read(file.path)
        if not isinstance(source, SourceText):
            yield None
            continue
        for call in read_cmake(source).calls_of(*_ADDING, *_RUNNING):
            for word in call.arguments:
                written = _HERE.sub("", word.value)
                if "$" not in written:
                    above = posixpath.dirname(file.path)
                    yield from (posixpath.normpath(f"{at}/{written}") for at in (above or ".", "."))
                elif call.name in _ADDING:
                    yield None


_ROOT = "project(acme_rover_sensor_config_1)\n"
_PLUGIN = {"plugin/CMakeLists.txt": "project(plugin)\nadd_library(plugin p.cc)\n"}

GOOD = [
    {"urdf/rover.orig.urdf": "<robot name='rover'/>", "meshes/wheel.dae": "<COLLADA/>"},
    {"CMakeLists.txt": f"{_ROOT}add_subdirectory(plugin)\n", **_PLUGIN},
    {"CMakeLists.txt": f"{_ROOT}add_subdirectory(${{PROJECT_SOURCE_DIR}}/plugin)\n", **_PLUGIN},
]
BAD = [
    {
        "launch/spawner.rb~": "",
        "meshes/Wheel.STEP": "",
        "@reported": ["launch/spawner.rb~:1", "meshes/Wheel.STEP:1"],
    },
    {".vscode/settings.json": "{}", "@reported": [".vscode:1"]},
    {
        "install/COLCON_IGNORE": "",
        "install/launch/spawner.rb~": "",
        "@links": {"install/package.xml": "/home/me/acme/package.xml"},
        "@reported": ["install:1"],
    },
    {"model_old.sdf": "<sdf version='1.6'/>", "@reported": ["model_old.sdf:1"]},
    {"CMakeLists.txt": _ROOT, **_PLUGIN, "@reported": ["plugin/CMakeLists.txt:1"]},
    {"launch/package.xml": "<package/>", "@reported": ["launch/package.xml:1"]},
]
