"""Data of the layers: a robot, the poses of its links, and the appearance of its meshes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from msgspec import field

from checker.base.record import Record
from checker.model.components import Link, Part, Pose
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.physics.trial.mjcf.names import is_finite_pose
from checker.report.scene.mesh_files import Notes, Surfaces, short
from checker.report.scene.scene import Item

Hung = Iterator[tuple[str, Item]]
"""Items, each with the scoped name of the link that it is connected to."""


class Showing(Record, eq=False, dict=True):
    """A robot to be shown.

    Attributes:
        robot: The robot.
        frames: Poses in the robot's frame of the links that are shown, by scoped name.
        surfaces: The surfaces of its mesh files.
        notes: What is not shown.
        size: Radius of the sphere around its shapes, metres; markers are as large as it suits.
    """

    robot: Robot
    frames: Mapping[str, Transform]
    surfaces: Surfaces
    notes: Notes = field(default_factory=Notes)
    size: float = 1.0

    @cached_property
    def links(self) -> tuple[Link, ...]:
        """The links that are shown."""
        return tuple(self.robot.links_by_name[name] for name in self.frames)

    def placed(self, link: Link, part: Part, pose: Pose) -> Transform | None:
        """Return where a part is in its link's frame; None, with a note, where unknown."""
        place = self._in_link(link, pose)
        if place is None:
            what = f"{part.element.tag} {short(part.name.value)!r}"
            self.notes.say(f"{what} is not shown: its place is not known")
        return place

    def centre_in_link(self, link: Link) -> Transform | None:
        """Return a link's centre of mass, with the axes of its moments, in the link's frame."""
        return Transform() if link.inertial is None else self._in_link(link, link.inertial.pose)

    @staticmethod
    def inertial_path(link: Link) -> str:
        """Return the path of the element that states what a link weighs, or should."""
        return link.element.path if link.inertial is None else link.inertial.span.element

    def _in_link(self, link: Link, pose: Pose) -> Transform | None:
        place: Transform | None = pose.transform
        if pose.relative_to:
            whole = self.robot.pose_of_part(link, pose)
            place = None if whole is None else self.frames[link.scoped_name].inverse @ whole
        return place if place is not None and is_finite_pose(place) else None
