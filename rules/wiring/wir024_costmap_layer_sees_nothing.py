"""A layer of a costmap that does not mark what its sensors see.

An obstacle or voxel layer marks what the sources in `observation_sources` see. Without that
parameter it subscribes to nothing, says so nowhere, and the robot drives into what its map does not
have. A source in the list without a block of its name has the defaults: a LaserScan, of which
nothing is marked above `max_obstacle_height`, which is 0. It is also 0 in a block that does not
state it. A voxel layer holds 16 voxels in each
column; above them nothing is marked, whatever `z_voxels` says.

Layers of Nav2 that `plugins` lists are judged, by all parameter files of the package; for ROS 1
those whose sources are written below a name that is no layer.

Fix: list the sources below the layer, `observation_sources: scan`, and give each a block with
`topic`, `data_type` and `max_obstacle_height`. Write `z_voxels: 16` and a larger `z_resolution`.
Source: navigation2, nav2_costmap_2d/plugins/obstacle_layer.cpp (`observation_sources`),
nav2_voxel_grid, `VoxelGrid::resize`; ROS 1: costmap_2d.
"""

import math
from collections.abc import Collection, Iterator

from checker.base.words import Suggestions
from checker.package.package import Package
from checker.ros.wiring.costmaps import VOXEL_LAYER, CostmapBlock, costmap_blocks
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located, SourceText
from checker.source.yaml import YamlNode, read_root

_SOURCES = "observation_sources"
_HIGHEST = "max_obstacle_height"
_MOST_VOXELS = 16
_OF_ROS_1 = ("costmap_2d::ObstacleLayer", "costmap_2d::VoxelLayer")


@rule("WIR024", "costmap-layer-sees-nothing", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report obstacle layers without sources, sources without a block, and too many voxels."""
    if package.workspace.launches_with(_SOURCES):
        return
    costmaps = [*costmap_blocks(package)]
    given: dict[str, set[str]] = {}
    for costmap in costmaps:
        given.setdefault(costmap.block.node, set()).update(costmap.block.parameters)
    for costmap in costmaps:
        for layer in costmap.layers:
            if costmap.observes(layer.value):
                yield from _sources(costmap, layer, given[costmap.block.node])
            if costmap.plugin(layer.value) == VOXEL_LAYER:
                yield from _voxels(costmap, layer.value)
    yield from _in_ros_1(package)


def _sources(
    costmap: CostmapBlock, layer: Located[str], given: Collection[str]
) -> Iterator[Finding]:
    """Judge the sources of a layer; `given` are the names of parameters in any file."""
    name = layer.value
    described = {
        it.split(".")[1] for it in given if it.startswith(f"{name}.") and it.count(".") == 2
    }
    listed = costmap.get(f"{name}.{_SOURCES}")
    if listed is None and f"{name}.{_SOURCES}" not in given:
        verb = "move the one of the costmap" if costmap.get(_SOURCES) else "write it"
        cure = f"{verb} below {name}, `{_SOURCES}: {' '.join(sorted(described)) or 'scan'}`"
        yield finding(
            layer,
            f"{name} of {costmap.block.node} has no {_SOURCES}, so it marks no obstacle: {cure}",
            severity=Severity.ERROR if described else None,
            key=f"{costmap.block.node} {name}",
        )
    names = [(it, word) for it in (listed.texts if listed else ()) for word in it.value.split()]
    near = Suggestions(sorted(described - {word for _, word in names}))
    for text, word in names:
        if word not in described:
            yield finding(
                text,
                f"source {word!r} of {name} has no block, so nothing above 0 m is marked: write "
                f"`{word}:` with topic, data_type and max_obstacle_height below {name}"
                f"{near.hint(word)}",
                key=f"{name} {word}",
            )
        elif costmap.may_mark(f"{name}.{word}") and f"{name}.{word}.{_HIGHEST}" not in given:
            yield finding(
                text,
                f"source {word!r} of {name} has no {_HIGHEST}, which is 0 by default, so nothing "
                f"above 0 m is marked: write `{_HIGHEST}: 2.0` below {word}",
                key=f"{name} {word}",
            )


def _voxels(costmap: CostmapBlock, layer: str) -> Iterator[Finding]:
    """Report a number of voxels that the grid does not hold, where obstacles are above it."""
    voxels = costmap.get(f"{layer}.z_voxels")
    number = voxels.number if voxels is not None else None
    if number is None or number.value <= _MOST_VOXELS:
        return
    size = costmap.number(f"{layer}.z_resolution", 0.2)
    bottom = costmap.number(f"{layer}.origin_z", 0.0)
    seen = [
        it.number.value
        for name, it in costmap.block.parameters.items()
        if name.startswith(f"{layer}.")
        and name.endswith(f".{_HIGHEST}")
        and it.number
        and name.count(".") == 2
    ]
    highest = min(costmap.number(f"{layer}.{_HIGHEST}", 2.0), max(seen, default=math.inf))
    top = bottom + _MOST_VOXELS * size
    if top < min(highest, bottom + number.value * size):
        yield finding(
            number,
            f"z_voxels of {layer} is {number.value:g}, and the grid holds {_MOST_VOXELS}: nothing "
            f"above {top:g} m is marked; write z_voxels: {_MOST_VOXELS} and z_resolution: "
            f"{math.ceil(100 * (highest - bottom) / _MOST_VOXELS) / 100:g}",
            key=f"{layer} z_voxels",
        )


def _in_ros_1(package: Package) -> Iterator[Finding]:
    """Report layers of ROS 1 without sources where some stand below a name that is no layer."""
    files = (package.read(file.path) for file in package.index.with_suffix(".yaml", ".yml"))
    texts = (it for it in files if isinstance(it, SourceText) and "costmap" in it.text)
    maps = [each for text in texts for each in _mappings(read_root(text))]
    holders = {
        str(key.scalar): key
        for each in maps
        for key, value in each.entries
        if value.get(_SOURCES) is not None
    }
    layers = [layer for each in maps for layer in _layers(each)]
    names = {str(name.scalar) for name, _ in layers}
    lost = [key for name, key in holders.items() if name not in names]
    for name, kind in layers:
        if kind in _OF_ROS_1 and str(name.scalar) not in holders and lost:
            yield finding(
                name,
                f"layer {name.scalar} has no {_SOURCES}, so it marks no obstacle: they are below "
                f"{lost[0].scalar}, which is no layer; write `{name.scalar}:` there",
                key=f"{name.scalar} {lost[0].scalar}",
                related=[(lost[0], "the sources")],
            )


def _mappings(root: YamlNode | None) -> Iterator[YamlNode]:
    waiting = [root] if root is not None else []
    while waiting:
        node = waiting.pop()
        if node.kind == "mapping":
            yield node
            waiting += [value for _, value in node.entries]


def _layers(node: YamlNode) -> Iterator[tuple[YamlNode, str]]:
    plugins = node.get("plugins")
    for item in plugins.items if plugins is not None else ():
        name, kind = item.get("name"), item.get("type")
        if name is not None and kind is not None:
            yield name, str(kind.scalar)


def _costmap(layer: str, mark: str = "", more: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [obstacle_layer]{mark}
      obstacle_layer:
        plugin: {VOXEL_LAYER}
{layer}{more}
""",
    }


def _ros_1(sources: str, mark: str = "") -> dict[str, object]:
    return {
        "@urdf": True,
        "config/costmap_common.yaml": f"# costmap\n{sources}:\n  observation_sources: scan\n",
        "config/local_costmap.yaml": f"""local_costmap:
  plugins:
    - {{name: obstacle_layer, type: "costmap_2d::ObstacleLayer"}}{mark}
    - {{name: inflation_layer, type: "costmap_2d::InflationLayer"}}
""",
    }


_LISTED = "        observation_sources: scan"
_WITHOUT = "\n        scan: {topic: /scan, data_type: LaserScan}"
_SCAN = _WITHOUT.replace("}", ", max_obstacle_height: 2.0}")
_MARK = "  # ^ WIR024"
GOOD = [
    _costmap(_LISTED + _SCAN),
    _costmap(_LISTED + _WITHOUT.replace("}", ", marking: false}")),
    _costmap("        enabled: false"),
    _costmap(f"{_LISTED}{_SCAN}\n        z_voxels: 16"),
    _costmap(f"{_LISTED}{_SCAN}\n        z_voxels: 20\n        max_obstacle_height: 1.5"),
    _costmap("        observation_sources: $(var sources)"),
    {**_costmap(""), "config/sources.yaml": _costmap(_LISTED + _SCAN)["config/nav2.yaml"]},
    _ros_1("obstacle_layer"),
]
BAD = [
    _costmap("", _MARK),
    _costmap(_LISTED + _MARK + _WITHOUT),
    _costmap(_SCAN[1:], _MARK),
    _costmap(f"{_LISTED}{_MARK}", "", _SCAN.replace("scan:", "laser:")),
    _costmap(f"        z_voxels: 40{_MARK}\n        z_resolution: 0.05\n", "", _LISTED + _SCAN),
    _ros_1("obstacles_layer", _MARK),
]
