"""The sensors that a sheet lists."""

from __future__ import annotations

import pytest

from checker.model.specification.sensor_kinds import SensorKind


def listed(sheet, text):
    return [(str(each.kind), each.count) for each in sheet(text, "Sensors").sensors]


@pytest.mark.parametrize(
    ("item", "expected"),
    [
        ("1 x Velodyne VLP-16, modeled by gpu_lidar plugin", [("lidar", 1)]),
        ("2 x Arducam B0203 with LN008 - modeled by 4 camera plugins", [("camera", 4)]),
        ("2 x Arducam B0247 - modeled by camera plugins", [("camera", 2)]),
        ("Ladybug omnidirectional camera: modeled by 6 `camera` plugins.", [("camera", 6)]),
        ("3x RGBD camera &mdash; d435i, modeled by `rgbd_camera` plugin.", [("rgbd_camera", 3)]),
        ("D435i RGBD Camera (x3), modeled by rgbd_camera plugin", [("rgbd_camera", 3)]),
        ("2x Planar lidar, modeled by `gpu_lidar` plugin.", [("planar_lidar", 2)]),
        ("2 x Garmin LIDAR-Lite v3 modeled by gpu_ray", [("point_lidar", 2)]),
        ("A Microstrain CV5-25 IMU, modeled by the standard imu plugin", [("imu", 1)]),
        ("Onboard IMU - N/A, modeled by `imu` plugin", [("imu", None)]),
        ("Quad Camera system. They are modeled by the standard camera plugin", [("camera", None)]),
        ("F7, modeled by imu and air_pressure plugin", [("imu", None), ("air_pressure", None)]),
        ("1 x SCD30 - modeled by GasEmitterDetector plugin", [("gas", 1)]),
        ("1 x Seek Thermal Compact modeled by thermal sensor system", [("thermal_camera", 1)]),
        ("Altimeter &mdash; DPS310, modeled by `air_pressure` plugin.", [("air_pressure", None)]),
        ("4 x Wheel odometry - modeled by pose-publisher plugin", [("wheel_odometry", 4)]),
        ("Tracking camera, modeled by two `camera` sensors", [("camera", 2)]),
        ("1 x magnetometer - The real vehicle has none", [("magnetometer", 1)]),
        ("12 communication breadcrumbs are also available", [("breadcrumbs", 12)]),
    ],
)  # fmt: skip
def test_an_item_says_kind_and_number(sheet, item, expected):
    assert listed(sheet, f"* {item}") == expected


@pytest.mark.parametrize(
    "text",
    [
        "* Robot turret with camera mount, modeled by JointStateController plugins.",
        "* LWIR camera (not modeled because thermal camera not yet supported)",
        "* LIDAR - Robosense, there is not (yet) an Ignition-Gazebo plugin",
        "* ~~1 x GPS~~",
        "The robot has a camera and a lidar.",
        "* 12 x Raspberry Pi Zero W",
    ],
)
def test_what_is_not_listed_as_modeled(sheet, text):
    assert listed(sheet, text) == []


def test_items_below_an_item_give_its_number(sheet):
    text = (
        "* TOF Cameras, modeled by depth_camera plugin\n  - 1 fixed on top\n  - 1 at the camera\n"
    )
    assert listed(sheet, text) == [("depth_camera", 2)]


def test_an_item_and_the_words_above_its_list_name_configurations(sheet):
    text = (
        "Rover Sensor Config 1 uses:\n* 1 x IMU\n\nRover Sensor Config 2 adds 12 breadcrumbs:\n"
        "* 1 x GPS\n\nfurther:\n* thermal camera in sensor configurations 3 and 4\n* 1 x sonar\n"
    )
    sensors = sheet(text, "Sensors").sensors
    assert [(str(each.kind), sorted(each.configurations)) for each in sensors] == [
        ("imu", [1]),
        ("breadcrumbs", [2]),
        ("gps", [2]),
        ("thermal_camera", [3, 4]),
        ("sonar", []),
    ]  # fmt: skip


def test_a_listed_sensor_marks_its_item(sheet):
    (imu,) = sheet("* 1 x `imu`\n  of two lines", "Sensors").sensors
    assert imu.span.text == "1 x `imu`\n  of two lines"
    assert imu.text == "1 x imu of two lines"


def test_payloads_are_no_sensors():
    assert [kind for kind in SensorKind if not kind.is_sensor] == [
        SensorKind.WHEEL_ODOMETRY,
        SensorKind.BREADCRUMBS,
        SensorKind.COMMS,
        SensorKind.LIGHT,
    ]
