"""Descriptions that nothing names, where launch files load a robot that is not available."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Mapping

from checker.package.files_above import README, files_around
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.package.target import package_around
from checker.robots.candidates import is_included
from checker.robots.leftovers import unnamed
from checker.robots.unloaded import Naming, may_be_loaded, takes_any_file
from checker.source.text import SourceText, without_comments

_PUBLISHED = "robot_description"
_LOADING = re.compile(rf"{_PUBLISHED}|xacro|MoveItConfigsBuilder")
"""What a launch file contains that loads a robot, or may."""
_SUFFIX = re.compile(r"\.(?:urdf|xacro)\b")
_FOUND = re.compile(r"\$\(find\s{1,8}([\w.-]{1,200})\s{0,8}\)/([\w./-]{1,300})")


def naming_of(package: Package) -> Naming:
    """Return the texts that may name the descriptions of a package.

    The files of other packages that launch files of ROS 1 name and that exist are left out.
    """

    def without_theirs(texts: Mapping[str, str]) -> dict[str, str]:
        return {
            file: _FOUND.sub(lambda it: "" if _is_theirs(package, *it.groups()) else it[0], text)
            for file, text in texts.items()
        }

    return Naming(
        without_theirs(package.workspace.launch_texts),
        without_theirs(package.naming_launch_texts),
        [page.text for page in files_around(package, README)],
    )


def _is_theirs(package: Package, name: str, path: str) -> bool:
    """Return whether another package, which is not around this one, has a file."""
    other = package.named(name)
    return other is not None and not package.root.is_relative_to(other.root) and other.exists(path)


def left_beside_robot(package: Package, paths: Iterable[str]) -> frozenset[str]:
    """Return what `_left` does; for a model within a package what that package has so."""
    around = package_around(package)
    if around is None or package.exists("package.xml"):
        return _left(package, paths)
    folder = package.root.relative_to(around.root).as_posix()
    left = _left(around, [f"{folder}/{path}" for path in paths])
    return frozenset(it.removeprefix(f"{folder}/") for it in left)


def _left(package: Package, paths: Iterable[str]) -> frozenset[str]:
    """Return paths of descriptions that nothing names, where launch files load another robot.

    That robot is not available, or its launch file is not evaluated. Each launch file that may load
    a robot contains the name of a file, or how it ends, and takes no other one from an argument.

    Args:
        package: The package being checked.
        paths: Its descriptions, none of which a launch file is known to load.
    """
    naming = naming_of(package)
    texts = (without_comments(*it) for it in package.naming_launch_texts.items())
    loading = [text for text in texts if _LOADING.search(text)]
    is_open = any(takes_any_file(text) or not _SUFFIX.search(text) for text in loading)
    if is_open or not any(_PUBLISHED in text for text in loading):
        return frozenset()
    left = (it for it in unnamed(package, paths) if not _has_stem(loading, it))
    alone = (it for it in left if not (may_be_loaded(naming, it) or is_included(package, it)))
    return frozenset(it for it in alone if not _is_in_world(package, it))


def _is_in_world(package: Package, path: str) -> bool:
    """Return whether an SDF file includes the model folder that a description is in."""
    folder = posixpath.basename(posixpath.dirname(path))
    return bool(folder) and any(
        isinstance(source := holder.read(entry.path), SourceText)
        and f"model://{folder}" in source.text
        for holder in (package, *package.other_packages)
        for entry in holder.index.with_suffix(".sdf", ".world")
    )


def _has_stem(texts: Iterable[str], path: str) -> bool:
    """Return whether a text has the name of a file, up to its first dot."""
    stem = posixpath.basename(path).partition(".")[0]
    return any(has_word(text, stem) for text in texts)
