"""A system plugin for models that is attached to the world.

The plugin prints that it should be attached to a model, and has no effect. Drives, joint
controllers, batteries and pose publishers work on the model that contains them.

Fix: move the plugin into the `<model>` or `<include>` that it is for.
Source: `Configure` of these systems in gz-sim; `gazebo_plugins.json` lists them.
"""

from checker.base.resources import table
from checker.model.plugin_library import is_of_gazebo, library_stem
from checker.model.world import World, systems_of
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WLD005", "model-system-in-world", Severity.WARNING, Concern.ROBOT)
def check(world: World) -> Findings:
    """Report the plugins of a world that work on a model."""
    of_models = frozenset(table("gazebo_plugins")["of_models"])
    for plugin in world.plugins:
        stem = library_stem(plugin.filename.value)
        if is_of_gazebo(stem) and of_models.intersection(systems_of(plugin)):
            yield finding(
                plugin,
                f"{plugin.label} has no effect in the world {world.name!r}: it works on the "
                "model that contains it",
            )


def _plugin(library: str, name: str) -> str:
    return f'<plugin filename="{library}" name="gz::sim::systems::{name}"/>'


def _world(plugin: str, more: str = "") -> str:
    return f"""
<sdf version="1.9">
  <world name="hall">
    {plugin}
    <model name="rover">
      <link name="body"/>
      {more}
    </model>
  </world>
</sdf>
"""


_DRIVE = _plugin("gz-sim-diff-drive-system", "DiffDrive")
_MARK = "  <!-- ^ WLD005 -->"
GOOD = [
    _world(_plugin("gz-sim-physics-system", "Physics"), _DRIVE),
    _world('<plugin filename="AcmeDrive" name="acme::DiffDrive"/>'),
]
BAD = [
    _world(_DRIVE + _MARK),
    _world(_plugin("libgz-sim8-pose-publisher-system.so", "PosePublisher") + _MARK),
]
