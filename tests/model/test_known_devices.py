"""Devices by their names in running text and in the names of a model."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.devices.known import known_devices
from tests.model.test_device_form import DEVICE

KNOWN = known_devices()


def named(text: str, types: tuple[str, ...] | None = None) -> str:
    device = KNOWN.find_in_text(text, types)
    return device.id if device is not None else ""


@pytest.mark.parametrize(
    ("text", "id"),
    [
        ("LIDAR - Velodyne VLP-16, modeled by `gpu_lidar` plugin", "velodyne_vlp16"),
        ("1x 3D medium range lidar: Velodyne-16", "velodyne_vlp16"),
        ("Ouster OS1-16", "ouster_os1_16"),
        ("Ouster OS-1 64", "ouster_os1_64"),
        ("Ouster OS1-64 Gen 2", "ouster_os1_gen2"),
        ("D435i RGBD Camera (x3)", "realsense_d435"),
        ("an Ouster OS0 above a Velodyne VLP-16", ""),
        ("a lidar", ""),
        ("VLP-1600", ""),
        ("x" * 600 + " VLP-16", ""),
    ],
)
def test_running_text(text: str, id: str) -> None:
    assert named(text) == id


@pytest.mark.parametrize(
    ("text", "name", "figure", "value"),
    [
        ("FLIR Blackfly BFLY-U3-23S6C-C", "FLIR BFLY-U3-23S6C", "megapixels", 2.3),
        ("Point Grey Flea3 FL3-U3-13E4C", "FLIR FL3-U3-13E4C", "megapixels", 1.3),
        ("Blackfly S BFS-PGE-122S6M", "FLIR BFS-PGE-122S6M", "megapixels", 12.2),
        ("Basler acA1300-60gm", "Basler acA1300-60gm", "width", 1300),
        ("Basler a2A2590-60ucPRO", "Basler a2A2590-60ucPRO", "width", 2590),
        ("Manta G-145B", "Allied Vision Manta G-145B", "megapixels", 1.45),
        ("Alvium 1800 U-501c", "Allied Vision Alvium 1800 U-501c", "megapixels", 5.01),
        ("Prosilica GT1290C", "Allied Vision Prosilica GT1290C", "width", 1290),
        ("Ximea MC023CG-SY", "XIMEA MC023CG", "megapixels", 2.3),
    ],
)
def test_type_codes(text: str, name: str, figure: str, value: float) -> None:
    device = KNOWN.find_in_text(text)
    assert device is not None
    assert device.name == name
    assert device.values[figure] == pytest.approx(value)
    assert device.is_from_memory(figure)
    assert device is KNOWN.find_in_text(f"two of {text}")


def test_the_number_of_a_ueye_stands_for_its_sensor() -> None:
    device = KNOWN.find_in_text("IDS uEye UI-3240CP-C")
    assert device is not None
    assert (device.name, device.values) == ("IDS uEye UI-3240CP", {"image_sizes": [[1280, 1024]]})
    other = KNOWN.find_in_text("IDS uEye UI-3000SE")
    assert other is not None
    assert not other.values


def test_a_device_with_a_datasheet_comes_before_its_type_code() -> None:
    assert named("FLIR Blackfly S BFS-U3-16S2C-CS") == "flir_blackfly_s"
    assert named("Basler acA2040-35gc") == "basler_aca2040"
    assert named("a camera of 1300-60 parts") == ""


def test_devices_of_other_types_do_not_count() -> None:
    text = "Seek Thermal Compact, next to the D435"
    assert named(text) == ""
    assert named(text, ("thermal",)) == "seek_compact"
    assert named(text, ("imu",)) == ""


@pytest.mark.parametrize("name", ["vlp16", "front_vlp16_link", "/robot/vlp-16/points", "VLP_16"])
def test_names_of_a_model(name: str) -> None:
    device = KNOWN.find_in_name(name)
    assert device is not None
    assert device.id == "velodyne_vlp16"


def test_a_users_device_is_asked_first() -> None:
    own = {**DEVICE, "id": "own_vlp16", "match": r"\bVLP[- ]?16\b"}
    device = known_devices([own]).find_in_text("Velodyne VLP-16")
    assert device is not None
    assert device.id == "own_vlp16"
    assert not device.is_from_memory("rows")


def test_what_is_from_memory_says_so() -> None:
    device = KNOWN.find_in_text("VLP-16")
    assert device is not None
    assert device.is_from_memory("body")
    assert not device.is_from_memory("rows")


@given(st.text(max_size=700))
def test_any_text_can_be_searched(text: str) -> None:
    KNOWN.find_in_text(text)
    KNOWN.find_in_name(text)
