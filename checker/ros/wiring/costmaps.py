"""Costmaps of Nav2 in the parameter files of a package."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.ros_parameters import NodeBlock, Parameter
from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.source.text import Located

COSTMAPS = ("local_costmap", "global_costmap")
OBSTACLE_LAYER = "nav2_costmap_2d::ObstacleLayer"
VOXEL_LAYER = "nav2_costmap_2d::VoxelLayer"


class CostmapBlock(Record, eq=False):
    """The parameters that a file gives to a costmap.

    Attributes:
        file: The path of the file as the package lists it.
        block: The parameters.
    """

    file: str
    block: NodeBlock

    def get(self, name: str) -> Parameter | None:
        """Return a parameter, by its name with dots."""
        return self.block.parameters.get(name)

    def number(self, name: str, default: float) -> float:
        """Return the value of a parameter, or its default where it is none or no number."""
        stated = self.get(name)
        number = stated.number if stated is not None else None
        return default if number is None else number.value

    @property
    def layers(self) -> Iterator[Located[str]]:
        """The layers that it lists, those that are on."""
        plugins = self.get("plugins")
        for layer in plugins.texts if plugins is not None else ():
            enabled = self.get(f"{layer.value}.enabled")
            if enabled is None or enabled.node.scalar is True:
                yield layer

    def plugin(self, layer: str) -> str:
        """Return the class of a layer; empty if it is not stated."""
        plugin = self.get(f"{layer}.plugin")
        return plugin.texts[0].value if plugin is not None and plugin.texts else ""

    def may_mark(self, source: str) -> bool:
        """Return whether a source, `layer.source`, is not for clearing alone."""
        marking = self.get(f"{source}.marking")
        return marking is None or marking.node.scalar is not False

    def observes(self, layer: str) -> bool:
        """Return whether a layer is one of Nav2's own that mark what sensors see."""
        return self.plugin(layer) in (OBSTACLE_LAYER, VOXEL_LAYER)


def costmap_blocks(package: Package) -> Iterator[CostmapBlock]:
    """Yield the parameters of costmaps in the files of a package."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        for block in blocks_in(package, file.path, "_costmap"):
            if block.node in COSTMAPS:
                yield CostmapBlock(file.path, block)
