"""What sensors and plugins publish and listen to, and under which topics."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.resources import table
from checker.launch.ros1.bridge import Direction
from checker.model.sensing.kind import SensorType
from checker.ros.topics import (
    Channel,
    channels,
    comparable,
    standard_topics,
)
from tests.model.robots import sdf

SENSOR = "/world/*/model/*/link/base/sensor/front"
SYSTEMS = "ignition::gazebo::systems"


def of_sensor(kind: str, content: str = "", release: str = "dome") -> dict[str, Channel]:
    sensor = f'<sensor name="front" type="{kind}">{content}</sensor>'
    read = sdf(f'<link name="base">{sensor}</link>')
    return {channel.what: channel for channel in channels(read, release)}


def of_plugin(name: str, content: str = "") -> dict[str, Channel]:
    read = sdf(f'<plugin filename="p.so" name="{SYSTEMS}::{name}">{content}</plugin>')
    return {channel.what: channel for channel in channels(read, "dome")}


@pytest.mark.parametrize(
    ("kind", "content", "topics"),
    [
        ("camera", "", {"image": f"{SENSOR}/image", "camera_info": f"{SENSOR}/camera_info"}),
        ("camera", "<topic>a/b</topic>", {"image": "/a/b", "camera_info": "/a/camera_info"}),
        ("camera", "<topic>/a</topic>", {"image": "/a", "camera_info": "/camera_info"}),
        ("gpu_ray", "", {"scan": f"{SENSOR}/scan", "points": f"{SENSOR}/scan/points"}),
        ("gpu_lidar", "<topic>l</topic>", {"scan": "/l", "points": "/l/points"}),
        ("imu", "<topic>/my/imu</topic>", {"data": "/my/imu"}),
        ("contact", "", {}),
        ("logical_camera", "", {}),
    ],
)
def test_topics_of_sensors(kind: str, content: str, topics: dict[str, str]) -> None:
    found = of_sensor(kind, content)
    assert {what: channel.topics[0] for what, channel in found.items()} == topics


@pytest.mark.parametrize(
    ("release", "content", "image", "info"),
    [
        ("dome", "", SENSOR, "/world/*/model/*/link/base/sensor/camera_info"),
        ("dome", "<topic>a/heat</topic>", "/a/heat", "/a/camera_info"),
        ("fortress", "", f"{SENSOR}/image", f"{SENSOR}/camera_info"),
        ("harmonic", "", f"{SENSOR}/image", f"{SENSOR}/camera_info"),
        ("harmonic", "<topic>a/heat</topic>", "/a/heat", "/a/camera_info"),
    ],
)
def test_a_thermal_camera_has_other_topics_in_dome(
    release: str, content: str, image: str, info: str
) -> None:
    found = of_sensor("thermal", content, release)
    assert found["image"].topics == (image,)
    assert found["camera_info"].topics == (info,)


def test_topics_of_a_drive() -> None:
    found = of_plugin("DiffDrive")
    assert found["cmd_vel"].topics == ("/model/*/cmd_vel",)
    assert found["cmd_vel"].direction is Direction.TO_IGN
    assert found["odometry"].topics == ("/model/*/odometry",)
    found = of_plugin("DiffDrive", "<topic>/model/X1/cmd_vel_relay</topic>")
    assert found["cmd_vel"].topics == ("/model/*/cmd_vel_relay",)


def test_topics_of_a_multicopter_stand_in_its_namespace() -> None:
    content = "<robotNamespace>model/X1</robotNamespace><commandSubTopic>go</commandSubTopic>"
    found = of_plugin("MulticopterVelocityControl", content)
    assert found["cmd_vel"].topics == ("/model/*/go",)
    assert of_plugin("MulticopterVelocityControl") == {}


def test_a_topic_with_an_unstated_name_is_not_known() -> None:
    assert of_plugin("LinearBatteryPlugin") == {}
    assert of_plugin("GasDetector") == {}
    found = of_plugin("LinearBatteryPlugin", "<battery_name>b</battery_name>")
    assert found["battery state"].topics == ("/model/*/battery/b/state",)


def test_topics_compare_whatever_the_robot_is_called() -> None:
    assert comparable("/model/X1/pose") == comparable("model/acme/pose") == "/model/*/pose"
    assert comparable("/world/w/model/X1/link/l") == "/world/*/model/*/link/l"
    assert comparable("/a/model/b") == "/a/model/b"


@given(st.text(alphabet="/abmodelwrd*", max_size=40))
def test_comparing_twice_changes_nothing(topic: str) -> None:
    once = comparable(topic)
    assert comparable(once) == once
    assert once.startswith("/")


def test_the_table_is_whole() -> None:
    topics = table("gazebo_topics")
    kinds = {member.value for member in SensorType}
    assert topics["sensors"].keys() <= kinds
    entries = [each for group in ("sensors", "plugins") for each in topics[group].values()]
    for entry in (each for several in entries for each in several):
        assert entry["need"] in ("required", "wanted", "optional")
        if "ros_name" in entry:
            assert re.fullmatch(entry["ros_name"], entry["ros_example"])
    assert all(comparable(topic) == topic for topic in standard_topics())
