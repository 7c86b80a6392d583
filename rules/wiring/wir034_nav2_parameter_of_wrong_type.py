"""A parameter of Nav2 has another type than the node declares.

ROS does not convert the types of parameters: where a `double` is declared, `20` is refused and
`20.0` is right. The node throws `InvalidParameterTypeException` while it is configured, and the
lifecycle manager aborts the bringup: no node of Nav2 becomes active.

The nodes and plugins of Nav2 itself are checked, by their usual names, in Humble, Jazzy and Kilted;
Foxy took other types as well. It is a warning in a file that no launch file names, and where
nothing shows the distribution.

Fix: write the number with a decimal point where a `double` is declared, without one for an `int`.
Source: navigation2, what its nodes and plugins declare, by branch; rclcpp,
`InvalidParameterTypeException`.
"""

from collections.abc import Iterator, Mapping

from checker.base.resources import table
from checker.model.ros_parameters import NodeBlock, Parameter
from checker.package.distribution_sign import former_name
from checker.package.package import Package
from checker.ros.ros2_control.distributions import distribution_of
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Context, Findings, Severity, finding, replace_text, rule

_PLUGIN = ".plugin"
_LONGEST = 40
"""Characters of a value that a message shows."""


@rule("WIR034", "nav2-parameter-of-wrong-type", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, context: Context) -> Findings:
    """Report numbers and truth values that Nav2 declares with another type."""
    distribution = distribution_of(context)
    if former_name(package):
        return
    for file in package.index.with_suffix(".yaml", ".yml"):
        launched = package.workspace.launches_file(file.path.rpartition("/")[2])
        certain = launched and package.distribution_sign is not None
        for block in blocks_in(package, file.path, "ros__parameters"):
            for parameter, kind in _declared(block, distribution):
                found = parameter.type
                if not found or found == kind or not parameter.is_known:
                    continue
                number = found == "int" and kind == "double"
                text = parameter.span.text
                yield finding(
                    parameter,
                    f"{block.node} refuses {parameter.name}: {text[:_LONGEST]} is of type {found}, "
                    f"expected {kind}" + (f": write {text}.0" if number else ""),
                    severity=None if certain else Severity.WARNING,
                    fix=replace_text(parameter, f"{text}.0") if number else None,
                )


def _declared(block: NodeBlock, distribution: str) -> Iterator[tuple[Parameter, str]]:
    """Yield the parameters of a node that Nav2 declares, each with its type."""
    known = table("nav2_parameters")
    own = known["nodes"].get(block.node)
    for name, parameter in block.parameters.items() if own is not None else ():
        kind = _type(own, name, distribution)
        owner, _, rest = name.partition(".")
        named = block.parameters.get(f"{owner}{_PLUGIN}")
        if rest and named is not None and named.texts:
            plugin = known["plugins"].get(named.texts[0].value.replace("/", "::"), {})
            source = f"*.{rest.rpartition('.')[2]}"
            kind = _type(plugin, rest, distribution) or _type(plugin, source, distribution)
        if kind:
            yield parameter, kind


def _type(declared: Mapping[str, str], name: str, distribution: str) -> str:
    """Return the type that a distribution declares; empty if it declares none."""
    kind, *distributions = declared.get(name, "").split(" ")
    return kind if not distributions or distribution in distributions else ""


def _params(time: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""controller_server:
  ros__parameters:
    controller_frequency: 20.0
    progress_checker:
      plugin: nav2_controller::SimpleProgressChecker
      movement_time_allowance: {time}{mark}
""",
        "launch/nav.launch.xml": """<launch><node pkg="nav2_controller" exec="controller_server">
<param from="$(find-pkg-share acme_rover_bringup)/config/nav2.yaml"/></node></launch>
""",
    }


def _costmap(height: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"""local_costmap:
  local_costmap:
    ros__parameters:
      width: 3
      obstacles:
        plugin: nav2_costmap_2d::ObstacleLayer
        observation_sources: scan
        scan: {{max_obstacle_height: {height}}}{mark}
""",
    }


_MARK = "  # ^ WIR034"
GOOD = [_params("20.0"), _costmap("2.0"), _params("$(var time)")]
BAD = [_params("20", _MARK), _params("'20'", _MARK), _costmap("2", _MARK)]
