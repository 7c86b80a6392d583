"""An arm that nothing fixes to the world, on a base that cannot carry it.

Gazebo puts a robot on the ground, and nothing but its weight holds it there. The real arm is
screwed to a table. In simulation it falls over at once, or when it stretches out.

Meant are robots without wheels, drive, legs, rotors and thrusters, whose root link carries one
chain of joints. They are reported if the centre of mass of the robot with its arm stretched out
level is beyond the edge of the base: an arm with a wide or heavy base stands.

Fix: add `<link name="world"/>` (URDF) and a joint of the type `fixed` from `world` to the root
link.
Source: statics; the conversion of URDF to SDF in sdformat and Gazebo Classic, where a fixed joint
to `world` fixes the robot; ros_gz_sim, `create`, and gazebo_ros, `spawn_entity.py`: a spawned robot
is free to move.
"""

from __future__ import annotations

from collections.abc import Iterator

from checker.finding import Fix, Safety
from checker.model.components import Joint
from checker.model.geometry.placed_shapes import union
from checker.model.locomotion.drive import body_velocity
from checker.model.locomotion.legs import looks_legged
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.physics.mass.arm_loads import load_bounds
from checker.physics.mass.link_geometry import known_box, unknown_mesh
from checker.physics.mass.mass_properties import MassProperties
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.xml_insertion import append_to

_HINGES = ("revolute", "continuous")
_UPRIGHT = 0.7
"""Part along z of an axis that is nearer to upright than to level: it does not lift the arm."""
_IN_WATER = ("thruster", "buoyan", "hydrodynamic")
"""Parts of the names of plugins that carry or push a robot in water."""


@rule("KIN021", "arm-not-fixed-to-world", Severity.WARNING, Concern.ROBOT)
def check(masses: MassProperties, simulations: Simulations | None, *, hinges: int = 2) -> Findings:
    """Report arms that are free to fall over, at their root link.

    Options:
        hinges: Revolute and continuous joints in a row that lift an arm, at least, before the first
            link that carries several moving parts, such as fingers. A camera's pan and tilt has
            one.
    """
    robot = masses.robot
    is_spawned = simulations is not None and bool(simulations.given(robot))
    root = _loose_root(robot) if is_spawned or robot.is_for_gazebo else ""
    chain = _chain(robot, root) if root else ()
    lifting = [it for it in chain if it.type.value in _HINGES and _lifts(robot, it)]
    if len(lifting) < hinges or _may_move(robot) or not masses.standing <= robot.tree.base:
        return
    unknown = robot.unweighed or robot.unplaced_part or _unknown_base(robot)
    if unknown:
        yield unchecked(unknown)
        return
    moment, weight = load_bounds(masses, "", 0.0).get(lifting[0], 0.0), robot.gravity * masses.mass
    edge = _half_width(robot)
    if moment > edge * weight:
        yield finding(
            robot.tree.links[root],
            f"nothing fixes {root!r} to the world, so the arm falls over in Gazebo: stretched out, "
            f"the centre of mass of the robot is {moment / weight:.2g} m from joint "
            f"{lifting[0].name.value!r}, and its base reaches {edge:.2g} m; write "
            f"{_expected(robot, root)}",
            fix=_fixed(robot, root),
            covered_by=("INE016",),
        )


def _loose_root(robot: Robot) -> str:
    """Return the root link of a robot that nothing holds; empty if it is held, or has several."""
    tree = robot.tree
    roots = [name for name in tree.links if name not in tree.ties_above]
    is_held = robot.is_static or any(tie.parent == WORLD for tie in tree.ties)
    return "" if len(roots) != 1 or is_held or robot.shown_only else roots[0]


def _may_move(robot: Robot) -> bool:
    """Return whether a robot may move from its place, so that no base has to carry it."""
    moves = robot.drives or robot.flies or robot.balances or any(map(_carries, _names(robot)))
    return bool(moves or any(map(body_velocity, robot.plugins)) or looks_legged(robot))


def _names(robot: Robot) -> Iterator[str]:
    for plugin in robot.all_plugins:
        yield f"{plugin.filename.value} {plugin.class_name}".lower()


def _carries(name: str) -> bool:
    return any(word in name for word in _IN_WATER)


def _chain(robot: Robot, root: str) -> Iterator[Joint]:
    """Yield the moving joints from the root on, up to a body that carries several or none."""
    bodies = robot.tree.rigid_bodies
    moving: dict[str, list[Tie]] = {}
    for tie in robot.tree.ties:
        if tie.joint.type.value != "fixed" and tie.parent != WORLD:
            moving.setdefault(bodies.of_link[tie.parent], []).append(tie)
    body, seen = bodies.of_link[root], set[str]()
    while body not in seen and len(moving.get(body, ())) == 1:
        seen.add(body)
        tie = moving[body][0]
        yield tie.joint
        body = bodies.of_link[tie.child]


def _lifts(robot: Robot, joint: Joint) -> bool:
    axis = robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
    return axis is not None and abs(axis[2]) < _UPRIGHT


def _unknown_base(robot: Robot) -> str:
    reasons = (unknown_mesh(robot, robot.tree.links[name]) for name in robot.tree.base)
    return next(filter(None, reasons), "")


def _half_width(robot: Robot) -> float:
    """Return half of the larger level side of the box around the base, metres; 0 without shapes."""
    boxes = [known_box(robot, robot.tree.links[name]) for name in robot.tree.base]
    box = union([box for box in boxes if box is not None])
    return max(box.high[i] - box.low[i] for i in (0, 1)) / 2 if box is not None else 0.0


def _expected(robot: Robot, root: str) -> str:
    joint = f"a fixed joint from world to {root}"
    return f'<link name="world"/> and {joint}' if robot.conventions.is_urdf else joint


def _fixed(robot: Robot, root: str) -> Fix | None:
    """Return the fix that adds link and joint; None where xacro puts the name together."""
    if robot.tree.links[root].element.written.get("name") != root:
        return None
    parent, child = f"<parent>{WORLD}</parent>", f"<child>{root}</child>"
    lines = []
    if robot.conventions.is_urdf:
        parent, child = f'<parent link="{WORLD}"/>', f'<child link="{root}"/>'
        lines = [f'<link name="{WORLD}"/>']
    lines += [f'<joint name="{WORLD}_to_{root}" type="fixed">', f"  {parent}", f"  {child}"]
    return Fix(Safety.UNSAFE, (append_to(robot.element, [*lines, "</joint>"]),))


_URDF = """<robot name="picker">{world}
  <link name="pedestal">{mark}
    {inertial}
    <collision><geometry><box size="{width} 0.14 0.1"/></geometry></collision>
  </link>
  {links}
  <gazebo><plugin filename="gz_ros2_control-system" name="p"/></gazebo>
</robot>
"""
_INERTIAL = (
    '<inertial><origin xyz="{x} 0 0"/><mass value="{mass}"/>'
    '<inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>'
)
_LINK = """<link name="part_{number}">
    {inertial}
    <collision><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.05 0.05"/></geometry></collision>
  </link>
  <joint name="turn_{number}" type="revolute">
    <parent link="{parent}"/><child link="part_{number}"/><origin xyz="{x} 0 {z}"/>
    <axis xyz="{axis}"/><limit lower="-2" upper="2" effort="90" velocity="1"/>
  </joint>
"""
_WORLD = """
  <link name="world"/>
  <joint name="stand" type="fixed"><parent link="world"/><child link="pedestal"/></joint>"""
_MARK = "  <!-- ^ KIN021 -->"


def _arm(joints: int = 4, width: float = 0.2, mass: int = 3, **more: str) -> dict[str, object]:
    links = "".join(
        _LINK.format(
            number=number,
            parent=f"part_{number - 1}" if number else "pedestal",
            x=0.2 if number > 1 else 0,
            z=0 if number else 0.2,
            axis="0 1 0" if number else "0 0 1",
            inertial=_INERTIAL.format(x=0.1, mass=1.5),
        )
        for number in range(joints)
    )
    inertial = _INERTIAL.format(x=0, mass=mass)
    texts = {"world": "", "mark": "", **more}
    urdf = _URDF.format(links=links, width=width, inertial=inertial, **texts)
    return {"@urdf": True, "@profile": "gazebo-harmonic", "urdf/picker.urdf": urdf}


GOOD = [
    _arm(world=_WORLD),
    _arm(2),
    _arm(width=0.9),
    _arm(mass=60),
]
BAD = [_arm(mark=_MARK), _arm(3, mass=1, mark=_MARK), _arm(6, mass=12, mark=_MARK)]
