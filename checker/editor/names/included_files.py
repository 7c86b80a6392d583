"""Files that share names: those that include each other, and the robot that they describe."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.editor.names.mention import FileNames, Included
from checker.editor.names.readers.expressions import is_composed
from checker.formats.xacro.files import ROOT, local_path, path_of
from checker.package.inheritance import Found
from checker.package.model_file import own_model
from checker.package.package import Package
from checker.package.uris import Unknown, path_behind

_FIND = re.compile(r"\$\(find\s{1,8}([\w.-]{1,200})\s{0,8}\)")
_COMPUTED = re.compile(r"\$[{(]|[*?\[]")


def included_path(package: Package, path: str, included: Included) -> str | None:
    """Return the path of an included file; None if it is not known or not available.

    Args:
        package: The package being checked.
        path: The path of the file that includes.
        included: What it includes.
    """
    if included.by_xacro:
        spelled = _FIND.sub(lambda match: f"{ROOT}/{match[1]}", included.uri)
        if is_computed(included) or not spelled:
            return None
        folder = posixpath.dirname(path_of(package, path))
        return local_path(package, posixpath.normpath(posixpath.join(folder, spelled)))
    folder = posixpath.dirname(path)
    uri = included.uri if "://" in included.uri else f"model://{included.uri}"
    beside = posixpath.normpath(posixpath.join(folder, included.uri))
    if "://" not in included.uri and package.exists(beside):
        return _model_at(package, beside)
    found = path_behind(package, folder, uri)
    return _model_named(package, uri) if isinstance(found, Unknown) else _model_at(package, found)


def is_computed(included: Included) -> bool:
    """Return whether the name of the included file is an expression."""
    return _COMPUTED.search(_FIND.sub("", included.uri)) is not None


def _model_at(package: Package, path: str) -> str | None:
    """Return the model file at a path, which may be the folder of a model or package."""
    path = posixpath.normpath(path)
    if path == ".":
        return own_model(package)
    if path.startswith("../") and path.count("/") == 1:
        sibling = package.workspace.package(path.removeprefix("../"))
        model = own_model(sibling) if sibling is not None else None
        return f"{path}/{model}" if model is not None else None
    entry = package.resolve(path)
    if entry is None:
        return None
    if entry.is_folder:
        return f"{path}/model.sdf" if package.exists(f"{path}/model.sdf") else None
    return path


def _model_named(package: Package, uri: str) -> str | None:
    """Return the model of the package whose folder a URI names, wherever that is."""
    ending = f"/{uri.rstrip('/').rpartition('/')[2]}/model.sdf"
    files = package.index.with_suffix("model.sdf")
    return next((it.path for it in files if f"/{it.path}".endswith(ending)), None)


class Scopes(Record):
    """Owners of the things of each file.

    Attributes:
        robots: The owners of links, joints, frames, sensors and models, by path.
        xacro: The owners of properties, macros and arguments of xacro, by path.
        values: The possible values of expressions, by the owner of the xacro files.
    """

    robots: Mapping[str, str]
    xacro: Mapping[str, str]
    values: Mapping[str, frozenset[str]]


def scopes_of(
    package: Package, files: Mapping[str, FileNames], links: Mapping[str, tuple[str | None, ...]]
) -> Scopes:
    """Return what the things of each file belong to.

    Args:
        package: The package being checked.
        files: The files by path.
        links: The paths of the files that each file includes, by its path.
    """
    xacro = _connected(files, links)
    robots = {path: xacro[path] for path in files if files[path].format in ("sdf", "robot")}
    robots |= _by_robot(files, robots)
    described = {robots[path] for path in files if files[path].format == "robot"}
    own = package.model_path
    model = own.path if isinstance(own, Found) else ""
    is_sdf = model in files and files[model].format == "sdf"
    if is_sdf or len(described) == 1:
        robots = {path: "" if scope in described else scope for path, scope in robots.items()}
    if is_sdf:
        robots[model] = ""
    values: dict[str, set[str]] = {}
    for path, file in files.items():
        values.setdefault(xacro[path], set()).update(file.values)
    return Scopes(robots, xacro, {scope: frozenset(found) for scope, found in values.items()})


def _by_robot(files: Mapping[str, FileNames], robots: Mapping[str, str]) -> dict[str, str]:
    """Return for each description the first of all that give their robot the same name."""
    first: dict[str, str] = {}
    for path, file in sorted(files.items()):
        if file.format == "robot" and file.model and not is_composed(file.model):
            first.setdefault(file.model, robots[path])
    joined = {
        robots[path]: first[file.model]
        for path, file in files.items()
        if file.format == "robot" and file.model in first
    }
    return {path: joined.get(scope, scope) for path, scope in robots.items()}


def _connected(
    files: Mapping[str, FileNames], links: Mapping[str, tuple[str | None, ...]]
) -> dict[str, str]:
    """Return for each file the first of all that xacro joins with it, the package's own before."""
    above = {path: path for path in files}

    def first(path: str) -> str:
        while above[path] != path:
            above[path] = path = above[above[path]]
        return path

    for one, other in _joined(files, links):
        left, right = sorted((first(one), first(other)), key=lambda it: (it.startswith(".."), it))
        above[right] = left
    return {path: first(path) for path in files}


def _joined(
    files: Mapping[str, FileNames], links: Mapping[str, tuple[str | None, ...]]
) -> Iterator[tuple[str, str]]:
    """Yield the pairs of files that xacro makes one text."""
    of_xacro = [path for path, file in files.items() if file.format == "robot"]
    for path, file in files.items():
        for included, target in zip(file.included, links[path], strict=True):
            if not included.by_xacro:
                continue
            if target in files:
                yield path, str(target)
            elif is_computed(included):
                # It may be any of them.
                yield from ((path, other) for other in of_xacro if not other.startswith("../"))
