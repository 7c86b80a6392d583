"""The real sheets: what a person reads in them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from checker.model.specification.motion import MotionQuantity as Motion
from checker.model.specification.sheet import Specification, read_specification
from checker.source.text import SourceText
from checker.source.text_file import decode

# Mass in kg, endurance in s, greatest speed along x in m/s and about z in rad/s.
NUMBERS = {
    "cerberus_anymal_c_sensor_config_1": (55, 4269, 0.704, None),
    "coro_crystal_sensor_config_1": (1.5, 600, 4, None),
    "coro_jeanine_sensor_config_1": (46.6, 3600, 1, None),
    "coro_mike_sensor_config_1": (75.7, 3882, 3, 2),
    "coro_pam_sensor_config_1": (3.557, 1150, 7.6, 3.4),
    "coro_rocky_sensor_config_1": (4.076, 10482, 3, None),
    "csiro_data61_ozbot_atr_sensor_config_1": (150, 18720, 1.2, 2.6),
    "ctu_cras_norlab_absolem_sensor_config_1": (38, 7200, 0.4, 0.5),
    "emesent_hovermap_sensor_config_1": (5.36, 1200, 5, 1.75),
    "explorer_ds1_sensor_config_1": (5.2, 600, 4, 1.2),
    "robotika_freyja_sensor_config_1": (29.6, 3600, 2.5, None),
}
SENSORS = {
    "cerberus_anymal_c_sensor_config_1": "imu lidar lidar imu camera 12xbreadcrumbs",
    "coro_crystal_sensor_config_1": "1xrgbd_camera 1xcamera 1xair_pressure 1ximu 1xgas"
    " 1xpoint_lidar 1xmagnetometer",
    "coro_jeanine_sensor_config_1": "1xlidar 1xrgbd_camera 1ximu 1xmagnetometer 1xair_pressure"
    " 1xgas 4xcamera 12xbreadcrumbs",
    "coro_mike_sensor_config_1": "1xlidar 1xrgbd_camera 1xthermal_camera 1ximu 1xmagnetometer"
    " 1xair_pressure 1xgas 4xcamera 4xwheel_odometry 12xbreadcrumbs",
    "coro_pam_sensor_config_1": "3xrgbd_camera 1xair_pressure 1ximu 1xmagnetometer 1xgas"
    " 2xpoint_lidar",
    "coro_rocky_sensor_config_1": "1xrgbd_camera 1ximu 1xair_pressure 1xgas 2xcamera"
    " 4xwheel_odometry 6xbreadcrumbs",
    "csiro_data61_ozbot_atr_sensor_config_1": "1xlidar camera 1ximu 12xbreadcrumbs",
    "ctu_cras_norlab_absolem_sensor_config_1": "6xcamera 1xrgbd_camera planar_lidar imu"
    " 12xbreadcrumbs",
    "emesent_hovermap_sensor_config_1": "imu lidar imu camera",
    "explorer_ds1_sensor_config_1": "3xrgbd_camera 1xlidar 1ximu",
    "robotika_freyja_sensor_config_1": "2xrgbd_camera 2xplanar_lidar 4xcamera imu magnetometer"
    " air_pressure wheel_odometry gas 6xbreadcrumbs",
}


@pytest.fixture
def read(corpus: Path) -> Callable[[str], Specification]:
    return lambda package: _sheet(corpus, package)


def _sheet(corpus: Path, package: str) -> Specification:
    data = (corpus / package / "specifications.md").read_bytes()
    return read_specification(SourceText("specifications.md", decode(data)))


def test_every_real_sheet_stands_in_the_tables(corpus):
    assert {path.parent.name for path in corpus.glob("*/specifications.md")} == set(NUMBERS)
    assert set(NUMBERS) == set(SENSORS)


@pytest.mark.parametrize("package", NUMBERS)
def test_numbers(read, package):
    sheet = read(package)
    forward = sheet.limit(Motion.LINEAR_VELOCITY, "x")
    turning = sheet.limit(Motion.ANGULAR_VELOCITY, "z")
    found = (
        sheet.total_mass.value,
        sheet.endurance.value,
        forward.maximum,
        turning and turning.maximum,
    )
    assert found == pytest.approx(NUMBERS[package])


@pytest.mark.parametrize("package", SENSORS)
def test_sensors(read, package):
    listed = [
        (f"{sensor.count}x" if sensor.count is not None else "") + sensor.kind
        for sensor in read(package).sensors
    ]
    assert listed == SENSORS[package].split()


@pytest.mark.parametrize("package", NUMBERS)
def test_breadcrumbs_belong_to_another_configuration(read, package):
    for sensor in read(package).sensors:
        assert (sensor.configurations == {2}) is (sensor.kind == "breadcrumbs")


def test_the_rocky_acceleration_is_the_modeled_one(read):
    limit = read("coro_rocky_sensor_config_1").limit(Motion.LINEAR_ACCELERATION, "x")
    assert (limit.minimum, limit.maximum) == (-4, 4)


@pytest.mark.parametrize("package", NUMBERS)
def test_the_headings_that_reviewers_ask_for_are_found(read, package):
    sheet = read(package)
    for title in ("Description", "Sensors", "Motion Characteristics", "Endurance Characteristics"):
        assert not sheet.section(title).is_empty
    assert sheet.section("Validation and Specification Links") is not None
    assert (sheet.section("Usage Rights") is None) is package.startswith(("explorer", "robotika"))
