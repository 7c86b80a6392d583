"""The robots with their meshes, and their measurements: masses, views of sensors, trials."""

from __future__ import annotations

from contextlib import ExitStack

from msgspec.structs import replace

from checker.base.cache import Cache
from checker.base.extras import PHYSICS
from checker.base.output import Stages
from checker.base.parts import NotAvailable, part
from checker.model.placed_robots import PlacedRobots
from checker.model.robot import Robot
from checker.model.sensing.view import SensorViews
from checker.package.package import Package
from checker.physics.mass.arm_loads import ArmLoads, arm_loads
from checker.physics.mass.link_inertias import LinkInertias
from checker.physics.mass.link_inertias import link_inertias as read_link_inertias
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mesh.package_meshes import PackageMeshes, mesh_uris, picked_parts
from checker.physics.mesh.process import MeshServer
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial, SettledTrial
from checker.physics.trial.run import RobotTrials
from checker.physics.trial.settling import unsettled_reason
from checker.physics.views.sensor_views import RobotViews


@part
def robots(
    placed: PlacedRobots,
    package: Package,
    cache: Cache,
    stages: Stages,
    reader: MeshServer,
    ends: ExitStack,
) -> tuple[Robot, ...]:
    """Return the robots of the package with their meshes."""
    with_meshes = []
    for robot in placed.robots:
        uris, picks = mesh_uris(robot), picked_parts(robot)
        meshes = PackageMeshes(package, uris, cache, stages, reader.server, picks)
        ends.callback(meshes.stop)
        with_meshes.append(replace(robot, meshes=meshes))
    return tuple(with_meshes)


@part
def link_inertias(robots: tuple[Robot, ...]) -> tuple[LinkInertias, ...]:
    """Return the inertia of each link, as written."""
    return tuple(map(read_link_inertias, robots))


@part
def masses(robots: tuple[Robot, ...], cache: Cache, stages: Stages) -> tuple[MassProperties, ...]:
    """Return the robots as Pinocchio weighs them."""
    PHYSICS.require_for("mass properties")
    from checker.physics.mass.robot_mass import weigh

    with stages.stage("weigh"):
        return tuple(weigh(robot, cache) for robot in robots)


@part
def arms(masses: tuple[MassProperties, ...]) -> tuple[ArmLoads, ...]:
    """Return the joints of the robots that hold a weight."""
    return tuple(map(arm_loads, masses))


@part
def robot_views(
    robots: tuple[Robot, ...], cache: Cache, stages: Stages, reader: MeshServer, ends: ExitStack
) -> RobotViews:
    """Return the views of the robots' sensors, as they are being computed."""
    PHYSICS.require_for("the view of sensors")
    views = RobotViews(robots, cache, stages, reader.server)
    ends.callback(views.stop)
    return views


@part
def views(views: RobotViews) -> tuple[SensorViews, ...]:
    """Return the robots and what of themselves their sensors see."""
    return views.views


@part
def trials(robots: tuple[Robot, ...], cache: Cache, stages: Stages, ends: ExitStack) -> RobotTrials:
    """Return the trials of the robots, as they are being driven."""
    PHYSICS.require_for("the trial")
    trials = RobotTrials(robots, cache, stages)
    ends.callback(trials.stop)
    return trials


@part
def robot_trials(trials: RobotTrials) -> tuple[RobotTrial, ...] | NotAvailable:
    """Return the robots and their trials."""
    return trials.once


@part
def settled_trials(driven: tuple[RobotTrial, ...]) -> tuple[SettledTrial, ...] | NotAvailable:
    """Return those of them that come to rest before they drive."""
    reasons = [
        each.invalid_reason or each.robot.stuck_wheel or unsettled_reason(each.trial)
        for each in driven
    ]
    fit = [each for each, reason in zip(driven, reasons, strict=True) if not reason]
    unfit = next(filter(None, reasons), "")
    if not fit:
        return NotAvailable(unfit)
    first, *others = (SettledTrial(each.robot, each.trial) for each in fit)
    return (replace(first, others=unfit), *others)


@part
def repeated_trials(trials: RobotTrials) -> tuple[RepeatedTrial, ...] | NotAvailable:
    """Return the robots and their trials, also at half the time step."""
    return trials.twice
