"""The wiring of one launch file: all that it starts, and what these are to one another."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from checker.base.record import Record
from checker.expand.ros2_launch.graph import LaunchGraph, Ros2Launch
from checker.model.ros.simulation import Simulation, Simulations
from checker.model.ros.wiring.nodes import WiredNode, wired_node
from checker.model.ros.wiring.transforms import Transform, transforms
from checker.model.ros2_control.robot_control import ControlReader


class Wiring(Record, eq=False, dict=True):
    """The wiring of one launch file.

    Attributes:
        graph: Of the launch file.
        nodes: That it starts with the defaults of all arguments.
        simulation: What it simulates and bridges; None when it has nothing to do with Gazebo.
    """

    graph: LaunchGraph
    nodes: tuple[WiredNode, ...]
    simulation: Simulation | None

    @cached_property
    def transforms(self) -> tuple[Transform, ...]:
        """Transforms of odometry and localisation that it publishes for certain."""
        return tuple(transforms(self.nodes, self.simulation))


def wirings(
    launch: Ros2Launch, simulations: Simulations | None, reader: ControlReader
) -> Iterator[Wiring]:
    """Yield the wiring of each launch file that starts a node.

    Args:
        launch: The launch files of a package.
        simulations: What they simulate; None when that is nothing.
        reader: Of the files of the package.
    """
    launched = simulations.launched if simulations is not None else ()
    by_graph = {id(simulation.graph): simulation for simulation in launched}
    for graph in launch.entries:
        nodes = tuple(wired_node(node, reader) for node in graph.nodes if node.starts)
        if nodes:
            yield Wiring(graph, nodes, by_graph.get(id(graph)))
