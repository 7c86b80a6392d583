"""A world whose own plugins replace the default systems of Gazebo.

As soon as a world names one plugin, Gazebo does not load physics, user commands and the scene
broadcaster any more: nothing moves, nothing can be spawned, or the window stays empty. A world
whose models have neither joints nor collisions, such as a camera alone, needs no physics: an info.
From Ionic on, a world can load both with `<gz:policies>`.

Fix: name the missing plugin as well.
Source: gz-sim, `SimulationRunner::LoadServerPlugins` and server.config.
"""

from checker.model.robot import Robot
from checker.model.world import World, holds
from checker.rule import Concern, Context, Findings, Severity, finding, rule

_DEFAULTS = {
    "physics": "nothing moves",
    "user-commands": "no robot can be spawned",
    "scene-broadcaster": "windows and visualizers show nothing",
}
_LESS = {"scene-broadcaster": Severity.INFO}
"""Lower severities for systems that a server without windows does not need."""


@rule("WLD002", "default-systems-lost", Severity.WARNING, Concern.INTERFACE)
def check(world: World, context: Context) -> Findings:
    """Report the usual systems that a list of plugins leaves out."""
    if not world.plugins:
        return
    loaded = world.all_systems(context.release)
    for system, without in _DEFAULTS.items():
        if holds(loaded, system):
            continue
        yield finding(
            world,
            f"world {world.name!r} names plugins, but not {system}, so Gazebo does not load it: "
            f"{without}",
            severity=_severity(world, system),
            key=f"{world.name} {system}",
            related=[(world.plugins[0], "from this plugin on, only those named here are loaded")],
        )


def _severity(world: World, system: str) -> Severity | None:
    """Return the severity; of physics, whether a model in the world needs it now."""
    loose = [model for model in world.models if not model.is_static]
    if system != "physics" or not loose:
        return _LESS.get(system)
    # A camera without body and joint waits to be moved.
    return Severity.ERROR if any(map(_has_body_or_joint, loose)) else Severity.INFO


def _has_body_or_joint(model: Robot) -> bool:
    return bool(model.joints) or any(link.collisions for link in model.links)


def _world(plugins: str, mark: str = "") -> str:
    return f"""
<sdf version="1.9">
  <world name="hall">{mark}
    {plugins}
    <model name="box"><link name="body"/></model>
  </world>
</sdf>
"""


def _plugin(system: str, name: str) -> str:
    return f'<plugin filename="gz-sim-{system}-system" name="gz::sim::systems::{name}"/>'


_PHYSICS = _plugin("physics", "Physics")
_OTHERS = _plugin("user-commands", "UserCommands") + _plugin(
    "scene-broadcaster", "SceneBroadcaster"
)
GOOD = [
    _world(""),
    _world(_PHYSICS + _OTHERS),
    _world('<gui><plugin filename="MinimalScene" name="3D View"/></gui>'),
]
BAD = [
    _world(_OTHERS, "  <!-- ^ WLD002 -->"),
    _world(_PHYSICS, "  <!-- ^ WLD002 -->"),
]
