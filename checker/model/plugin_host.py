"""Hosts that load plugins: a model, or a world."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.robot import Robot
from checker.model.world import World


class PluginHost(Record, eq=False):
    """A model or a world, as far as plugins are concerned.

    Attributes:
        plugins: Those of a model and its sensors; those of a world and its static models.
        robot: The model; None for a world.
        unread: The reasons why plugins of the model are not among these; else empty.
    """

    plugins: tuple[Plugin, ...]
    robot: Robot | None = None
    unread: str = ""


def model_host(robot: Robot) -> PluginHost:
    """Return a model as what loads its plugins."""
    return PluginHost(robot.all_plugins, robot, robot.unread_plugins)


def world_host(world: World) -> PluginHost:
    """Return a world as what loads its plugins; models that move are separate hosts."""
    of_models = (
        plugin for model in world.models if model.is_static for plugin in model.all_plugins
    )
    return PluginHost((*world.plugins, *of_models))
