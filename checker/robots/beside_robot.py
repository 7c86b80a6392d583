"""Descriptions that nothing names, where launch files load a robot that is not available."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable

from checker.package.mentions import has_word
from checker.package.package import Package
from checker.robots.candidates import is_included
from checker.robots.leftovers import unnamed
from checker.robots.unloaded import Naming, may_be_loaded, takes_any_file
from checker.source.text import without_comments

_PUBLISHED = "robot_description"
_LOADING = re.compile(rf"{_PUBLISHED}|xacro|MoveItConfigsBuilder")
"""What a launch file contains that loads a robot, or may."""
_SUFFIX = re.compile(r"\.(?:urdf|xacro)\b")


def left_beside_robot(package: Package, naming: Naming, paths: Iterable[str]) -> frozenset[str]:
    """Return paths of descriptions that nothing names, where launch files load another robot.

    That robot is not available, or its launch file is not evaluated. Each launch file that may load
    a robot contains the name of a file, or how it ends, and takes no other one from an argument.

    Args:
        package: The package being checked.
        naming: The texts that may name a description.
        paths: Its descriptions, none of which a launch file is known to load.
    """
    texts = (without_comments(*it) for it in naming.own.items())
    loading = [text for text in texts if _LOADING.search(text)]
    is_open = any(takes_any_file(text) or not _SUFFIX.search(text) for text in loading)
    if is_open or not any(_PUBLISHED in text for text in loading):
        return frozenset()
    left = (it for it in unnamed(package, paths) if not _has_stem(loading, it))
    return frozenset(
        it for it in left if not (may_be_loaded(naming, it) or is_included(package, it))
    )


def _has_stem(texts: Iterable[str], path: str) -> bool:
    """Return whether a text has the name of a file, up to its first dot."""
    stem = posixpath.basename(path).partition(".")[0]
    return any(has_word(text, stem) for text in texts)
