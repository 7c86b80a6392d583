"""The parts of a package that physics tells: masses, views of sensors, the trial, the display."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.extras import PHYSICS
from checker.base.parts import NotAvailable
from checker.base.record import Record

if TYPE_CHECKING:
    from checker.engine.display import RobotDisplay
    from checker.engine.subject import Subject
    from checker.model.sensing.view import SensorViews
    from checker.physics.mass.mass_properties import MassProperties
    from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial, SettledTrial
    from checker.physics.trial.run import RobotTrials
    from checker.physics.views.sensor_views import RobotViews


class PhysicsParts(Record, eq=False, dict=True):
    """What is measured of the robots; each part is begun when it is first asked for.

    Attributes:
        subject: The package under review.
    """

    subject: Subject

    @cached_property
    def masses(self) -> tuple[MassProperties, ...] | NotAvailable:
        """The robots as Pinocchio weighs them."""
        if isinstance(self.subject.robots, NotAvailable):
            return self.subject.robots
        PHYSICS.needed_by("mass properties")
        from checker.physics.mass.robot_mass import weigh

        with self.subject.stages.stage("weigh"):
            return tuple(weigh(robot, self.subject.cache) for robot in self.subject.robots)

    @cached_property
    def trials(self) -> RobotTrials | NotAvailable:
        """The trials of the robots."""
        if isinstance(self.subject.robots, NotAvailable):
            return self.subject.robots
        PHYSICS.needed_by("the trial")
        from checker.physics.trial.run import RobotTrials

        return RobotTrials(self.subject.robots, self.subject.cache, self.subject.stages)

    @property
    def undriven(self) -> Mapping[int, str]:
        """Why robots have no trial, by their number; nothing where no rule asked for one."""
        trials: RobotTrials | NotAvailable | None = self.__dict__.get("trials")
        if trials is None or isinstance(trials, NotAvailable):
            return {}
        return trials.undriven

    @property
    def driven(self) -> tuple[RobotTrial, ...] | NotAvailable:
        """The robots and their trials."""
        return self.trials if isinstance(self.trials, NotAvailable) else self.trials.once

    @property
    def settled(self) -> tuple[SettledTrial, ...] | NotAvailable:
        """Those of them that come to rest before they drive."""
        # Whoever asks for these has the figures shown, too.
        self.subject.part("RobotTrial")
        driven = self.driven
        if isinstance(driven, NotAvailable):
            return driven
        from checker.physics.trial.robot_trial import SettledTrial
        from checker.physics.trial.settling import unrest_of

        reasons = [
            each.unlike or each.robot.stuck_wheel or unrest_of(each.trial) for each in driven
        ]
        fit = [each for each, reason in zip(driven, reasons, strict=True) if not reason]
        unfit = next(filter(None, reasons), "")
        if not fit:
            return NotAvailable(unfit)
        first, *others = (SettledTrial(each.robot, each.trial) for each in fit)
        return (replace(first, others=unfit), *others)

    @property
    def driven_twice(self) -> tuple[RepeatedTrial, ...] | NotAvailable:
        """The robots and their trials, also at half the time step."""
        return self.trials if isinstance(self.trials, NotAvailable) else self.trials.twice

    @cached_property
    def display(self) -> RobotDisplay | NotAvailable:
        """The robot in 3D; a check that shows nothing loads none of the modules behind it."""
        from checker.engine.display import RobotDisplay

        had = self.subject.robots
        if isinstance(had, NotAvailable):
            return had
        return RobotDisplay(had, self.subject.cache, self.subject.stages, self.subject.processes)

    @cached_property
    def robot_views(self) -> RobotViews | NotAvailable:
        """The views of the robots' sensors."""
        subject, robots = self.subject, self.subject.robots
        if isinstance(robots, NotAvailable):
            return robots
        PHYSICS.needed_by("the view of sensors")
        from checker.physics.views.sensor_views import RobotViews

        return RobotViews(robots, subject.cache, subject.stages, subject.mesh_server)

    @property
    def views(self) -> tuple[SensorViews, ...] | NotAvailable:
        """The robots and what of themselves their sensors see."""
        views = self.robot_views
        return views if isinstance(views, NotAvailable) else views.views
