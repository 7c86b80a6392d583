"""Locomotion of a robot: wheels, tracks and rotors of its drive plugins, in SI units."""

from __future__ import annotations

import enum

from checker.base.record import Record
from checker.model.components import Joint, Link, Plugin
from checker.model.controllers import Controller
from checker.model.geometry.transform import Vector
from checker.source.text import Located, Span


class DriveKind(enum.StrEnum):
    """The way a robot moves, as reports state it."""

    DIFFERENTIAL = "differential drive"
    SKID_STEER = "skid-steer drive"
    ACKERMANN = "Ackermann steering"
    MECANUM = "Mecanum drive"
    OMNI = "omni-wheel drive"
    TRACKED = "tracks"
    MULTICOPTER = "multicopter"
    LEGGED = "legs"
    NONE = "no drive detected"


class Side(enum.StrEnum):
    """Side of a wheel or track, as its plugin states it."""

    LEFT = "left"
    RIGHT = "right"


class MotionLimits(Record, eq=False):
    """Limits of one kind of motion of a plugin; None if it states none.

    Velocities in m/s or rad/s, accelerations in m/s² or rad/s². A multicopter's limits are the
    same both ways: its minima are the negated maxima.

    Attributes:
        holder: The plugin, or the element in it, that holds or should hold them.
    """

    holder: Span
    min_velocity: Located[float] | None = None
    max_velocity: Located[float] | None = None
    min_acceleration: Located[float] | None = None
    max_acceleration: Located[float] | None = None

    @property
    def complete(self) -> bool:
        """True if all four are stated."""
        four = (
            self.min_velocity,
            self.max_velocity,
            self.min_acceleration,
            self.max_acceleration,
        )
        return None not in four


class Wheel(Record, eq=False):
    """A wheel that a plugin turns.

    Attributes:
        name: The joint as the plugin names it.
        joint: The joint that turns it.
        link: The joint's child.
        body: `link` and the links fixed to it: their collisions are the wheel's.
        side: What the plugin states.
        centre: Origin of the joint in the robot's frame, metres; None if unknown.
        axis: Direction of the joint's axis in the robot's frame, of length 1; None if unknown.
        radius: Reach of its collisions across the axis, metres; None if no collision or no
            axis is known.
        width: Extent of its collisions along the axis, metres; likewise.
        steering: The joint that steers it; None for a wheel that does not steer.
        is_reversed: Whether the drive turns it against its axis, as diff_drive_controller does with
            a negative multiplier of its radius.
    """

    name: Located[str]
    joint: Joint
    link: Link
    body: tuple[Link, ...]
    side: Side
    centre: Vector | None
    axis: Vector | None
    radius: float | None
    width: float | None
    steering: Joint | None = None
    is_reversed: bool = False

    @property
    def forward_axis(self) -> Vector | None:
        """Direction about which it turns when the robot is to drive forward; None if unknown."""
        if self.axis is None or not self.is_reversed:
            return self.axis
        x, y, z = self.axis
        return -x, -y, -z


class WheelDrive(Record, eq=False):
    """One DiffDrive, AckermannSteering or MecanumDrive plugin, or one of Gazebo Classic.

    A controller of ros2_control that drives wheels is one too.

    Attributes:
        plugin: The plugin of Gazebo, or the controller.
        wheels: The wheels that the plugin drives, in its order; joints that do not exist are left
            out, one named for both sides stands there twice.
        wheel_separation: Metres; the plugin's default (`stated` false) where it states none.
        wheel_radius: Metres; likewise.
        wheel_base: Metres, of Ackermann steering.
        kingpin_width: Metres, of Ackermann steering.
        steering_limit: Radians, of Ackermann steering.
        steering: Left and right steering joints of Ackermann steering, as the plugin names them.
        separation_tag: Parameter of the separation; empty if there is none to compare.
        diameter_tag: Parameter of twice the radius; empty for one of the radius.
        swaps: Whether the plugin takes the wheels that it names as left for those on the right.
        radius_tag: Parameter of the radius.
        base_tag: Parameter of the wheel base.
        kingpin_tag: Parameter of the kingpin width; of all tags, empty if there is none.
        slips: Whether its wheels may slip sideways in a turn, so that the separation is raised.
        turning_arm: Metres that a Mecanum or omni wheel rolls in a turn of one radian; None if
            that is not stated.
    """

    plugin: Plugin | Controller
    wheels: tuple[Wheel, ...]
    wheel_separation: Located[float]
    wheel_radius: Located[float]
    linear: MotionLimits
    angular: MotionLimits
    wheel_base: Located[float] | None = None
    kingpin_width: Located[float] | None = None
    steering_limit: Located[float] | None = None
    steering: tuple[tuple[Joint, Side], ...] = ()
    separation_tag: str = "wheel_separation"
    diameter_tag: str = ""
    swaps: bool = False
    radius_tag: str = "wheel_radius"
    base_tag: str = "wheel_base"
    kingpin_tag: str = "kingpin_width"
    slips: bool = True
    turning_arm: Located[float] | None = None

    @property
    def path(self) -> str:
        """A key that distinguishes its plugin from others of the robot."""
        return self.plugin.path if isinstance(self.plugin, Controller) else self.plugin.element.path

    @property
    def axis(self) -> Vector | None:
        """Direction of the first wheel's axis that is known; None if none is."""
        return next((wheel.axis for wheel in self.wheels if wheel.axis is not None), None)

    def wheels_on(self, side: Side) -> tuple[Wheel, ...]:
        """Return the wheels that the plugin states are on one side."""
        return tuple(wheel for wheel in self.wheels if wheel.side is side)


class Track(Record, eq=False):
    """A link whose surface a TrackController moves.

    Attributes:
        plugin: The TrackController.
        side: The side of the TrackedVehicle that commands it; None if none does.
    """

    plugin: Plugin
    link: Link
    side: Side | None
    limits: MotionLimits


class TrackedDrive(Record, eq=False):
    """One TrackedVehicle plugin.

    Attributes:
        tracks: The tracks that it commands and that have a TrackController.
        separation: Metres between the tracks; the plugin's default where it states none.
        steering_efficiency: Share of the commanded turn that the tracks are expected to lose.
    """

    plugin: Plugin
    tracks: tuple[Track, ...]
    separation: Located[float]
    steering_efficiency: Located[float]
    linear: MotionLimits
    angular: MotionLimits


class Rotor(Record, eq=False):
    """A rotor of a multicopter: one MulticopterMotorModel.

    Attributes:
        name: The joint as the plugin names it.
        joint: None if it does not exist.
        link: None if it does not exist.
        number: `motorNumber`; None if not stated.
        direction: 1 for counter-clockwise (`ccw`), −1 for clockwise; 0 if not stated or unknown.
        motor_constant: Thrust = motor_constant · ω², N·s²; the plugin's default (`stated` false)
            where it states none.
        moment_constant: Torque about the axis = moment_constant · thrust, metres; likewise.
        max_velocity: Greatest rotor speed, rad/s; likewise.
        centre: The rotor's centre in the robot's frame, metres.
        axis: The axis of its joint in the robot's frame, of length 1.
    """

    plugin: Plugin
    name: Located[str]
    joint: Joint | None
    link: Link | None
    number: Located[float] | None
    direction: int
    motor_constant: Located[float]
    moment_constant: Located[float]
    max_velocity: Located[float]
    centre: Vector | None
    axis: Vector | None

    @property
    def lifts(self) -> bool:
        """True if its thrust points up rather than forward, as that of an aeroplane's propeller."""
        return self.axis is None or abs(self.axis[2]) >= _UPRIGHT


_UPRIGHT = 0.5
"""Cosine of the angle between a rotor's axis and the vertical."""


class RotorEntry(Record, eq=False):
    """One `<rotor>` of the controller's `<rotorConfiguration>`.

    Attributes:
        joint_name: Empty text if not stated.
        direction: 1 or −1; None if not stated.
        force_constant: The controller's word for `motorConstant`.
        moment_constant: As of the rotor.
        span: The element.
    """

    joint_name: Located[str]
    direction: Located[float] | None
    force_constant: Located[float] | None
    moment_constant: Located[float] | None
    span: Span


class CopterControl(Record, eq=False):
    """One MulticopterVelocityControl plugin.

    Attributes:
        linear: x, y, z limits of velocity and acceleration.
        angular: x, y, z limits of the turn rate.
    """

    plugin: Plugin
    entries: tuple[RotorEntry, ...]
    linear: tuple[MotionLimits, ...]
    angular: tuple[MotionLimits, ...]


class Locomotion(Record, eq=False):
    """All that moves a robot.

    Attributes:
        undriven: The links of a robot that no plugin drives that are called wheels and turn
            freely about an axis that lies. The side is the one that they stand on; casters are
            steered.
        by_joint: The drive that plugins form together where each turns one wheel, as those of an
            autopilot's rover do; the first of them represents all.
        doubt: The reason why that is not certain, as the end of a sentence.
    """

    kind: DriveKind
    wheel_drives: tuple[WheelDrive, ...] = ()
    tracked_drives: tuple[TrackedDrive, ...] = ()
    tracks: tuple[Track, ...] = ()
    rotors: tuple[Rotor, ...] = ()
    copters: tuple[CopterControl, ...] = ()
    leg_joints: tuple[Joint, ...] = ()
    undriven: tuple[Wheel, ...] = ()
    by_joint: WheelDrive | None = None
    doubt: str = ""

    @property
    def drives(self) -> tuple[WheelDrive, ...]:
        """Drives that turn wheels, by a plugin for all of them or one by one."""
        return self.wheel_drives or ((self.by_joint,) if self.by_joint is not None else ())

    @property
    def wheels(self) -> tuple[Wheel, ...]:
        """The wheels of the drives that name several, each once."""
        by_joint = {wheel.joint: wheel for drive in self.wheel_drives for wheel in drive.wheels}
        return tuple(by_joint.values())
