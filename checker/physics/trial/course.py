"""The course: the commands of a robot, second by second."""

from __future__ import annotations

import math
from collections.abc import Sequence

from checker.physics.trial.profile import Knots, Limits, ramp_to
from checker.physics.trial.trial import Leg

VERSION = "2"
"""The version of the course; it changes when figures of older trials are no longer comparable."""

SETTLE, DRIVE, STOP_DRIVE = "settle", "drive", "stop after drive"
TURN, STOP_TURN, FULL = "turn", "stop after turn", "full speed"
HOVER, CLIMB, HOLD = "hover", "climb", "hold"
MOVE, TOGETHER = "joint by joint", "all joints"

SETTLE_SECONDS = 2.0
DRIVE_SECONDS = 4.0
STOP_SECONDS = 1.5
FULL_SECONDS = 2.0
HOLD_SECONDS = 4.0
HOVER_SECONDS = 4.0
CLIMB_SECONDS = 4.0
CLIMB_METRES = 1.0
CORNERS = 3
"""Moves of the path on which all joints move, the last one back to the start."""

_STEADY_SECONDS = 2.0
"""Time that a leg is driven at constant speed, after the ramp."""
_LONGEST_RAMP = 6.0
"""Seconds that a leg may be longer so that a slow ramp ends."""

_USUAL_SPEED = 1.0
"""m/s or rad/s, where a plugin states no limit."""
_FASTEST = 10.0
"""m/s; nothing on the ground is driven faster."""
_GENTLE = 1.0
"""m/s² (or rad/s²): a tenth of g, which neither slips nor tips, where limits allow more."""


def gentle_speed(fastest: float) -> float:
    """Return the speed of a leg that is not about the limit, m/s or rad/s.

    Args:
        fastest: The velocity limit; inf without.
    """
    usual = fastest if math.isfinite(fastest) else _USUAL_SPEED
    return min(max(0.2, usual / 2), 1.0, usual)


def full_speed(limits: Limits) -> float:
    """Return the speed of the last leg, m/s."""
    return min(limits.fastest if math.isfinite(limits.fastest) else _USUAL_SPEED, _FASTEST)


_NO_LIMITS = Limits()


def driving_legs(
    linear: Limits, turn: tuple[float, float], angular: Limits = _NO_LIMITS
) -> tuple[Leg, ...]:
    """Return the legs of a robot on wheels or tracks.

    Args:
        linear: Limits of the forward motion.
        turn: Forward speed (m/s) and turn rate (rad/s) of the turn.
        angular: Limits of the turning.
    """
    speed = gentle_speed(linear.fastest)
    ramp = _ramp_seconds(speed, linear)
    turn_ramp = max(_ramp_seconds(turn[0], linear), _ramp_seconds(abs(turn[1]), angular))
    plan = (
        (SETTLE, SETTLE_SECONDS, 0.0, 0.0),
        (DRIVE, max(DRIVE_SECONDS, ramp + _STEADY_SECONDS), speed, 0.0),
        (STOP_DRIVE, max(STOP_SECONDS, ramp + 0.5), 0.0, 0.0),
        (TURN, max(DRIVE_SECONDS, turn_ramp + _STEADY_SECONDS), *turn),
        (STOP_TURN, max(STOP_SECONDS, turn_ramp + 0.5), 0.0, 0.0),
        (FULL, FULL_SECONDS, full_speed(linear), 0.0),
    )
    return _one_after_another(plan)


def _ramp_seconds(speed: float, limits: Limits) -> float:
    rate = min(limits.acceleration, _GENTLE)
    return min(speed / rate, _LONGEST_RAMP) if rate > 0.0 else _LONGEST_RAMP


def flying_legs() -> tuple[Leg, ...]:
    """Return the legs of a copter; it hovers one metre above the place where it settled."""
    return _one_after_another(
        (
            (SETTLE, SETTLE_SECONDS, 0.0, 0.0),
            (HOVER, HOVER_SECONDS, 0.0, 0.0),
            (CLIMB, CLIMB_SECONDS, CLIMB_METRES / (CLIMB_SECONDS / 2), 0.0),
        )
    )


def holding_legs() -> tuple[Leg, ...]:
    """Return the legs of a robot that only stands."""
    return _one_after_another(_HOLDING)


_HOLDING = ((SETTLE, SETTLE_SECONDS, 0.0, 0.0), (HOLD, HOLD_SECONDS, 0.0, 0.0))


def moving_legs(seconds: float, together: float) -> tuple[Leg, ...]:
    """Return the legs of a robot whose joints are moved.

    Args:
        seconds: The time in which they move one by one.
        together: The time in which all move at once.
    """
    moving = ((MOVE, seconds, 0.0, 0.0), (TOGETHER, together, 0.0, 0.0))
    return _one_after_another((*_HOLDING, *moving))


def _one_after_another(plan: Sequence[tuple[str, float, float, float]]) -> tuple[Leg, ...]:
    legs: list[Leg] = []
    now = 0.0
    for name, seconds, linear, angular in plan:
        legs.append(Leg(name, now, now + seconds, linear, angular))
        now += seconds
    return tuple(legs)


def linear_command(legs: Sequence[Leg], limits: Limits) -> Knots:
    """Return the forward speed that a plugin with these limits commands, m/s."""
    return ramp_to(((leg.start, leg.end, leg.linear, _rate(leg)) for leg in legs), limits)


def angular_command(legs: Sequence[Leg], limits: Limits) -> Knots:
    """Return the turn rate that a plugin with these limits commands, rad/s."""
    return ramp_to(((leg.start, leg.end, leg.angular, _rate(leg)) for leg in legs), limits)


def _rate(leg: Leg) -> float:
    """Return the greatest acceleration of a leg; at full speed only the plugin limits it."""
    return math.inf if leg.name == FULL else _GENTLE
