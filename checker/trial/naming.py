"""Names in a scene are ours: those of robots may hold anything, or nothing, or come twice."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Names:
    """The names of the parts of a robot in its scene.

    Attributes:
        bodies: Link to body.
        joints: Joint to MuJoCo's joint of its first axis; that of a second has `_2` behind.
        free: Link that hangs on nothing to its free joint.
        geoms: Geom to link.
        actuators: Joint to actuator.
        belts: Link to the geoms that can have a surface velocity.
        balls: Joints that neither turn about one axis nor slide.
    """

    bodies: dict[str, str] = field(default_factory=dict)
    joints: dict[str, str] = field(default_factory=dict)
    free: dict[str, str] = field(default_factory=dict)
    geoms: dict[str, str] = field(default_factory=dict)
    actuators: dict[str, str] = field(default_factory=dict)
    belts: dict[str, tuple[str, ...]] = field(default_factory=dict)
    balls: set[str] = field(default_factory=set)

    _joints: int = 0

    def body(self, link: str) -> str:
        """Name the body of a link."""
        return self.bodies.setdefault(link, f"b{len(self.bodies)}")

    def joint(self, joint: str, *, ball: bool) -> str:
        """Name a joint; of two with one name, the robot's name leads to the first."""
        name = f"j{self._joints}"
        self._joints += 1
        if ball:
            self.balls.add(joint)
        self.joints.setdefault(joint, name)
        return name

    def free_joint(self, link: str) -> str:
        """Name the free joint of a link that hangs on nothing."""
        return self.free.setdefault(link, f"f{len(self.free)}")

    def geom(self, link: str) -> str:
        """Name a geom of a link."""
        name = f"g{len(self.geoms)}"
        self.geoms[name] = link
        return name
