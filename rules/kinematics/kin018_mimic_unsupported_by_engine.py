"""A joint that mimics another, with a physics engine that has no mimic constraint.

The two joints are not coupled in the simulation: the second finger of a gripper moves freely,
although RViz shows it following, because robot_state_publisher supports `<mimic>`. DART, the
default engine of Gazebo Sim, has no mimic constraint; Bullet Featherstone has one. URD019 is the
rule for Fortress. Joints that a plugin drives or that are in `<ros2_control>` are not reported:
gz_ros2_control moves the latter.

Fix: in the world's physics plugin write `<engine>` with
`<filename>gz-physics-bullet-featherstone-plugin</filename>` (WLD009 lists what that engine lacks);
or drive the joint with ros2_control or another plugin.
Source: gz-physics, features of dartsim and bullet-featherstone (gz-physics 7, 8, 9), issue 432;
gz-sim, Physics.cc: the default engine; gz_ros2_control issue 340.
"""

from collections.abc import Iterator

from checker.model.components import Joint
from checker.model.robot import Robot
from checker.model.world import World
from checker.ros.engine_uses import EngineUse, engine_uses
from checker.ros.simulation import Simulations
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_SHOWS = ("JointStatePublisher", "PosePublisher")
"""Systems that name joints and move none."""


@rule("KIN018", "mimic-unsupported-by-engine", Severity.WARNING, Concern.ROBOT)
def check(simulations: Simulations | None, world: World | None, context: Context) -> Findings:
    """Report mimicking joints of robots that are spawned, and of models that are in the world."""
    if not context.is_gazebo_sim or context.release == "fortress":
        return
    for use in engine_uses(simulations, world):
        for model in use.models:
            yield from _loose(model, use, context.release)


def _loose(robot: Robot, use: EngineUse, release: str) -> Iterator[Finding]:
    engine = use.engine
    if engine.has_mimic(release) or robot.is_static:
        return
    chosen = " (the default)" if engine.is_default else ""
    for joint in robot.joints:
        leader = next(iter(joint.mimics), None)
        if leader is not None and not joint.immovable and not _is_moved(robot, joint):
            yield finding(
                leader,
                f"joint {joint.name.value!r} mimics {leader.value!r}, but the physics engine "
                f"{engine.title}{chosen} has no such constraint: they move independently; expected "
                "gz-physics-bullet-featherstone-plugin, or a controller for this joint",
                related=use.places,
                key=f"mimic {engine.key}",
            )


def _is_moved(robot: Robot, joint: Joint) -> bool:
    """Return whether a plugin names the joint, or the hardware of ros2_control does."""
    name = joint.name.value
    if joint.scoped_name in robot.driven_joints:
        return True
    controls = robot.element.all("ros2_control")
    if any(it.get("name") == name for control in controls for it in control.all("joint")):
        return True
    return any(
        element.value.strip() == name
        for plugin in robot.plugins
        if plugin.class_name not in _SHOWS
        for element in plugin.element.descendants()
    )


def _world(physics: str, mark: str) -> str:
    return f"""<sdf version="1.11">
<world name="hall">
  <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics">{physics}</plugin>
  <plugin filename="gz-sim-user-commands-system" name="gz::sim::systems::UserCommands"/>
  <model name="gripper">
    <link name="palm"/>
    <link name="left"/>
    <link name="right"/>
    <joint name="left_joint" type="revolute">
      <parent>palm</parent><child>left</child><axis><xyz>0 0 1</xyz></axis>
    </joint>
    <joint name="right_joint" type="revolute">
      <parent>palm</parent><child>right</child>
      <axis><xyz>0 0 1</xyz>
        <mimic joint="left_joint"><multiplier>1</multiplier></mimic>{mark}
      </axis>
    </joint>
  </model>
</world>
</sdf>
"""


_ENGINE = "<engine><filename>gz-physics-bullet-featherstone-plugin</filename></engine>"
_ROBOT = """<robot name="rover">
  <link name="base_link"/>
  <link name="left"/>
  <link name="right"/>
  <joint name="left_joint" type="continuous">
    <parent link="base_link"/><child link="left"/>
  </joint>
  <joint name="right_joint" type="continuous">
    <parent link="base_link"/><child link="right"/>
    <mimic joint="left_joint"/>@
  </joint>
  <gazebo/>
</robot>
"""
_CONTROL = """<ros2_control name="hand" type="system"><joint name="right_joint"/></ros2_control>
  <gazebo/>"""
_DRIVEN = (
    """<gazebo><plugin filename="x" name="acme::Mimic"><to>right_joint</to></plugin></gazebo>"""
)


def _spawned_example(
    mark: str = "", engine: str = "", control: str = "<gazebo/>"
) -> dict[str, object]:
    robot = _ROBOT.replace("@", mark).replace("<gazebo/>", control)
    gazebo = {"-r empty.sdf": f"-r empty.sdf{engine}"}
    changed = {"@launch": gazebo, "urdf/rover.urdf": robot}
    return {"@bridge": True, "@profile": "ros2", **changed}


def _fixed_example(mark: str = "", physics: str = "", profile: str = "gazebo-harmonic") -> object:
    return {"@fragment": _world(physics, mark), "@profile": profile}


_MARK = "  <!-- ^ KIN018 -->"
GOOD = [
    _spawned_example(engine=" --physics-engine gz-physics-bullet-featherstone-plugin"),
    _spawned_example(engine=" --physics-engine acme-physics"),
    _spawned_example(control=_CONTROL),
    _spawned_example(control=_DRIVEN),
    _fixed_example(physics=_ENGINE),
    _fixed_example(profile="gazebo-fortress"),
]
BAD = [_spawned_example(_MARK), _fixed_example(_MARK)]
