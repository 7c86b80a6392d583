"""How fast a robot turns when its wheels slip: a quasi-static balance of Coulomb friction.

While it turns steadily, the friction forces at the contact points and their moments add up to
nothing. The twist (vx, vy, ω) for which they do makes the power of friction Σ grip·|slip| least:
the sum is convex, so Newton's method finds it, made smooth by less and less.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.trial.ground import Footing

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_SMOOTHING = (1e-1, 1e-2, 1e-3, 1e-4)
"""m/s below which slip counts as creep, one after the other."""
_ROUNDS = 60
_ENOUGH = 1e-10


def predicted_twist(footing: Footing) -> Array | None:
    """Return vx, vy (m/s, of the robot's frame) and ω (rad/s); None if nothing holds it."""
    import numpy as np

    if not footing.grip.sum() > 0.0:
        return None
    # Lengths near 1 make the Newton steps well scaled.
    arm = max(float(np.abs(footing.points).max()), 1e-6)
    x, y = footing.points.T / arm
    ones, none = np.ones_like(x), np.zeros_like(x)
    # slip = jacobian · twist + slide, with ω in m/s at the arm.
    jacobian = np.stack([np.stack([ones, none, -y], 1), np.stack([none, ones, x], 1)], 1)
    grip = footing.grip / footing.grip.sum()
    twist = np.zeros(3)
    for creep in _SMOOTHING:
        twist = _least_power(jacobian, footing.slide, grip, twist, creep)
    twist[2] /= arm
    return twist if np.isfinite(twist).all() else None


def _least_power(jacobian: Array, slide: Array, grip: Array, twist: Array, creep: float) -> Array:
    """Return the twist of least friction power, by Newton's method with a line search."""
    import numpy as np

    def power(at: Array) -> float:
        slip = jacobian @ at + slide
        return float(grip @ np.sqrt((slip**2).sum(axis=1) + creep**2))

    now = power(twist)
    for _ in range(_ROUNDS):
        slip = jacobian @ twist + slide
        size = np.sqrt((slip**2).sum(axis=1) + creep**2)
        unit = slip / size[:, None]
        turned = jacobian.transpose(0, 2, 1)
        gradient = grip @ (turned @ unit[:, :, None])[:, :, 0]
        across = np.eye(2) - unit[:, :, None] * unit[:, None, :]
        curvature = ((grip / size)[:, None, None] * (turned @ across @ jacobian)).sum(axis=0)
        move = np.linalg.lstsq(curvature, -gradient, rcond=1e-12)[0]
        if -float(gradient @ move) < _ENOUGH * creep:
            break
        share = 1.0
        while share > 1e-6 and power(twist + share * move) > now + 1e-4 * share * gradient @ move:
            share /= 2
        twist = twist + share * move
        now = power(twist)
    return twist
