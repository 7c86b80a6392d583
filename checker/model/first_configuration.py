"""Another configuration of the same robot, to compare with."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.robot import Robot


class FirstConfiguration(Record, eq=False):
    """The available configuration of lowest number, for those of higher numbers; without meshes.

    Attributes:
        name: Its package.
        robot: The robot with the plugins that its own spawner adds. Places in it are relative to
            its package.
    """

    name: str
    robot: Robot
