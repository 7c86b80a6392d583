"""The wiring of a launch: which parameters a node gets, and what is not known."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.ros.wiring.services import wanted_services
from checker.ros.wiring.wiring import Wiring
from checker.rule_testing import write_example

HEAD = "LaunchDescription([\n"
IMPORT = "from launch_ros.actions import Node\n"
IMPORTS = f"""{IMPORT}from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from nav2_common.launch import ReplaceString
"""
FILE = 'os.path.join(HERE, "config", "a.yaml")'


def wiring(nodes: str, folder: Path, yaml: str = "") -> Wiring:
    """Return the wiring of a launch file that starts nodes beside those of a rover."""
    changes = {HEAD: f"{HEAD}{nodes},\n", IMPORT: IMPORTS}
    example = {"@bridge": True, "@launch": changes, "config/a.yaml": yaml}
    with open_input(write_example(example, folder)) as opened:
        subject = Subject(opened.packages[0])
        found = subject.all(Wiring)
        subject.close()
    assert not isinstance(found, NotAvailable)
    (launched,) = found
    return launched


@pytest.mark.parametrize(
    ("node", "yaml", "value"),
    [
        (f"parameters=[{FILE}]", "lidar: {ros__parameters: {rate: 1}}", 1),
        (f"parameters=[{FILE}]", "/lidar: {ros__parameters: {rate: 1}}", 1),
        (f"parameters=[{FILE}]", "/**/lidar: {ros__parameters: {rate: 1}}", 1),
        (f"parameters=[{FILE}]", "camera: {ros__parameters: {rate: 1}}", None),
        (f"parameters=[{FILE}]", "r1/lidar: {ros__parameters: {rate: 1}}", None),
        (f"parameters=[{FILE}], namespace='r1'", "lidar: {ros__parameters: {rate: 1}}", None),
        (f"parameters=[{FILE}], namespace='r1'", "r1: {lidar: {ros__parameters: {rate: 1}}}", 1),
        (f"parameters=[{FILE}], namespace='r1'", "'/*/lidar': {ros__parameters: {rate: 1}}", 1),
        (
            f"parameters=[{FILE}]",
            "lidar: {ros__parameters: {rate: 1}}\n/**: {ros__parameters: {rate: 2}}",
            2,
        ),
        (f"parameters=[{FILE}, {{'rate': 3}}]", "lidar: {ros__parameters: {rate: 1}}", 3),
        (f"parameters=[{{'rate': 3}}, {FILE}]", "lidar: {ros__parameters: {rate: 1}}", 1),
        (
            f"parameters=[{FILE}, {{'rate': 3}}]",
            "/**: {ros__parameters: {rate: 2}}\nlidar: {ros__parameters: {rate: 1}}",
            1,  # what the launch file says is for every node, and joins the first block
        ),
        (
            f"parameters=[{FILE}, {{'rate': 3}}], namespace='r1'",
            "/**: {ros__parameters: {rate: 2}}\n/**/lidar: {ros__parameters: {rate: 1}}",
            3,
        ),
    ],
)
def test_the_parameters_that_count(node: str, yaml: str, value: int | None, tmp_path: Path) -> None:
    launched = wiring(f'Node(package="a", executable="b", name="lidar", {node})', tmp_path, yaml)

    setting = launched.nodes[0].settings.get("rate")
    assert (setting.value if setting is not None else None) == value


@pytest.mark.parametrize(
    ("replacing", "value"),
    [
        ('{"base_frame: base": ("base_frame: ", "r1", "/base")}', "r1/base"),
        ('{"frame: base": "frame: hull"}, condition=IfCondition("true")', "hull"),
        ('{"frame: base": "frame: hull"}, condition=IfCondition("false")', "base"),
        ('{"frame: base": "frame: hull"}, condition=IfCondition(LaunchConfiguration("n"))', None),
        ('{"base_frame: base": LaunchConfiguration("n")}', None),
        ('{"odom": "r1/odom"}', "base"),
    ],
)
def test_what_a_launch_file_replaces_in_a_file(
    replacing: str, value: str | None, tmp_path: Path
) -> None:
    launched = wiring(
        'DeclareLaunchArgument("n"), Node(package="a", executable="b", name="lidar", '
        f"parameters=[ReplaceString({FILE}, {replacing})])",
        tmp_path,
        "lidar: {ros__parameters: {base_frame: base}}",
    )

    assert launched.nodes[0].settings["base_frame"].text == value


@pytest.mark.parametrize(
    ("action", "why"),
    [
        ('Node(package="a", executable="b")', "what a/b publishes is not known"),
        (
            'Node(package="topic_tools", executable="relay")',
            "some of the topics that topic_tools/relay publishes are not known",
        ),
        ("another()", "another is not defined"),
        ('Node(package="joy", executable="joy_node")', ""),
    ],
)
def test_what_else_may_publish(action: str, why: str, tmp_path: Path) -> None:
    unknown = wiring(action, tmp_path).more_publishers("std_msgs/msg/String")

    assert unknown.startswith(why)
    assert bool(unknown) is bool(why)


def test_names_that_a_command_line_gives_are_not_known(tmp_path: Path) -> None:
    node = 'Node(package="joy", executable="joy_node", ros_arguments=["-r", "__node:=stick"])'
    launched = wiring(node, tmp_path)

    assert launched.nodes[0].full_name == ""
    assert not launched.nodes[0].knows_parameters


CONTROL = """controller_manager:
  ros__parameters:
    base: {type: diff_drive_controller/DiffDriveController}
    lidar: {type: acme_controllers/Lidar}
base:
  ros__parameters: {}
"""
MANAGER = 'Node(package="controller_manager", executable="ros2_control_node", {})'
SPAWNER = 'Node(package="controller_manager", executable="spawner", arguments=["base"{}])'


@pytest.mark.parametrize(
    ("manager", "spawner", "topic"),
    [
        (f"parameters=[{FILE}]", "", "/base/odom"),
        (f'parameters=[{FILE}], remappings=[("~/odom", "/odom")]', "", "/odom"),
        (f'parameters=[{FILE}], remappings=[("/base/odom", "/odom")]', "", "/odom"),
        (f'parameters=[{FILE}], namespace="r1"', "", "/r1/base/odom"),
        (
            f"parameters=[{FILE}]",
            ', "--controller-ros-args", "-r ~/odom:=/wheels/odom"',
            "/wheels/odom",
        ),
    ],
)
def test_where_a_controller_publishes(
    manager: str, spawner: str, topic: str, tmp_path: Path
) -> None:
    nodes = f"{MANAGER.format(manager)}, {SPAWNER.format(spawner)}"
    launched = wiring(nodes, tmp_path, CONTROL)

    assert list(launched.publishers("nav_msgs/msg/Odometry")) == [topic]


def test_topics_of_costmaps_that_are_relative_are_not_known(tmp_path: Path) -> None:
    yaml = """local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [a, b]
      a: {observation_sources: x y, x: {topic: /x}, y: {topic: y}}
      b: {observation_sources: z, z: {topic: /z, data_type: PointCloud2}, enabled: true}
      c: {observation_sources: w, w: {topic: /w}}
"""
    node = f'Node(package="nav2_controller", executable="controller_server", parameters=[{FILE}])'
    launched = wiring(node, tmp_path, yaml)

    told = [it for it in launched.endpoints if it.parameter]
    assert [(it.topic, *it.types) for it in told] == [
        ("/x", "sensor_msgs/msg/LaserScan"),
        ("/z", "sensor_msgs/msg/PointCloud2"),
    ]


@pytest.mark.parametrize(
    ("nodes", "why"),
    [
        (SPAWNER.format(""), "what controller 'base' publishes is not known"),
        ('Node(package="joy", executable="joy_node")', ""),
    ],
)
def test_what_parts_may_publish_unseen(nodes: str, why: str, tmp_path: Path) -> None:
    assert wiring(nodes, tmp_path).unknown_parts == why


@pytest.mark.parametrize(
    ("node", "names"),
    [
        ('parameters=[{"node_names": ["amcl", "r1/map_server"]}]', ["/amcl", "/r1/map_server"]),
        ('namespace="r1", parameters=[{"node_names": ["amcl"]}]', ["/r1/amcl"]),
        ('parameters=[{"node_names": LaunchConfiguration("x")}]', []),
        ("parameters=[other()]", []),
    ],
)
def test_the_nodes_that_a_lifecycle_manager_waits_for(
    node: str, names: list[str], tmp_path: Path
) -> None:
    manager = f'Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", {node})'
    launched = wiring(manager, tmp_path)

    assert [it.name for it in wanted_services(launched.nodes[0])] == [
        f"{name}/get_state" for name in names
    ]
