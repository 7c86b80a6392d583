"""Names in a scene: generated, since those of robots may be empty, repeated or of any form."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from checker.model.geometry.transform import Rotation, Transform

# Numbers as MJCF writes them: never one that is not finite, never one that loses digits.


FAR = 1e6
"""Metres beyond which a place counts as a slip: sums of squares must stay exact to 1 mm."""
LARGEST = 1e12
"""Greatest mass, moment or stiffness in SI units; beyond it products in a mass matrix overflow."""

Quaternion = tuple[float, float, float, float]


def usable(value: float, largest: float = LARGEST) -> bool:
    """Return whether a number may be in a model: finite and not beyond a bound."""
    return abs(value) <= largest


def clamp(value: float, low: float, high: float, default: float) -> float:
    """Return a number within bounds; the default for NaN."""
    return default if math.isnan(value) else min(max(value, low), high)


def numbers(values: Iterable[float]) -> str:
    """Return numbers so that reading them gives the same bits."""
    return " ".join(repr(float(value)) for value in values)


def pose_attributes(pose: Transform) -> str:
    """Return the attributes that pose a body or geom."""
    return f'pos="{numbers(pose.translation)}" quat="{numbers(quaternion(pose.rotation))}"'


def is_finite_pose(pose: Transform) -> bool:
    """Return whether a pose is of finite numbers, within `FAR`."""
    turns = [number for row in pose.rotation for number in row]
    return all(usable(number, FAR) for number in pose.translation) and all(
        map(math.isfinite, turns)
    )


def quaternion(rotation: Rotation) -> Quaternion:
    """Return w, x, y, z of a rotation (Shepperd's method: divides by the largest of the four)."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation
    rows = (
        (1 + xx + yy + zz, zy - yz, xz - zx, yx - xy),
        (zy - yz, 1 + xx - yy - zz, xy + yx, xz + zx),
        (xz - zx, xy + yx, 1 - xx + yy - zz, yz + zy),
        (yx - xy, xz + zx, yz + zy, 1 - xx - yy + zz),
    )
    best = max(range(4), key=lambda i: rows[i][i])
    length = math.hypot(*rows[best])
    w, x, y, z = (number / length for number in rows[best])
    return (w, x, y, z)


@dataclass
class Names:
    """The names of the parts of a robot in its scene.

    Attributes:
        bodies: Link to body.
        joints: Joint to MuJoCo's joint of its first axis; that of a second has `_2` behind.
        free: Link that has no parent to its free joint.
        geoms: Geom to link.
        actuators: Joint to actuator.
        belts: Link to the geoms that can have a surface velocity.
        balls: Joints that neither turn about one axis nor slide.
    """

    bodies: dict[str, str] = field(default_factory=dict)
    joints: dict[str, str] = field(default_factory=dict)
    free: dict[str, str] = field(default_factory=dict)
    geoms: dict[str, str] = field(default_factory=dict)
    actuators: dict[str, str] = field(default_factory=dict)
    belts: dict[str, tuple[str, ...]] = field(default_factory=dict)
    balls: set[str] = field(default_factory=set)

    _joints: int = 0

    def body(self, link: str) -> str:
        """Name the body of a link."""
        return self.bodies.setdefault(link, f"b{len(self.bodies)}")

    def joint(self, joint: str, *, ball: bool) -> str:
        """Name a joint; of two with one name, the robot's name leads to the first."""
        name = f"j{self._joints}"
        self._joints += 1
        if ball:
            self.balls.add(joint)
        self.joints.setdefault(joint, name)
        return name

    def free_joint(self, link: str) -> str:
        """Name the free joint of a link that has no parent."""
        return self.free.setdefault(link, f"f{len(self.free)}")

    def geom(self, link: str) -> str:
        """Name a geom of a link."""
        name = f"g{len(self.geoms)}"
        self.geoms[name] = link
        return name
