"""The body of a robot reaches below its wheels or tracks, or is close to the ground.

The robot rests on its body: the wheels do not touch the ground or carry too little load to push.
With little ground clearance, the first bump stops the robot. Usually the wheels are too high in the
body. No accepted package that we checked shows this: the lowest has a clearance of half a wheel's
radius.

Fix: raise or shrink the collision, or lower the wheels.
Source: geometry of collisions in the robot's initial pose.
"""

from collections import Counter

from checker.model.geometry.placed_shapes import Placed, place_shapes
from checker.model.locomotion.rolling_parts import carriers, on_one_axle, rolling_parts
from checker.model.robot import Robot
from checker.model.tree import WORLD
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ball_wheel


@rule("GEO011", "body-below-wheels", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, *, tolerance: float = 0.005, least_clearance: float = 0.25) -> Findings:
    """Report collisions of the body that reach below all wheels or have little clearance.

    Arms, legs and other moving parts may reach down. A robot with one axle needs something else to
    stand on, such as a caster, and is skipped. What swivels with a wheel of its own, as a fork
    does, may be near the ground, but not below the wheels.

    Options:
        tolerance: Metres that a collision may reach below the lowest point of wheels and tracks
            before it is an error.
        least_clearance: Clearance below a collision as a share of the largest wheel's radius, or of
            half a track's height; less is a warning.
    """
    parts = rolling_parts(robot)
    if not parts or on_one_axle(parts):
        return
    ground = min(part.box.low[2] for part in parts)
    radius = max(part.box.high[2] - part.box.low[2] for part in parts) / 2
    rolling = {link.scoped_name for part in parts for link in part.links}
    bodies = robot.tree.rigid_bodies
    carrying = {bodies.of_link[name] for name in carriers(robot, parts)}
    forks = _forks(robot, rolling)
    for link in robot.tree.links.values():
        name = link.scoped_name
        if name in rolling or bodies.of_link[name] not in carrying:
            continue
        for piece in place_shapes(robot, link, link.collisions):
            clearance = piece.box.low[2] - ground
            if clearance >= -tolerance and bodies.of_link[name] in forks:
                continue
            # What reaches below the wheels by no more than the tolerance has no room at all.
            if clearance < -tolerance or max(clearance, 0.0) < least_clearance * radius:
                yield _finding(piece, clearance, least_clearance * radius, tolerance)


def _forks(robot: Robot, rolling: set[str]) -> set[str]:
    """Return the rigid bodies that move on a joint of their own and carry one wheel."""
    bodies = robot.tree.rigid_bodies
    ties = [it for it in robot.tree.ties if it.joint.type.value != "fixed" and it.parent != WORLD]
    wheels = Counter(bodies.of_link[it.parent] for it in ties if it.child in rolling)
    return {body for it in ties if wheels[body := bodies.of_link[it.child]] == 1}


def _finding(piece: Placed, clearance: float, expected: float, tolerance: float) -> Finding:
    what = f"collision {piece.shape.name.value!r} of {piece.link.name.value!r}"
    if clearance < -tolerance:
        message = f"{what} reaches {-clearance * 1e3:.3g} mm below the wheels"
        return finding(piece.shape.pose, message)
    return finding(
        piece.shape.pose,
        f"{what} leaves {max(clearance, 0.0) * 1e3:.3g} mm to the ground under the wheels, "
        f"expected {expected * 1e3:.3g} mm or more",
        severity=Severity.WARNING,
    )


_FORK = """
<link name="fork">
  <collision name="tip">
    <pose>-0.3 0 {z} 0 0 0</pose>{mark}
    <geometry><box><size>0.1 0.02 0.1</size></box></geometry>
  </collision>
</link>
<joint name="swivel" type="revolute"><parent>base_link</parent><child>fork</child></joint>
"""


def _caster(z: float, mark: str = "") -> str:
    """Return a rover whose third wheel is that of a caster."""
    wheel = ball_wheel("caster_wheel", -0.3, 0.0).replace("base_link", "fork")
    return _rover(0.0, rear=False, more=f"{_FORK.format(z=z, mark=mark)}{wheel}")


def _rover(
    z: float, mark: str = "", link: str = "base_link", rear: bool = True, more: str = ""
) -> str:
    ends = (("front", 0.3), ("rear", -0.3)) if rear else (("front", 0.0),)
    sides = (("left", 0.2), ("right", -0.2))
    wheels = "".join(ball_wheel(f"{end}_{side}", x, y) for end, x in ends for side, y in sides)
    joints = "".join(
        f"<{side}_joint>{end}_{side}_axle</{side}_joint>" for end, _ in ends for side, _ in sides
    )
    body = f"""
<link name="{link}">
  <collision name="belly">
    <pose>0 0 {z} 0 0 0</pose>{mark}
    <geometry><box><size>0.2 0.2 0.1</size></box></geometry>
  </collision>
</link>
"""
    base = '<link name="base_link"/>' if link != "base_link" else ""
    arm = """
<joint name="shoulder" type="revolute"><parent>base_link</parent><child>arm</child></joint>
"""
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
{base}{body}{wheels}{more}{arm if link == "arm" else ""}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">{joints}</plugin>
</model>
</sdf>
"""


_MARK = "  <!-- ^ GEO011 -->"
GOOD = [
    _rover(0.0),
    _rover(-0.02),
    _rover(-0.2, link="arm"),
    _rover(-0.07, rear=False),
    _caster(-0.04),
]
BAD = [_rover(-0.08, _MARK), _rover(-0.04, _MARK), _caster(-0.08, _MARK)]
