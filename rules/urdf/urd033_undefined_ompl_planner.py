"""A planner of OMPL that a group of MoveIt lists and the file does not define.

MoveIt reads the definition of each listed planner below `planner_configs` at the top. Without one
it logs "Could not find the planner configuration", and the planner cannot be chosen; a request that
names it gets the default, RRTConnect. Definitions that are written below a group are never read.

A file without `planner_configs` at the top is judged by definitions below its groups alone: the
names of the others may be those of the defaults that `MoveItConfigsBuilder` adds.

Fix: write the definitions below `planner_configs:` at the top, and their names below the group.
Source: MoveIt, OMPLInterface::loadPlannerConfigurations; moveit_configs_utils, ompl_defaults.yaml.
"""

from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, misspelt, rule
from checker.source.text import Located
from checker.source.yaml import YamlNode, read_root

_FILE = "ompl_planning.yaml"
_PLANNERS = "planner_configs"


@rule("URD033", "undefined-ompl-planner", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report planners without a definition, and definitions below groups."""
    for file in package.index.with_suffix(_FILE):
        root = read_root(package.read(file.path))
        top = (root.get("ompl") or root) if root is not None else None
        for name, group in top.entries if top is not None else ():
            if top is not None and name.scalar != _PLANNERS:
                yield from _judged(str(name.scalar), group, top.get(_PLANNERS))


def _judged(name: str, group: YamlNode, defined: YamlNode | None) -> Iterator[Finding]:
    """Judge the planners of a group by the definitions at the top, if there are any."""
    listed = group.get(_PLANNERS)
    known = [str(key.scalar) for key, _ in defined.entries] if defined is not None else []
    below = [(key, it) for key, it in group.entries if _is_definition(it)]
    below += [(key, it) for key, it in listed.entries if _is_definition(it)] if listed else []
    lost = [key for key, _ in below if key.scalar not in known]
    for key in lost:
        yield finding(
            key,
            f"MoveIt does not read planner {key.scalar!r} below group {name!r}: write its "
            f"definition below {_PLANNERS} at the top of the file",
            key=f"{name} {_PLANNERS}",
        )
    suggestions, gone = Suggestions(known), [key.scalar for key in lost]
    for item in listed.items if listed is not None and known else ():
        if isinstance(item.scalar, str) and item.scalar not in (*known, *gone):
            yield misspelt(
                Located(item.scalar, item.span),
                f"planner {item.scalar!r} of group {name!r} has no definition below {_PLANNERS}: "
                "MoveIt plans with RRTConnect instead",
                suggestions,
            )


def _is_definition(node: YamlNode) -> bool:
    kind = node.get("type")
    return kind is not None and str(kind.scalar).startswith("geometric::")


def _planners(top: str, group: str) -> dict[str, object]:
    return {"@urdf": True, f"config/{_FILE}": f"{top}arm:\n{group}\n"}


_TOP = "planner_configs:\n  RRTConnect: {type: 'geometric::RRTConnect'}\n"
_MARK = "  # ^ URD033"
GOOD = [
    _planners(_TOP, "  planner_configs: [RRTConnect]"),
    _planners(_TOP, "  longest_valid_segment_fraction: 0.005"),
    _planners("", "  planner_configs: [RRTConnectkConfigDefault]"),
    _planners("planning_plugin: ompl_interface/OMPLPlanner\n", "  planner_configs: [RRT]"),
]
BAD = [
    _planners(_TOP, f"  planner_configs:\n    - RRTConect{_MARK}"),
    _planners(_TOP, f"  planner_configs:\n    - RRTConnect\n    - PRM{_MARK}"),
    _planners("", f"  planner_configs:\n    PRM: {{type: 'geometric::PRM'}}{_MARK}"),
    _planners(
        "", f"  planner_configs: [PRM]\n  PRM:{_MARK}\n    type: geometric::PRM\n    range: 0.0"
    ),
]
