"""Descriptions that nothing names and whose meshes are gone, beside one that a program names."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from itertools import chain, islice

from checker.package.package import Package
from checker.package.uris import path_behind
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_PROGRAMS = (".py", ".cpp", ".cc", ".h", ".hpp", ".yaml", ".yml", ".json", ".toml", ".sh", ".bat")
_PAGES = (".ts", ".tsx", ".js", ".jsx", ".html", ".vue")
_TEXTS_LIMIT = 400
"""Files of the workspace that are searched for names of descriptions."""


def leftovers(package: Package, documents: Mapping[str, XmlDocument]) -> frozenset[str]:
    """Return paths of descriptions that nothing names and all of whose meshes are missing.

    Args:
        package: The package being checked.
        documents: Its descriptions by their paths, none of which a launch file loads.
    """
    gone = [path for path, document in documents.items() if _lacks_meshes(package, document, path)]
    if not gone or len(documents) == 1:
        return frozenset()
    workspace = package.workspace
    packages = {it.root: it for it in (package, *workspace.packages.values())}.values()
    texts = "\n".join(
        chain(
            islice(chain.from_iterable(_texts(it, _PROGRAMS) for it in packages), _TEXTS_LIMIT),
            workspace.launch_texts.values(),
        )
    )
    if not any(posixpath.basename(path) in texts for path in documents):
        return frozenset()
    return frozenset(path for path in gone if _stem(path) not in texts)


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


def _lacks_meshes(package: Package, document: XmlDocument, path: str) -> bool:
    uris = {mesh.get("filename") or "" for mesh in document.root.descendants("mesh")}
    found = [path_behind(package, posixpath.dirname(path), uri) for uri in uris]
    return bool(found) and all(isinstance(it, str) and not package.exists(it) for it in found)


def _stem(path: str) -> str:
    return posixpath.basename(path).partition(".")[0]
