"""Files that a README tells users to put into a package, such as maps of their own rooms."""

from __future__ import annotations

import posixpath
import re
from typing import TYPE_CHECKING

from checker.package.files_above import README, files_around

if TYPE_CHECKING:
    from checker.package.package import Package

_WRITES = re.compile(r"(?:^|[\s$&;])(?:cp|mv|map_saver(?:_cli)?)\s([^\n`&;]{1,400})")
"""The words of a command that writes a file where its last word says."""


def put_there_by(package: Package, holder: str, path: str) -> str:
    """Return the README that tells users to put files into a folder; empty if none does.

    Args:
        package: The package being checked.
        holder: The name of the package with the folder.
        path: A file in this folder, from the folder of its package.
    """
    folder = posixpath.dirname(path)
    for page in files_around(package, README) if folder else ():
        targets = (words.split() for words in _WRITES.findall(page.text))
        if any(f"/{holder}/{folder}/" in f"/{words[-1]}" for words in targets if words):
            return page.file
    return ""
