"""The URDF files of a package that represent a robot, and the faults of those that cannot."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import field

from checker.base.record import Record
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.fault import XacroFault


class UrdfFiles(Record, eq=False):
    """Results of reading the URDF files of a package.

    Attributes:
        descriptions: The descriptions of the files with a robot.
        faults: The faults because of which files have no robot.
        unread: The reasons why files could not be read, each the end of a sentence.
        unused: The same of files with links, joints or macros that no file of a robot includes.
        set_aside: The same of files next to an SDF model that no launch file loads.
        old: Files that only newer releases of xacro refuse; the descriptions are those of
            Melodic's.
        assumed: Arguments that are not given, with the choice that is taken, by file.
        others: The files that give another robot with another value of an argument.
    """

    descriptions: tuple[UrdfDescription, ...] = ()
    faults: tuple[XacroFault, ...] = ()
    unread: tuple[str, ...] = ()
    unused: tuple[str, ...] = ()
    set_aside: tuple[str, ...] = ()
    old: tuple[XacroFault, ...] = ()
    assumed: Mapping[str, str] = field(default_factory=dict)
    others: tuple[UrdfDescription, ...] = ()
