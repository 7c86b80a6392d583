"""Begins with parts that take long, so that they come about while the rules run."""

from __future__ import annotations

from collections.abc import Set
from contextlib import suppress

from checker.base.allowance import Exceeded
from checker.base.extras import PHYSICS
from checker.base.parts import type_name
from checker.engine.judge import TRIALS
from checker.engine.subject import Subject
from checker.formats.urdf.description import UrdfDescription
from checker.model.robot import Robot
from checker.model.sensing.view import SensorViews
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.trial.robot_trial import RepeatedTrial
from checker.physics.trial.run import RobotTrials
from checker.physics.views.sensor_views import RobotViews
from checker.robots.package_descriptions import PackageDescriptions
from checker.robots.urdf_files import UrdfFiles

_WITH_MESHES = TRIALS | {type_name(MassProperties)}
_OF_URDF = frozenset(map(type_name, (UrdfDescription, UrdfFiles)))


def begin(subject: Subject, kinds: Set[str]) -> None:
    """Start to make the parts that the rules need.

    Args:
        subject: The package.
        kinds: Names of the types of parts.
    """
    if PHYSICS.is_installed:
        if kinds & _WITH_MESHES:
            _begin_meshes(subject)
        if type_name(MassProperties) in kinds:
            # Pinocchio is loaded while the meshes are read, which the next parts wait for.
            with suppress(Exception):
                subject.one(MassProperties)
        if kinds & TRIALS:
            trials = subject.one(RobotTrials)
            if isinstance(trials, RobotTrials):
                trials.begin(twice=type_name(RepeatedTrial) in kinds)
        if type_name(SensorViews) in kinds:
            views = subject.one(RobotViews)
            if isinstance(views, RobotViews):
                views.begin()
    if kinds & _OF_URDF:
        subject.one(PackageDescriptions)


def begin_meshes(subject: Subject) -> None:
    """Begin to read the robot's meshes; errors occur again when a rule requests them."""
    with suppress(Exception, Exceeded), subject.allowance.piece():
        if PHYSICS.is_installed:
            _begin_meshes(subject)


def _begin_meshes(subject: Subject) -> None:
    robot = subject.one(Robot)
    if isinstance(robot, Robot) and isinstance(robot.meshes, PackageMeshes):
        robot.meshes.begin()


def begin_display(subject: Subject) -> None:
    """Begin to draw the robot."""
    if PHYSICS.is_installed:
        from checker.engine.display import RobotDisplay

        display = subject.one(RobotDisplay)
        if isinstance(display, RobotDisplay):
            display.begin()
