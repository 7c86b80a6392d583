"""Target of the URI of a mesh, texture or model among the available packages."""

from __future__ import annotations

import posixpath
import re
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.package.fuel import is_on_fuel, path_from_fuel
from checker.package.installed import source_of
from checker.package.resource_path import searched_folders
from checker.package.target import package_around

if TYPE_CHECKING:
    from checker.package.package import Package

_SCHEME = re.compile(r"(?:model://|package:///?)([^/]+)/?(.*)", re.DOTALL)
"""Pinocchio reads `package:///` as `package://`; URD002 reports that others do not."""
_RELATIVE_FILE = re.compile(r"file://([^/].*)", re.DOTALL)
"""A path on the resource path of Gazebo, which may contain the folder of the model."""
_ON_DRIVE = re.compile(r"(?:file:/{2,3})?[A-Za-z]:[/\\\\]+(.*)", re.DOTALL)
_AT_HOME = re.compile(
    r"(?:file://)?/(?:(?:home|Users|media|run/media)/[^/]+|root|mnt)/(.*)", re.DOTALL
)
_HOME = r"(?:~|\$HOME|\$\(env HOME\))"
_BELOW_HOME = re.compile(rf"{_HOME}/(.*)", re.DOTALL)
"""A path in the home of the user who starts the launch file."""
_IN_WORKSPACE = re.compile(
    rf"(?:file://|{_HOME})?/(?!opt/ros/)(?:.*/)?(?:src|install|devel)/.*", re.DOTALL
)
_INSTALLED = re.compile(
    r"(?:file://)?/(?:.*/)?(?:install(?:/[^/]+)?|devel|opt/ros/\w+)/share/([^/]+)/(.+)", re.DOTALL
)
"""A path in the folder into which colcon or catkin installs packages, or in that of ROS."""
_PLACEHOLDER = re.compile(
    r"(?:file://)?/((?:full/|absolute/)?path[/_]to[/_].*|your[/_].*)", re.DOTALL
)
"""A path of a template that nobody replaced: `/path/to/your/arm.urdf`."""
_ELSEWHERE = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:|/")


_MODEL = "model://"
_LONGEST = 1_000
"""Characters of a path; systems have 4,096 at most."""


class Unknown(Record):
    """The target of a URI is unknown; the reason continues a sentence about it.

    Attributes:
        reason: The reason, such as `is in arm_description, which is not available`.
        package: The package; empty if none is named.
    """

    reason: str
    package: str = ""


def path_behind(package: Package, folder: str, uri: str) -> str | Unknown:
    """Return the path that a URI leads to, from a package; nothing need be there.

    A path below an installed package is that of the file in the source which is installed there,
    also where it names the folder of the installation. A path on its author's machine is that of
    the same file in the package, if it has one. So is a path below a folder that Gazebo may search.
    A model that lacks the file may be another one of that name.

    Args:
        package: The package whose file states it.
        folder: The folder of that file, relative to the package.
        uri: The URI as written.
    """
    if named := _SCHEME.match(uri) or _INSTALLED.fullmatch(uri):
        inside = _in_package(package, *named.groups())
        if isinstance(inside, Unknown):
            below = below_searched_folder(package, uri)
        else:
            below = None if package.exists(inside) else _in_namesake(package, uri)
        return inside if below is None else _from(package, *below)
    if is_on_fuel(uri):
        on_fuel = path_from_fuel(package, uri)
        return on_fuel or Unknown("is on Fuel, in a model that is not available")
    if (on_path := _RELATIVE_FILE.match(uri)) and (found := _on_path(package, folder, on_path[1])):
        return found
    if _ELSEWHERE.match(uri) or not uri:
        on_drive = _ON_DRIVE.fullmatch(uri)
        where = "on a drive of another machine" if on_drive else "outside the workspace"
        return own_path_on_machine(package, uri) or Unknown(f"is {where}")
    path = posixpath.normpath(posixpath.join(folder, uri))
    sibling = path.split("/")[1] if path.startswith("../") else ""
    is_known = sibling in ("", package.root.name) or package.workspace.package(sibling)
    return path if is_known or package.exists(path) else _absent(sibling)


def _on_path(package: Package, folder: str, path: str) -> str:
    """Return where a path is on a resource path around the package, or beside the file; else empty.

    The resource path may be that of the package, or contain the folder of the model.
    """
    in_model = f"/{path}".partition(f"/{package.root.name}/")[2]
    places = filter(None, (posixpath.join(folder, path), path, in_model))
    return next((it for it in map(posixpath.normpath, places) if package.exists(it)), "")


def own_path_on_machine(package: Package, uri: str) -> str:
    """Return the path in the package that ends a path on its author's machine; empty without one.

    That is a path on a drive of Windows, `D:/work/arm/a.stl`, in a home, `/home/me/arm/a.stl` or
    `~/arm/a.stl`, or a placeholder, `/path/to/arm/a.stl`.
    A path in the folder of an installation names its package, which may be another one.
    """
    installed = _INSTALLED.fullmatch(uri)
    if installed and installed[1] not in (package.name, package.declared_name):
        return ""
    forms = (_ON_DRIVE, _AT_HOME, _BELOW_HOME, _PLACEHOLDER)
    on_machine = next(filter(None, (form.fullmatch(uri) for form in forms)), None)
    path = on_machine[1].replace("\\", "/") if on_machine else ""
    while path and not package.exists(path):
        path = path.partition("/")[2]
    return path


def uri_of_machine(package: Package, path: str) -> str:
    """Return the `package://` of a path on its author's machine that names the file's package.

    Empty if none of the packages that are available has it.
    """
    folders = path[:_LONGEST].split("/")
    for number, name in enumerate(folders):
        holder, inside = package.named(name), "/".join(folders[number + 1 :])
        if holder is not None and inside and holder.exists(inside):
            return f"package://{name}/{inside}"
    return ""


def is_on_one_machine(path: str) -> bool:
    """Return whether a path or URI is in a home, on a drive of Windows, or in a built workspace."""
    text = path.strip()
    return any(it.fullmatch(text) for it in (_ON_DRIVE, _AT_HOME, _IN_WORKSPACE))


def is_below_home(path: str) -> bool:
    """Return whether a path is in the home of the user who starts the launch file."""
    return _BELOW_HOME.fullmatch(path.strip()) is not None


def is_placeholder(path: str) -> bool:
    """Return whether a path or URI is that of a template which has to be replaced."""
    return _PLACEHOLDER.fullmatch(path.strip()) is not None


def uri_of_installed(uri: str) -> str:
    """Return the `package://` of a path in the folder of an installation; empty for any other."""
    found = _INSTALLED.fullmatch(uri)
    return f"package://{found[1]}/{found[2]}" if found else ""


def _in_package(package: Package, name: str, path: str) -> str | Unknown:
    """Return a path in a named package or model."""
    # Models on Fuel bear the package's name in upper case.
    own = name.casefold() == package.name.casefold()
    holder = package if own else package.named(name)
    if holder is None:
        return _absent(name)
    inside = path if holder.exists(path or ".") else source_of(holder, path) or path
    return posixpath.normpath(inside if holder is package else f"../{holder.name}/{inside}")


def below_searched_folder(package: Package, uri: str) -> tuple[Package, str] | None:
    """Return the package and the file of a `model://` that names neither a package nor a model.

    `model://meshes/arm.stl` is `models/meshes/arm.stl` where Gazebo searches the folder `models`.
    None if the package of ROS around has no such file, or several.

    Args:
        package: The package whose file states it.
        uri: The URI as written.
    """
    end = uri.removeprefix(_MODEL)
    name, _, path = end.partition("/")
    around = package_around(package) or package
    if end == uri or not path or package.named(name) or not around.exists("package.xml"):
        return None
    found = [*around.index.ending(end), *([end] if around.exists(end) else [])]
    return (around, found[0]) if len(found) == 1 else None


def _in_namesake(package: Package, uri: str) -> tuple[Package, str] | None:
    """Return the package and the file of a `model://` whose model is in another folder of the name.

    A folder that the package around adds to Gazebo's search path comes first.
    """
    end = uri.removeprefix(_MODEL)
    around = package_around(package) or package
    if end == uri or "/" not in end or not around.exists("package.xml"):
        return None
    searched = {
        posixpath.join(it.folder, end)
        for classic in (True, False)
        for it in searched_folders(around, classic=classic)
        if it.folder is not None
    }
    found = sorted(
        around.index.ending(end), key=lambda it: f"{around.declared_name}/{it}" not in searched
    )
    return (around, found[0]) if found else None


def _from(package: Package, around: Package, path: str) -> str:
    """Return a path in the package around another one as that one lists it."""
    if around is package:
        return path
    file = around.root / path
    inside = not package.only and file.is_relative_to(package.root)
    return file.relative_to(package.root).as_posix() if inside else f"../{around.name}/{path}"


def _absent(name: str) -> Unknown:
    return Unknown(f"is in {name}, which is not available", name)
