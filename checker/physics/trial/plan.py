"""The plan of a trial, as data: the child that simulates needs nothing of the robot."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import field

from checker.base.record import Record
from checker.model.geometry.transform import Vector
from checker.physics.trial.profile import Knots
from checker.physics.trial.trial import Leg


class DrivenWheel(Record):
    """A wheel that a servo turns.

    Attributes:
        joint: Scoped name.
        links: Scoped names of the link below the joint and of those fixed to it.
        radius: Metres, of its collisions; the plugin's where it has none.
        friction: Coefficients along its way and along its axle, where the file states them by
            direction; None if it is the same in all.
        rollers: Angle from its way to the axes of the rollers that touch the ground, rad,
            counter-clockwise from above: friction acts along them alone. None without rollers.
    """

    joint: str
    links: tuple[str, ...]
    radius: float
    friction: tuple[float, float] | None = None
    rollers: float | None = None


class Belt(Record):
    """A link whose surface moves.

    Attributes:
        link: Scoped name.
        forward: Direction in which a positive speed drives, in the robot's frame, of length 1.
        speed: Over time, m/s.
    """

    link: str
    forward: Vector
    speed: Knots


class PlannedRotor(Record):
    """A rotor.

    Attributes:
        link: Scoped name.
        centre: The centre in the robot's frame, metres.
        up: Direction of its thrust in the robot's frame, of length 1.
        spin: 1 counter-clockwise, −1 clockwise, 0 unknown.
        most: Greatest thrust, N.
        gain: Actual thrust / thrust that the controller commands.
        moment: Torque / thrust, metres.
    """

    link: str
    centre: Vector
    up: Vector
    spin: int
    most: float
    gain: float
    moment: float


class Movement(Record):
    """A joint that moves without jerks between the corners of its line in `Plan.places`.

    Attributes:
        leader: Scoped name of the joint that it copies; its own if it copies none.
        step: How far it moves from its start when it moves alone, rad or m.
        reach: How far at most when all joints move.
    """

    leader: str
    step: float
    reach: float


class Plan(Record):
    """The commands of a trial.

    Attributes:
        kind: A value of `DriveKind`.
        legs: The course.
        linear: Commanded forward speed over time, m/s.
        angular: Commanded turn rate over time, rad/s.
        speeds: The speeds of joints by scoped name over time, rad/s.
        places: The places of joints that a stiff servo holds or steers, over time, rad or m.
        moves: The joints among `places` that are moved for their own sake, not to steer wheels.
        starts: Positions in which joints start instead of 0, rad or m.
        wheels: The wheels among `speeds` that stand on the ground.
        belts: What a tracked robot stands on.
        rotors: What carries a copter.
        efforts: Effort limits of joints that are driven, N·m or N.
        limits_act: Whether the simulator keeps joints within them, and within velocity limits.
        speed_limit: m/s; None without.
        acceleration_limit: m/s²; None without.
        turns_in_place: Whether the turn is one in place, not a circle.
        notes: What could not be driven and why, as sentences.
        moved: What moves and by what, as in `Trial`.
        not_driven: The reason why it is not driven, as in `Trial`.
    """

    kind: str
    legs: tuple[Leg, ...]
    linear: Knots = ()
    angular: Knots = ()
    speeds: Mapping[str, Knots] = field(default_factory=dict)
    places: Mapping[str, Knots] = field(default_factory=dict)
    moves: Mapping[str, Movement] = field(default_factory=dict)
    starts: Mapping[str, float] = field(default_factory=dict)
    wheels: tuple[DrivenWheel, ...] = ()
    belts: tuple[Belt, ...] = ()
    rotors: tuple[PlannedRotor, ...] = ()
    efforts: Mapping[str, float] = field(default_factory=dict)
    limits_act: bool = True
    speed_limit: float | None = None
    acceleration_limit: float | None = None
    turns_in_place: bool = True
    notes: tuple[str, ...] = ()
    moved: str = ""
    not_driven: str = ""

    @property
    def seconds(self) -> float:
        """Length of the course, s."""
        return self.legs[-1].end if self.legs else 0.0

    def leg(self, name: str) -> Leg | None:
        """Return a leg of the course; None if it is not driven."""
        return next((leg for leg in self.legs if leg.name == name), None)
