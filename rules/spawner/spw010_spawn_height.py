"""A robot that starts in the ground, or far above it.

If the robot starts in the ground, contact forces throw it into the air. If it drops from a height,
it bounces, tips over or loses its pose estimate before the first command.

No accepted package that we checked has this fault.

Fix: write a height into `<pose>` that puts the lowest point of the wheels just above the ground:
`#{_z + 0.2}` for wheels that reach 0.19 m below the model's origin.
Source: SubT review findings. Legged robots start high and lower themselves, so they are skipped.
"""

from collections.abc import Iterator

from checker.launch.spawner.emitted_xml import SpawnedXml
from checker.launch.spawner.reader import SPAWNER_ARGUMENTS
from checker.model.components import Collision, Link
from checker.model.locomotion.legs import is_legged
from checker.model.mesh import MeshFault
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Span

DOWN = (0.0, 0.0, -1.0)
GROUND = SPAWNER_ARGUMENTS[5]
"""Value of `_z` with which the spawner is evaluated, metres."""


@rule("SPW010", "spawn-height", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot, spawned: SpawnedXml, *, deepest: float = 0.005, highest: float = 0.3
) -> Findings:
    """Compare the lowest point of the robot's collisions with the ground.

    Options:
        deepest: Metres that the lowest point of the collisions may start below the ground; more is
            reported.
        highest: Metres that the lowest point of the collisions may start above the ground; more is
            reported.
    """
    if is_legged(robot):
        return
    poses = [pose for spawn in spawned.spawns if (pose := spawn.child("pose")) is not None]
    depths = [depth for depth in _depths(robot) if depth is not None]
    for pose in poses:
        height = _height(pose.text_span, spawned)
        if height is None:
            continue
        clearance = height - max(depths, default=0.0)
        if depths and clearance < -deepest:
            yield finding(
                pose.text,
                f"the robot starts {-clearance:.3g} m in the ground, expected it above the ground",
            )
        elif (unknown := _unknown_shape(robot)) is not None:
            yield unchecked(f"the spawn height depends on {unknown}")
        elif depths and clearance > highest:
            yield finding(
                pose.text,
                f"the robot starts {clearance:.3g} m above the ground, "
                f"expected at most {highest:g} m",
            )


def _height(pose: Span, spawned: SpawnedXml) -> float | None:
    """Return how far above `_z` a pose is; None if it does not depend on `_z`."""
    words = spawned.words_of(pose)
    if len(words) != len("xyzrpy") or not spawned.parameters_of(words[2]):
        return None
    try:
        return float(words[2].text) - float(GROUND or 0.0)
    except ValueError:
        return None


def _depths(robot: Robot) -> Iterator[float | None]:
    """Yield how far each collision reaches below the robot's origin, metres."""
    for link in robot.links:
        for collision in link.collisions:
            yield _depth(robot, link, collision)


def _depth(robot: Robot, link: Link, collision: Collision) -> float | None:
    pose = robot.pose_of_part(link, collision.pose)
    return robot.support_of(collision.geometry, pose, DOWN) if pose is not None else None


def _unknown_shape(robot: Robot) -> str | None:
    """Return which shape of unknown size may reach lowest, and why it is unknown.

    If the robot has wheels, only theirs count, because they reach lowest.
    """
    wheels = [wheel for wheel in robot.wheels if wheel.collisions]
    for link in wheels or robot.links:
        for collision in link.collisions:
            shape = collision.geometry.shape
            if shape in ("mesh", "polyline") and _depth(robot, link, collision) is None:
                mesh = robot.mesh_of(collision)
                why = f", which {mesh.reason}" if isinstance(mesh, MeshFault) else ""
                uri = collision.geometry.uri
                return f"{uri.value if uri is not None else f'a {shape}'}{why}"
    return None


def _spawner(z: str, mark: str = "") -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}">
      <pose>#{{_x}} #{{_y}} {z} #{{_roll}} #{{_pitch}} #{{_yaw}}</pose> {mark}
    </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_MARK = "<!-- ^ SPW010 -->"
_BALL = """
<link name="ball">
  <pose>0 0 -0.1 0 0 0</pose>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
"""

_MESH = """
<link name="foot"><collision name="c">
  <geometry><mesh><uri>meshes/foot.obj</uri><scale>1 1 0.2</scale></mesh></geometry>
</collision></link>
"""
_PYRAMID = """v 0 0 -1
v 0.1 0 0
v 0 0.1 0
v -0.1 -0.1 0
f 1 2 3
f 1 3 4
f 1 4 2
f 2 4 3
"""

GOOD = [
    {"@fragment": _BALL, "launch/spawner.rb": _spawner("#{_z + 0.2}")},
    {"@fragment": _BALL, "launch/spawner.rb": _spawner("#{_z + 0.45}")},
    {"launch/spawner.rb": _spawner("#{_z + 9}")},
    {
        "@fragment": _MESH,
        "meshes/foot.obj": _PYRAMID,
        "launch/spawner.rb": _spawner("#{_z + 0.2}"),
    },
]
BAD = [
    {
        "@fragment": _MESH,
        "meshes/foot.obj": _PYRAMID,
        "launch/spawner.rb": _spawner("#{_z + 0.1}", _MARK),
    },
    {"@fragment": _BALL, "launch/spawner.rb": _spawner("#{_z}", _MARK)},
    {"@fragment": _BALL, "launch/spawner.rb": _spawner("#{_z + 2}", _MARK)},
]
