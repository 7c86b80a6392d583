"""The samples of a run as arrays, cut into the legs of its course."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from checker.physics.trial.measures.touches import Touches
from checker.physics.trial.plan import Plan
from checker.physics.trial.simulation.simulation import Run
from checker.physics.trial.trial import Leg

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_SLACK = 1e-6
"""Seconds, for times that are sums of steps."""


@dataclass
class Motion:
    """A run, as measurements need it.

    Attributes:
        time: Seconds (n).
        position: Of the robot's frame, metres (n × 3).
        rotation: Of the robot's frame in the world (n × 3 × 3).
        velocity: Of the origin of the robot's frame in the world, m/s (n × 3).
        spin: In the world, rad/s (n × 3).
        yaw: Heading without jumps, radians (n).
        tilt: Between the robot's z axis and the vertical, radians (n).
        forward: Speed along the robot's x axis, m/s (n).
        contacts: With the ground, sampled more often than the rest.
    """

    run: Run
    plan: Plan
    time: Array = field(init=False)
    position: Array = field(init=False)
    rotation: Array = field(init=False)
    velocity: Array = field(init=False)
    spin: Array = field(init=False)
    yaw: Array = field(init=False)
    tilt: Array = field(init=False)
    forward: Array = field(init=False)
    contacts: Touches = field(init=False)

    def __post_init__(self) -> None:
        import numpy as np

        samples = self.run.samples
        self.time = np.array(samples.time)
        self.position = np.array(samples.position)
        self.rotation = np.array(samples.rotation)
        self.velocity = np.array(samples.velocity)
        self.spin = np.array(samples.spin)
        self.yaw = np.unwrap(np.arctan2(self.rotation[:, 1, 0], self.rotation[:, 0, 0]))
        self.tilt = np.arccos(np.clip(self.rotation[:, 2, 2], -1.0, 1.0))
        self.forward = np.einsum("ij,ij->i", self.velocity, self.rotation[:, :, 0])
        self.contacts = self.run.contacts.touches(self.run.rig)

    def between(self, start: float, end: float) -> slice:
        """Return the samples of a stretch of time, seconds, its end excluded."""
        import numpy as np

        first, behind = np.searchsorted(self.time, (start - _SLACK, end - _SLACK))
        return slice(int(first), int(behind))

    def during(self, leg: Leg) -> slice:
        """Return the samples of a leg."""
        return self.between(leg.start, leg.end)

    def last(self, leg: Leg, seconds: float) -> slice:
        """Return the samples of the end of a leg."""
        return self.between(max(leg.end - seconds, leg.start), leg.end)

    def leg(self, name: str) -> Leg | None:
        """Return a leg that was driven to its end; None without."""
        leg = self.plan.leg(name)
        finished = leg is not None and len(self.time) > 0 and self.time[-1] > leg.end - 0.1
        return leg if finished else None

    def touches(self, leg: Leg, seconds: float) -> Touches:
        """Return the contacts at the end of a leg."""
        return self.contacts.between(max(leg.end - seconds, leg.start) - _SLACK, leg.end - _SLACK)

    @property
    def weight(self) -> float:
        """Newtons."""
        import numpy as np

        return self.run.rig.mass * float(np.linalg.norm(self.run.rig.model.opt.gravity))
