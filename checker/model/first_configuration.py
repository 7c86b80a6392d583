"""Another configuration of the same robot, to compare with."""

from __future__ import annotations

from checker.base.record import record
from checker.model.robot import Robot


@record(eq=False)
class FirstConfiguration:
    """The configuration of lowest number at hand, for those of higher numbers; without meshes.

    Attributes:
        name: Its package.
        robot: With the plugins that its own spawner adds. Places in it are relative to its package.
    """

    name: str
    robot: Robot
