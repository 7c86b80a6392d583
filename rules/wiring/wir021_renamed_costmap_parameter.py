"""A range of a costmap layer by a name that the distribution of Nav2 does not read.

Since Galactic the obstacle and voxel layers read `obstacle_max_range` and `raytrace_max_range` for
`obstacle_range` and `raytrace_range`. A name that is not read changes nothing: obstacles are marked
up to 2.5 m and cleared up to 3 m, the defaults, whatever the file says.

Layers of other packages keep their names, and are not checked.

Fix: write the name that the message gives.
Source: navigation2, pull request 2126, January 2021.
"""

from checker.package.package import Package
from checker.ros.wiring.costmaps import OBSTACLE_LAYER, VOXEL_LAYER, costmap_blocks
from checker.rule import Concern, Findings, Severity, finding, rule

_NEWER = {"obstacle_range": "obstacle_max_range", "raytrace_range": "raytrace_max_range"}
_OLDER = {new: old for old, new in _NEWER.items()}


@rule("WIR021", "renamed-costmap-parameter", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report ranges of observation sources by their former or later name."""
    sign = package.distribution_sign
    in_foxy = sign is not None and sign.distro == "foxy"
    names = _OLDER if in_foxy else _NEWER
    for costmap in costmap_blocks(package):
        for path, parameter in costmap.block.parameters.items():
            layer, name = path.partition(".")[0], path.rpartition(".")[2]
            if name in names and costmap.observes(layer):
                yield finding(
                    parameter.span,
                    f"{path} is not read, so the default counts: "
                    f"{'Foxy' if in_foxy else 'Nav2 since Galactic'} reads {names[name]}",
                    key=name,
                )


def _costmap(name: str, mark: str = "", plugin: str = OBSTACLE_LAYER) -> dict[str, object]:
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
    _costmap("raytrace_range", _MARK, VOXEL_LAYER),
    {**_costmap("obstacle_max_range", _MARK), **_FOXY},
]
