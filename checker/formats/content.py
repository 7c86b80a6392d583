"""Content of a file of any format."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from checker.base.record import Record
from checker.model.robot import Robot
from checker.model.world import World
from checker.package.package import Package
from checker.source.xml import XmlDocument


class Content(Record, eq=False):
    """The robots and worlds of a file.

    Attributes:
        robots: The robots that are not part of another one, in the order of the file.
        worlds: The worlds in the order of the file.
        missing: The reason why a robot that the file names is not among these, as a sentence
            without its full stop; else empty.
    """

    robots: tuple[Robot, ...]
    worlds: tuple[World, ...] = ()
    missing: str = ""


Reader: TypeAlias = Callable[[XmlDocument, Package], Content]
"""Returns the content of a file of a package. What cannot be read are faults of the robot."""
