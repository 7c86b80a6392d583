"""Measures the wheels that a drive plugin names: where they are, and how large."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Joint, Link, Plugin
from checker.model.geometry.placed_shapes import Placed, place_shapes
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector
from checker.model.locomotion.locomotion import Side, Wheel
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.model.robot import Robot


# The collision that a wheel rolls on, and whether it stands as the wheel turns.


_ROUND = ("cylinder", "capsule", "cone")
"""Shapes that are round about their own z axis and nothing else."""
ASKEW = math.radians(1)
"""Least angle at which a wheel's collision counts as turned, not as of another size."""


def wheel_shapes(robot: Robot, wheel: Wheel) -> list[Placed]:
    """Return the collisions of a wheel whose extent is known."""
    return [piece for link in wheel.body for piece in place_shapes(robot, link, link.collisions)]


def tread(robot: Robot, wheel: Wheel) -> Placed | None:
    """Return the collision that a wheel rolls on: the largest; None if none is known."""
    return max(wheel_shapes(robot, wheel), key=lambda piece: piece.box.diagonal, default=None)


def angle_to_axle(wheel: Wheel, rolls: Placed) -> float | None:
    """Return the angle between the axis of a shape and that of a wheel's joint, 0…π/2 rad.

    None if one of them has no axis: a sphere or box, a joint whose axis is not known.
    """
    if wheel.axis is None or rolls.shape.geometry.shape not in _ROUND:
        return None
    along = rolls.pose.rotate((0.0, 0.0, 1.0))
    cosine = abs(sum(a * b for a, b in zip(along, wheel.axis, strict=True)))
    return math.acos(min(cosine, 1.0)) if math.isfinite(cosine) else None


def is_misaligned(robot: Robot, wheel: Wheel) -> bool:
    """Return whether a wheel's tread stands across its joint: its reach then states nothing."""
    rolls = tread(robot, wheel)
    angle = angle_to_axle(wheel, rolls) if rolls is not None else None
    return angle is not None and angle > ASKEW


_DIRECTIONS = 16
"""Across the axis, in which the reach of a wheel is measured; for a cylinder one would do."""
_FARTHEST = 1e6
"""Metres; what reaches farther has no size that could be used."""


class WheelReader:
    """Finds the wheels of a robot by the joints that plugins name."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.child_of = {tie.joint: tie.child for tie in robot.tree.ties}
        self.parent_of = {tie.joint: tie.parent for tie in robot.tree.ties}
        self.fixed: dict[str, list[str]] = {}
        for tie in robot.tree.ties:
            if tie.joint.type.value == "fixed" and tie.parent != tie.child:
                self.fixed.setdefault(tie.parent, []).append(tie.child)
        self.body_of: dict[str, str] = {}
        self.measured: dict[Joint, _Measured] = {}

    def read(
        self,
        plugin: Plugin,
        name: Located[str],
        side: Side,
        knuckles: Mapping[str, Joint],
    ) -> Wheel | None:
        """Return the wheel below a joint; None if there is no such joint or no link below.

        Args:
            plugin: What names the joint: one of the model that contains the plugin.
            name: The name of the joint.
            side: What the plugin states.
            knuckles: Steering joints by the link that each of them turns.
        """
        joint = self.robot.joints_by_name.get(plugin.scoped(name.value))
        link = self.robot.links_by_name.get(self.child_of.get(joint, "")) if joint else None
        if joint is None or link is None:
            return None
        return self._wheel(joint, link, name, side, knuckles)

    def wheel_below(
        self,
        joint: Joint,
        side: Side,
        knuckles: Mapping[str, Joint],
        name: Located[str] | None = None,
    ) -> Wheel | None:
        """Return the wheel below a joint that no plugin names; None if no link is below.

        Args:
            joint: The joint of the robot.
            side: The side that it is on.
            knuckles: Steering joints by the link that each of them turns.
            name: What a controller calls it; the joint's own name when None.
        """
        link = self.robot.links_by_name.get(self.child_of.get(joint, ""))
        if link is None:
            return None
        return self._wheel(joint, link, name or joint.name, side, knuckles)

    def _wheel(
        self,
        joint: Joint,
        link: Link,
        name: Located[str],
        side: Side,
        knuckles: Mapping[str, Joint],
    ) -> Wheel:
        if joint not in self.measured:
            self.measured[joint] = self._measure(joint, link)
        known = self.measured[joint]
        steering = knuckles.get(self.parent_of[joint])
        return Wheel(
            name,
            joint,
            link,
            known.body,
            side,
            known.centre,
            known.axis,
            known.radius,
            known.width,
            steering,
        )

    def knuckles(self, steering: Iterable[Joint]) -> dict[str, Joint]:
        """Return steering joints by the scoped name of the link that each of them turns."""
        return {self.child_of[joint]: joint for joint in steering if joint in self.child_of}

    def _measure(self, joint: Joint, link: Link) -> _Measured:
        pose = self.robot.pose_of_joint(joint)
        centre = None if pose is None else pose.translation
        if centre is not None and not all(map(math.isfinite, centre)):
            centre = None
        axis = self.robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
        body = self._body(link)
        if centre is None or axis is None:
            return _Measured(body, centre, axis)
        return _Measured(body, centre, axis, *self._size(body, centre, axis))

    def _body(self, link: Link) -> tuple[Link, ...]:
        """Return a link and those that fixed joints tie below it, unless another wheel has them."""
        top = link.scoped_name
        links, waiting = [link], list(self.fixed.get(top, ()))
        self.body_of.setdefault(top, top)
        while waiting:
            name = waiting.pop()
            if name not in self.body_of:
                self.body_of[name] = top
                links.append(self.robot.links_by_name[name])
                waiting += self.fixed.get(name, ())
        return tuple(links)

    def _size(
        self, body: Iterable[Link], centre: Vector, axis: Vector
    ) -> tuple[float | None, float | None]:
        """Return reach across the axis and extent along it, metres; None without collisions."""
        x, y, z = axis
        directions = (*perpendicular_directions(axis), axis, (-x, -y, -z))
        reaches = []
        for link in body:
            for shape in link.collisions:
                pose = self.robot.pose_of_part(link, shape.pose)
                if pose is None:
                    continue
                known = [self._reach(shape.geometry, pose, d, centre) for d in directions]
                reach = [distance for distance in known if distance is not None]
                if len(reach) == len(directions):
                    reaches.append(reach)
        if not reaches:
            return None, None
        width = max(reach[-2] for reach in reaches) + max(reach[-1] for reach in reaches)
        return max(max(reach[:-2]) for reach in reaches), width

    def _reach(
        self, geometry: Geometry, pose: Transform, direction: Vector, centre: Vector
    ) -> float | None:
        far = self.robot.support_of(geometry, pose, direction)
        if far is None:
            return None
        reach = far - sum(a * b for a, b in zip(direction, centre, strict=True))
        return reach if abs(reach) < _FARTHEST else None


class _Measured(Record, eq=False):
    body: tuple[Link, ...]
    centre: Vector | None
    axis: Vector | None
    radius: float | None = None
    width: float | None = None


def perpendicular_directions(axis: Vector) -> list[Vector]:
    """Return directions of length 1 around an axis of length 1."""
    x, y, z = axis
    # The least component gives the direction that is least parallel to the axis.
    least = min(range(3), key=lambda i: abs(axis[i]))
    other = tuple(1.0 if i == least else 0.0 for i in range(3))
    u = _normal(_cross((x, y, z), (other[0], other[1], other[2])))
    v = _cross((x, y, z), u)
    around = []
    for step in range(_DIRECTIONS):
        angle = 2 * math.pi * step / _DIRECTIONS
        c, s = math.cos(angle), math.sin(angle)
        around.append((c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2]))
    return around


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _normal(a: Vector) -> Vector:
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length)
