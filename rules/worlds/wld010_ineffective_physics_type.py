"""A world that chooses a physics engine by an attribute that Gazebo Sim does not read.

The attribute chose the engine of Gazebo Classic. In Gazebo Sim the world's physics plugin names it,
in `<engine>`; without that, DART is loaded. `ode` is not reported, because most worlds contain it.

Fix: name the library in `<engine><filename>` of the physics plugin, or write `ode`.
Source: gz-sim, SdfEntityCreator.cc and Physics.cc, which do not read the type.
"""

from checker.model.physics_engine import engine_name
from checker.model.world import World
from checker.rule import Concern, Context, Findings, Severity, finding, rule

_OTHERS = ("bullet", "simbody")


@rule("WLD010", "ineffective-physics-type", Severity.INFO, Concern.ROBOT)
def check(world: World, context: Context) -> Findings:
    """Report a type that is not DART's, in a world that names no engine."""
    physics = world.element.child("physics")
    asked = physics.attribute("type") if physics is not None else None
    if asked is None or asked.value not in _OTHERS or not context.is_gazebo_sim:
        return
    if engine_name(world) is None:
        yield finding(
            asked,
            f'<physics type="{asked.value}"> chooses nothing in Gazebo Sim, which loads DART: '
            "expected <engine><filename> in the world's physics plugin",
        )


def _world(physics: str, engine: str = "", profile: str = "gazebo-harmonic") -> dict[str, str]:
    world = f"""<sdf version="1.9">
<world name="hall">
  {physics}
  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics">{engine}</plugin>
</world>
</sdf>
"""
    return {"@fragment": world, "@profile": profile}


_ENGINE = "<engine><filename>gz-physics-bullet-featherstone-plugin</filename></engine>"
GOOD = [
    _world('<physics name="p" type="ode"/>'),
    _world('<physics name="p" type="bullet"/>', _ENGINE),
    _world('<physics name="p" type="bullet"/>', profile="gazebo-classic"),
]
BAD = [
    _world('<physics name="p" type="bullet"/>  <!-- ^ WLD010 -->'),
]
