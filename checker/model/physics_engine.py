"""Which physics engine Gazebo Sim loads for a world, and what it makes of a model."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.base.resources import table
from checker.model.plugin_library import library_stem

if TYPE_CHECKING:
    from checker.model.sdf.world import World

_LIBRARY = re.compile(r"(?:gz|ignition)-physics\d*-([\w-]+)-plugin")


class PhysicsEngine(Record):
    """A physics engine that is known.

    Attributes:
        key: In the table, such as `dartsim`.
        title: What messages call it.
        is_default: Whether Gazebo loads it because nothing names another one.
    """

    key: str
    title: str
    is_default: bool

    def has_mimic(self, release: str) -> bool:
        """Whether `<mimic>` couples joints in a Gazebo release."""
        return release in table("physics_engines")["engines"][self.key]["mimic"]


def engine_of(world: World | None, told: str = "") -> PhysicsEngine | None:
    """Return the engine of a world; None for one that is not known.

    Args:
        world: The world; None for one of Gazebo's own.
        told: What the command line says behind `--physics-engine`; empty for nothing.
    """
    name = told or (_named(world) if world is not None else "")
    if not name:
        return _engine(table("physics_engines")["default"], is_default=True)
    match = _LIBRARY.fullmatch(library_stem(name))
    return _engine(match[1], is_default=False) if match else None


def _engine(key: str, *, is_default: bool) -> PhysicsEngine | None:
    entry = table("physics_engines")["engines"].get(key)
    return PhysicsEngine(key, entry["title"], is_default) if entry else None


def _named(world: World) -> str:
    """Return what `<engine><filename>` of the world's plugins says; empty when none does."""
    for plugin in world.plugins:
        engine = plugin.element.child("engine")
        if engine is not None and (file := engine.child("filename")) is not None:
            return file.value.strip()
    return ""
