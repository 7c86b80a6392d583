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
from checker.ros.wiring.costmaps import COSTMAPS
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText
from checker.source.yaml import read_root

_PARAMETERS = "ros__parameters"
_SERVERS = ("controller_server", "planner_server")


@rule("WIR028", "costmap-block-not-nested", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report blocks of costmaps that lack one of the two levels of names."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        source = package.read(file.path)
        if not isinstance(source, SourceText) or "costmap" not in source.text:
            continue
        root = read_root(source)
        if root is None or not any(root.get(name) is not None for name in _SERVERS):
            continue
        for key, value in root.entries if root.kind == "mapping" else ():
            if key.scalar in COSTMAPS and value.get(_PARAMETERS) is not None:
                yield finding(
                    key,
                    f"no node reads this block: the costmap is /{key.scalar}/{key.scalar}, and "
                    f"runs with its defaults; write `{key.scalar}:` twice, one below the other",
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
