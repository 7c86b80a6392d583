"""Figures about a robot that every report shows."""

from __future__ import annotations

from checker.model.drive import drive_name
from checker.parts import NotAtHand
from checker.subject import Subject


def facts_of(subject: Subject) -> dict[str, float | int | str]:
    """Return mass (kg), numbers of parts and the kind of drive; nothing without a robot."""
    robots = subject.robots
    if isinstance(robots, NotAtHand):
        return {}
    robot = robots[0]
    return {
        "robot": robot.name.value[:200],
        "mass_kg": round(robot.mass, 6),
        "links": len(robot.links),
        "joints": len(robot.joints),
        "sensors": len(robot.sensors),
        "plugins": len(robot.all_plugins),
        "drive": drive_name(robot.plugins),
    }
