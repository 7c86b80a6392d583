"""Worlds that contain a robot of their own, and launch files that name such a world."""

from __future__ import annotations

import posixpath
from collections.abc import Collection, Iterator
from itertools import chain

from checker.package.mentions import has_file
from checker.package.package import Package
from checker.source.xml import Element, XmlDocument

_WORLDS = (".sdf", ".world")


def names_world_with_robot(package: Package, texts: Collection[str], *, beyond: bool) -> bool:
    """Return whether a text names a world that contains or includes a robot.

    Args:
        package: The package being checked.
        texts: Launch files, without comments.
        beyond: Whether to look for worlds in the other packages of the workspace too.
    """
    holders = (package, *(package.other_packages if beyond else ()))
    return any(
        any(has_file(text, posixpath.basename(entry.path)) for text in texts)
        and any(_is_robot(model, holders) for model in _models(holder, entry.path, "world"))
        for holder in holders
        for entry in holder.index.with_suffix(*_WORLDS)
    )


def _models(package: Package, path: str, holding: str) -> Iterator[Element]:
    """Yield the models of a file, and the tags that include one."""
    document = package.xml(path)
    if isinstance(document, XmlDocument):
        root = document.root
        tops = root.all(holding) if holding == "world" else (root,)
        yield from chain.from_iterable((*top.all("model"), *top.all("include")) for top in tops)


def _is_robot(model: Element, holders: Collection[Package]) -> bool:
    """Return whether a model has joints and a plugin, or the one that it includes has them."""
    included = (model,) if model.tag == "include" else model.all("include")
    names = {posixpath.basename(uri.value.rstrip("/")) for it in included for uri in it.all("uri")}
    return _has_parts(model) or any(
        map(_has_parts, chain.from_iterable(_of_folders(it, names) for it in holders))
    )


def _of_folders(package: Package, names: Collection[str]) -> Iterator[Element]:
    """Yield the models in folders of some names."""
    for entry in package.index.with_suffix(".sdf") if names else ():
        if posixpath.basename(posixpath.dirname(entry.path)) in names:
            yield from _models(package, entry.path, "sdf")


def _has_parts(model: Element) -> bool:
    return model.child("joint") is not None and model.child("plugin") is not None
