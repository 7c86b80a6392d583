"""The figures that a trial yields: what each means, its unit, and the rule that judges it."""

from __future__ import annotations

from checker.base.record import Record


class Measure(Record):
    """What a figure means.

    Attributes:
        label: For tables.
        unit: SI; empty for ratios and counts.
        rule: Id of the rule that judges it; empty for a figure that only informs.
        silence_is_ok: Whether the figure is in order when that rule says nothing.
    """

    label: str
    unit: str = ""
    rule: str = ""
    silence_is_ok: bool = True


MEASURES: dict[str, Measure] = {
    # settle: 2 s without command, from 10 mm above the ground
    "settle_drop": Measure("drop while settling", "m", "TRI002"),
    "settle_rise": Measure("rise while settling", "m", "TRI002"),
    "settle_shift": Measure("sideways move while settling", "m", "TRI002"),
    "settle_tilt": Measure("tilt after settling", "rad", "TRI002"),
    "settle_speed": Measure("speed after settling", "m/s", "TRI002"),
    "rest_penetration": Measure("deepest contact at rest", "m", "TRI002"),
    # drive straight
    "speed_ratio": Measure("speed reached / commanded", "", "TRI003"),
    "path_sideways": Measure("sideways / forward on the straight", "", "TRI004"),
    "path_heading": Measure("heading change on the straight", "rad", "TRI004"),
    "stop_speed": Measure("speed left after a stop", "m/s", "TRI008"),
    "stop_distance": Measure("stopping distance", "m"),
    "tilt_max": Measure("largest tilt", "rad"),
    # turn in place, or a circle with Ackermann steering
    "yaw_rate": Measure("turn rate reached", "rad/s", "TRI005"),
    "yaw_ratio": Measure("turn rate reached / commanded"),
    "yaw_predicted": Measure("turn rate predicted from the contact loads", "rad/s"),
    "yaw_of_predicted": Measure("turn rate reached / predicted", "", "TRI006"),
    "turn_drift": Measure("drift while turning", "m", "TRI018"),
    "turn_drift_explained": Measure("drift that the centre of mass predicts", "m"),
    "com_offset_side": Measure("centre of mass left of the middle of the wheels", "m"),
    "com_offset_front": Measure("centre of mass in front of the middle of the wheels", "m"),
    # full speed
    "full_speed": Measure("speed at full command", "m/s", "TRI014"),
    "full_speed_limit": Measure("velocity limit", "m/s"),
    "full_acceleration": Measure("acceleration at full command", "m/s²", "TRI014"),
    "full_acceleration_limit": Measure("acceleration limit", "m/s²"),
    # wheels, tracks, joints (one figure a part)
    "load_share": Measure("load / equal share", "", "TRI007"),
    "torque": Measure("largest torque, mean over 0.1 s", "N·m", "TRI009"),
    "torque_limit": Measure("effort limit", "N·m"),
    # copters
    "thrust_to_weight": Measure("largest thrust / weight", "", "DRV010"),
    "hover_effort": Measure("largest rotor thrust / its limit in hover", "", "TRI010"),
    "hover_sink": Measure("height lost in hover", "m", "TRI010"),
    "hover_tilt": Measure("tilt in hover", "rad", "TRI010"),
    "climbed": Measure("climb reached / commanded", "", "TRI010"),
    # legged robots, arms, robots without a drive
    "hold_sag": Measure("largest joint deviation in the held pose", "rad or m", "TRI011"),
    "hold_sink": Measure("height lost in the held pose", "m", "TRI011"),
    "hold_tilt": Measure("tilt in the held pose", "rad", "TRI011"),
    # parts against each other (pairs)
    "start_overlap": Measure("parts inside each other at rest", "m", "GEO015", silence_is_ok=False),
    "sweep_overlap": Measure("parts inside each other in a joint's range", "m", "TRI015"),
    "unswept_joints": Measure("joints that were not moved through their range"),
    # energy
    "energy_gain": Measure("energy gained at rest / m·g·0.1 m", "", "TRI017"),
}
