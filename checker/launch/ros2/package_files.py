"""Files of the available packages, by the paths that launch files give them."""

from __future__ import annotations

import posixpath
import re

from checker.base.files import NotReadable
from checker.formats.xacro.files import ROOT, local_path
from checker.launch.ros2.graph import SharePath, is_known, share_path
from checker.package.installed import installed_as, source_of
from checker.package.package import Package
from checker.source.text import SourceText

PYTHON_ENTRY = re.compile(r"^def generate_launch_description\b", re.MULTILINE)


def is_python_launch(source: SourceText) -> bool:
    """Return whether a launch file is in Python; `ros2 launch` reads one named `.launch`, too.

    It gives such a file to its reader of XML first, and where this fails, to that of Python.
    """
    path = source.file.lower()
    named = path.endswith(".launch") and PYTHON_ENTRY.search(source.text) is not None
    return path.endswith(".py") or named


def local_file(package: Package, path: str) -> str | None:
    """Return a path below a share folder as the package lists it; None if it is not available."""
    target = share_path(path)
    if target is None:
        return None
    if package.named(target.package) is package:
        path = posixpath.normpath(f"{ROOT}/{package.root.name}/{target.path}")
    local = local_path(package, path)
    return local if local is not None and package.exists(local) else None


def read_file(package: Package, path: str) -> SourceText | str:
    """Return the text of a file below a share folder, or why it cannot be had."""
    target = share_path(path)
    if target is None:
        return "which file is read is not known before the launch"
    local = local_file(package, path)
    if local is None:
        if package.named(target.package) is None:
            return f"package {target.package} is not found"
        return f"{target} does not exist"
    source = package.read(local)
    return f"{local} {source.reason}" if isinstance(source, NotReadable) else source


def exists(package: Package, path: str) -> bool | None:
    """Return whether there is a file or folder at a path; None if unknown."""
    target = share_path(path)
    if target is None or not is_known(path) or package.named(target.package) is None:
        return None
    return local_file(package, path) is not None


def installed_path(package: Package, file: str) -> str:
    """Return the path of a file where it is installed.

    Args:
        package: The package being checked.
        file: The file as the package lists it.
    """
    holder, rest = package, file
    if file.startswith("../"):
        name, _, rest = file.removeprefix("../").partition("/")
        holder = package.workspace.package(name) or package
    return f"{ROOT}/{holder.declared_name}/{installed_as(holder, rest) or rest}"


def installs(package: Package, target: SharePath) -> bool:
    """Return whether a package installs what is at a path of its share folder."""
    return source_of(package, target.path) is not None


def launch_file(package: Package, name: str, file: str) -> str:
    """Return the path of the launch file that `ros2 launch` finds in a package by its name.

    Args:
        package: The package being checked.
        name: The package that has the file.
        file: The name of the file; it may be in any folder.
    """
    holder, path = package.named(name), f"launch/{file}"
    if holder is not None and (found := holder.index.ending(file)):
        path = installed_as(holder, found[0]) or found[0]
    return f"{ROOT}/{name}/{path}"
