"""Share of a sensor's view that the robot itself hides, and of a light's surroundings."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.components import Collision, Light, Link, Visual
from checker.model.robot import Robot
from checker.model.sensing.mounts import Mounted


class Hit(Record, eq=False):
    """A ray of a sensor that ends at a shape of its own robot.

    Attributes:
        share: The share of the view that the ray represents, 0 to 1.
        metres: The distance along the ray.
        azimuth: The azimuth of the ray, to the left of the sensor's x axis, radians.
        by: The shape, and its link.
    """

    share: float
    metres: float
    azimuth: float
    by: tuple[Link, Visual | Collision]


class View(Record, eq=False):
    """View of a camera or lidar of the robot that carries it, with all joints at their start.

    Simulators draw the outer side of a surface only, and only beyond the near clip: a sensor inside
    its housing sees through it. A lidar of type `ray`, which Gazebo Classic alone simulates, meets
    collisions in place of visuals.

    Attributes:
        filled: Rays that end at visuals, or at collisions.
        cut: Share of these that are nearer than the near clip, so that they are cut open.
        by: The shape that takes most, and its link; None if there is none in view.
    """

    mounted: Mounted
    filled: tuple[Hit, ...]
    cut: float
    by: tuple[Link, Visual | Collision] | None

    @property
    def hidden_share(self) -> float:
        """Share of the view that shapes fill, 0 to 1."""
        return sum(hit.share for hit in self.filled)

    def hidden_share_within(self, distance: float) -> float:
        """Return the share of the view that shapes nearer than a distance fill, metres."""
        return sum(hit.share for hit in self.filled if hit.metres < distance)


class CoveredLight(Record, eq=False):
    """A light that casts shadows, and a concave visual around it.

    Attributes:
        visual: A mesh, both sides of which count.
        around: Share of all directions in which it stands in the way, 0 to 1.
        ahead: Share of the light's beam in which it does; of one that shines all around, `around`.
    """

    light: Light
    visual: Visual
    around: float
    ahead: float


class SensorViews(Record, eq=False):
    """A robot and the views of its cameras and lidars.

    Attributes:
        views: The views that could be computed, in the order of the sensors.
        unseen: The reasons why something that may be in a view is not known, as ends of sentences.
        covered: Its lights in the boxes around concave meshes.
    """

    robot: Robot
    views: tuple[View, ...]
    unseen: tuple[str, ...] = ()
    covered: tuple[CoveredLight, ...] = ()
