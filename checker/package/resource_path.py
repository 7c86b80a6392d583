"""Paths that a package adds to the search path of Gazebo for meshes and models.

Environment hooks do so in each shell that sources the workspace; `<gazebo_ros>` in package.xml, in
what `gz_sim.launch.py` of ros_gz_sim and `gzserver.launch.py` of gazebo_ros start.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from itertools import chain

from checker.base.record import Record
from checker.package.files_above import files_above
from checker.package.package import Package
from checker.source.text import Located, SourceText, Span
from checker.source.xml import XmlDocument

_PLUGINS_NAMED = re.compile(r"\b(?:GZ_SIM|IGN_GAZEBO)_SYSTEM_PLUGIN_PATH\b|\bplugin_path\b")
"""The path of plugins, and the attribute of `<gazebo_ros>` that adds to it."""
_NAMED = re.compile(
    r"\b(?:GZ_SIM_RESOURCE_PATH|IGN_GAZEBO_RESOURCE_PATH|SDF_PATH|GZ_FILE_PATH|IGN_FILE_PATH)\b"
)
"""The resource path, and what gz-sim copies it into when it starts."""
_NAMED_IN_CLASSIC = re.compile(r"\bGAZEBO_(?:MODEL|RESOURCE)_PATH\b")
"""The same of Gazebo Classic: the first for `model://`, the second for `file://`."""
_TEXTS = (
    *(".md", ".rst", ".txt", ".sh", ".bash", ".zsh", ".env", ".dsv", ".in", ".py", ".xml"),
    *(".launch", ".yaml", ".yml", ".json", ".toml", ".cmake", "file"),
)
"""Ends of the names of documents, scripts, and files such as `Dockerfile` and `Makefile`."""
_ENVIRONMENT = re.compile(
    r"\A(?:\.\./)+(?:\.devcontainer/)?"
    r"(?:pixi\.toml|pyproject\.toml|\.envrc|[\w.-]*\.(?:env|sh|bash)"
    r"|[\w.-]*dockerfile[\w.-]*|(?:docker-)?compose[\w.-]*\.ya?ml|devcontainer\.json)\Z"
)
"""Paths in lower case of files around a package that set variables of the environment."""
_ADDS = ("prepend-non-duplicate", "append-non-duplicate", "prepend-non-duplicate-if-exists", "set")
_IN_SHELL = re.compile(
    r"(?:\$\{?(?:AMENT|COLCON)_CURRENT_PREFIX\}?|@CMAKE_INSTALL_PREFIX@)/([^\s:;\"']{1,300})"
)
_EXPORTS = ("gazebo_model_path", "gazebo_media_path")


def _variables(classic: bool) -> re.Pattern[str]:
    return _NAMED_IN_CLASSIC if classic else _NAMED


def sets_path(variable: str, *, classic: bool = False) -> bool:
    """Return whether a variable is the resource path, or searched like it.

    Args:
        variable: Its name.
        classic: Whether the path of Gazebo Classic is meant.
    """
    return _variables(classic).fullmatch(variable) is not None


class SearchedFolder(Record, eq=False):
    """A folder that is put on the path.

    Attributes:
        folder: The folder below the folder of all share folders: empty for that itself,
            `arm/models`; None if it is not known, or is elsewhere.
        known: Whether its place is known.
        span: What puts it there.
    """

    folder: str | None
    known: bool
    span: Span


def searched_folders(package: Package, *, classic: bool = False) -> Iterator[SearchedFolder]:
    """Yield what the hooks and the manifest of a package put on the path."""
    variables = _variables(classic)
    for path in hooks(package):
        source = package.read(path)
        if isinstance(source, SourceText):
            yield from _of_hook(source, package.declared_name, variables)
    yield from _exported(package)


def hooks(package: Package) -> tuple[str, ...]:
    """Return the environment hooks that a package's CMakeLists.txt registers."""
    calls = package.build.calls_of("ament_environment_hooks") if package.build else ()
    named = (posixpath.normpath(word.value) for call in calls for word in call.arguments)
    return tuple(path for path in named if package.exists(path))


def _of_hook(source: SourceText, name: str, variables: re.Pattern[str]) -> Iterator[SearchedFolder]:
    """Yield what one hook adds: a list of operations (`.dsv`), or a script of the shell."""
    at = 0
    for line in source.text.splitlines(keepends=True):
        span = Span(source, at, at + len(line.rstrip()))
        at += len(line)
        if line.lstrip().startswith("#") or not variables.search(line):
            continue
        text = line.replace("@PROJECT_NAME@", name) if source.file.endswith(".in") else line
        if ".dsv" in posixpath.basename(source.file):
            yield from _operation(text.strip().split(";"), span)
        else:
            found = _IN_SHELL.findall(text)
            yield from (_below_prefix(path, span) for path in found)
            if not found:
                yield SearchedFolder(None, False, span)


def _operation(words: list[str], span: Span) -> Iterator[SearchedFolder]:
    if words[0] not in _ADDS:
        yield SearchedFolder(None, False, span)
    for path in words[2:]:
        yield _below_prefix(path.replace("@CMAKE_INSTALL_PREFIX@/", ""), span)


def _below_prefix(path: str, span: Span) -> SearchedFolder:
    """Return the folder at a path below the prefix that a package is installed in."""
    first, _, rest = posixpath.normpath(path).partition("/")
    return SearchedFolder(rest if first == "share" else None, not {"$", "@"} & {*path}, span)


def _exported(package: Package) -> Iterator[SearchedFolder]:
    """Yield the folders of `<gazebo_ros gazebo_model_path="${prefix}/…"/>` in package.xml."""
    manifest = package.xml("package.xml")
    export = manifest.root.child("export") if isinstance(manifest, XmlDocument) else None
    for element in export.children if export is not None else ():
        for attribute in map(element.attribute, _EXPORTS):
            if element.tag == "gazebo_ros" and attribute is not None:
                yield from _share_folders(attribute, package.declared_name)


def _share_folders(attribute: Located[str], name: str) -> Iterator[SearchedFolder]:
    for path in attribute.value.split(":"):
        prefix, slash, rest = path.strip().partition("/")
        if prefix == "${prefix}":
            folder = posixpath.normpath(f"/{name}{slash}{rest}").lstrip("/")
            yield SearchedFolder(folder, "$" not in rest, attribute.span)
        else:
            yield SearchedFolder(None, "$" not in path, attribute.span)


def mentions(package: Package, *, classic: bool = False) -> Iterator[Span]:
    """Yield where the texts of a package name the path, except its hooks.

    Launch files set it; documents, scripts and container files tell users to do so. So do files
    around the package that set the environment of a workspace. Code in a comment does neither.
    """
    known = frozenset(hooks(package))
    files = (it.path for it in package.index.with_suffix(*_TEXTS) if it.path not in known)
    own = (source for source in map(package.read, files) if isinstance(source, SourceText))
    for source in chain(own, *files_above(package, _ENVIRONMENT)):
        for match in _variables(classic).finditer(source.text):
            if not _is_commented_out(source, match.start()):
                yield Span(source, *match.span())


def _is_commented_out(source: SourceText, at: int) -> bool:
    """Return whether a name is a string of Python in a comment: a call that was switched off."""
    line = source.text[source.text.rfind("\n", 0, at) + 1 : at]
    return source.file.endswith(".py") and line.lstrip().startswith("#") and line[-1] in "'\""


def plugin_folders(package: Package) -> frozenset[str] | None:
    """Return the folders that a package puts on the path of plugins, below the install prefix.

    None if it also names that path in another way than by a list of operations (`.dsv`) or
    package.xml, or a folder that is not known.
    """
    known = {path for path in hooks(package) if ".dsv" in posixpath.basename(path)}
    folders: set[str] = set()
    for file in package.index.with_suffix(*_TEXTS):
        source = package.read(file.path)
        if not isinstance(source, SourceText) or not _PLUGINS_NAMED.search(source.text):
            continue
        if file.path == "package.xml":
            folders.update(_plugin_exports(package))
        elif file.path in known:
            folders.update(_plugin_operations(source, package.declared_name))
        else:
            return None
    return (
        None
        if any({"$", "@", ""} & {*folder, folder} for folder in folders)
        else frozenset(folders)
    )


def _plugin_operations(source: SourceText, name: str) -> Iterator[str]:
    for line in source.text.replace("@PROJECT_NAME@", name).splitlines():
        operation, *words = line.strip().split(";")
        if _PLUGINS_NAMED.search(line) and not line.lstrip().startswith("#"):
            yield from words[1:] if operation in _ADDS else ("",)


def _plugin_exports(package: Package) -> Iterator[str]:
    """Yield what `<gazebo_ros plugin_path>` adds: `${prefix}` is the package's share folder."""
    manifest = package.xml("package.xml")
    export = manifest.root.child("export") if isinstance(manifest, XmlDocument) else None
    for element in export.all("gazebo_ros") if export is not None else ():
        for path in (element.get("plugin_path") or "").split(":"):
            share = f"share/{package.declared_name}"
            yield posixpath.normpath(path.strip().replace("${prefix}", share)) if path else ""
