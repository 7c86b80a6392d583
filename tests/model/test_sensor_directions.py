"""Where sensors look, what their names say about it, and how lights weaken."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.model.sensing.mounts import Mounted, called_directions, mounted_sensors
from tests.model.robots import sdf


def mounted(sensor: str, link: str = "head", pose: str = "0 0 0 0 0 0") -> Mounted:
    robot = sdf(f'<link name="{link}"><pose>{pose}</pose>{sensor}</link>')
    (found,) = mounted_sensors(robot)
    return found


def lidar(lower: float, upper: float, pose: str = "0 0 0 0 0 0") -> str:
    return (
        f'<sensor name="s" type="gpu_lidar"><pose>{pose}</pose><lidar><scan><horizontal>'
        f"<samples>9</samples><min_angle>{lower}</min_angle><max_angle>{upper}</max_angle>"
        "</horizontal></scan></lidar></sensor>"
    )


@given(st.floats(-3, 3), st.floats(-3, 3))
def test_a_camera_looks_along_its_x_axis_wherever_its_link_is_turned(
    turn: float, own: float
) -> None:
    camera = f'<sensor name="s" type="camera"><pose>1 2 3 0 0 {own}</pose></sensor>'
    looking = mounted(camera, pose=f"0 0 0 0 0 {turn}").looking
    assert looking == pytest.approx((math.cos(turn + own), math.sin(turn + own), 0.0))


def test_a_lidar_looks_along_the_middle_of_its_scan() -> None:
    assert mounted(lidar(0.0, math.pi)).looking == pytest.approx((0.0, 1.0, 0.0))
    assert mounted(lidar(math.pi, math.pi)).looking == pytest.approx((-1.0, 0.0, 0.0))
    assert mounted(lidar(math.pi, math.pi, "0 0 0 0 -1.5708 0")).looking == pytest.approx(
        (0.0, 0.0, -1.0), abs=1e-4
    )


def test_what_looks_to_all_sides_or_to_none_looks_nowhere() -> None:
    assert mounted(lidar(-math.pi, math.pi)).looking is None
    assert mounted('<sensor name="s" type="imu"/>').looking is None


def test_a_sensor_whose_place_is_unknown_is_left_out() -> None:
    robot = sdf(
        '<link name="a"><sensor name="s" type="camera"><pose relative_to="b">0 0 0 0 0 0</pose>'
        "</sensor></link>",
        version="1.9",
    )
    assert not list(mounted_sensors(robot))


@pytest.mark.parametrize(
    ("name", "link", "word"),
    [
        ("camera_front", "head", "front"),
        ("rearCam", "head", "rear"),
        ("rgbd2_left", "head", "left"),
        ("camera", "camera_rear_link", "rear"),
        ("camera", "rear_left_wheel", None),
        ("upper_backup_frontier", "head", None),
        ("", "", None),
    ],
)
def test_words_are_whole_words_of_the_sensor_or_of_a_link_made_for_it(
    name: str, link: str, word: str | None
) -> None:
    called = called_directions(mounted(f'<sensor name="{name}" type="camera"/>', link))
    assert (called.word if called else None) == word


def test_two_words_allow_what_lies_between_them() -> None:
    called = called_directions(mounted('<sensor name="front_left" type="camera"/>'))
    assert called is not None
    between = (math.sqrt(0.5), math.sqrt(0.5), 0.0)
    assert called.angle_to(between) == pytest.approx(0.0, abs=1e-6)
    assert called.angle_to((-1.0, 0.0, 0.0)) == pytest.approx(math.pi / 2)


@given(st.text(max_size=300))
def test_any_name_can_be_read(name: str) -> None:
    part = mounted('<sensor name="s" type="camera"/>')
    sensor = replace(part.sensor, name=replace(part.sensor.name, value=name))
    called_directions(replace(part, sensor=sensor))


def test_light_is_divided_as_its_attenuation_says() -> None:
    robot = sdf(
        '<link name="a"><light name="l" type="spot"><attenuation><range>9</range>'
        "<constant>0.5</constant><linear>0.1</linear><quadratic>0.01</quadratic>"
        '</attenuation><cast_shadows>1</cast_shadows></light><light name="m" type="spot"/></link>'
    )
    lamp, other = robot.links[0].lights
    assert lamp.attenuation is not None
    assert lamp.attenuation.divisor(2.0) == pytest.approx(0.74)
    assert lamp.attenuation.range.value == 9.0
    assert lamp.casts_shadows
    assert other.attenuation is None
    assert not other.casts_shadows


@pytest.mark.parametrize(
    ("more", "clear"),
    [
        ("", False),
        ("<transparency>0</transparency>", False),
        ("<transparency>0.4</transparency>", True),
        ("<material><diffuse>1 1 1 0.5</diffuse></material>", True),
        ("<material><diffuse>1 1 1 1</diffuse></material>", False),
    ],
)
def test_what_can_be_seen_through_says_so(more: str, clear: bool) -> None:
    shape = "<geometry><sphere><radius>1</radius></sphere></geometry>"
    robot = sdf(f'<link name="a"><visual name="v">{shape}{more}</visual></link>')
    assert robot.links[0].visuals[0].is_see_through is clear
