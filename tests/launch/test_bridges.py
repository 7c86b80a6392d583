"""Bridges: what passes between Gazebo and ROS, and where that is written."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.launch.ros1.bridge import BridgeKind, Direction, SensorTopic
from checker.launch.ros1.graph import LaunchFaultKind as Kind
from checker.launch.ros1.launch_file import LaunchCommand

PREFIX = '<arg name="p" value="/world/w/model/X1/link/base/sensor"/>'


def bridge_node(args: str, type_: str = "parameter_bridge", inside: str = "") -> str:
    node = f'<node pkg="b" type="{type_}" name="n" args="{args}">{inside}</node>'
    return f'<group ns="X1">{node}</group>'


@pytest.mark.parametrize(
    ("mark", "direction"), [("[", Direction.TO_ROS), ("]", Direction.TO_IGN), ("@", Direction.BOTH)]
)
def test_a_parameter_bridge_says_topic_types_and_direction(expand, mark, direction):
    args = f"$(arg p)/imu/imu@sensor_msgs/Imu{mark}ignition.msgs.IMU"
    inside = '<remap from="$(arg p)/imu/imu" to="imu/data"/>'
    (bridge,) = expand(PREFIX + bridge_node(args, inside=inside)).bridges
    assert bridge.ign_topic == "/world/w/model/X1/link/base/sensor/imu/imu"
    assert bridge.ros_topic == "/X1/imu/data"
    assert (bridge.ros_type, bridge.ign_type) == ("sensor_msgs/Imu", "ignition.msgs.IMU")
    assert bridge.direction is direction
    assert bridge.kind is BridgeKind.PARAMETER
    assert bridge.span.text == "$(arg p)/imu/imu"
    assert bridge.sensor == SensorTopic("w", "X1", "base", "imu", "imu")


def test_several_topics_of_one_node_are_several_bridges_each_with_its_place(expand):
    graph = expand(bridge_node("/a@s/A[i.A\n   b@s/B]i.B __name:=x"))
    assert [(bridge.ros_topic, bridge.span.text, bridge.span.line) for bridge in graph.bridges] == [
        ("/a", "/a", 1),
        ("/X1/b", "b", 2),
    ]
    assert graph.faults == ()


def test_an_image_bridge_takes_plain_topics(expand):
    inside = '<remap from="$(arg p)/cam/image" to="front/image_raw"/>'
    args = "$(arg p)/cam/image /other"
    graph = expand(PREFIX + bridge_node(args, "image_bridge", inside))
    assert [(bridge.ros_topic, bridge.span.text) for bridge in graph.bridges] == [
        ("/X1/front/image_raw", "$(arg p)/cam/image"),
        ("/other", "/other"),
    ]
    assert {bridge.ros_type for bridge in graph.bridges} == {"sensor_msgs/Image"}
    assert {bridge.kind for bridge in graph.bridges} == {BridgeKind.IMAGE}


def test_the_whole_attribute_is_marked_when_it_is_written_otherwise_than_it_reads(expand):
    (bridge,) = expand(bridge_node("/a&#x62;@s/A[i.A")).bridges
    assert bridge.ign_topic == "/ab"
    assert bridge.span.text.startswith("/a&#x62;")


@pytest.mark.parametrize("args", ["/a", "/a@s/A", "/a@s/A(i.A", "@s/A[i.A", "/a@s/A[i.A[x"])
def test_an_argument_that_is_no_bridge_is_a_fault(expand, args):
    graph = expand(bridge_node(args))
    assert [(fault.kind, fault.span.text) for fault in graph.faults] == [(Kind.BRIDGE, args)]


def test_an_argument_that_only_the_machine_knows_is_no_fault(expand):
    graph = expand(bridge_node("$(optenv EXTRA a b)"))
    assert graph.bridges == ()
    assert graph.faults == ()


def test_other_nodes_bridge_nothing(expand):
    assert expand(bridge_node("/a@s/A[i.A", "pose_tf_broadcaster")).bridges == ()


@pytest.mark.parametrize(
    ("topic", "parts"),
    [
        ("/world/w/model/m/link/l/sensor/s/scan/points", ("w", "m", "l", "s", "scan/points")),
        ("/world/w/model/m/link/l/sensor/s", ("w", "m", "l", "s", "")),
        ("/model/m/pose", None),
        ("world/w/model/m/link/l/sensor/s/scan", None),
        ("/world/w/model//link/l/sensor/s/scan", None),
        ("/world/w/model/m/joint/l/sensor/s/scan", None),
        ("", None),
    ],
)
def test_sensor_topics(topic, parts):
    expected = SensorTopic(*parts) if parts else None
    assert SensorTopic.parse(topic) == expected


@given(st.text(alphabet="/worldmelinksr ", max_size=80))
def test_no_topic_makes_the_parser_raise(topic):
    parsed = SensorTopic.parse(topic)
    assert parsed is None or topic.startswith(f"/world/{parsed.world}/model/{parsed.model}/")


def test_a_launch_command_is_taken_apart():
    command = LaunchCommand.parse(
        "roslaunch --wait x_config_1 vehicle_topics.launch world_name:=w name:=n odd breadcrumbs:=1"
    )
    assert command == LaunchCommand(
        "x_config_1",
        "vehicle_topics.launch",
        {"world_name": "w", "name": "n", "breadcrumbs": "1"},
        options=("--wait",),
        leftover=("odd",),
    )


@pytest.mark.parametrize(
    ("text", "package", "file"),
    [
        ("roslaunch ./launch/a.launch name:=n", "", "./launch/a.launch"),
        ("/opt/ros/bin/roslaunch p a.launch", "p", "a.launch"),
        ("roslaunch", "", ""),
    ],
)
def test_a_launch_command_names_package_and_file(text, package, file):
    command = LaunchCommand.parse(text)
    assert command is not None
    assert (command.package, command.file) == (package, file)


@pytest.mark.parametrize("text", ["", "rosrun p t", "rosparam set a b"])
def test_other_commands_are_no_launch_commands(text):
    assert LaunchCommand.parse(text) is None


def test_bridges_that_a_condition_leaves_out_are_dormant(expand):
    off = bridge_node("/sleeps@s/A[i.A").replace("<group", '<group if="$(arg more)"')
    graph = expand('<arg name="more" default="0"/>' + off + bridge_node("/wakes@s/A[i.A"))
    assert [bridge.ign_topic for bridge in graph.bridges] == ["/wakes"]
    assert [bridge.ign_topic for bridge in graph.dormant_bridges] == ["/sleeps"]
    assert not graph.faults


def test_what_is_dormant_starts_nothing_and_follows_no_include(expand):
    graph = expand(
        '<group if="0"><include file="$(find p)/launch/a.launch"/>'
        '<node pkg="b" type="x" name="n"/><param name="a" value="1"/></group>'
    )
    assert graph.nodes == graph.params == graph.includes == graph.dormant_bridges == ()
    assert graph.unresolved_includes == graph.faults == ()
