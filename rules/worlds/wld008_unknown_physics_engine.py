"""A world that names a physics engine that its Gazebo release does not have.

Gazebo prints one line, "Failed to find plugin", and continues without physics: nothing falls, and
no joint moves. Bullet Featherstone is available from Harmonic on. Libraries are called
`ignition-physics-…-plugin` in Fortress, and `gz-physics-…-plugin` in all later releases. An engine
that is not Gazebo's own may be built elsewhere, so it is a warning.

Fix: write what the message names, or remove `<engine>` for the default, DART.
Source: gz-sim, Physics.cc; gz-physics, libraries of its releases (`physics_engines.json`).
"""

from checker.base.words import Suggestions
from checker.model.physics_engine import engine_library, engine_name, libraries_of
from checker.model.plugin_library import release_label
from checker.model.world import World
from checker.package.dependencies import available_packages
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Severity, finding, rule

_IN_PLACE = "static://"
"""An engine that is linked into the program."""


@rule("WLD008", "unknown-physics-engine", Severity.WARNING, Concern.ROBOT)
def check(world: World, package: Package, context: Context) -> Findings:
    """Report the library in `<engine>`."""
    name = engine_name(world)
    known = libraries_of(context.release)
    if name is None or not context.is_gazebo_sim or name.value.startswith(_IN_PLACE):
        return
    stem = engine_library(name.value)
    if stem in known or stem in available_packages(package).libraries():
        return
    hint = Suggestions(known).hint(stem) or f"; expected one of {', '.join(known)}"
    yield finding(
        name,
        f"nothing moves: {release_label(context.release)} has no physics engine {stem!r}, and no "
        f"available package builds it{hint}",
    )


def _world(engine: str, mark: str = "", profile: str = "gazebo-harmonic") -> dict[str, str]:
    world = f"""<sdf version="1.9">
<world name="hall">
  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics">
    <engine><filename>{engine}</filename></engine>{mark}
  </plugin>
</world>
</sdf>
"""
    return {"@fragment": world, "@profile": profile}


_MARK = "  <!-- ^ WLD008 -->"
GOOD = [
    _world("gz-physics-bullet-featherstone-plugin"),
    _world("libgz-physics7-tpe-plugin.so"),
    _world("ignition-physics-dartsim-plugin"),
    _world("static://gz::physics::dartsim::Plugin"),
    _world("ignition-physics-tpe-plugin", profile="gazebo-fortress"),
]
BAD = [
    _world("gz-physics-bullet-feathrstone-plugin", _MARK),
    _world("mujoco", _MARK),
    _world("ignition-physics-bullet-featherstone-plugin", _MARK, "gazebo-fortress"),
]
