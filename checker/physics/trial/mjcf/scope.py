"""What of a robot a trial is about: whether there can be one, whose pose counts, what can move."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.model.tree import canonical_link

if TYPE_CHECKING:
    from checker.physics.trial.mjcf.layout import Layout


_UNSEEN = (MeshTrouble.NOT_LOOKED_AT, MeshTrouble.UNSUPPORTED)
"""What a robot stands on may be in such a file: without it, it would be another robot."""


def unusable_because(robot: Robot, layout: Layout) -> str:
    """Return why no trial is possible, as the end of a sentence; empty if one is."""
    if robot.missing_parts:
        return f"parts of the robot are not at hand: {robot.missing_parts}"
    if not robot.links:
        return "the robot has no links"
    if robot.is_static:
        return "the robot is static"
    for link in robot.links:
        for collision in link.collisions:
            mesh = robot.mesh_of(collision)
            if isinstance(mesh, MeshFault) and mesh.trouble in _UNSEEN:
                uri = collision.geometry.uri
                return f"the collision mesh {uri.value if uri else ''} {mesh.reason}"
    if not any(layout.geoms.values()):
        return "the robot has no collision shape that can be used"
    return ""


def root_of(robot: Robot, layout: Layout) -> str:
    """Return the link whose pose is the robot's: the one that carries most of its mass.

    Of a robot in one piece, that is the link that all others hang on.
    """
    tree = layout.forest
    canonical = canonical_link(robot)

    def weight(top: str) -> tuple[float, bool]:
        mass = sum(layout.inertias[name].mass for name in tree.under(top))
        return mass, top == canonical

    return max(tree.tops, key=weight)


def swept_joints(robot: Robot, joints: Iterable[str]) -> tuple[str, ...]:
    """Return the joints that move something other than a wheel, track or rotor."""
    spinning = {wheel.joint.scoped_name for wheel in robot.locomotion.wheels}
    spinning |= {rotor.joint.scoped_name for rotor in robot.locomotion.rotors if rotor.joint}
    wheels = {wheel.scoped_name for wheel in robot.wheels}
    spinning |= {tie.joint.scoped_name for tie in robot.tree.ties if tie.child in wheels}
    return tuple(name for name in joints if name not in spinning)
