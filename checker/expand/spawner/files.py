"""Files that a spawner may read: those of the workspace, through the caller's loader only.

Ruby sees the workspace as the folder `/workspace`; no other folder exists.
"""

from __future__ import annotations

import posixpath
from typing import Protocol

from checker.source.text import SourceText

ROOT = "/workspace"


class SpawnerFiles(Protocol):
    """Gives texts of the workspace; paths are relative to it, normalised, with `/`."""

    def read(self, path: str) -> SourceText | str:
        """Return a text, or the reason why it cannot be given."""
        ...

    def exists(self, path: str) -> bool:
        """Whether there is a file or folder of this path, text or not."""
        ...

    def package_folder(self, name: str) -> str | None:
        """Return the folder of a package, or None when the package is not at hand."""
        ...


def absolute(path: str) -> str:
    """Return the path under which Ruby sees a file of the workspace."""
    return posixpath.normpath(posixpath.join(ROOT, path))


def workspace_path(path: str) -> str | None:
    """Return the path relative to the workspace of an absolute path, or None outside it."""
    if not path.startswith("/"):
        return None
    clean = posixpath.normpath(path)
    return clean[len(ROOT) + 1 :] if clean.startswith(ROOT + "/") else None


def joined_path(parts: list[str]) -> str:
    """Join as `File.join` does: one `/` between the parts, and `..` is kept."""
    if not parts:
        return ""
    path = parts[0]
    for part in parts[1:]:
        if path.endswith("/"):
            path = path.rstrip("/") + "/" if part.startswith("/") else path
            path += part.lstrip("/")
        else:
            path += part if part.startswith("/") else f"/{part}"
    return path


def folder_of(path: str) -> str:
    """Return the folder as `File.dirname` does."""
    folder = posixpath.dirname(path.rstrip("/") or path)
    return folder or "."


def expanded(path: str, folder: str | None) -> str | None:
    """Return the path as `File.expand_path` does, or None when it depends on where Ruby runs."""
    if path.startswith("~"):
        return None
    if not path.startswith("/"):
        if folder is None or not folder.startswith("/"):
            return None
        path = posixpath.join(folder, path)
    return "/" + posixpath.normpath(path).lstrip("/")
