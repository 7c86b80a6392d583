"""Content of the drive plugin: distances from the geometry, limits from the joints."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from statistics import fmean

from lxml import etree
from msgspec.structs import replace

from checker.base.record import Record
from checker.base.resources import table
from checker.convert.xml_writer import number
from checker.migrate.options import MigrationOptions, NotMigrated
from checker.migrate.wheels import Wheels
from checker.migrate.xml_parts import put
from checker.model.locomotion.locomotion import Wheel
from checker.model.locomotion.rotors import GRAVITY
from checker.model.robot import Robot

_STEERING_LIMIT = 0.5
"""Radians, where the steering joints state none."""
_ROUNDED = 6
"""Digits behind the point, of metres."""
LATERAL_COMPLIANCE = 0.172
"""WheelSlip's value in accepted skid-steer robots of SubT."""
_WHEELS_THAT_SLIP = 4


class Drive(Record, eq=False):
    """A DiffDrive or AckermannSteering.

    Attributes:
        wheels: The wheels that it turns.
        separation: The distance between left and right wheels, metres.
        radius: The radius of the wheels, metres.
        max_velocity: m/s.
        max_acceleration: m/s².
        normal_force: The normal force on each wheel of a robot whose wheels slip, N; else None.
        steering: Left and right steering joint; empty for one that does not steer.
        wheel_base: The distance between front and rear wheels, metres.
        kingpin_width: The distance between the steering joints, metres.
        steering_limit: Radians.
        notes: What was decided.
        open_points: What the author should check.
    """

    wheels: Wheels
    separation: float
    radius: float
    max_velocity: float
    max_acceleration: float
    normal_force: float | None = None
    steering: tuple[str, ...] = ()
    wheel_base: float = 0.0
    kingpin_width: float = 0.0
    steering_limit: float = 0.0
    notes: tuple[str, ...] = ()
    open_points: tuple[str, ...] = ()

    @property
    def left(self) -> list[str]:
        """Joints on the left, from front to rear."""
        return [wheel.joint.name.value for wheel in self.wheels.left]

    @property
    def right(self) -> list[str]:
        """Joints on the right."""
        return [wheel.joint.name.value for wheel in self.wheels.right]

    @property
    def slipping(self) -> list[str]:
        """Links of the wheels that slip sideways in a turn."""
        return [wheel.link.name.value for wheel in self.wheels.all] if self.normal_force else []

    @property
    def turning_radius(self) -> float:
        """Turning radius of the rear axle's middle, metres; 0 for one that turns on the spot."""
        return self.wheel_base / math.tan(self.steering_limit) if self.steering else 0.0


def drive_of(robot: Robot, wheels: Wheels, wishes: MigrationOptions) -> Drive:
    """Compute the drive plugin of a robot with wheels.

    Raises:
        NotMigrated: The wheels have no size or are in one place.
    """
    separation = _mean_y(wheels.left) - _mean_y(wheels.right)
    radii = [wheel.radius for wheel in wheels.all if wheel.radius]
    if not radii or not 0.0 < separation < math.inf:
        raise NotMigrated(
            f"the wheels have no size or no distance: left {_places(wheels.left)}, right "
            f"{_places(wheels.right)}; are the sides swapped, or are collisions missing?"
        )
    radius = fmean(radii)
    velocity, why = _velocity(wheels, radius, wishes)
    acceleration = wishes.max_acceleration or _standard()["acceleration_typical"]
    plain = Drive(
        wheels,
        round(separation, _ROUNDED),
        round(radius, _ROUNDED),
        velocity,
        float(acceleration),
        open_points=(
            "limits of the drive (launch/spawner.rb and specifications.md): "
            f"{velocity:g} m/s {why}, {acceleration:g} m/s²",
        ),
    )
    return _steering(robot, plain) if wheels.steering else _skidding(robot, plain)


def _standard() -> dict[str, float]:
    limits = table("subt_standards")["limits_without_validation"]
    return {**limits["ugv"], "acceleration_typical": limits["acceleration_typical"]}


def _velocity(wheels: Wheels, radius: float, wishes: MigrationOptions) -> tuple[float, str]:
    """Return the limit of velocity, m/s, and where it comes from."""
    if wishes.max_velocity is not None:
        return wishes.max_velocity, "from your options"
    rates = [axis.velocity.value for wheel in wheels.all for axis in wheel.joint.axes]
    reachable = min((rate for rate in rates if rate > 0.0), default=math.inf) * radius
    usual = float(_standard()["max_velocity"])
    if reachable >= usual:
        return usual, "SubT's limit without validation"
    return math.floor(reachable * 1000) / 1000, "from the wheels' velocity limits"


def _skidding(robot: Robot, plain: Drive) -> Drive:
    count = len(plain.wheels.all)
    note = f"DiffDrive turns {', '.join((*plain.left, *plain.right))}: {plain.wheels.reason}"
    notes = (
        note,
        f"wheel separation {plain.separation:g} m and radius {plain.radius:g} m from the geometry",
    )
    if count < _WHEELS_THAT_SLIP:
        return replace(plain, notes=notes)
    force = round(robot.mass * GRAVITY / count, 2)
    slip = f"WheelSlip for a skid-steer robot: {force:g} N on each of {count} wheels"
    factor = (
        "skid-steer robots turn as if their track were wider: increase <wheel_separation> in "
        "launch/spawner.rb until the robot reaches the commanded turn rate"
    )
    points = (*plain.open_points, factor)
    return replace(plain, notes=(*notes, slip), normal_force=force, open_points=points)


def _steering(robot: Robot, plain: Drive) -> Drive:
    joints = plain.wheels.steering
    rear = [wheel for wheel in plain.wheels.all if wheel.steering not in joints]
    if not rear:
        raise NotMigrated(
            "every driven wheel is steered, which AckermannSteering does not support; name the "
            "wheels that it drives with --left-wheels and --right-wheels"
        )
    poses = [robot.pose_of_joint(joint) for joint in joints]
    places = [pose.translation for pose in poses if pose is not None]
    if len(places) < len(joints):
        raise NotMigrated(f"joint {joints[0].name.value!r} steers, but its place is not known")
    base = abs(fmean(p[0] for p in places) - fmean(w.centre[0] for w in rear if w.centre))
    limits = [abs(x.value) for j in joints for x in (j.axes[0].lower, j.axes[0].upper)]
    limit = min((angle for angle in limits if 0.0 < angle < math.pi / 2), default=_STEERING_LIMIT)
    names = tuple(joint.name.value for joint in joints)
    assumed = f"the steering joints state no limits: {limit:g} rad is assumed (launch/spawner.rb)"
    points = () if limit in limits else (assumed,)
    note = f"AckermannSteering steers by {', '.join(names)}: {plain.wheels.reason}"
    return replace(
        plain,
        steering=names,
        wheel_base=round(base, _ROUNDED),
        kingpin_width=round(abs(places[0][1] - places[1][1]), _ROUNDED),
        steering_limit=round(limit, _ROUNDED),
        notes=(note, f"wheel base {base:.4g} m, steering up to {limit:.3g} rad"),
        open_points=(*plain.open_points, *points),
    )


def turn_forward(tree: etree._Element, wheels: Wheels) -> list[str]:
    """Turn round the axes of wheels that would roll backwards; return what was done."""
    backwards = {
        wheel.joint.name.value for wheel in wheels.all if wheel.axis and wheel.axis[1] < 0.0
    }
    for joint in tree.iter("joint"):
        if joint.get("name") not in backwards:
            continue
        xyz = joint.find("axis/xyz")
        axis = joint.find("axis")
        if axis is not None and xyz is not None:
            flipped = [number(-float(word)) for word in (xyz.text or "").split()]
            put(axis, "xyz", " ".join(flipped))
    if not backwards:
        return []
    return [
        f"the axes of {', '.join(sorted(backwards))} are reversed, because they pointed backwards"
    ]


def _mean_y(wheels: Sequence[Wheel]) -> float:
    places = [wheel.centre[1] for wheel in wheels if wheel.centre is not None]
    return fmean(places) if places else math.nan


def _places(wheels: Sequence[Wheel]) -> str:
    return ", ".join(_wheel_texts(wheels))


def _wheel_texts(wheels: Sequence[Wheel]) -> Iterator[str]:
    for wheel in wheels:
        at = "unknown" if wheel.centre is None else f"y {wheel.centre[1]:.3g} m"
        size = "no radius" if not wheel.radius else f"radius {wheel.radius:.3g} m"
        yield f"{wheel.joint.name.value} ({at}, {size})"
