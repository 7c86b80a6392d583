"""What a robot stands on during a stretch of time: contact points, loads, belts and wheels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from checker.trial.motion import Motion
from checker.trial.profile import value_at
from checker.trial.recording import Touch

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

Flat = tuple[float, float]
"""x and y."""
Point = tuple[float, float, float, float, float]
"""Grip (N), x, y (metres), slide along x and y (m/s)."""


@dataclass(frozen=True)
class Footing:
    """Contact points in the robot's frame, averaged over samples.

    Attributes:
        points: x, y in metres (n × 2).
        grip: Largest friction force, N (n).
        slide: Velocity of the surface that touches, against the robot, m/s (n × 2).
    """

    points: Array
    grip: Array
    slide: Array


def loads(touches: Sequence[Touch]) -> dict[str, float]:
    """Return the mean normal force on each link, N."""
    total: dict[str, float] = {}
    for touch in touches:
        for link, load in zip(touch.links, touch.loads.tolist(), strict=True):
            total[link] = total.get(link, 0.0) + load
    return {link: load / len(touches) for link, load in total.items()}


def middle(motion: Motion, touches: Sequence[Touch]) -> Array | None:
    """Return the middle of the driven wheels, or of where the belts touch; x, y in metres."""
    import numpy as np

    driven = [wheel.joint for wheel in motion.plan.wheels]
    columns = [number for number, name in enumerate(motion.run.rig.names) if name in driven]
    belts = {belt.link for belt in motion.plan.belts}
    if columns:
        places = [touch.anchors[columns, :2] for touch in touches]
    else:
        places = [
            touch.points[[link in belts for link in touch.links], :2]
            for touch in touches
            if touch.links
        ]
    together = np.concatenate(places) if places else np.zeros((0, 2))
    if not len(together):
        return None
    centre: Array = (together.min(axis=0) + together.max(axis=0)) / 2
    return centre


def footing(motion: Motion, touches: Sequence[Touch]) -> Footing:
    """Return what a robot stands on; parts that roll freely hold nothing and are left out.

    A wheel counts as one point, the middle of its loads: across its width it gives way.
    """
    import numpy as np

    surfaces = _Surfaces(motion)
    points: list[Point] = []
    wheels: dict[str, list[Point]] = {}
    for touch in touches:
        grips = (touch.loads * touch.friction / len(touches)).tolist()
        for link, (x, y, z), grip in zip(touch.links, touch.points.tolist(), grips, strict=True):
            slide = surfaces.velocity(link, (x, y, z), touch)
            if slide is not None and grip > 0.0:
                into = wheels.setdefault(link, []) if link in surfaces.wheels else points
                into.append((grip, x, y, *slide))
    points += [_joined(each) for each in wheels.values()]
    columns = np.array(points).reshape(-1, 5)
    return Footing(columns[:, 1:3], columns[:, 0], columns[:, 3:])


def _joined(points: Sequence[Point]) -> Point:
    """Return the middle of points by their grip, with all of it."""
    grip = sum(point[0] for point in points)
    x, y, u, v = (sum(p[0] * p[column] for p in points) / grip for column in range(1, 5))
    return grip, x, y, u, v


class _Surfaces:
    """Finds how the surface of a link moves against the robot, as it is commanded."""

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self.rig = motion.run.rig
        numbers = {name: number for number, name in enumerate(self.rig.names)}
        self.wheels = {
            link: (numbers[wheel.joint], wheel.joint)
            for wheel in motion.plan.wheels
            if wheel.joint in numbers
            for link in wheel.links
        }
        self.belts = {belt.link: belt for belt in motion.plan.belts}
        self.loose = self._loose()

    def _loose(self) -> set[str]:
        """Return the links that a joint without servo lets move."""
        model, scene = self.rig.model, self.rig.scene
        servos = set(self.rig.joints.tolist())
        loose = [False] * model.nbody
        for body in range(1, model.nbody):
            first, count = model.body_jntadr[body], model.body_jntnum[body]
            free = any(
                joint not in servos and model.jnt_type[joint] != 0
                for joint in range(first, first + count)
            )
            loose[body] = free or loose[model.body_parentid[body]]
        return {link for link, body in scene.bodies.items() if loose[model.body(body).id]}

    def velocity(self, link: str, point: Sequence[float], touch: Touch) -> Flat | None:
        """Return a velocity in the robot's frame, m/s; None for a part that rolls freely."""
        if link in self.wheels:
            number, joint = self.wheels[link]
            rate = value_at(self.motion.plan.speeds[joint], touch.time)
            x, y, z = (a - b for a, b in zip(point, touch.anchors[number].tolist(), strict=True))
            ax, ay, az = touch.axes[number].tolist()
            return rate * (ay * z - az * y), rate * (az * x - ax * z)
        if link in self.belts:
            belt = self.belts[link]
            speed = value_at(belt.speed, touch.time)
            return -speed * belt.forward[0], -speed * belt.forward[1]
        return None if link in self.loose else (0.0, 0.0)
