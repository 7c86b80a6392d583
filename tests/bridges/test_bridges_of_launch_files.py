"""What is read of bridges: arguments, files, names on both sides."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.bridges.entry import (
    BridgeFault,
    BridgeFaultKind,
    Passed,
    read_argument,
)
from checker.launch.ros2.bridges.file import read_bridge_file
from checker.package.inputs import open_input
from checker.ros.simulation import Simulation, Simulations
from checker.rule_testing import write_example
from checker.source.text import Located, SourceText
from checker.source.yaml import read_yaml

SCAN = "/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan"
ODOMETRY = """- ros_topic_name: odom
  gz_topic_name: base/odometry
  ros_type_name: nav_msgs/msg/Odometry
  gz_type_name: gz.msgs.Odometry
  direction: GZ_TO_ROS
"""
BRIDGE = 'executable="parameter_bridge", arguments=[],'
FILE = '"config_file": os.path.join(HERE, "config", "bridge.yaml")'


def simulation(example: dict[str, object], folder: Path) -> Simulation:
    """Return what the launch file of an example simulates."""
    package = write_example({"@bridge": ODOMETRY, **example}, folder)
    with open_input(package) as opened:
        subject = Subject(opened.packages[0])
        found = subject.one(Simulations)
        subject.close()
    assert isinstance(found, Simulations)
    return found.launched[0]


def names(example: dict[str, object], folder: Path) -> list[tuple[str, str]]:
    """Return the topics in Gazebo and in ROS."""
    entries = simulation(example, folder).entries
    return [(entry.gz_topic, entry.ros_topic) for entry in entries]


def launched(bridge: str = BRIDGE, file: str = FILE) -> dict[str, object]:
    """Return an example whose bridge is started in another way."""
    return {"@launch": {BRIDGE: bridge, FILE: file}}


@pytest.mark.parametrize(
    ("bridge", "file", "expected"),
    [
        (BRIDGE, FILE, [("/base/odometry", "/odom")]),
        (f'{BRIDGE} namespace="r1",', FILE, [("/base/odometry", "/r1/odom")]),
        (
            f'{BRIDGE} namespace="r1",',
            f'{FILE}, "expand_gz_topic_names": True',
            [("/r1/base/odometry", "/r1/odom")],
        ),
        (f'{BRIDGE} remappings=[("odom", "/o")],', FILE, [("/base/odometry", "/o")]),
        (BRIDGE.replace("[]", f'["{SCAN}"]'), '"lazy": True', [("/scan", "/scan")]),
        (
            BRIDGE.replace("[]", f'["{SCAN}", "--ros-args", "-r", "/scan:=/front"]'),
            '"lazy": True',
            [("/scan", "/front")],
        ),
        (
            BRIDGE.replace(
                "[]", '["--ros-args", "-p", ["config_file:=", HERE, "/config/bridge.yaml"]]'
            ),
            '"lazy": True',
            [("/base/odometry", "/odom")],
        ),
    ],
)
def test_names_on_both_sides(
    bridge: str, file: str, expected: list[tuple[str, str]], tmp_path: Path
) -> None:
    assert names(launched(bridge, file), tmp_path) == expected


def test_image_bridge_takes_plain_topics(tmp_path: Path) -> None:
    program = 'package="ros_gz_bridge", executable="parameter_bridge", arguments=[]'
    images = 'package="ros_gz_image", executable="image_bridge", arguments=["front/image"]'
    found = simulation({"@launch": {program: images}}, tmp_path)

    (entry,) = found.entries
    assert (entry.gz_topic, entry.ros_topic, entry.gz_name) == (
        *("/front/image", "/front/image", "Image"),
    )


def test_a_command_bridges_as_well(tmp_path: Path) -> None:
    start = "LaunchDescription([\n"
    command = f'ExecuteProcess(cmd=["ros2", "run", "ros_gz_bridge", "parameter_bridge", "{SCAN}"]),'
    imported = "from launch.actions import ExecuteProcess, IncludeLaunchDescription"
    changes = {
        start: start + command,
        "from launch.actions import IncludeLaunchDescription": imported,
    }

    assert ("/scan", "/scan") in names({"@launch": changes}, tmp_path)


def test_a_file_that_is_not_at_hand_is_told(tmp_path: Path) -> None:
    found = simulation(launched(file=FILE.replace("HERE", '"/elsewhere"')), tmp_path)

    assert not found.entries
    assert "is not read" in found.bridges.unread[0]
    assert found.unread


def test_the_robot_and_its_topics_are_known(tmp_path: Path) -> None:
    found = simulation({}, tmp_path)

    (spawned,) = found.robots
    assert (spawned.name, spawned.publisher is not None) == ("rover", True)
    assert {"/scan", "/scan/points", "/model/*/cmd_vel", "/model/*/odometry"} <= set(found.topics)
    assert not found.unknown_topics
    assert found.is_whole


def test_an_unknown_plugin_may_publish_anything(tmp_path: Path) -> None:
    plugin = '<gazebo><plugin filename="acme" name="acme::Radar"/></gazebo>'
    robot = f'<robot name="rover"><link name="base_link"/>{plugin}</robot>'

    (reason,) = simulation({"urdf/rover.urdf": robot}, tmp_path).unknown_topics
    assert "Radar" in reason


def test_a_lidar_on_a_lumped_link_may_be_found_on_either(tmp_path: Path) -> None:
    robot = """<robot name="rover"><link name="base_link"/><link name="mast"/>
    <joint name="j" type="fixed"><parent link="base_link"/><child link="mast"/></joint>
    <gazebo reference="mast"><sensor name="lidar" type="gpu_lidar"/></gazebo></robot>"""
    topics = simulation({"urdf/rover.urdf": robot}, tmp_path).topics

    for link in ("mast", "base_link"):
        assert f"/world/*/model/*/link/{link}/sensor/lidar/scan" in topics


def test_a_package_without_gazebo_has_no_simulations(tmp_path: Path) -> None:
    package = write_example({"@urdf": True}, tmp_path)
    with open_input(package) as opened:
        assert isinstance(Subject(opened.packages[0]).one(Simulations), NotAvailable)


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        (SCAN, ("/scan", "sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan", Direction.TO_ROS)),
        ("a@b/msg/C]gz.msgs.D", ("a", "b/msg/C", "gz.msgs.D", Direction.TO_IGN)),
        ("a@b/msg/C@gz.msgs.D", ("a", "b/msg/C", "gz.msgs.D", Direction.BOTH)),
    ],
)
def test_arguments(word: str, expected: tuple[object, ...]) -> None:
    read = read_argument(_word(word))
    assert isinstance(read, Passed)
    parts = (read.gz_topic.value, read.ros_type.value, read.gz_type.value, read.direction)
    assert parts == expected


@pytest.mark.parametrize("word", ["", "a", "@b", "a@", "a@b", "a@[c", "a@b[", "a@b[c[d", "a@b@c]d"])
def test_arguments_that_are_refused(word: str) -> None:
    assert isinstance(read_argument(_word(word)), BridgeFault)


@pytest.mark.parametrize(("name", "missing"), [("bridge", False), ("bridges", True)])
def test_a_file_as_argument_is_named(name: str, missing: bool, tmp_path: Path) -> None:
    path = f'os.path.join(HERE, "config", "{name}.yaml")'
    bridge = BRIDGE.replace("[]", f"['@' + {path}]")
    (fault,) = simulation(launched(bridge, '"lazy": True'), tmp_path).bridges.faults

    assert f"write '--ros-args', '-p', 'config_file:=…/{name}.yaml'" in fault.message
    assert fault.message.endswith("does not exist") == missing


@pytest.mark.parametrize(
    "text",
    ["", "a: *b", "[[[", "- 1", "- [a]", "3", "- {1: 2}", "- {ros_type_name: {a: b}}", "- ~"],
)
def test_hostile_files_end_in_faults(text: str) -> None:
    items = list(read_bridge_file(read_yaml(SourceText("bridge.yaml", text))))

    assert bool(items) is bool(text)
    assert all(isinstance(item, BridgeFault) for item in items)


TYPES = "ros_type_name: nav_msgs/msg/Odometry, gz_type_name: gz.msgs.Odometry"


@pytest.mark.parametrize(
    ("entry", "kinds"),
    [
        (f"{{topic_name: a, {TYPES}}}", []),
        (f"{{ros_topic: a, gz_topic_name: b, {TYPES}}}", [BridgeFaultKind.UNKNOWN_KEY]),
        (f"{{ros_topic: a, {TYPES}}}", [BridgeFaultKind.DROPPED]),
        (
            f"{{ros_topic: a, gz_topic: b, {TYPES}}}",
            [BridgeFaultKind.DROPPED, BridgeFaultKind.UNKNOWN_KEY],
        ),
        (
            "{ros_topic_name: a, ros_type_name: b/msg/C, ign_type_name: ignition.msgs.IMU}",
            [BridgeFaultKind.UNKNOWN_KEY],
        ),
        ("{service_name: a, ros_type_name: b/srv/C, gz_req_type_name: gz.msgs.Empty}", []),
    ],
)
def test_what_is_left_out_and_what_is_ignored(entry: str, kinds: list[BridgeFaultKind]) -> None:
    items = read_bridge_file(read_yaml(SourceText("bridge.yaml", f"- {entry}")))

    assert [item.kind for item in items if isinstance(item, BridgeFault)] == kinds


def _word(text: str) -> Located[str]:
    return Located(text, SourceText("a.launch.py", text).whole())
