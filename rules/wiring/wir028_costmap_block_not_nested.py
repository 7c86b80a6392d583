"""Parameters of a costmap of Nav2 in a block that no node reads.

The costmaps are nodes in a namespace of their own name: `/local_costmap/local_costmap`. A block
`local_costmap:` with `ros__parameters:` directly below is for a node `/local_costmap`, which does
not exist: the costmap runs with its defaults, without the sources, the footprint and the frames of
the file, and says so nowhere.

It is reported in files with parameters of Nav2's controller or planner.

Fix: write the name twice: `local_costmap:`, below it `local_costmap:`, below it `ros__parameters:`.
Source: navigation2, `Costmap2DROS`: the namespace of a costmap is its name; rcl_yaml_param_parser:
keys are namespaces and names of nodes.
"""

from checker.package.package import Package
from checker.ros.wiring.costmaps import costmap_blocks
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Findings, Severity, finding, rule

_SERVERS = frozenset({"controller_server", "planner_server"})


@rule("WIR028", "costmap-block-not-nested", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report blocks of costmaps that lack one of the two levels of names."""
    for costmap in costmap_blocks(package):
        name, block = costmap.block.node, costmap.block
        servers = (it.node for it in blocks_in(package, costmap.file, name))
        if block.name.strip("/") == name and not _SERVERS.isdisjoint(servers):
            yield finding(
                block.span,
                f"no node reads this block: the costmap is /{name}/{name}, and runs with its "
                f"defaults; write `{name}:` twice, one below the other",
            )


def _file(costmap: str, server: str = "controller_server") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""{server}:
  ros__parameters: {{controller_frequency: 20.0}}
{costmap}
""",
    }


_FLAT = """local_costmap:{}
  ros__parameters: {{width: 3}}"""
GOOD = [
    _file("local_costmap:\n  local_costmap:\n    ros__parameters: {width: 3}"),
    _file(_FLAT.format(""), "other_server"),
]
BAD = [_file(_FLAT.format("  # ^ WIR028"))]
