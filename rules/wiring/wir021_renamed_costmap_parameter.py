"""A range of a costmap layer by a name that the distribution of Nav2 does not read.

Since Galactic the obstacle and voxel layers read `obstacle_max_range` and `raytrace_max_range` for
`obstacle_range` and `raytrace_range`. A name that is not read changes nothing: obstacles are marked
up to 2.5 m and cleared up to 3 m, the defaults, whatever the file says.

Layers of other packages keep their names, and are not checked.

Fix: write the name that the message gives.
Source: navigation2, pull request 2126, January 2021.
"""

from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Findings, Severity, finding, rule

_NEWER = {"obstacle_range": "obstacle_max_range", "raytrace_range": "raytrace_max_range"}
_OLDER = {new: old for old, new in _NEWER.items()}
_LAYERS = ("nav2_costmap_2d::ObstacleLayer", "nav2_costmap_2d::VoxelLayer")
_COSTMAPS = ("local_costmap", "global_costmap")


@rule("WIR021", "renamed-costmap-parameter", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report ranges of observation sources by their former or later name."""
    sign = package.distribution_sign
    in_foxy = sign is not None and sign.distro == "foxy"
    names = _OLDER if in_foxy else _NEWER
    for file in package.index.with_suffix(".yaml", ".yml"):
        for block in blocks_in(package, file.path, "nav2_costmap_2d"):
            if block.node not in _COSTMAPS:
                continue
            for path, parameter in block.parameters.items():
                layer, name = path.partition(".")[0], path.rpartition(".")[2]
                plugin = block.parameters.get(f"{layer}.plugin")
                of_nav2 = plugin is not None and any(it.value in _LAYERS for it in plugin.texts)
                if of_nav2 and name in names:
                    yield finding(
                        parameter.span,
                        f"{path} is not read, so the default counts: "
                        f"{'Foxy' if in_foxy else 'Nav2 since Galactic'} reads {names[name]}",
                        key=name,
                    )


def _costmap(name: str, mark: str = "", plugin: str = _LAYERS[0]) -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [obstacle_layer]
      obstacle_layer:
        plugin: "{plugin}"
        observation_sources: scan
        scan:
          topic: /scan
          {name}: 6.0{mark}
""",
    }


_FOXY = {"README.md": "A rover for ROS 2 Foxy.\n"}
_MARK = "  # ^ WIR021"
GOOD = [
    _costmap("obstacle_max_range"),
    {**_costmap("obstacle_range"), **_FOXY},
    _costmap("obstacle_range", plugin="spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer"),
]
BAD = [
    _costmap("obstacle_range", _MARK),
    _costmap("raytrace_range", _MARK, _LAYERS[1]),
    {**_costmap("obstacle_max_range", _MARK), **_FOXY},
]
