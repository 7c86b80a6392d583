"""The model behind an `<include>`: which file its URI names, as simulators look for it."""

from __future__ import annotations

import posixpath
from collections.abc import Callable

from checker.base.record import Record
from checker.formats.sdf.document import parse_version
from checker.package.manifests import SdfEntry, read_model_config
from checker.package.package import Package
from checker.package.uris import Unknown, path_behind
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

IncludeReader = Callable[[Located[str]], "XmlDocument | str"]
"""Gives the model file behind the URI of an `<include>`, or states why it cannot be read.

The URI's place gives the including file, to which relative URIs refer.
"""


def read_no_include(uri: Located[str]) -> XmlDocument | str:
    """Read no include at all."""
    return f"{uri.value} is not available"


def included_model(placed: Element, include: IncludeReader) -> Element | str:
    """Return the model behind an `<include>`, or state why there is none."""
    uri = placed.child("uri")
    document = include(uri.text) if uri is not None else "an <include> without <uri>"
    if isinstance(document, str):
        return document
    model = next(iter(document.root.all("model")), None)
    return model if model is not None else f"{document.source.file} contains no model"


class ModelIncludes(Record):
    """Finds the model file behind the URI of an `<include>`: an `IncludeReader`."""

    package: Package

    def __call__(self, uri: Located[str]) -> XmlDocument | str:
        """Return the file, or state why it cannot be read; relative URIs start at the includer."""
        path = self._path(uri.value, posixpath.dirname(uri.span.source.file))
        if path is None:
            return f"{uri.value} is not available"
        document = self.package.xml(path)
        return document if isinstance(document, XmlDocument) else f"{path} cannot be read"

    def _path(self, uri: str, folder: str) -> str | None:
        """Return the path of a model: next to the file, else of an available package.

        A bare name is looked up as `model://name` is: along the paths of the simulator. An absolute
        path may be that of an installed package.
        """
        if "://" not in uri:
            beside = self._model_file_at(posixpath.join(folder, uri), folder)
            if beside is not None:
                return beside
            uri = uri if uri.startswith("/") else f"model://{uri}"
        path = path_behind(self.package, folder, uri)
        return None if isinstance(path, Unknown) else self._model_file_at(path, folder)

    def _model_file_at(self, path: str, folder: str) -> str | None:
        """Return the model file at a path, which may be a folder; None if nothing is there."""
        path = posixpath.normpath(path)
        entry = self.package.resolve(path)
        is_sibling = path.startswith("../") and path.count("/") == 1
        if is_sibling or path in (".", folder) or (entry is not None and entry.is_folder):
            return self._model_in(path)
        return path if entry is not None else None

    def _model_in(self, folder: str) -> str:
        """Return the model file of a folder: the newest that its model.config names."""
        config = self.package.xml(posixpath.normpath(f"{folder}/model.config"))
        entries = read_model_config(config).sdf if isinstance(config, XmlDocument) else ()
        newest = max(entries, key=_version, default=None)
        named = newest.file.value if newest is not None else "model.sdf"
        return posixpath.normpath(f"{folder}/{named}")


def _version(entry: SdfEntry) -> tuple[int, int]:
    return parse_version(entry.version.value) or (0, 0)
