"""Scene of a robot: links, the contents of each in layers, and their motion."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.model.geometry.transform import Transform, Vector, rotation_from_quaternion
from checker.physics.mesh.surface import Surface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


class Layer(enum.StrEnum):
    """Layer that can be shown and hidden."""

    VISUAL = "visual"
    COLLISION = "collision"
    INERTIA = "inertia"
    FRAME = "frame"
    JOINT = "joint"
    MASS = "mass"
    VIEW = "view"


class Item(Record, eq=False):
    """One thing to see.

    Attributes:
        layer: What it is shown and hidden with.
        name: The name of the visual, joint, sensor, … it represents.
        element: Path of that one's element, as `Place.element` has it.
        pose: The pose in the frame of its link.
        surfaces: Its triangles, before `scale`.
        scale: Along its own x, y, z; negative numbers mirror it.
    """

    layer: Layer
    name: str
    element: str
    pose: Transform
    surfaces: tuple[Surface, ...]
    scale: Vector = (1.0, 1.0, 1.0)


class LinkNode(Record, eq=False):
    """A link with its items.

    Attributes:
        name: Scoped name; no two links have the same.
        element: Path of its element, as `Place.element` has it.
        pose: The pose in the robot's frame while all joints stand at 0.
        items: What is to see.
        carrier: Name of the link with a track that this one is fixed to; empty if it has a track
            of its own, and for what stays where it is.
    """

    name: str
    element: str
    pose: Transform
    items: tuple[Item, ...]
    carrier: str = ""


class Tracks(Record, eq=False):
    """Motion of links in the world (z up, the ground at z = 0).

    Attributes:
        time: The time of the samples, seconds (n).
        poses: The poses by the link's name: x, y, z (metres) and quaternion w, x, y, z (n × 7).
    """

    time: Array
    poses: Mapping[str, Array]


class DisplayScene(Record, eq=False):
    """The scene of a robot.

    Attributes:
        robot: Its name.
        links: Carriers before those they carry.
        tracks: Their motion; None without a trial.
        notes: What is not shown, as sentences.
    """

    robot: str
    links: tuple[LinkNode, ...]
    tracks: Tracks | None = None
    notes: tuple[str, ...] = ()

    def poses(self, sample: int = 0) -> dict[str, Transform]:
        """Return the pose of each link in the world at a sample of the tracks.

        Without tracks the world is the robot's frame.
        """
        tracked = self.tracks.poses if self.tracks is not None else {}
        own = {link.name: link.pose for link in self.links}
        poses: dict[str, Transform] = {}
        for link in self.links:
            if link.name in tracked:
                poses[link.name] = _pose(tracked[link.name][sample])
            elif link.carrier:
                in_carrier = own[link.carrier].inverse @ link.pose
                poses[link.name] = poses[link.carrier] @ in_carrier
            else:
                poses[link.name] = link.pose
        return poses


def _pose(seven: Array) -> Transform:
    x, y, z, *quaternion = (float(number) for number in seven)
    return Transform(rotation_from_quaternion(*quaternion), (x, y, z))
