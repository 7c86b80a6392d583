"""Folders that colcon made are in the repository.

`build`, `install` and `log` hold copies of the packages, with paths and links of the machine that
built them: another one cannot use them, and they differ from the sources after the next change.
They are not checked.

They are reported once, for the first package, where a `.git`, `.gitignore` or README beside or
above them shows a repository and no `.gitignore` excludes them.

Fix: `git rm -r --cached` them, and write their names into `.gitignore`.
Source: colcon documentation, "Quick start": `build`, `install` and `log` are made by each build.
"""

import os
from pathlib import Path

from checker.package.git_ignored import ignored_by
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

_OF_REPOSITORIES = (".git", ".gitignore", "README.md", "README.rst", "README.txt", "README")


@rule("PKG029", "build-products-committed", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report the folders in what the user gave, for the first of its packages."""
    given = package.workspace.given
    if given is None:
        return
    for folder in package.workspace.built.get(package.root, ()):
        if _is_kept(package, folder, given):
            path = folder.relative_to(given).as_posix()
            yield finding(
                package.place(_path(package, folder)),
                f"{path} is what colcon built, in the repository, and another machine cannot use "
                f"it: run git rm -r --cached {path}, and write {folder.name}/ into .gitignore",
                key="built",
            )


def _is_kept(package: Package, folder: Path, given: Path) -> bool:
    """Return whether a folder is in a repository, and no .gitignore excludes it."""
    above = [it for it in folder.parents if it.is_relative_to(given)]
    is_in = any((it / name).exists() for it in above for name in _OF_REPOSITORIES)
    return is_in and not ignored_by(package, f"{_path(package, folder)}/file")


def _path(package: Package, folder: Path) -> str:
    return Path(os.path.relpath(folder, package.root)).as_posix()


_INSTALLED = "install/acme_arm/share/colcon-core/packages/acme_arm"
GOOD = [
    {"@ros2": True, _INSTALLED: ""},
    {"@ros2": True, _INSTALLED: "", ".gitignore": "*.o\n/build\n/install\n/log\n"},
    {"@ros2": True, "install/README.md": "", "README.md": ""},
]
BAD = [
    {"@ros2": True, _INSTALLED: "", ".gitignore": "*.o\n", "@reported": ["install:1"]},
    {"@ros2": True, "build/a/colcon_build.rc": "0", "README.md": "", "@reported": ["build:1"]},
    {"@ros2": True, "log/COLCON_IGNORE": "", "README.md": "", "@reported": ["log:1"]},
]
