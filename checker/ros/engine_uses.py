"""Models that each physics engine of Gazebo Sim simulates, from worlds and launch files."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.physics_engine import PhysicsEngine, engine_of
from checker.model.robot import Robot
from checker.model.world import World
from checker.ros.servers import GazeboServer
from checker.ros.simulation import Simulations


class EngineUse(Record, eq=False):
    """A known physics engine and the models that it simulates.

    Attributes:
        engine: The engine.
        models: Robots that are spawned, and the models of the world.
        places: The places that name Gazebo and the world, each with its name in messages.
    """

    engine: PhysicsEngine
    models: tuple[Robot, ...]
    places: tuple[tuple[GazeboServer | World, str], ...]


def engine_uses(simulations: Simulations | None, world: World | None) -> Iterator[EngineUse]:
    """Yield the engine of a checked world, and those of the servers that launch files start."""
    if world is not None and (engine := engine_of(world)) is not None:
        yield EngineUse(engine, world.models, ((world, "this world"),))
    for simulation in simulations.launched if simulations is not None else ():
        for server in simulation.servers:
            started = (server, "Gazebo is started here")
            for loaded in () if server.unknown else server.worlds or (None,):
                engine = engine_of(loaded, server.engine)
                if engine is not None:
                    place = ((loaded, "this world"),) if loaded is not None else ()
                    yield EngineUse(engine, simulation.models, (started, *place))
