"""A model with a part that the world's chosen physics engine cannot simulate.

DART, which Gazebo Sim loads by itself, does what most models need. Other engines, for example
Bullet Featherstone for `<mimic>`, lack features: only DART has heightmaps, wheel slip and tracks,
Bullet has few joint types, and TPE none. Bullet Featherstone moves only one tree of links of a
model, and reads `<friction><bullet>`, not `<ode>`, to which `<mu1>` of a URDF is converted. Gazebo
prints this at most in its debug output.

Fix: use DART, or what the message names.
Source: gz-physics, features of each engine, and gz-sim, Physics.cc (`physics_engines.json`).
"""

from collections.abc import Iterator

from checker.base.record import Record
from checker.formats.friction import FrictionReader
from checker.model.robot import Robot
from checker.model.world import World, holds, systems_of
from checker.ros.engine_uses import EngineUse, engine_uses
from checker.ros.simulation import Simulations
from checker.rule import Concern, Context, Findings, Severity, Where, finding, rule

_DART = "expected the default engine, DART"


class _Loss(Record, eq=False):
    """A part that an engine ignores.

    Attributes:
        kind: Losses of one kind are one finding with several places.
        part: What it is.
        effect: The effect, and what to do.
        severity: None for the rule's own.
    """

    kind: str
    part: Where
    effect: str
    severity: Severity | None = None


@rule("WLD009", "engine-lacks-feature", Severity.WARNING, Concern.ROBOT)
def check(simulations: Simulations | None, world: World | None, context: Context) -> Findings:
    """Report what the engines that worlds and launch files name ignore."""
    if not context.is_gazebo_sim:
        return
    for use in engine_uses(simulations, world):
        for model in use.models if use.engine.lacks else ():
            for loss in _losses(model, use):
                yield finding(
                    loss.part,
                    f"physics engine {use.engine.title} {loss.effect}",
                    severity=loss.severity,
                    related=use.places,
                    key=f"{use.engine.key} {loss.kind}",
                )


def _losses(model: Robot, use: EngineUse) -> Iterator[_Loss]:
    yield from _shapes(model, use.engine.lacks.get("shapes", ()))
    if model.is_static:
        return
    yield from _joints(model, use.engine.lacks.get("joints", ()))
    yield from _systems(model, use.engine.lacks.get("systems", ()))
    if "trees" in use.engine.lacks:
        yield from _trees(model)
    if "ode_friction" in use.engine.lacks:
        yield from _friction(model)


def _shapes(model: Robot, lacking: list[str]) -> Iterator[_Loss]:
    for link in model.links:
        for collision in link.collisions:
            shape = collision.geometry.shape
            if shape in lacking:
                effect = f"has no <{shape}>, so robots fall through {link.name.value!r}: {_DART}"
                yield _Loss(shape, collision.geometry, effect, Severity.ERROR)


def _joints(model: Robot, lacking: list[str]) -> Iterator[_Loss]:
    for joint in model.joints:
        kind = joint.type.value
        if joint.parent.value == "world" and kind == "fixed":
            continue
        is_urdf = model.conventions.is_urdf
        of_sdf = "revolute" if kind == "continuous" and is_urdf else kind
        if "*" in lacking or of_sdf in lacking:
            effect = f"has no joint of type {kind!r}, such as {joint.name.value!r}: {_DART}"
            yield _Loss("joint", joint.type, effect)


def _systems(model: Robot, lacking: list[str]) -> Iterator[_Loss]:
    for plugin in model.all_plugins:
        systems = frozenset(systems_of(plugin))
        if any(holds(systems, system) for system in lacking):
            yield _Loss("plugin", plugin, f"lacks a feature that {plugin.label} needs: {_DART}")


def _trees(model: Robot) -> Iterator[_Loss]:
    groups = model.tree.groups
    if len(groups) > 1:
        link = model.links_by_name[groups[1][0]]
        effect = (
            "moves one tree of links of a model, and disables the others: no joint connects "
            f"{link.name.value!r} to {groups[0][0]!r}"
        )
        yield _Loss("tree", link, effect, Severity.ERROR)


def _friction(model: Robot) -> Iterator[_Loss]:
    reader = FrictionReader(model)
    for link in model.links:
        for collision in link.collisions[:1]:
            if collision.element.child("surface", "friction", "bullet") is not None:
                continue
            stated = reader.friction_of(link, collision).first
            if stated is not None and stated.value != 1.0:
                effect = (
                    f"takes 1 as the friction of {link.name.value!r}, not {stated.value:g}: it "
                    "reads <friction><bullet><friction> of SDF alone"
                )
                yield _Loss("friction", stated, effect)


def _world(engine: str, model: str, profile: str = "gazebo-harmonic") -> dict[str, str]:
    world = f"""<sdf version="1.9">
<world name="hall">
  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics">
    <engine><filename>{engine}</filename></engine>
  </plugin>
  <plugin filename="gz-sim-user-commands-system" name="gz::sim::systems::UserCommands"/>
  <model name="rover">
    {model}
  </model>
</world>
</sdf>
"""
    return {"@fragment": world, "@profile": profile}


def _ground(mark: str = "") -> str:
    return f"""<static>true</static><link name="l"><collision name="c"><geometry>
    <heightmap><uri>a.png</uri></heightmap>{mark}
    </geometry></collision></link>"""


def _slide(engine: str, mark: str = "") -> str:
    return f"""<link name="l"><collision name="c"><geometry><box><size>1 1 1</size></box></geometry>
    <surface><friction><{engine}>
    <mu>0.2</mu>{mark}
    </{engine}></friction></surface></collision></link>"""


def _two(joint: str, mark: str = "", joint_mark: str = "") -> str:
    tied = f"""<joint name="j" type="{joint}">{joint_mark}
    <parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>"""
    return f"""<link name="a"/>
    <link name="b"/>{mark}
    {tied if joint else ""}"""


def _slip(mark: str = "") -> str:
    slip = '<plugin filename="gz-sim-wheel-slip-system" name="gz::sim::systems::WheelSlip"/>'
    return f'<link name="a"/>\n{slip}{mark}'


_SPAWNED = """<robot name="rover">
  <link name="base_link"><collision><geometry><sphere radius="1"/></geometry></collision></link>
  <gazebo reference="base_link">
    <mu1>0.1</mu1>@
  </gazebo>
</robot>
"""


def _example(mark: str = "", engine: str = "") -> dict[str, object]:
    gazebo = {"-r empty.sdf": f"-r empty.sdf{engine}"}
    robot = _SPAWNED.replace("@", mark)
    return {"@bridge": True, "@profile": "ros2", "@launch": gazebo, "urdf/rover.urdf": robot}


_MARK = "  <!-- ^ WLD009 -->"
_FEATHERSTONE = "gz-physics-bullet-featherstone-plugin"
GOOD = [
    _world("gz-physics-dartsim-plugin", _ground()),
    _world("acme-physics-plugin", _ground()),
    _world(_FEATHERSTONE, _slide("bullet")),
    _world(_FEATHERSTONE, _two("prismatic")),
    _world("gz-physics-dartsim-plugin", _slip()),
    _example(),
]
BAD = [
    _world(_FEATHERSTONE, _ground(_MARK)),
    _world(_FEATHERSTONE, _slide("ode", _MARK)),
    _world(_FEATHERSTONE, _two("", _MARK)),
    _world(_FEATHERSTONE, _slip(_MARK)),
    _world("ignition-physics-bullet-plugin", _two("prismatic", "", _MARK), "gazebo-fortress"),
    _world("gz-physics-tpe-plugin", _two("revolute", "", _MARK)),
    _example(_MARK, f" --physics-engine {_FEATHERSTONE}"),
]
