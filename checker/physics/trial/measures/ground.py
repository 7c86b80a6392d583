"""Support of a robot during a period: contact points, loads, belts and wheels."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.physics.trial.measures.motion import Motion
from checker.physics.trial.profile import Knots, value_at
from checker.physics.trial.simulation.contacts import Touches

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Mask = NDArray[np.bool_]


class Footing(Record):
    """Contact points in the robot's frame, averaged over samples.

    Attributes:
        points: x, y in metres (n × 2).
        grip: Largest friction forces along x and along y, N (n × 2).
        slide: Velocity of the surface that touches, against the robot, m/s (n × 2).
    """

    points: Array
    grip: Array
    slide: Array


def loads(touches: Touches) -> dict[str, float]:
    """Return the mean normal force on each link, N."""
    import numpy as np

    total = np.bincount(touches.link, touches.loads, len(touches.names)) / len(touches.time)
    return dict(zip(touches.names, total.tolist(), strict=True))


def drag(motion: Motion, touches: Touches) -> dict[str, float]:
    """Return the largest friction force on each link that slides with the robot's body, N."""
    import numpy as np

    surfaces = _Surfaces(motion, touches)
    moving = {*surfaces.wheels, *surfaces.belts, *surfaces.loose}
    grip = touches.loads * touches.friction.max(axis=1)
    total = np.bincount(touches.link, grip, len(touches.names)) / len(touches.time)
    pairs = zip(touches.names, total.tolist(), strict=True)
    return {name: force for name, force in pairs if force > 0.0 and name not in moving}


def middle(motion: Motion, touches: Touches) -> Array | None:
    """Return the middle of the driven wheels, or of where the belts touch; x, y in metres."""
    import numpy as np

    driven = [wheel.joint for wheel in motion.plan.wheels]
    columns = [number for number, name in enumerate(motion.run.rig.names) if name in driven]
    belts = {belt.link for belt in motion.plan.belts}
    if columns:
        places = touches.anchors[:, columns, :2].reshape(-1, 2)
    else:
        is_belt = np.array([name in belts for name in touches.names])
        places = touches.points[is_belt[touches.link], :2]
    if not len(places):
        return None
    centre: Array = (places.min(axis=0) + places.max(axis=0)) / 2
    return centre


def footing(motion: Motion, touches: Touches) -> Footing:
    """Return what a robot stands on; parts that roll freely hold nothing and are left out.

    A wheel counts as one point, the middle of its loads: across its width it gives way.
    """
    import numpy as np

    surfaces = _Surfaces(motion, touches)
    grip = touches.loads[:, None] * touches.friction / len(touches.time)
    columns = np.column_stack([grip, touches.points[:, :2], surfaces.velocities()])
    holds = (grip.max(axis=1) > 0.0) & ~np.isnan(columns).any(axis=1)
    columns, link = columns[holds], touches.link[holds]
    is_wheel = np.array([name in surfaces.wheels for name in touches.names])
    wheels = [_joined(columns[link == wheel]) for wheel in np.unique(link[is_wheel[link]])]
    columns = np.vstack([columns[~is_wheel[link]], *wheels])
    return Footing(columns[:, 2:4], columns[:, :2], columns[:, 4:])


def _joined(points: Array) -> Array:
    """Return the middle of points by their grip (the first two columns), with all of it."""
    import numpy as np

    grip = points[:, :2]
    most = grip.max(axis=1)
    return np.array([*grip.sum(axis=0), *(most @ points[:, 2:] / most.sum())])


class _Surfaces:
    """Finds how the surface of a link moves against the robot, as it is commanded."""

    def __init__(self, motion: Motion, touches: Touches) -> None:
        self.motion, self.touches = motion, touches
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

    def velocities(self) -> Array:
        """Return velocities in the robot's frame, m/s; NaN for parts that roll freely (k × 2)."""
        import numpy as np

        velocities = np.zeros((len(self.touches.link), 2))
        for number in np.unique(self.touches.link).tolist():
            name, of = self.touches.names[number], self.touches.link == number
            if name in self.wheels:
                velocities[of] = self._of_wheel(*self.wheels[name], of)
            elif name in self.belts:
                belt = self.belts[name]
                velocities[of] = np.outer(
                    self._commands(belt.speed, of), np.negative(belt.forward[:2])
                )
            elif name in self.loose:
                velocities[of] = np.nan
        return velocities

    def _of_wheel(self, joint: int, name: str, of: Mask) -> Array:
        """Return the velocity of a wheel's surface at its contacts: it turns about its axis."""
        import numpy as np

        samples = self.touches.sample[of]
        x, y, z = (self.touches.points[of] - self.touches.anchors[samples, joint]).T
        ax, ay, az = self.touches.axes[samples, joint].T
        rate = self._commands(self.motion.plan.speeds[name], of)
        return np.column_stack([rate * (ay * z - az * y), rate * (az * x - ax * z)])

    def _commands(self, line: Knots, of: Mask) -> Array:
        """Return what is commanded when some contacts were sampled."""
        import numpy as np

        commands = np.array([value_at(line, time) for time in self.touches.time.tolist()])
        return commands[self.touches.sample[of]]
