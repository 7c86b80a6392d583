"""Descriptions that nothing names, beside one that a program or a page names."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from itertools import chain, islice

from checker.package.mentions import has_file
from checker.package.package import Package
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_NAMING = (
    *(".py", ".cpp", ".cc", ".h", ".hpp", ".yaml", ".yml", ".json", ".toml", ".sh", ".bat"),
    *(".md", ".rst", ".ipynb", ".m"),
)
_PAGES = (".ts", ".tsx", ".js", ".jsx", ".html", ".vue")
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
    workspace = package.workspace
    packages = {it.root: it for it in (package, *workspace.packages.values())}.values()
    texts = [
        *islice(chain.from_iterable(_texts(it, _NAMING) for it in packages), _TEXTS_LIMIT),
        *workspace.launch_texts.values(),
    ]
    left = frozenset(path for path in documents if not any(_names(it, path) for it in texts))
    return left if len(left) < len(documents) else frozenset()


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
    return has_file(text, name) or any(it in text for it in values)
