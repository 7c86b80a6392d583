"""Options of a migration, and the exception for one that is not possible."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import field

from checker.base.errors import CheckerError
from checker.base.record import Record


class NotMigrated(CheckerError):
    """A description that cannot be migrated; its text is one sentence and states what to do."""


class MigrationOptions(Record):
    """The author's options; empty ones are detected.

    Attributes:
        organization: In front of the package's name.
        robot: Name of the robot in the package's name.
        config: Number of the sensor configuration.
        left_wheels: Joints of the wheels on the left.
        right_wheels: Joints of the wheels on the right.
        max_velocity: Limit of the drive, m/s.
        max_acceleration: Limit of the drive, m/s².
        urdf: The file that describes the robot.
        args: Arguments for xacro.
    """

    organization: str = ""
    robot: str = ""
    config: int = 1
    left_wheels: tuple[str, ...] = ()
    right_wheels: tuple[str, ...] = ()
    max_velocity: float | None = None
    max_acceleration: float | None = None
    urdf: str = ""
    args: Mapping[str, str] = field(default_factory=dict)
