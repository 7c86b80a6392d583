"""Which Gazebo a launch file starts, which world it loads, and what its special actions bridge."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.ros.simulation import Simulation
from tests.bridges.test_bridges_of_launch_files import simulation

GAZEBO = 'IncludeLaunchDescription(gazebo, launch_arguments=[("gz_args", "-r empty.sdf")]),'
HALL = '<sdf version="1.9"><world name="hall"/></sdf>'
WORLD = 'os.path.join(HERE, "worlds", "hall.sdf")'
IMPORTS = "from launch.actions import IncludeLaunchDescription\n"


def started(action: str, folder: Path) -> Simulation:
    """Return what a launch file simulates that starts Gazebo by another action."""
    imports = (
        f"{IMPORTS}from launch.actions import ExecuteProcess\n"
        "from launch_ros.actions import ComposableNodeContainer\n"
        "from launch_ros.descriptions import ComposableNode\n"
        "from ros_gz_bridge.actions import RosGzBridge\nfrom ros_gz_sim.actions import GzServer\n"
    )
    changes = {GAZEBO: f"{action},", IMPORTS: imports}
    return simulation({"@launch": changes, "worlds/hall.sdf": HALL}, folder)


def included(file: str, arguments: str) -> str:
    path = f'os.path.join(get_package_share_directory("ros_gz_sim"), "launch", "{file}")'
    return f"IncludeLaunchDescription({path}, launch_arguments=[{arguments}])"


@pytest.mark.parametrize(
    "action",
    [
        f'IncludeLaunchDescription(gazebo, launch_arguments=[("gz_args", ["-r -s ", {WORLD}])])',
        included("gz_server.launch.py", f'("world_sdf_file", {WORLD})'),
        included("ros_gz_sim.launch.py", f'("world_sdf_file", {WORLD})'),
        f'ExecuteProcess(cmd=["gz", "sim", "-r", {WORLD}])',
        f"GzServer(world_sdf_file={WORLD})",
        f'Node(package="ros_gz_sim", executable="gzserver",\n'
        f'     parameters=[{{"world_sdf_file": {WORLD}}}])',
        'ComposableNodeContainer(name="c", composable_node_descriptions=[ComposableNode(\n'
        '    package="ros_gz_sim", plugin="ros_gz_sim::GzServer",\n'
        f'    parameters=[{{"world_sdf_file": {WORLD}}}])])',
    ],
)
def test_the_world_is_known(action: str, tmp_path: Path) -> None:
    found = started(action, tmp_path)

    assert [world.name for world in found.worlds] == ["hall"]
    assert found.starts_gazebo
    assert not found.unknown_worlds


@pytest.mark.parametrize(
    ("action", "servers", "unknown"),
    [
        (included("gz_sim.launch.py", '("gz_args", "-g")'), 0, 0),
        (included("gz_gui.launch.py", ""), 0, 0),
        ('ExecuteProcess(cmd=["gz", "topic", "-l"])', 0, 0),
        (included("gz_sim.launch.py", '("gz_args", "-r elsewhere.sdf")'), 1, 1),
        ('GzServer(world_sdf_string="<sdf/>")', 1, 1),
        (included("gz_sim.launch.py", '("gz_args", "-r empty.sdf")'), 1, 0),
    ],
)
def test_servers_without_a_world_at_hand(
    action: str, servers: int, unknown: int, tmp_path: Path
) -> None:
    found = started(action, tmp_path)

    assert len(found.servers) == servers
    assert len(found.unknown_worlds) == unknown
    assert not found.worlds


BRIDGE = 'os.path.join(HERE, "config", "bridge.yaml")'


@pytest.mark.parametrize(
    ("action", "topic"),
    [
        (f'RosGzBridge(bridge_name="b", config_file={BRIDGE})', "/odom"),
        (f'RosGzBridge(bridge_name="b", config_file={BRIDGE}, namespace="r1")', "/r1/odom"),
        (included("ros_gz_sim.launch.py", f'("config_file", {BRIDGE})'), "/odom"),
        (
            included("ros_gz_sim.launch.py", f'("config_file", {BRIDGE}), ("namespace", "r1")'),
            "/r1/odom",
        ),
    ],
)
def test_special_actions_bridge(action: str, topic: str, tmp_path: Path) -> None:
    found = started(action, tmp_path)

    assert [entry.ros_topic for entry in found.entries].count(topic) == 1 + (topic == "/odom")


XML = """<launch>
  <gz_server world_sdf_file="$(find-pkg-share acme_rover_bringup)/worlds/hall.sdf"/>
  <ros_gz_bridge bridge_name="b"
    config_file="$(find-pkg-share acme_rover_bringup)/config/bridge.yaml"/>
</launch>
"""


def test_tags_are_read_as_well(tmp_path: Path) -> None:
    launched = {"launch/rover.launch.py": None, "launch/rover.launch.xml": XML}
    found = simulation({**launched, "worlds/hall.sdf": HALL}, tmp_path)

    assert [world.name for world in found.worlds] == ["hall"]
    assert [entry.ros_topic for entry in found.entries] == ["/odom"]


def test_services_are_read(tmp_path: Path) -> None:
    service = "- {service_name: /world/hall/control, ros_type_name: a/srv/B}\n"
    found = simulation({"@bridge": service}, tmp_path)

    assert [each.name.value for each in found.bridges.services] == ["/world/hall/control"]
    assert not found.entries


def test_robots_that_a_launch_file_of_gazebo_spawns_are_not_known(tmp_path: Path) -> None:
    action = included("ros_gz_spawn_model.launch.py", '("topic", "robot_description")')
    found = started(f"{GAZEBO} {action}", tmp_path)

    assert len(found.robots) == 1
    assert "spawns is not known" in found.unknown_robots[0]


SERVICE = """"-s", "/world/empty/create", "--reqtype", "gz.msgs.EntityFactory", "--req" """


@pytest.mark.parametrize(
    "command",
    [
        'cmd=["ros2", "run", "ros_gz_sim", "create", "-file", URDF, "-name", "second"]',
        f"""cmd=["gz", "service", {SERVICE}, f'name: "second", sdf_filename: "{{URDF}}"']""",
        f"""cmd=["ign", "service", {SERVICE}, ["sdf_filename: '", URDF, "' name: 'second'"]]""",
        f"""cmd=["gz", "service", {SERVICE}, 'name: "second" sdf: "' + description + '"']""",
        """cmd=["bash", "-c", "sleep 5; gz service -s /world/empty/create --req "
            "'sdf_filename: \\"" + URDF + "\\", name: \\"second\\"'"]""",
        """cmd=["gz service -s /world/empty/create --req 'sdf_filename: \\"" + URDF +
            "\\" name: \\"second\\"'"], shell=True""",
    ],
)
def test_robots_that_commands_spawn(command: str, tmp_path: Path) -> None:
    found = started(f"{GAZEBO} ExecuteProcess({command})", tmp_path)

    assert {each.name for each in found.robots} == {"rover", "second"}
    assert not found.unknown_robots


@pytest.mark.parametrize("asked", ["""'sdf_filename: "elsewhere.sdf"'""", """'sdf: "<sdf/>"'"""])
def test_commands_that_spawn_what_is_not_known(asked: str, tmp_path: Path) -> None:
    command = f'ExecuteProcess(cmd=["gz", "service", {SERVICE}, {asked}])'
    found = started(f"{GAZEBO} {command}", tmp_path)

    assert found.unknown_robots == ("what create spawns is not known",)
