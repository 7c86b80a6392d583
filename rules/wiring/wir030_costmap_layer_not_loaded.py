"""A layer of a costmap that has parameters, but is not in the list of layers to load.

A costmap of Nav2 loads the layers in `plugins` and those in `filters`. The block of another layer
is not read, and nothing says so. Without its inflation layer, cells beside an obstacle cost
nothing: the planner leads the robot along walls, closer than half its width. A local costmap
without a layer that marks obstacles is empty, and the robot drives into them.

It is reported of an inflation layer where the costmap loads none, and of an obstacle or voxel layer
of the local costmap where it loads only inflation and static layers. A block with `enabled: false`
is meant, and so is one that another parameter file lists. Nav2's own files have a `static_layer`
that the local costmap does not load.

Fix: add the name of the layer to `plugins`, the inflation layer as the last one.
Source: navigation2, nav2_costmap_2d/src/costmap_2d_ros.cpp, `getParameters` and `on_configure`.
"""

from collections.abc import Iterator

from checker.package.package import Package
from checker.ros.wiring.costmaps import OBSTACLE_LAYER, VOXEL_LAYER, CostmapBlock, costmap_blocks
from checker.rule import Concern, Findings, Severity, finding, rule

_INFLATION = "nav2_costmap_2d::InflationLayer"
_STATIC = "nav2_costmap_2d::StaticLayer"
_LISTS = ("plugins", "filters")
_SUFFIX = ".plugin"


@rule("WIR030", "costmap-layer-not-loaded", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report layers that no file lists, where the costmap loads none that does the same."""
    costmaps = [*costmap_blocks(package)]
    for costmap in costmaps:
        node = costmap.block.node
        listed = {name for it in costmaps if it.block.node == node for name in _listed(it)}
        loaded = {costmap.plugin(name) for name in listed}
        plugins = costmap.get("plugins")
        if plugins is None or not plugins.texts:
            continue
        for name, loss in _unlisted(costmap, loaded):
            if name in listed or package.workspace.launches_with(name):
                continue
            names = ", ".join((*(it.value for it in plugins.texts), name))
            yield finding(
                costmap.block.parameters[f"{name}{_SUFFIX}"],
                f"{name} of {node} is not loaded, so {loss}: write plugins: [{names}]",
                key=f"{node} {name}",
                related=[(plugins, "the layers that are loaded")],
            )


def _listed(costmap: CostmapBlock) -> Iterator[str]:
    for parameter in filter(None, map(costmap.get, _LISTS)):
        yield from (text.value for text in parameter.texts)


def _unlisted(costmap: CostmapBlock, loaded: set[str]) -> Iterator[tuple[str, str]]:
    """Yield layers with a block whose like is not loaded, and what the costmap lacks without."""
    sees_nothing = costmap.block.node == "local_costmap" and loaded <= {_INFLATION, _STATIC}
    for name in costmap.block.parameters:
        layer = name.removesuffix(_SUFFIX)
        enabled = costmap.get(f"{layer}.enabled")
        if layer == name or "." in layer or (enabled and enabled.node.scalar is False):
            continue
        kind = costmap.plugin(layer)
        if kind == _INFLATION and kind not in loaded:
            yield layer, "the robot is led close along obstacles"
        elif kind in (OBSTACLE_LAYER, VOXEL_LAYER) and sees_nothing:
            yield layer, "the costmap marks no obstacle"


def _costmap(
    plugins: str, layer: str = "InflationLayer", mark: str = "", more: str = ""
) -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [{plugins}]
      walls:
        plugin: {_STATIC}
      extra:
        plugin: nav2_costmap_2d::{layer}{mark}{more}
""",
    }


_OFF = "\n        enabled: false"
_MARK = "  # ^ WIR030"
GOOD = [
    _costmap("walls, extra"),
    _costmap("walls", "StaticLayer"),
    _costmap("walls", more=_OFF),
    {**_costmap("walls"), "config/more.yaml": _costmap("extra")["config/nav2.yaml"]},
    _costmap("walls, acme_layer", "ObstacleLayer"),
]
BAD = [
    _costmap("walls", mark=_MARK),
    _costmap("walls", "ObstacleLayer", _MARK),
]
