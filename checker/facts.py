"""Figures about a robot that every report shows; nothing is read or weighed for their sake."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from checker.dynamics.mass_properties import MassProperties
from checker.mesh.package_meshes import TimedMeshes
from checker.model.components import Collision, Visual
from checker.model.mesh import Mesh
from checker.model.robot import Robot
from checker.parts import NotAtHand
from checker.subject import Subject
from checker.trial.robot_trial import RobotTrial

_DIGITS = 6


def facts_of(subject: Subject) -> dict[str, Any]:
    """Return what is known of the first robot by now; nothing without a robot.

    Masses in kg, lengths in m, angles in degrees, inertia in kg·m². What only meshes, Pinocchio
    or the trial can tell is there when a rule has asked for it.
    """
    robots = subject.robots
    if isinstance(robots, NotAtHand):
        return {}
    robot = robots[0]
    known: dict[str, Any] = {
        "robot": robot.name.value[:200],
        "mass_kg": robot.mass,
        "links": len(robot.links),
        "joints": len(robot.joints),
        "sensors": len(robot.sensors),
        "plugins": len(robot.all_plugins),
        "drive": str(robot.locomotion.kind),
    }
    if _meshes_are_known(robot):
        known |= {"size_m": _size(robot), **_triangles(robot)}
    for masses in subject.provided(MassProperties)[:1]:
        known |= _balance(masses)
    for driven in subject.provided(RobotTrial)[:1]:
        known["thrust_to_weight"] = driven.trial.value("thrust_to_weight")
    return dict(_finite(known))


def _balance(masses: MassProperties) -> Mapping[str, Any]:
    tip = masses.tip_angle
    return {
        "centre_of_mass_m": masses.centre,
        "inertia_kg_m2": masses.inertia,
        "tip_angle_deg": None if tip is None else math.degrees(tip),
    }


def _meshes_are_known(robot: Robot) -> bool:
    meshes = robot.meshes
    return isinstance(meshes, TimedMeshes) and (meshes.read or not meshes.number)


def _size(robot: Robot) -> list[float] | None:
    """Return the sides of the box around the robot; None where a part's extent is not known."""
    shaped = [link for link in robot.links if link.collisions or link.visuals]
    boxes = [box for link in shaped if (box := robot.box_of(link)) is not None]
    if not boxes or len(boxes) < len(shaped):
        return None
    return [
        max(box.high[axis] for box in boxes) - min(box.low[axis] for box in boxes)
        for axis in range(3)
    ]


def _triangles(robot: Robot) -> dict[str, int]:
    """Return how many triangles the meshes of collisions and of visuals have."""
    return {
        "collision_triangles": sum(
            _triangles_of(robot, shape) for link in robot.links for shape in link.collisions
        ),
        "visual_triangles": sum(
            _triangles_of(robot, shape) for link in robot.links for shape in link.visuals
        ),
    }


def _triangles_of(robot: Robot, shape: Collision | Visual) -> int:
    mesh = robot.mesh_of(shape)
    return mesh.triangles if isinstance(mesh, Mesh) else 0


def _finite(known: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield what JSON can express and somebody can read: finite numbers of few digits."""
    for name, value in known.items():
        if isinstance(value, int | str):
            yield name, value
        elif value is not None and (figures := _rounded(value)) is not None:
            yield name, figures


def _rounded(value: float | Sequence[Any]) -> float | list[Any] | None:
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None
    rounded = [_rounded(each) for each in value]
    return None if None in rounded else rounded
