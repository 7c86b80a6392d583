"""A parameter of a Nav2 node has the name that it had in ROS 1.

The node does not declare it, ignores it without a message, and uses its default: with
`initial_pose_x` amcl starts at the origin, or waits for a pose. In a file that no launch file names
it is an info.

Fix: write the name of Nav2. For an initial pose also write `set_initial_pose: true`.
Source: amcl of ROS 1, wiki.ros.org/amcl; nav2_amcl, the parameters that it declares.
"""

from checker.base.resources import table
from checker.package.package import Package
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WIR036", "parameter-of-ros-1", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report parameters by the table of former names."""
    former = table("nav2_parameters")["ros_1"]
    for file in package.index.with_suffix(".yaml", ".yml"):
        launched = package.workspace.launches_file(file.path.rpartition("/")[2])
        for block in blocks_in(package, file.path, "ros__parameters"):
            names = former.get(block.node, {})
            for name in sorted(names.keys() & block.parameters.keys()):
                yield finding(
                    block.parameters[name],
                    f"{block.node} of Nav2 ignores {name}, its name in ROS 1: write {names[name]}",
                    severity=None if launched else Severity.INFO,
                )


def _params(name: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"amcl:\n  ros__parameters:\n    {name}: 2.0{mark}\n",
        "launch/nav.launch.xml": """<launch><node pkg="nav2_amcl" exec="amcl">
<param from="$(find-pkg-share acme_rover_bringup)/config/nav2.yaml"/></node></launch>
""",
    }


GOOD = [_params("alpha1"), _params("initial_pose.x")]
BAD = [_params("odom_alpha1", "  # ^ WIR036"), _params("initial_pose_x", "  # ^ WIR036")]
