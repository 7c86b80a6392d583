"""A robot as a scene of MuJoCo: MJCF text, and the names by which its parts are found in it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain

from msgspec import field

from checker.base.record import Record
from checker.model.geometry.transform import Transform
from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.model.tree import WORLD, canonical_link
from checker.physics.trial.mjcf.layout import BodyWriter, Layout
from checker.physics.trial.mjcf.names import Names, numbers, quaternion
from checker.physics.trial.mjcf.repairs import Ledger
from checker.physics.trial.trial import Repair

# What of a robot a trial is about: whether there can be one, whose pose counts, what can move.


_UNSEEN = (
    *(MeshTrouble.NOT_LOOKED_AT, MeshTrouble.UNSUPPORTED, MeshTrouble.MISSCALED),
    *(MeshTrouble.MISSING, MeshTrouble.POINTER),
)
"""Kinds of unread collision meshes: without such a mesh, the trial would be of another robot."""


def unusable_because(robot: Robot, layout: Layout, servos: Sequence[str]) -> str:
    """Return why no trial is possible, as the end of a sentence; empty if one is.

    What does not stand on the ground needs no shape, where servos move its joints.
    """
    if robot.missing_parts:
        return robot.missing_parts
    if not robot.links:
        return "the robot has no links"
    if robot.is_static:
        return "the robot is static"
    for link in robot.links:
        for collision in link.collisions:
            mesh = robot.mesh_of(collision)
            if isinstance(mesh, MeshFault) and mesh.trouble in _UNSEEN:
                uri = collision.geometry.uri
                return f"{uri.value if uri else 'a mesh'} {mesh.reason}"
    mounted = not layout.stands or layout.held
    if not any(layout.geoms.values()) and not (mounted and servos):
        return "the robot has no collision shape that can be used"
    return ""


def root_of(robot: Robot, layout: Layout) -> str:
    """Return the link whose pose is the robot's: the one that carries most of its mass.

    Of a robot in one piece, that is the link that all others are connected to.
    """
    tree = layout.forest
    canonical = canonical_link(robot)

    def weight(top: str) -> tuple[float, bool]:
        mass = sum(layout.inertias[name].mass for name in tree.under(top))
        return mass, top == canonical

    return max(tree.tops, key=weight)


def swept_joints(robot: Robot, joints: Iterable[str]) -> tuple[str, ...]:
    """Return the joints that move something other than a wheel, track or rotor."""
    spinning = {wheel.joint.scoped_name for wheel in robot.locomotion.wheels}
    spinning |= {rotor.joint.scoped_name for rotor in robot.locomotion.rotors if rotor.joint}
    wheels = {wheel.scoped_name for wheel in robot.wheels}
    spinning |= {tie.joint.scoped_name for tie in robot.tree.ties if tie.child in wheels}
    return tuple(name for name in joints if name not in spinning)


Pair = tuple[str, str]

GROUND = "ground"
"""Name of the ground's geom."""
TRACKED = 200
"""Links whose motion is kept; of a robot with more of them, none is."""
DROP = 0.01
"""Metres between the lowest collision point and the ground at the start."""


class Scene(Record):
    """The robot as MJCF text, with the names by which its parts are found in it.

    Each body's frame is its link's; at the start all joints are at 0, as the file poses the links.

    Attributes:
        mjcf: Needs no files. The ground is the geom `ground`, at z = 0.
        bodies: Scoped name of a link to its body.
        joints: Scoped name of a joint to MuJoCo's joint of its first axis (the second has `_2`
            behind); joints that are held fixed have none.
        free_joints: Scoped name of a link that has no parent to its free joint.
        geoms: Geom to the scoped name of its link.
        actuators: Scoped name of a joint to its actuator, a velocity servo of gain 1.
        belts: Scoped name of a link to its geoms that can have a surface velocity. Its direction is
            the *geom's*: turn one given in the link's frame by the inverse of `geom_quat`.
        welded: Scoped name of a link to that of the link that it moves with; `world` for one that
            is fixed to the world.
        tied: Pairs of such links (or `world`) that a joint lets move against each other.
        swept: Scoped names of joints to move through their ranges.
        repairs: What had to be changed.
        notes: What was left out, as sentences.
        root: Scoped name of the link whose pose is the robot's.
        root_in_robot: Position (metres) and quaternion (w, x, y, z) of that link in the robot's
            frame at the start.
        spawn_height: z of the robot's frame at the start, metres.
        unusable: The reason why no trial is possible, as the end of a sentence; empty if one is.
    """

    mjcf: str = ""
    bodies: Mapping[str, str] = field(default_factory=dict)
    joints: Mapping[str, str] = field(default_factory=dict)
    free_joints: Mapping[str, str] = field(default_factory=dict)
    geoms: Mapping[str, str] = field(default_factory=dict)
    actuators: Mapping[str, str] = field(default_factory=dict)
    belts: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    welded: Mapping[str, str] = field(default_factory=dict)
    tied: tuple[Pair, ...] = ()
    swept: tuple[str, ...] = ()
    repairs: tuple[Repair, ...] = ()
    notes: tuple[str, ...] = ()
    root: str = ""
    root_in_robot: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
    spawn_height: float = 0.0
    unusable: str = ""


def build_scene(
    robot: Robot,
    *,
    servos: Sequence[str] = (),
    belts: Sequence[str] = (),
    timestep: float = 0.002,
) -> Scene:
    """Write the scene of a robot.

    Args:
        robot: Its joints stand at 0.
        servos: Scoped names of joints that get a velocity servo; its gain is set at run time.
        belts: Scoped names of links whose surface moves.
        timestep: Seconds.
    """
    layout = Layout(robot)
    ledger = layout.ledger
    unusable = unusable_because(robot, layout, servos)
    if unusable:
        return Scene(repairs=tuple(ledger.repairs), notes=ledger.notes, unusable=unusable)
    height = DROP - layout.lowest
    # Nothing states how high what is mounted stands: an arm on a table reaches below its base.
    touches = layout.stands and not layout.held
    if not layout.stands:
        # What a joint fixes to the world stays in its place; of URDF the node that spawns it may
        # have put it on a table, so that it is lifted out of the ground.
        touches = robot.conventions.states_start
        height = 0.0 if touches else max(0.0, height)
    writer = BodyWriter(layout, frozenset(belts))
    bodies, names, root = writer.text(height), writer.names, root_of(robot, layout)
    return Scene(
        mjcf=_document(
            f'timestep="{timestep!r}" gravity="0 0 {-robot.gravity!r}"',
            _assets(layout),
            bodies,
            _servos(names, servos, ledger),
            touches=touches,
        ),
        bodies=names.bodies,
        joints=names.joints,
        free_joints=names.free,
        geoms=names.geoms,
        actuators=names.actuators,
        belts=names.belts,
        welded=layout.welded,
        tied=layout.jointed_pairs,
        swept=swept_joints(robot, names.joints),
        repairs=tuple(ledger.repairs),
        notes=ledger.notes,
        root=root,
        root_in_robot=_seven(layout.poses[root]),
        spawn_height=height,
    )


def _servos(names: Names, servos: Sequence[str], ledger: Ledger) -> str:
    """Write the actuators and name them."""
    lines = []
    for joint in dict.fromkeys(servos):
        if joint in names.joints and joint not in names.balls:
            actuator = names.actuators.setdefault(joint, f"a{len(names.actuators)}")
            lines.append(f'<velocity name="{actuator}" joint="{names.joints[joint]}" kv="1"/>')
        else:
            ledger.note("Driven joints neither turn nor slide", joint)
    return "\n".join(lines)


def _assets(layout: Layout) -> str:
    # Shells, for MuJoCo refuses thin solids; what shapes weigh is never taken from them.
    return "\n".join(
        f'<mesh name="{name}" inertia="shell" vertex="{numbers(chain.from_iterable(points))}"/>'
        for name, points in layout.hulls.items()
    )


def _document(options: str, assets: str, bodies: str, servos: str, *, touches: bool) -> str:
    # The ground takes part in every contact, and geoms of the robot in those with the ground alone.
    return f"""<mujoco>
<compiler angle="radian" inertiafromgeom="false" autolimits="false" fusestatic="false"/>
<option {options} integrator="discrete" cone="elliptic" impratio="10"/>
<size memory="64M"/>
<asset>
{assets}
</asset>
<worldbody>
<geom name="{GROUND}" type="plane" size="0 0 1" priority="0" contype="{touches:d}" conaffinity="0"/>
{bodies}
</worldbody>
<actuator>
{servos}
</actuator>
</mujoco>
"""


def _seven(pose: Transform) -> tuple[float, ...]:
    return (*pose.translation, *quaternion(pose.rotation))


def carriers_of(scene: Scene) -> dict[str, str]:
    """Return the link that carries each link, by scoped names; itself for one that moves.

    What is fixed to the world is carried by the first such link. Nothing of a robot with more than
    `TRACKED` moving links.
    """
    fixed = next((name for name, base in scene.welded.items() if base == WORLD != name), WORLD)
    carriers = {
        name: fixed if base == WORLD else base
        for name, base in scene.welded.items()
        if name != WORLD
    }
    return carriers if len(set(carriers.values())) <= TRACKED else {}
