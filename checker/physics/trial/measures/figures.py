"""The figures that a trial yields: their meanings and units. Rules name those they judge."""

from __future__ import annotations

from checker.base.record import Record


class Measure(Record):
    """Meaning of a measure.

    Attributes:
        label: The label for tables.
        unit: SI; empty for ratios and counts.
        silence_is_ok: Whether the figure is in order when the rule that judges it reports nothing.
    """

    label: str
    unit: str = ""
    silence_is_ok: bool = True


MEASURES: dict[str, Measure] = {
    # settle: 2 s without command, from 10 mm above the ground
    "settle_drop": Measure("drop while settling", "m"),
    "settle_rise": Measure("rise while settling", "m"),
    "settle_shift": Measure("sideways move while settling", "m"),
    "settle_tilt": Measure("tilt after settling", "rad"),
    "settle_speed": Measure("speed after settling", "m/s"),
    "rest_penetration": Measure("deepest contact at rest", "m"),
    # drive straight
    "speed_ratio": Measure("speed reached / commanded"),
    "path_sideways": Measure("sideways / forward on the straight"),
    "path_heading": Measure("heading change on the straight", "rad"),
    "stop_speed": Measure("speed left after a stop", "m/s"),
    "stop_distance": Measure("stopping distance", "m"),
    "tilt_max": Measure("largest tilt", "rad"),
    # turn in place, or a circle with Ackermann steering
    "yaw_rate": Measure("turn rate reached", "rad/s"),
    "yaw_ratio": Measure("turn rate reached / commanded"),
    "yaw_predicted": Measure("turn rate predicted from the contact loads", "rad/s"),
    "yaw_of_predicted": Measure("turn rate reached / predicted"),
    "turn_drift": Measure("drift while turning", "m"),
    "turn_drift_explained": Measure("drift that the centre of mass predicts", "m"),
    "com_offset_side": Measure("centre of mass left of the middle of the wheels", "m"),
    "com_offset_front": Measure("centre of mass in front of the middle of the wheels", "m"),
    # full speed
    "full_speed": Measure("speed at full command", "m/s"),
    "full_speed_limit": Measure("velocity limit", "m/s"),
    "full_acceleration": Measure("acceleration at full command", "m/s²"),
    "full_acceleration_limit": Measure("acceleration limit", "m/s²"),
    # wheels, tracks, joints (one figure a part)
    "load_share": Measure("load / equal share"),
    "drag": Measure("friction of what slides / weight"),
    "torque": Measure("largest torque, mean over 0.1 s", "N·m"),
    "torque_limit": Measure("effort limit", "N·m"),
    # copters
    "thrust_to_weight": Measure("largest thrust / weight"),
    "hover_effort": Measure("largest rotor thrust / its limit in hover"),
    "hover_sink": Measure("height lost in hover", "m"),
    "hover_tilt": Measure("tilt in hover", "rad"),
    "climbed": Measure("climb reached / commanded"),
    # legged robots, arms, robots without a drive
    "hold_sag": Measure("largest joint deviation in the held pose", "rad or m"),
    "hold_sink": Measure("height lost in the held pose", "m"),
    "hold_tilt": Measure("tilt in the held pose", "rad"),
    # joints that controllers move (one figure a joint): alone, and all together
    "move_step": Measure("way of a joint moved alone", "rad or m"),
    "move_error": Measure("largest distance of a joint from its path", "rad or m"),
    "move_torque": Measure("largest torque that its path needs", "N·m"),
    # parts against each other (pairs)
    "start_overlap": Measure("parts inside each other at rest", "m", silence_is_ok=False),
    "sweep_overlap": Measure("parts inside each other in a joint's range", "m"),
    "path_overlap": Measure("parts inside each other while all joints move", "m"),
    "unswept_joints": Measure("joints that were not moved through their range"),
    # energy
    "energy_gain": Measure("energy gained at rest / m·g·0.1 m"),
}
