"""A world whose physics step or real-time factor is not above zero.

At each step Gazebo adds `<max_step_size>` to the time of the world: with zero, time does not
advance and nothing moves; a negative one is not valid. `<real_time_factor>` is the ratio of
simulated to real time: with zero or less, Gazebo has no speed to run at. Gazebo Classic does not
use it: its pace is `<max_step_size>` times `<real_time_update_rate>`.

Fix: state a step above zero, usually 0.001 to 0.004 s, and a factor above zero, usually 1.
Source: gz-sim, SimulationRunner; Gazebo Classic, World (from memory).
"""

from checker.model.values import parse_number
from checker.model.world import World
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.xml import Element

_EFFECTS = {
    "max_step_size": "time does not advance, and nothing moves",
    "real_time_factor": "Gazebo has no speed to run at",
}


@rule("WLD007", "non-positive-physics-step", Severity.WARNING, Concern.ROBOT)
def check(world: World, context: Context) -> Findings:
    """Report steps and factors of the physics in force that are not above zero."""
    physics = _in_force(world)
    for tag, effect in _EFFECTS.items() if physics is not None else ():
        if tag == "real_time_factor" and context.release == "classic":
            continue
        stated = physics.child(tag) if physics is not None else None
        value = parse_number(stated.text.value) if stated is not None else None
        if stated is not None and value is not None and value <= 0:
            yield finding(
                stated.text,
                f"<{tag}> of world {world.name!r} is {value:g}, expected more than 0: {effect}",
            )


def _in_force(world: World) -> Element | None:
    """Return the `<physics>` that states it is the default, else the first."""
    every = [*world.element.all("physics")]
    said = [it for it in every if (it.get("default") or "").lower() in ("1", "true")]
    return next(iter((*said, *every)), None)


def _world(*physics: str) -> str:
    lines = "\n    ".join(physics)
    return f'\n<sdf version="1.9">\n  <world name="hall">\n    {lines}\n  </world>\n</sdf>\n'


def _physics(step: str, factor: str = "1", default: str = "", mark: str = "") -> str:
    stated = f' default="{default}"' if default else ""
    return (
        f'<physics name="p" type="ode"{stated}><max_step_size>{step}</max_step_size>'
        f"<real_time_factor>{factor}</real_time_factor></physics>{mark}"
    )


_MARK = "  <!-- ^ WLD007 -->"
GOOD = [
    _world(),
    _world(_physics("0.001")),
    _world(_physics("0"), _physics("0.001", default="true")),
    {"@profile": "gazebo-classic", "model.sdf": _world(_physics("0.001", "0"))},
]
BAD = [
    _world(_physics("0", mark=_MARK)),
    _world(_physics("-0.001", mark=_MARK)),
    _world(_physics("0.001", "0", mark=_MARK)),
]
