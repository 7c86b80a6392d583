"""The worlds of an SDF file."""

from __future__ import annotations

from checker.formats.sdf.includes import IncludeReader, included_model
from checker.formats.sdf.links import read_plugin
from checker.formats.sdf.reader import read_robot
from checker.model.world import World
from checker.source.xml import Element, XmlDocument

_INCLUDES_LIMIT = 100


def read_worlds(document: XmlDocument, include: IncludeReader) -> tuple[World, ...]:
    """Read the worlds of a file."""
    return tuple(_read_world(world, include) for world in document.root.all("world"))


def _read_world(world: Element, include: IncludeReader) -> World:
    models = [read_robot(model, include) for model in world.all("model")]
    unknown = []
    for placed in list(world.all("include"))[:_INCLUDES_LIMIT]:
        model = included_model(placed, include)
        if isinstance(model, Element):
            models.append(read_robot(model, include, placed))
        elif (uri := placed.child("uri")) is not None:
            unknown.append(uri.text)
    plugins = tuple(read_plugin(plugin) for plugin in world.all("plugin"))
    return World(world, plugins, tuple(models), tuple(unknown))
