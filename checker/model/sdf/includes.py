"""The models that a package's model includes."""

from __future__ import annotations

import posixpath

from checker.base.record import Record
from checker.model.sdf.document import parse_version
from checker.package.manifests import SdfEntry, read_model_config
from checker.package.package import Package
from checker.source.text import Located
from checker.source.xml import XmlDocument


class ModelIncludes(Record):
    """Finds the model file behind the URI of an `<include>`: an `IncludeReader`."""

    package: Package

    def __call__(self, uri: Located[str]) -> XmlDocument | str:
        """Return the file, or say why it cannot be read; relative URIs start at the includer."""
        path = self._path(uri.value, posixpath.dirname(uri.span.source.file))
        if path is None:
            return f"{uri.value} is not at hand"
        document = self.package.xml(path)
        return document if isinstance(document, XmlDocument) else f"{path} cannot be read"

    def _path(self, uri: str, folder: str) -> str | None:
        """Return the path of a model: of a package at hand, of a folder, or as it is named."""
        if uri.startswith("model://"):
            name, _, uri = uri.removeprefix("model://").partition("/")
            holder = self.package.workspace.package(name)
            if holder is None:
                return None
            folder = "" if holder is self.package else f"../{holder.name}"
        path = posixpath.normpath(posixpath.join(folder, uri or "."))
        entry = self.package.resolve(path)
        if path in (".", folder) or (entry is not None and entry.is_folder):
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
