"""The name of the new package: `<organization>_<robot>_sensor_config_<#>`."""

from __future__ import annotations

import re

from checker.migrate.source import Source
from checker.migrate.wishes import NotMigrated, Wishes
from checker.record import record

NO_ORGANIZATION = "my_team"
"""Stands for the organization that nobody has named."""
_LENGTH_LIMIT = 60
_UNFIT = re.compile(r"[^a-z0-9]+")
_ENDING = re.compile(r"(?:_(?:description|gazebo|urdf|model|sensor_config_\d+))+$", re.IGNORECASE)


@record()
class Names:
    """What things are called in the new package.

    Attributes:
        organization: Lower case, `_` between words.
        robot: Likewise.
        config: Number of the sensor configuration.
    """

    organization: str
    robot: str
    config: int

    @property
    def package(self) -> str:
        """Name of the package, and of its folder."""
        return f"{self.organization}_{self.robot}_sensor_config_{self.config}"

    @property
    def short(self) -> str:
        """Name of the robot in examples."""
        return f"{self.organization}_{self.robot}"


def names_for(wishes: Wishes, source: Source) -> Names:
    """Return the names that were asked for; else those that the source suggests.

    Raises:
        NotMigrated: A name has no letter or digit, or the number is below 1.
    """
    if wishes.config < 1:
        raise NotMigrated(f"the configuration is {wishes.config}, expected 1 or more")
    organization = _word(wishes.organization or NO_ORGANIZATION, "--organization")
    own = source.description.robot.name.value or source.package.root.name
    robot = _word(wishes.robot or _ENDING.sub("", own), "--robot")
    return Names(organization, robot, wishes.config)


def _word(name: str, option: str) -> str:
    word = _UNFIT.sub("_", name.lower()).strip("_")[:_LENGTH_LIMIT].strip("_")
    if not word:
        raise NotMigrated(
            f"{name!r} is not a package name; give {option} with lower-case letters and digits"
        )
    return word
