"""Parameters of a controller that are for another namespace than its controller manager.

A block of a parameter file is for the node of that full name: `arm_controller:` is only for
`/arm_controller`. In a `ros2_control_node` with a namespace the controller is another node, which
gets none of them: it is not configured, as its joints are missing, and the robot does not move. Of
a controller manager in Gazebo, R2C012 reports it.

A file with a block of the same node for the manager's namespace is for several robots: its blocks
for other namespaces are not reported.

Fix: put the blocks below the key of the namespace, or write `/**/arm_controller` for any namespace.
Source: rcl_yaml_param_parser; rclcpp, `parameter_map_from`; controller_manager,
`ControllerManager::add_controller_impl`.
"""

from checker.launch.ros2.graph import is_known
from checker.model.ros_parameters import unread_blocks
from checker.ros.ros2_control.launched import MANAGER_NODE
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WIR017", "controller-block-in-other-namespace", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report blocks of ros2_control_node and the spawned controllers that reach none of them."""
    spawners = filter(None, (node.spawner for node in wiring.nodes))
    spawned = {name.value for spawner in spawners for name in spawner.names}
    for node in wiring.nodes:
        namespace = node.node.namespace
        if node.node.executable.value != MANAGER_NODE or not is_known(namespace):
            continue
        for file in node.files:
            for block in unread_blocks(file.blocks, namespace, spawned | {node.name}):
                yield finding(
                    block.span,
                    f"{block.node} gets none of these parameters: they are for {block.name}, and "
                    f"ros2_control_node runs in {namespace}: write `/**/{block.node}:`",
                    key=f"{block.name} {namespace}",
                    related=[(node.node.span, "the controller manager")],
                )


_LAUNCH = """LaunchDescription([
        Node(package="controller_manager", executable="ros2_control_node", namespace="cell",
             parameters=[os.path.join(HERE, "config", "arm.yaml")]),
        Node(package="controller_manager", executable="spawner", namespace="cell",
             arguments=["arm_controller"]),
"""


def _arm(controller: str, mark: str = "", launch: str = _LAUNCH) -> dict[str, object]:
    return {
        "@bridge": True,
        "@launch": {"LaunchDescription([\n": launch},
        "config/arm.yaml": f"""/**/controller_manager:
  ros__parameters:
    arm_controller: {{type: joint_trajectory_controller/JointTrajectoryController}}
{controller}:{mark}
  ros__parameters: {{joints: [shoulder]}}
""",
    }


_MARK = "  # ^ WIR017"
GOOD = [
    _arm("/**/arm_controller"),
    _arm("/cell/arm_controller"),
    _arm("arm_controller", launch=_LAUNCH.replace(' namespace="cell",', "")),
    _arm("other_controller"),
]
BAD = [
    _arm("arm_controller", _MARK),
    _arm("/hall/arm_controller", _MARK),
]
