"""A model loads a system that serves a whole world.

Sensors, Imu, Contact, Physics and their like work on the whole world, wherever they are loaded. In
a model they also run for all other models, once for each model that loads them, in addition to
those of the world: two systems publish the same data, or conflict.

Fix: load the system in the world, once.
Source: systems of gz-sim, as listed in `gazebo_plugins.json`; tutorial "Sensors".
"""

from checker.base.resources import table
from checker.model.plugin_library import is_of_gazebo, library_stem
from checker.model.robot import Robot
from checker.model.world import systems_of
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("PLG011", "world-system-in-model", Severity.INFO, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report systems of worlds among the plugins of a robot."""
    of_worlds = frozenset(table("gazebo_plugins")["of_worlds"])
    for plugin in robot.plugins:
        stem = library_stem(plugin.filename.value)
        if is_of_gazebo(stem) and of_worlds.intersection(systems_of(plugin)):
            yield finding(
                plugin,
                f"{plugin.label} serves the whole world: a world that loads it too runs it twice",
                key=plugin.label,
            )


def _plugin(library: str, name: str, mark: str = "") -> dict[str, str]:
    text = f'<plugin filename="{library}" name="{name}"/>{mark}'
    return {"@profile": "gazebo-harmonic", "@fragment": text}


_MARK = "  <!-- ^ PLG011 -->"
GOOD = [
    _plugin("gz-sim-diff-drive-system", "gz::sim::systems::DiffDrive"),
    _plugin("AcmeSensors", "acme::Sensors"),
]
BAD = [
    _plugin("gz-sim-sensors-system", "gz::sim::systems::Sensors", _MARK),
    _plugin("libgz-sim8-imu-system.so", "gz::sim::systems::Imu", _MARK),
]
