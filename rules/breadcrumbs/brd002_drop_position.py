"""Breadcrumbs appear inside the robot or far from it.

Contact forces push a relay that appears inside a body out again, and push the robot too. A relay
that appears far away may be inside a wall. The place is the relay's origin. The rule looks at
collisions. For a mesh it uses the convex hull, which may reach beyond the mesh, so a place in the
hull's outer layer passes.

Fix: choose a `<pose>` just behind the robot.
Source: SubT reviews of breadcrumbs, which require a place outside the robot and at most 0.3 m
behind it (`subt_standards.json`).
"""

import math

from checker.model.breadcrumbs import breadcrumbs
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import Placed, place_shapes, union
from checker.model.geometry.transform import Vector, dot
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_ROUNDING = 1e-9
_AXES: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_SIDES: tuple[Vector, ...] = tuple(
    (x / math.hypot(x, y, z), y / math.hypot(x, y, z), z / math.hypot(x, y, z))
    for x in (-1, 0, 1)
    for y in (-1, 0, 1)
    for z in (-1, 0, 1)
    if x or y or z
)


@rule("BRD002", "drop-position", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot, *, farthest: float = 0.3, depth: float = 0.0, mesh_depth: float = 0.05
) -> Findings:
    """Compare where relays appear with the robot's collisions.

    Options:
        farthest: Greatest horizontal distance, metres, from the box around the robot's collisions
            to where a relay appears; more is reported.
        depth: Metres inside a collision from which a relay is reported; with 0, a relay on the
            surface is reported too.
        mesh_depth: Metres inside the convex hull of a mesh from which a relay is reported.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    plugins = breadcrumbs(robot)
    if plugins and robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    if not plugins:
        return
    shapes = [piece for link in robot.links for piece in place_shapes(robot, link, link.collisions)]
    for plugin in plugins:
        if plugin.drop is None:
            continue
        point = plugin.drop.value
        hits = (
            shape
            for shape in shapes
            if _is_inside(
                robot, shape, point, mesh_depth if shape.shape.geometry.shape == "mesh" else depth
            )
        )
        hit = next(hits, None)
        gap = _gap(union(shape.box for shape in shapes), point)
        if hit is not None:
            yield finding(
                plugin.drop,
                f"breadcrumbs appear at {_words(point)}, inside link {hit.link.name.value!r}: "
                f"expected a place outside the robot, at most {farthest:g} m behind it",
                related=[(hit.shape, "the collision in which they appear")],
            )
        elif robot.unseen_meshes:
            yield unchecked(robot.unseen_meshes[0])
        elif gap is not None and gap > farthest:
            yield finding(
                plugin.drop,
                f"breadcrumbs appear at {_words(point)}, {gap:.2g} m from the robot: "
                f"expected {farthest:g} m or less",
            )


def _is_inside(robot: Robot, piece: Placed, point: Vector, depth: float) -> bool:
    """Return whether a point is inside a shape whose sides are those of robot and shape."""
    own = tuple(piece.pose.rotate(axis) for axis in _AXES)
    sides = (*_SIDES, *own, *((-x, -y, -z) for x, y, z in own))
    return all(piece.support(robot, side) - dot(side, point) >= depth - _ROUNDING for side in sides)


def _gap(box: Box | None, point: Vector) -> float | None:
    """Return the horizontal distance of a point to a box, metres; None without a box."""
    if box is None:
        return None
    x, y = (max(box.low[i] - point[i], point[i] - box.high[i], 0.0) for i in range(2))
    return math.hypot(x, y)


def _words(point: Vector) -> str:
    return "({:g}, {:g}, {:g}) m".format(*point)


def _robot(pose: str) -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <collision name="c"><geometry><box><size>0.6 0.4 0.2</size></box></geometry></collision>
</link>
<plugin filename="libignition-gazebo-breadcrumbs-system.so" name="ignition::Breadcrumbs">
  <breadcrumb>
    <sdf version="1.6">
      <model name="crumb">
        {pose}
      </model>
    </sdf>
  </breadcrumb>
</plugin>
</model>
</sdf>
"""


_MARK = " <!-- ^ BRD002 -->"

GOOD = [
    _robot("<pose>-0.45 0 0 0 0 0</pose>"),
    _robot("<pose>-0.25 0 -0.15 0 0 0</pose>"),
    _robot("<pose>behind</pose>"),
]
BAD = [
    _robot(f"<pose>-0.25 0 0 0 0 0</pose>{_MARK}"),
    _robot(f"<pose>0 0 0.1 0 0 0</pose>{_MARK}"),
    _robot(f"<pose>-0.7 0 0 0 0 0</pose>{_MARK}"),
    _robot("<static>0</static>").replace('name="crumb">', f'name="crumb">{_MARK}'),
]
