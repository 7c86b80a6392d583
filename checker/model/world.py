"""Worlds: the systems that they load, and the models in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cached_property

from checker.base.record import Record
from checker.base.resources import table
from checker.model.components import Plugin, Sensor
from checker.model.plugin_library import is_of_gazebo, library_stem
from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element, Tagged

DEFAULT_SYSTEMS = frozenset({"physics", "user-commands", "scene-broadcaster"})
"""Plugins that Gazebo loads into a world without plugins, from its server.config."""
EMPTY_SYSTEMS = DEFAULT_SYSTEMS | {"contact"}
"""Plugins of `empty.sdf`, Gazebo's own world; from memory."""
_WITH_POLICIES = ("ionic", "jetty")
_POLICIES = ("gz:policies", "ignition:policies")


class World(Tagged, Record, eq=False, dict=True):
    """A `<world>`.

    Attributes:
        element: The world.
        plugins: Its own, those of windows left out.
        models: Models in it, and those that it includes and that are available.
        unknown: Includes whose model is not available.
    """

    element: Element
    plugins: tuple[Plugin, ...]
    models: tuple[Robot, ...]
    unknown: tuple[Located[str], ...]

    @property
    def name(self) -> str:
        """Its name; empty if it states none."""
        return (self.element.get("name") or "").strip()

    @cached_property
    def systems(self) -> frozenset[str]:
        """Systems that its plugins and those of its models load: `sensors`, `physics`, `imu`."""
        of_models = (plugin for model in self.models for plugin in model.all_plugins)
        plugins = (*self.plugins, *of_models)
        return frozenset(name for plugin in plugins for name in systems_of(plugin))

    def all_systems(self, release: str) -> frozenset[str]:
        """Return the systems that run in it: its own, and those that Gazebo loads by itself."""
        asked = release in _WITH_POLICIES and self.takes_server_plugins
        return self.systems | (DEFAULT_SYSTEMS if asked or not self.plugins else frozenset())

    @property
    def takes_server_plugins(self) -> bool:
        """True if it loads the server's own plugins in addition to its own; from Ionic on."""
        policies = (self.element.child(name) for name in _POLICIES)
        said = (it.child("include_server_config_plugins") for it in policies if it is not None)
        return any(it is not None and it.text.value.lower() in ("1", "true") for it in said)

    @cached_property
    def is_settled(self) -> bool:
        """True if all that it loads is known.

        It names plugins, so that Gazebo adds none; they are Gazebo's own; its models are available.
        """
        stems = (library_stem(plugin.filename.value) for plugin in self.plugins)
        whole = not any(model.missing_parts for model in self.models) and not self.unknown
        return whole and bool(self.plugins) and all(map(is_of_gazebo, stems))

    @cached_property
    def gravity(self) -> tuple[float, ...]:
        """Its acceleration along x, y and z, m/s²; Gazebo's default where it states none."""
        stated = ValueReader().numbers(self.element, "gravity", (0.0, 0.0, -9.8))
        return tuple(each.value for each in stated)

    def sensors(self) -> Iterator[tuple[Robot, Sensor]]:
        """Yield the sensors of its models."""
        for model in self.models:
            for sensor in model.sensors:
                yield model, sensor


def holds(systems: Collection[str], system: str) -> bool:
    """Return whether a system is among others, which are named by library or by class."""
    return system in systems or system.replace("-", "") in systems


def systems_of(plugin: Plugin) -> Iterator[str]:
    """Yield the names of Gazebo's systems that a plugin may be: by its library, by its class."""
    stem = library_stem(plugin.filename.value)
    for prefix in ("gz-sim", "ignition-gazebo"):
        if stem.startswith(prefix) and stem.endswith("-system"):
            yield stem.removeprefix(prefix).lstrip("0123456789").strip("-").removesuffix("-system")
    if "::systems::" in plugin.name.value:
        yield plugin.class_name.lower()


def sensor_system(release: str, sensor: Sensor) -> str:
    """Return the system that a sensor needs in a release; empty for none, or an unknown one."""
    types = table("gazebo_sensors")["releases"].get(release, {"types": ()})["types"]
    wanted = sensor.type.value
    fitting = (entry for entry in types if wanted in entry["spellings"] and entry["simulated"])
    return next((entry["system"] or "" for entry in fitting), "")
