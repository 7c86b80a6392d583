"""A planning pipeline of MoveIt in the form of another ROS 2 distribution.

Humble reads `planning_plugin`, and `request_adapters` as one text with spaces, of names
`default_planner_request_adapters/…`. Since Jazzy they are lists: `planning_plugins`,
`request_adapters` of `default_planning_request_adapters/…`, and `response_adapters` of
`default_planning_response_adapters/…`. A text for a list, or a list for a text, ends move_group:
"expected [string_array] got [string]". So does an adapter of a name that is no longer there; and a
pipeline without `planning_plugins` has no planner, so nothing is planned.

The files `…planning.yaml` are judged where the package names its distribution, or `--distro` does;
what no launch file loads is a warning.

Fix: since Jazzy, `planning_plugins: [ompl_interface/OMPLPlanner]`; below `request_adapters`
ResolveConstraintFrames, ValidateWorkspaceBounds, CheckStartStateBounds and
CheckStartStateCollision; below `response_adapters` AddTimeOptimalParameterization,
ValidateSolution and DisplayMotionPath.
Source: MoveIt 2, MIGRATION.md, and planning_pipeline.cpp of humble and jazzy; moveit/moveit2#2854.
"""

import posixpath
from collections.abc import Iterator

from checker.base.record import Record
from checker.package.package import Package
from checker.ros.ros2_control.distributions import ORDER, named_distribution
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.yaml import YamlNode, read_root

_FILES = "planning.yaml"
_BUILDER, _CHOICE = "MoveItConfigsBuilder", "pipelines="
_OLD, _NEW = "planning_plugin", "planning_plugins"
_ADAPTERS = ("request_adapters", "response_adapters")
_OLD_NAMES = "default_planner_request_adapters/"
_SINCE_JAZZY = ("jazzy", "kilted", "lyrical", "rolling")
_DEEPEST = 5


class _Fault(Record):
    node: YamlNode
    message: str


@rule("URD037", "planning-pipeline-of-another-release", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, context: Context) -> Findings:
    """Report pipelines that the distribution does not read, each at the first place."""
    named = named_distribution(package, context)
    if named not in (*_SINCE_JAZZY, "humble"):
        return
    others = {it for it in ORDER if it != named}
    for file in package.index.with_suffix(_FILES):
        root = read_root(package.read(file.path))
        is_other = any(it in file.path.lower() for it in others)
        if root is None or is_other or package.lies_in_unit(file.path):
            continue
        for pipeline in _pipelines(root):
            faults = [*(_since_jazzy if named in _SINCE_JAZZY else _in_humble)(pipeline)]
            if faults:
                yield finding(
                    faults[0].node,
                    f"MoveIt of {named.capitalize()} {faults[0].message}",
                    severity=None if _is_loaded(package, file.path) else Severity.WARNING,
                    related=[(it.node, f"it {it.message}") for it in faults[1:]],
                )


def _pipelines(node: YamlNode, depth: int = 0) -> Iterator[YamlNode]:
    """Yield the mappings that name a planner, wherever they are."""
    if node.get(_OLD) is not None or node.get(_NEW) is not None:
        yield node
    for _, below in node.entries if depth < _DEEPEST else ():
        yield from _pipelines(below, depth + 1)


def _since_jazzy(pipeline: YamlNode) -> Iterator[_Fault]:
    old, new = pipeline.get(_OLD), pipeline.get(_NEW)
    if new is None and old is not None:
        yield _Fault(old, f"does not read {_OLD}: write `{_NEW}: [{old.scalar}]`")
    for key in (_NEW, *_ADAPTERS):
        given = pipeline.get(key)
        if given is not None and isinstance(given.scalar, str):
            yield _Fault(given, f"stops at this text: {key} is a list")
    for item in (it for key in _ADAPTERS if (given := pipeline.get(key)) for it in given.items):
        if str(item.scalar).startswith(_OLD_NAMES):
            yield _Fault(item, f"has no adapter {item.scalar}")


def _in_humble(pipeline: YamlNode) -> Iterator[_Fault]:
    given = pipeline.get(_ADAPTERS[0])
    if given is not None and given.kind == "sequence":
        yield _Fault(given, f"stops at this list: {_ADAPTERS[0]} is one text with spaces")


def _is_loaded(package: Package, path: str) -> bool:
    """Return whether a launch file names a file, or MoveIt's builder takes it for its name."""
    name = posixpath.basename(path)
    pipeline = name.removesuffix(f"_{_FILES}")
    quoted = (f'"{pipeline}"', f"'{pipeline}'")
    return package.workspace.launches_file(name) or any(
        _CHOICE not in text or any(it in text for it in quoted)
        for text in package.workspace.launches_with(_BUILDER)
    )


def _pipeline(distribution: str, lines: str, file: str = "ompl_planning.yaml") -> dict[str, object]:
    return {
        "@urdf": True,
        "README.md": f"An arm for ROS 2 {distribution}.\n",
        f"config/{file}": lines,
    }


_HUMBLE = """planning_plugin: ompl_interface/OMPLPlanner{}
request_adapters: >-
  default_planner_request_adapters/AddTimeOptimalParameterization
  default_planner_request_adapters/ResolveConstraintFrames
"""
_JAZZY = """planning_plugins: [ompl_interface/OMPLPlanner]
request_adapters:
  - default_planning_request_adapters/ResolveConstraintFrames
response_adapters: [default_planning_response_adapters/ValidateSolution]
"""
_MARK = "  # ^ URD037"
_LIST = "planning_plugin: ompl_interface/OMPLPlanner\nrequest_adapters: [a/B, a/C]"
GOOD = [
    _pipeline("Humble", _HUMBLE.format("")),
    _pipeline("Jazzy", _JAZZY),
    _pipeline("Jazzy", _JAZZY + "planning_plugin: ompl_interface/OMPLPlanner\n"),
    _pipeline("Jazzy", _HUMBLE.format(""), "humble_planning.yaml"),
    _pipeline("Jazzy", "arm:\n  planner_configs: [RRTConnect]\n"),
]
BAD = [
    _pipeline("Jazzy", _HUMBLE.format(_MARK)),
    _pipeline("Jazzy", "move_group:\n  ros__parameters:\n    planning_plugin: a/B" + _MARK),
    _pipeline("Jazzy", f"planning_plugins: ompl_interface/OMPLPlanner{_MARK}\n"),
    _pipeline(
        "Jazzy",
        _JAZZY.replace("planning_request", "planner_request").replace(
            "ConstraintFrames", f"ConstraintFrames{_MARK}"
        ),
    ),
    _pipeline("Humble", _LIST + _MARK),
]
