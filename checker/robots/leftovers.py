"""Descriptions that nothing names, beside one that a program names or a world that is started."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain, islice

from checker.package.files_above import README, files_around
from checker.package.package import Package
from checker.robots.world_robots import names_world_with_robot
from checker.source.text import SourceText, without_comments
from checker.source.xml import XmlDocument

_NAMING = (
    *(".py", ".cpp", ".cc", ".h", ".hpp", ".yaml", ".yml", ".json", ".toml", ".sh", ".bat"),
    *(".md", ".rst", ".ipynb", ".m"),
)
_PAGES = (".ts", ".tsx", ".js", ".jsx", ".html", ".vue")
_OF_URDF = ("robot_description", ".urdf", ".xacro")
"""What a launch file contains that may load a description, by whatever name."""
_PATH = re.compile(r"[\w./-]+")
_TEXTS_LIMIT = 400
"""Files of the workspace that are searched for names of descriptions."""


def leftovers(package: Package, documents: Mapping[str, XmlDocument]) -> frozenset[str]:
    """Return paths of descriptions that nothing names, where a text names another of them.

    Args:
        package: The package being checked.
        documents: Its descriptions by their paths, none of which a launch file loads.
    """
    if len(documents) == 1:
        return frozenset()
    left = unnamed(package, documents)
    return left if len(left) < len(documents) else frozenset()


def left_beside_world(package: Package, paths: Iterable[str]) -> frozenset[str]:
    """Return paths of descriptions that nothing names, where a world with a robot is started.

    Launch files of the package start this world of it, and none loads any description.

    Args:
        package: The package being checked.
        paths: Its descriptions, none of which a launch file loads.
    """
    naming = [without_comments(*it) for it in package.naming_launch_texts.items()]
    if any(word in text for text in naming for word in _OF_URDF):
        return frozenset()
    started = [without_comments(*it) for it in package.launch_texts.items()]
    is_beside = names_world_with_robot(package, started, beyond=False)
    return unnamed(package, paths) if is_beside else frozenset()


def unnamed(package: Package, paths: Iterable[str]) -> frozenset[str]:
    """Return the paths of descriptions that no program, launch file or README names."""
    workspace = package.workspace
    packages = (package, *package.other_packages)
    texts = [
        *islice(chain.from_iterable(_texts(it, _NAMING) for it in packages), _TEXTS_LIMIT),
        *workspace.launch_texts.values(),
        *(page.text for page in files_around(package, README)),
    ]
    return frozenset(path for path in paths if not any(_names(it, path) for it in texts))


def is_of_page(package: Package, path: str) -> bool:
    """Return whether a web page that reads URDF gets a file: from the folder `public`."""
    return "public" in path.split("/")[:-1] and any(
        ".urdf" in text for text in islice(_texts(package, _PAGES), _TEXTS_LIMIT)
    )


def _texts(package: Package, suffixes: tuple[str, ...]) -> Iterator[str]:
    for file in package.index.with_suffix(*suffixes):
        source = package.read(file.path)
        if isinstance(source, SourceText):
            yield source.text


def _names(text: str, path: str) -> bool:
    """Return whether a text names a file, or has its stem as a value."""
    name = posixpath.basename(path)
    stem = name.partition(".")[0]
    values = (f'"{stem}"', f"'{stem}'", f":={stem}", f": {stem}\n")
    written = _PATH.findall(text) if name in text else ()
    return any(_is_path_of(it, path) for it in written) or any(it in text for it in values)


def _is_path_of(written: str, path: str) -> bool:
    """Return whether a path with any folders in front, or a part of it, is that of a file."""
    parts, own = [it for it in written.split("/") if it.strip(".")], path.split("/")
    shared = min(len(parts), len(own))
    return bool(parts) and parts[-shared:] == own[-shared:]
