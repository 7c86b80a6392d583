"""The parts of a migration, each for itself."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from checker.convert.conversion import Conversion, Lumped
from checker.formats.sdf.reader import read_sdf
from checker.migrate.bridges import sensor_bridges
from checker.migrate.names import call_base_link, check_names
from checker.migrate.options import NotMigrated
from checker.migrate.plugins import judge_plugins
from checker.migrate.sensors import rewrite_sensors
from checker.migrate.xml_parts import TOLERANCE, sharpen_angles
from checker.model.geometry.transform import Transform
from tests.convert.trees import converted
from tests.model.robots import document


def posed(angle: str) -> etree._Element:
    return etree.fromstring(f"<model><pose>0 0 0 {angle} 0 0</pose></model>")


def angle_in(tree: etree._Element) -> str:
    return (tree.findtext("pose") or "").split()[3]


@given(st.integers(-4, 4), st.floats(-0.9 * TOLERANCE, 0.9 * TOLERANCE))
def test_an_angle_near_a_quarter_turn_becomes_exact(quarters: int, off: float) -> None:
    tree = posed(repr(quarters * math.pi / 2 + off))
    sharpen_angles(tree)
    if quarters:
        assert float(angle_in(tree)) == pytest.approx(quarters * math.pi / 2, abs=2e-15)
    else:
        assert float(angle_in(tree)) == off


@given(st.floats(0.01, 1.5, allow_nan=False))
def test_other_angles_stay_as_they_are(angle: float) -> None:
    tree = posed(repr(angle))
    assert sharpen_angles(tree) == []
    assert angle_in(tree) == repr(angle)


@pytest.mark.parametrize(
    "pose", ["", "0 0 0", "a b c d e f", "0 0 0 nan inf 1e999", "0 0 0 1 2 3 4"]
)
def test_poses_that_are_none_stay(pose: str) -> None:
    tree = etree.fromstring(f"<model><pose>{pose}</pose></model>")
    assert sharpen_angles(tree) == []
    assert (tree.findtext("pose") or "") == pose


def test_constants_of_the_guide() -> None:
    tree = posed("1.57079")
    assert len(sharpen_angles(tree)) == 1
    assert angle_in(tree) == "1.5707963267948966"


def test_angles_in_degrees_stay_as_they_are() -> None:
    tree = etree.fromstring("<model><pose degrees='true'>0 0 0 0 0 355</pose></model>")
    assert sharpen_angles(tree) == []


COLLISION = "<collision name='c'><pose>0 0 0.3 0 0 0</pose></collision>"
WITHOUT_BASE = f"""<sdf><model><link name="base_footprint">{COLLISION}</link><link name="wheel"/>
<joint name="j"><parent>base_footprint</parent><child>wheel</child></joint></model></sdf>"""


def test_the_root_takes_name_and_place_of_a_base_link_that_was_merged_into_it() -> None:
    tree = etree.fromstring(WITHOUT_BASE)
    lumped = {"base_link": Lumped("base_footprint", Transform(translation=(0.0, 0.0, 0.1)))}
    assert call_base_link(Conversion(tree, lumped=lumped))
    (link,) = [each for each in tree.iter("link") if each.get("name") == "base_link"]
    assert link.findtext("pose") == "0 0 0.1 0 0 0"
    assert link.findtext("collision/pose") == "0 0 0.2 0 0 0"
    assert tree.findtext("model/joint/parent") == "base_link"


def test_a_pose_in_degrees_is_moved_and_written_in_radians() -> None:
    tree = etree.fromstring(
        WITHOUT_BASE.replace("<pose>0 0 0.3 0 0 0", '<pose degrees="true">0 0 0.3 0 0 90')
    )
    call_base_link(Conversion(tree, lumped={"base_link": Lumped("base_footprint", Transform())}))
    (pose,) = tree.findall(".//collision/pose")
    assert pose.text == "0 0 0.3 0 0 1.5707963267948966"
    assert not pose.attrib


@pytest.mark.parametrize(
    "text",
    [
        WITHOUT_BASE.replace("base_footprint", "base_link"),
        "<sdf><model><link name='a'/><link name='b'/></model></sdf>",
        "<sdf><model/></sdf>",
    ],
)
def test_where_the_root_is_clear_or_unclear_nothing_is_renamed(text: str) -> None:
    tree = etree.fromstring(text)
    assert call_base_link(Conversion(tree)) == []
    assert etree.tostring(tree).decode() == etree.tostring(etree.fromstring(text)).decode()


@pytest.mark.parametrize(
    "name", ["a#{b}", "a$(arg b)", "a/b", "a<b", "", "a b", "a\nb", 'a"', "a\\b"]
)
def test_names_that_other_files_cannot_hold(name: str) -> None:
    link = etree.Element("link")
    link.set("name", name)
    model = etree.Element("model")
    model.append(link)
    with pytest.raises(NotMigrated, match="cannot contain"):
        check_names(model)


def rewritten(sensor: str) -> tuple[etree._Element, list[str]]:
    tree = etree.fromstring(f"<sdf><model><link name='base_link'>{sensor}</link></model></sdf>")
    notes = rewrite_sensors(tree)
    return tree.find("model/link"), notes


def types(link: etree._Element) -> list[tuple[str | None, str | None]]:
    return [(each.get("name"), each.get("type")) for each in link.iterfind("sensor")]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("ray", "gpu_lidar"),
        ("gpu_ray", "gpu_lidar"),
        ("depth", "rgbd_camera"),
        ("camera", "camera"),
        ("imu", "imu"),
        ("magnetometer", "magnetometer"),
        ("contact", "contact"),
        ("sonar", "gpu_lidar"),
    ],
)
def test_types_of_gazebo_9(old: str, new: str) -> None:
    link, _ = rewritten(f"<sensor name='a' type='{old}'/>")
    assert types(link) == [("a", new)]


@pytest.mark.parametrize("old", ["gps", "force_torque", "wireless_receiver", "rfid", ""])
def test_types_that_nothing_replaces(old: str) -> None:
    link, notes = rewritten(f"<sensor name='a' type='{old}'/>")
    assert types(link) == []
    assert notes == [f"sensor 'a' of type '{old}' is removed: Ignition Gazebo Dome has none"]


def test_a_plugin_decides_before_the_type() -> None:
    plugin = "<plugin name='p' filename='libgazebo_ros_openni_kinect.so'/>"
    link, _ = rewritten(f"<sensor name='X1/a' type='camera'>{plugin}</sensor>")
    assert types(link) == [("a", "rgbd_camera")]
    assert link.find("sensor/plugin") is None


def test_a_camera_of_two_lenses_becomes_two() -> None:
    lenses = "<camera name='left'/><camera name='right'/>"
    link, _ = rewritten(f"<sensor name='a' type='multicamera'>{lenses}</sensor>")
    assert types(link) == [("a_left", "camera"), ("a_right", "camera")]


def test_names_of_sensors_of_a_link_differ() -> None:
    link, _ = rewritten("<sensor name='a' type='imu'/><sensor name='X1/a' type='imu'/>")
    assert types(link) == [("a", "imu"), ("a_2", "imu")]


def test_a_sensor_gets_a_name_that_topics_can_hold() -> None:
    link, _ = rewritten("<sensor name='#{a} b' type='imu'/><sensor name='' type='imu'/>")
    assert types(link) == [("__a__b", "imu"), ("sensor", "imu")]


@pytest.mark.parametrize("kind", ["thermal", "camera", "rgbd_camera"])
def test_the_rate_of_every_camera_is_set_below_its_own_name(kind: str) -> None:
    sensor = f"<sensor name='a' type='{kind}'/>"
    text = f"<sdf version='1.6'><model name='m'><link name='l'>{sensor}</link></model></sdf>"
    (robot,) = read_sdf(document(text))
    (bridged,) = sensor_bridges(robot)
    prefix = "/world/$(arg world_name)/model/$(arg name)/link/l/sensor/a"
    assert (bridged.ign_prefix, bool(bridged.rate_topic)) == (prefix, True)
    infos = [each.ign_topic for each in bridged.bridges if each.ign_topic.endswith("/camera_info")]
    beside = prefix.removesuffix("/a") if kind == "thermal" else prefix
    assert infos == [f"{beside}/camera_info"]


@pytest.mark.parametrize(
    ("plugin", "asks"),
    [("libLiftDragPlugin.so", True), ("libLightVisualPlugin.so", False)],
)
def test_what_a_plugin_did_is_left_to_the_author_where_nothing_takes_its_place(
    plugin: str, asks: bool
) -> None:
    urdf = f"""<robot name="r"><link name="base_link"><inertial><mass value="1"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <gazebo><plugin name="p" filename="{plugin}"/></gazebo></robot>"""
    judged = judge_plugins(converted(urdf), "base_link")
    assert [plugin in each for each in judged.open_points] == ([True] if asks else [])


def test_the_range_of_a_lidar_is_what_its_plugin_leaves() -> None:
    rays = "<ray><range><min>0.1</min><max>300</max></range></ray>"
    plugin = """<plugin name='p' filename='libgazebo_ros_velodyne_laser.so'>
      <min_range>0.9</min_range><max_range>130</max_range></plugin>"""
    link, _ = rewritten(f"<sensor name='a' type='ray'>{rays}{plugin}</sensor>")
    assert link.findtext("sensor/lidar/range/min") == "0.9"
    assert link.findtext("sensor/lidar/range/max") == "130"


@given(
    st.sampled_from(["ray", "depth", "camera", "imu", "sonar"]), st.text("<>&0.9e-'x ", max_size=20)
)
def test_no_figure_of_a_sensor_is_too_odd(kind: str, text: str) -> None:
    sensor = etree.Element("sensor", name="a", type=kind)
    for path in ("update_rate", "camera/horizontal_fov", "camera/image/width", "ray/range/min"):
        holder = sensor
        for tag in path.split("/"):
            found = holder.find(tag)
            holder = etree.SubElement(holder, tag) if found is None else found
        holder.text = text
    tree = etree.Element("sdf")
    etree.SubElement(etree.SubElement(tree, "model"), "link", name="base_link").append(sensor)
    rewrite_sensors(tree)
    assert tree.find("model/link/sensor/always_on") is not None
