"""The sample of the Ouster OS-1: it weighs what the datasheet says, and takes its parameters."""

from __future__ import annotations

import math
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.engine.subject import Subject
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.trial.robot_trial import RobotTrial
from tests.urdf.conftest import Describe, robot

NAME = "ouster_description"
MASS, RADIUS, HEIGHT = 0.38, 0.042, 0.073
PARAMETERS = (
    "*origin parent:=base_link name:=os1_sensor topic:=/os1_cloud_node/points hz:=10 lasers:=64 "
    "samples:=512 min_range:=0.9 max_range:=75.0 noise:=0.008 min_angle:=-${pi} max_angle:=${pi}"
)


@pytest.fixture
def ouster(samples: Path) -> Iterator[Subject]:
    with open_input(samples / NAME) as found:
        yield Subject(found.packages[0])


def the_robot(subject: Subject) -> Robot:
    assert isinstance(subject.all(Robot), tuple)
    (found,) = subject.all(Robot)
    return found


def lidar_of(found: Robot) -> Sensor:
    (sensor,) = (sensor for sensor in found.sensors if sensor.kind.is_lidar)
    return sensor


def test_the_macro_has_the_twelve_parameters_of_the_tutorial(samples: Path) -> None:
    text = (samples / NAME / "urdf/OS1-64.urdf.xacro").read_text("utf-8")
    params = text.split('name="OS1-64" params="', 1)[1].split('"', 1)[0]
    assert params.split() == PARAMETERS.split()
    assert len(params.split()) == 12


def test_it_weighs_380_grams_and_its_inertia_is_that_of_the_cylinder(ouster: Subject) -> None:
    assert isinstance(ouster.all(MassProperties), tuple)
    lidar = ouster.all(MassProperties)[0].links["os1_sensor"]
    across = MASS * (3 * RADIUS**2 + HEIGHT**2) / 12
    along = MASS * RADIUS**2 / 2
    assert lidar.mass == pytest.approx(MASS)
    assert lidar.principal == pytest.approx(sorted((across, across, along)))
    assert lidar.centre == pytest.approx((0.0, 0.0, 0.1 + HEIGHT / 2))


def test_the_frames_are_those_of_the_driver(ouster: Subject) -> None:
    found = the_robot(ouster)
    above = {joint.child.value: joint for joint in found.joints}
    assert above["os1_sensor"].name.value == "mount_joint"
    assert above["os1_imu"].parent.value == above["os1_lidar"].parent.value == "os1_sensor"
    assert {joint.type.value for joint in found.joints} == {"fixed"}


def test_the_lidar_is_set_to_the_defaults(ouster: Subject) -> None:
    sensor = lidar_of(the_robot(ouster))
    lidar = sensor.lidar
    assert lidar is not None
    assert sensor.update_rate.value == 10
    assert (lidar.horizontal.samples.value, lidar.rows) == (512, 64)
    assert lidar.horizontal.angle == pytest.approx(2 * math.pi)
    assert (lidar.range_min.value, lidar.range_max.value) == (0.9, 75.0)


def test_a_box_that_carries_it_settles(ouster: Subject) -> None:
    assert isinstance(ouster.all(RobotTrial), tuple)
    (driven,) = ouster.all(RobotTrial)
    assert driven.trial.trouble == ()
    assert driven.trial.refused == ""
    assert driven.trial.value("settle_tilt") == pytest.approx(0.0, abs=0.01)
    assert driven.trial.value("settle_speed") == pytest.approx(0.0, abs=0.01)


def test_parameters_reach_the_sensor(samples: Path, tmp_path: Path) -> None:
    folder = tmp_path / NAME
    shutil.copytree(samples / NAME, folder)
    example = folder / "urdf/example.urdf.xacro"
    call = 'name="top_os1" hz="20" lasers="16" samples="1024" min_range="1" max_range="150"'
    text = example.read_text("utf-8").replace(
        '<xacro:OS1-64 parent="base_link">', f'<xacro:OS1-64 parent="base_link" {call}>'
    )
    example.write_text(text, "utf-8")
    with open_input(folder) as opened:
        found = the_robot(Subject(opened.packages[0]))
    sensor = lidar_of(found)
    assert "top_os1" in found.links_by_name
    assert sensor.lidar is not None
    assert sensor.update_rate.value == 20
    assert (sensor.lidar.horizontal.samples.value, sensor.lidar.rows) == (1024, 16)
    assert (sensor.lidar.range_min.value, sensor.lidar.range_max.value) == (1, 150)


SENSOR = """<link name="a"/>
<gazebo reference="a">
  <sensor name="s" type="ray">
    <ray>{range}</ray>
    <plugin name="p" filename="libgazebo_ros_velodyne_laser.so">{plugin}</plugin>
  </sensor>
</gazebo>"""
RANGE = "<range><min>0.3</min><max>131</max></range>"


@pytest.mark.parametrize(
    ("range_", "plugin", "expected"),
    [
        (RANGE, "<min_range>0.9</min_range><max_range>130</max_range>", (0.9, 130)),
        (RANGE, "<min_range>0.1</min_range><max_range>200</max_range>", (0.3, 131)),
        (RANGE, "", (0.3, 131)),
        ("", "<max_range>75</max_range>", (0, 75)),
        ("", "", (0, 0)),
    ],
)
def test_a_lidar_measures_what_its_plugin_passes_on(
    describe: Describe, range_: str, plugin: str, expected: tuple[float, float]
) -> None:
    body = SENSOR.format(range=range_, plugin=plugin)
    lidar = lidar_of(the_robot(describe({"acme_description/urdf/a.urdf.xacro": robot(body)}))).lidar
    assert lidar is not None
    assert (lidar.range_min.value, lidar.range_max.value) == expected
