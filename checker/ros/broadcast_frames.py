"""Frames that launch files and programs of the user's broadcast themselves."""

from __future__ import annotations

import re
from collections.abc import Collection

from checker.package.mentions import has_word
from checker.package.package import Package
from checker.source.text import SourceText

_BROADCASTS = re.compile(r"static_transform|TransformBroadcaster")


def is_broadcast(package: Package, frame: str) -> bool:
    """Return whether a file that broadcasts transforms names a frame.

    Args:
        package: The package whose programs are read; launch files are those of all packages.
        frame: The frame.
    """
    return any(_BROADCASTS.search(text) and has_word(text, frame) for text in _texts(package))


def _texts(package: Package) -> Collection[str]:
    programs = (package.read(file.path) for file in package.index.with_suffix(".py", ".cpp"))
    own = (source.text for source in programs if isinstance(source, SourceText))
    return (*package.workspace.launch_texts.values(), *own)
