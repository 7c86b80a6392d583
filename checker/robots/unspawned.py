"""SDF models and worlds that nothing names, where launch files spawn or start others."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain

from checker.launch.ros2.descriptions import LoadedDescription, loaded_descriptions
from checker.launch.ros2.graph import LaunchGraph
from checker.launch.ros2.package_launch import launch_graphs
from checker.package.files_above import README, files_above
from checker.package.kind import PackageKind
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.package.target import package_around
from checker.robots.shown_only import spawns_others
from checker.source.text import SourceText, without_comments
from checker.source.unused_values import without_unused_values

_NAMING = (
    *(".py", ".launch", ".xml", ".sdf", ".world", ".xacro", ".urdf", ".yaml", ".yml", ".json"),
    *(".md", ".rst", ".sh", ".cpp", ".cc", ".hpp", ".h", ".rb", ".erb", ".config"),
)
_COMPUTED = re.compile(r"""(?:[\]\})]|["']\s*[,+]\s*["']|["'])\.(?:world|sdf)\b""")
"""The name of a world that a launch file puts together."""
_WORLDS = (".world", ".sdf")
_ARGUMENTS = ("world", "worlds")
"""Names that launch files have for arguments and folders, whatever world they start."""
_WORLD_TAG = re.compile(r"<world\b")
_URI = re.compile(r"<uri>([^<>]{1,300})</uri>")
_SPAWNING = re.compile(
    r"""[\s"']-(?:file|database)\b|\bsdf_filename\b|\bSpawn(?:Entity|Model)\b|\bEntityFactory\b"""
    r"""|\bInsertModel"""
)
"""What puts a model of a file into a world, by whatever name."""
_OF_URDF = (".urdf", ".urdf.xacro", ".xacro")
"""Suffixes of the description that an SDF model was converted from."""
_OF_EDITOR = "model_editor_models"
"""The folder into which Gazebo's model editor writes what it saves."""
_BRANCH = "\u2500 "
"""A line of a README that draws the tree of files starts none of them."""


def unstarted_world(package: Package) -> str:
    """Return the clause that no launch file starts a world; empty where one may, or there is none.

    A path that a launch file computes and passes to nothing does not start it.

    Args:
        package: The world as a single file.
    """
    file = package.name
    if package.kind is not PackageKind.WORLD and not (package.only and file.endswith(".world")):
        return ""
    around = package_around(package)
    launches = package.workspace.launch_texts.values()
    if not (around.launch_texts if around else launches) or any(map(_COMPUTED.search, launches)):
        return ""
    own = (package.root / file).relative_to(around.root).as_posix() if around else ""
    texts = (text for _, text in _texts(around, package, own))
    if _is_started(chain(texts, _pages_above(package)), file):
        return ""
    return f"only in {file}, which no launch file starts"


def _pages_above(package: Package) -> Iterator[str]:
    return (it.text for sources in files_above(package, README) for it in sources)


def _is_started(texts: Iterable[str], file: str) -> bool:
    """Return whether texts have the name of a world's file, or its stem as a value."""
    stem = file.partition(".")[0]
    names = (file,) if stem in _ARGUMENTS else (file, f'"{stem}"', f"'{stem}'")
    lines = chain.from_iterable(_used(text, names).splitlines() for text in texts)
    return any(_BRANCH not in line and any(name in line for name in names) for line in lines)


def _used(text: str, names: Sequence[str]) -> str:
    """Return a text; of one that has one of the names without what Python sets and never reads."""
    return without_unused_values(text) if any(name in text for name in names) else text


def unspawned(package: Package, path: str) -> str:
    """Return the clause that no launch file loads a model, where one spawns another; else empty.

    Args:
        package: The folder of the model, or the model as a single file.
        path: The file of the model, as that package lists it.
    """
    around = package_around(package)
    if around is None and package.root.parent.name == _OF_EDITOR:
        return _left_by_editor(package, path)
    if around is None or package.exists("package.xml"):
        return ""
    folder = package.root.relative_to(around.root).as_posix()
    file = posixpath.normpath(posixpath.join(folder, path))
    stem = posixpath.basename(path).partition(".")[0]
    own, name = (file, stem) if package.only else (f"{folder}/", package.root.name)
    beside = package.only and any(around.exists(f"{file[:-4]}{it}") for it in _OF_URDF)
    if beside or (package.only and name in package.workspace.packages):
        # The name alone means the URDF or the package.
        name = posixpath.basename(path)
    by_path = dict(_texts(around, package, own))
    texts = [*by_path.values()]
    clause = f"only in {file}, which no launch file loads"
    is_named = any(name in text for text in texts)
    converted = beside and around.launch_texts and not any(map(_COMPUTED.search, texts))
    is_world = package.kind is PackageKind.WORLD or path.endswith(".world")
    apart = not is_world and _is_in_no_started_world(around, by_path, name)
    if apart or (converted and not is_named):
        return clause
    graphs = () if is_named else launch_graphs(around)
    loaded = [(graph, it) for graph in graphs for it in loaded_descriptions(around, graph)]
    if (
        not loaded
        or any(may_load_others(*pair) for pair in loaded)
        or not spawns_others(around, graphs, file)
    ):
        return ""
    return clause


def _is_in_no_started_world(around: Package, texts: Mapping[str, str], name: str) -> bool:
    """Return whether launch files start a world, and no world that one starts has a model.

    Nothing else may name the model, or spawn models of files.

    Args:
        around: The package of the model and of the worlds.
        texts: The texts that may name either, by path, without those of the model.
        name: The name of the model's folder.
    """
    worlds = {path for path, text in texts.items() if _is_world(path, text)}
    launches = [without_comments(*it) for it in around.launch_texts.items()]
    if not any(_is_started(launches, posixpath.basename(it)) for it in worlds):
        return False
    holding = [path for path, text in texts.items() if _has(path, text, name)]
    pages = [*_pages_above(around)]
    if not worlds.issuperset(holding) or any(has_word(page, name) for page in pages):
        return False
    others = {path: text for path, text in texts.items() if path not in worlds}
    if any(_SPAWNING.search(it) or _COMPUTED.search(it) for it in others.values()):
        return False
    starting = [*(without_comments(*it) for it in others.items()), *pages]
    return not any(_is_started(starting, posixpath.basename(path)) for path in holding)


def _is_world(path: str, text: str) -> bool:
    return path.endswith(_WORLDS) and _WORLD_TAG.search(text) is not None


def _has(path: str, text: str, name: str) -> bool:
    """Return whether a file names a model; SDF includes it by a URI, and model.config none."""
    if not path.endswith(_WORLDS):
        return not path.endswith("model.config") and has_word(text, name)
    parts = [part for uri in _URI.findall(text) for part in uri.strip().split("/")]
    return any(name in (part, part.partition(".")[0]) for part in parts)


def _left_by_editor(package: Package, path: str) -> str:
    """Return the clause that launch files load no model of Gazebo's model editor; else empty."""
    name = package.root.name
    names = (f"model://{name}", f"{name}/{path}")
    others = (text for _, text in _texts(None, package, ""))
    texts = [*others, *package.workspace.launch_texts.values()]
    named = any(each in text for text in texts for each in names)
    starts = bool(package.workspace.launch_words)
    return f"only in {name}/{path}, which no launch file loads" if starts and not named else ""


def may_load_others(graph: LaunchGraph, loaded: LoadedDescription) -> bool:
    """Return whether an argument of the launch file chooses the file that is loaded."""
    values = (it.default.value for it in graph.arguments if it.default is not None)
    return any(value and value in loaded.load.path for value in values)


def _texts(around: Package | None, package: Package, own: str) -> Iterator[tuple[str, str]]:
    """Yield the texts of the package around a model, and of those next to it, with their paths.

    Args:
        around: The package that the model is in, if any; packages within it are left out.
        package: The model.
        own: The path of the model in the package around it, whose texts are left out.
    """
    beside = [*package.workspace.packages.values()]
    if around is not None:
        beside = [around, *(it for it in beside if not it.root.is_relative_to(around.root))]
    for holder in beside:
        for entry in holder.index.with_suffix(*_NAMING):
            of_model = holder is around and entry.path.startswith(own)
            source = None if of_model else holder.read(entry.path)
            if isinstance(source, SourceText):
                yield f"{holder.root}/{entry.path}", source.text
