"""A robot and its trial together: figures lead to the parts they are about."""

from __future__ import annotations

from functools import cached_property

from checker.base.record import Record
from checker.model.components import Joint, Link, Part
from checker.model.controllers import Controller
from checker.model.locomotion.classic import enforces_limits
from checker.model.robot import Robot
from checker.physics.trial.trial import Leg, Trial


class RobotTrial(Record, eq=False, dict=True):
    """A robot that was driven, and the measurements.

    Attributes:
        others: The reason why other robots of the package are not among those; of the first robot
            only.
    """

    robot: Robot
    trial: Trial
    others: str = ""

    def link(self, name: str) -> Link | Robot:
        """Return the link of a scoped name; the robot if there is none."""
        return self.robot.links_by_name.get(name, self.robot)

    def joint(self, name: str) -> Joint | Robot:
        """Return the joint of a scoped name; the robot if there is none."""
        return self.robot.joints_by_name.get(name, self.robot)

    def part(self, name: str) -> Part:
        """Return the link of a scoped name, else the joint, else the robot."""
        part = self.robot.links_by_name.get(name) or self.robot.joints_by_name.get(name)
        return part or self.robot

    @property
    def enforces_limits(self) -> bool:
        """True if joints stay within their limits of velocity and effort."""
        return enforces_limits(self.robot)

    @cached_property
    def drive(self) -> Part | Controller:
        """Place of findings about its motion: its drive, else the robot."""
        locomotion = self.robot.locomotion
        plugins = [
            *(drive.plugin for drive in locomotion.drives),
            *(drive.plugin for drive in locomotion.tracked_drives),
            *(track.plugin for track in locomotion.tracks),
            *(copter.plugin for copter in locomotion.copters),
            *(rotor.plugin for rotor in locomotion.rotors),
        ]
        return plugins[0] if plugins else self.robot

    @property
    def rigid_steering(self) -> str:
        """Name of a steered link that touches the ground and cannot roll; empty if there is none.

        Such a robot is drawn in RViz alone: in a simulator its wheels drag.
        """
        rolling = {tie.parent for tie in self.robot.tree.ties if tie.joint.type.value != "fixed"}
        steered = {joint for drive in self.robot.locomotion.drives for joint, _ in drive.steering}
        for tie in self.robot.tree.ties:
            link = self.robot.links_by_name.get(tie.child)
            if tie.joint in steered and tie.child not in rolling and link and link.collisions:
                return link.name.value
        return ""

    @property
    def upright_wheels(self) -> list[Joint]:
        """Joints of driven wheels that spin on their sides, about a vertical axis."""
        wheels = self.robot.locomotion.wheels
        return [wheel.joint for wheel in wheels if wheel.axis and abs(wheel.axis[2]) > _UPRIGHT]

    @property
    def invalid_reason(self) -> str:
        """Reason why the trial is not valid for this robot, as the end of a sentence; else empty.

        For the trial, parts without a place got one, invalid masses were replaced, and shapes that
        cannot be used were left out.
        """
        masses = self.robot.unknown_masses.values()
        return self.robot.unplaced_part or next(iter(masses), "") or self.robot.bare_wheel

    def leg(self, name: str) -> Leg | None:
        """Return a stretch of the course by its name; None if it was not driven."""
        return next((leg for leg in self.trial.legs if leg.name == name), None)

    @property
    def drives_backwards(self) -> bool:
        """True if it drives against the command, faster than a creep."""
        return _against(self.trial.value("speed_ratio"))

    @property
    def turns_backwards(self) -> bool:
        """True if it turns against the command, faster than a creep."""
        return _against(self.trial.value("yaw_ratio"))


def _against(ratio: float | None) -> bool:
    return ratio is not None and ratio < -_CREEP


_UPRIGHT = 0.7
"""Vertical part of an axis of length 1."""
_CREEP = 0.1
"""Share of the command below which a direction is not certain: wheels that do not roll slide."""


class SettledTrial(RobotTrial):
    """A robot that came to rest before it was driven: the figures of its drive are valid."""


class RepeatedTrial(RobotTrial, kw_only=True):
    """A robot that was driven twice.

    Attributes:
        again: The trial at half the time step.
    """

    again: Trial
