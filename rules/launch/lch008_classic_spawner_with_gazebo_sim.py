"""A spawner of Gazebo Classic in a launch file that starts Gazebo Sim.

`spawn_entity.py` of gazebo_ros waits for a service of Gazebo Classic, which Gazebo Sim does not
have: the robot never appears.

Fix: use `create` of ros_gz_sim, `Node(package='ros_gz_sim', executable='create', …)`.
Source: gazebo_ros `spawn_entity.py`; ros_gz_sim `create`.
"""

from checker.launch.ros2.graph import GAZEBO, LaunchGraph, Ros2Launch, share_path
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH008", "classic-spawner-with-gazebo-sim", Severity.WARNING, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report spawners of Gazebo Classic with Gazebo Sim."""
    for graph in launch.entries:
        if not _starts_gazebo_sim(graph):
            continue
        for node in graph.nodes:
            if node.package.value == "gazebo_ros" and node.starts is True:
                yield finding(
                    node.package,
                    f"{node.executable.value} of gazebo_ros is for Gazebo Classic, and this launch "
                    "file starts Gazebo Sim: expected create of ros_gz_sim",
                )


def _starts_gazebo_sim(graph: LaunchGraph) -> bool:
    for include in graph.includes:
        target = share_path(include.target.value)
        if target is not None and target.package in GAZEBO and include.starts is True:
            return True
    return False


_SIMULATOR = """        IncludeLaunchDescription(PythonLaunchDescriptionSource(PathJoinSubstitution(
            [FindPackageShare('ros_gz_sim'), 'launch', 'gz_sim.launch.py']))),"""
_SPAWN = """        Node(package='gazebo_ros', executable='spawn_entity.py',
             arguments=['-topic', 'robot_description', '-entity', 'arm']),"""

GOOD = [{"@ros2": _SPAWN}, {"@ros2": _SIMULATOR}]
BAD = [
    {"@ros2": _SIMULATOR + "\n" + _SPAWN.replace(".py',", ".py',  # ^ LCH008")},
]
