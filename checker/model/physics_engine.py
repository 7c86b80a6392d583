"""Physics engine that Gazebo Sim loads for a world, and its support of a model."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.base.resources import table
from checker.model.plugin_library import library_stem
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.world import World

_LIBRARY = re.compile(r"(?:gz|ignition)-physics-([\w-]+)-plugin")
_NUMBERED = re.compile(r"-physics\d+-")


class PhysicsEngine(Record):
    """A physics engine that is known.

    Attributes:
        key: The key in the table, such as `dartsim`.
        title: What messages call it.
        is_default: Whether Gazebo loads it because nothing names another one.
    """

    key: str
    title: str
    is_default: bool

    def has_mimic(self, release: str) -> bool:
        """Return whether `<mimic>` couples joints in a Gazebo release."""
        return release in _engines()[self.key]["mimic"]

    @property
    def lacks(self) -> Mapping[str, Any]:
        """Elements that it cannot simulate, by kind."""
        lacking: Mapping[str, Any] = _engines()[self.key]["lacks"]
        return lacking


def engine_of(world: World | None, chosen: str = "") -> PhysicsEngine | None:
    """Return the engine of a world; None for one that is not known.

    Args:
        world: The world; None for one of Gazebo's own.
        chosen: The command line's value of `--physics-engine`; empty for none.
    """
    named = engine_name(world) if world is not None else None
    name = chosen or (named.value if named is not None else "")
    if not name:
        return _engine(table("physics_engines")["default"], is_default=True)
    match = _LIBRARY.fullmatch(engine_library(name))
    return _engine(match[1], is_default=False) if match else None


def engine_library(filename: str) -> str:
    """Return what identifies the library of an engine: its stem, without the release's number."""
    return _NUMBERED.sub("-physics-", library_stem(filename))


def libraries_of(release: str) -> list[str]:
    """Return the libraries of the engines that a release has; older names after the newer ones."""
    engines = [key for key, entry in _engines().items() if release in entry["in"]]
    prefixes = ("ignition",) if release == "fortress" else ("gz", "ignition")
    return [f"{prefix}-physics-{key}-plugin" for prefix in prefixes for key in engines]


def _engines() -> Mapping[str, Any]:
    engines: Mapping[str, Any] = table("physics_engines")["engines"]
    return engines


def _engine(key: str, *, is_default: bool) -> PhysicsEngine | None:
    entry = _engines().get(key)
    return PhysicsEngine(key, entry["title"], is_default) if entry else None


def engine_name(world: World) -> Located[str] | None:
    """Return what `<engine><filename>` of the world's plugins states; None if none does."""
    for plugin in world.plugins:
        engine = plugin.element.child("engine")
        if engine is not None and (file := engine.child("filename")) is not None:
            return file.text
    return None
