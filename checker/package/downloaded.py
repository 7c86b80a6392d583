"""Files that CMake downloads when a package is built, into the package or next to it."""

from __future__ import annotations

import posixpath
import re
from typing import TYPE_CHECKING

from checker.package.files_above import files_around
from checker.source.cmake import read_cmake

if TYPE_CHECKING:
    from checker.package.package import Package

_NAMES = re.compile(r"\A(?:\.\./)*cmakelists\.txt\Z")
_FOLDER_WORDS = {
    "externalproject_add": "SOURCE_DIR",
    "fetchcontent_declare": "SOURCE_DIR",
    "fetchcontent_populate": "SOURCE_DIR",
    "file": "DESTINATION",
}
"""Commands that fill a folder, and the word in front of it; of `file()`, `ARCHIVE_EXTRACT`."""
_ANY = re.compile("|".join((*_FOLDER_WORDS, "download")), re.IGNORECASE)


def downloaded_by(package: Package, path: str) -> str:
    """Return the line of a CMakeLists.txt that downloads a file: `../CMakeLists.txt:31`.

    Args:
        package: A package; the files of the folders around it count, as far as the user gave them.
        path: The path of the file, from the package.
    """
    wanted = _absolute(package, path)
    for source in files_around(package, _NAMES):
        folder = posixpath.dirname(source.file)
        for call in read_cmake(source).calls if _ANY.search(source.text) else ():
            words = [word.value for word in call.arguments]
            name, filled = _target(words), _filled(call.name, words)
            in_folder = filled and wanted.startswith(_absolute(package, folder, filled) + "/")
            if in_folder or (call.name == "file" and name == posixpath.basename(path)):
                return f"{source.file}:{source.position(call.span.start)[0]}"
    return ""


def _target(words: list[str]) -> str:
    """Return the name of the file that `file(DOWNLOAD url path)` writes."""
    return posixpath.basename(words[2]) if words[:1] == ["DOWNLOAD"] and len(words) > 2 else ""


def _filled(command: str, words: list[str]) -> str:
    """Return the folder that a command fills; empty if there is none, or it is not known."""
    copies = command == "file" and words[:1] != ["ARCHIVE_EXTRACT"]
    word = "" if copies else _FOLDER_WORDS.get(command, "")
    place = words.index(word) + 1 if word in words else len(words)
    folder = words[place] if place < len(words) else ""
    return "" if "$" in folder else folder


def _absolute(package: Package, *path: str) -> str:
    return posixpath.normpath(posixpath.join(package.root.as_posix(), *path))
