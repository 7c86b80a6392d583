"""The real models: what they hold is known, and counted here."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from checker.formats.sdf.reader import read_sdf
from checker.formats.sdf.schema import walk
from checker.model.robot import Robot
from checker.source.text_file import decode
from tests.model.robots import document, messages

# package, links, joints, sensors, kilograms
MODELS = [
    ("cerberus_anymal_c_sensor_config_1", 13, 12, 12, 55.0),
    ("coro_crystal_sensor_config_1", 5, 4, 7, 1.532),
    ("coro_jeanine_sensor_config_1", 5, 4, 9, 46.6),
    ("coro_mike_sensor_config_1", 6, 5, 10, 75.7),
    ("coro_pam_sensor_config_1", 5, 4, 8, 3.557),
    ("coro_rocky_sensor_config_1", 7, 6, 7, 4.076),
    ("costar_husky_sensor_config_1", 5, 4, 4, 56.612),
    ("csiro_data61_ozbot_atr_sensor_config_1", 5, 4, 6, 146.342),
    ("ctu_cras_norlab_absolem_sensor_config_1", 8, 7, 9, 38.6983),
    ("emesent_hovermap_sensor_config_1", 9, 8, 6, 5.3614),
    ("explorer_ds1_sensor_config_1", 5, 4, 7, 1.57),
    ("robotika_freyja_sensor_config_1", 5, 4, 11, 29.6),
    ("x1_sensor_config_6", 5, 4, 5, 56.582),
    ("x2_sensor_config_7", 5, 4, 5, 18.432),
]

NOISE = {"air_pressure/noise": 1}
UNKNOWN = {
    "coro_crystal_sensor_config_1": NOISE,
    "coro_jeanine_sensor_config_1": NOISE,
    "coro_mike_sensor_config_1": NOISE,
    "coro_pam_sensor_config_1": NOISE,
    "coro_rocky_sensor_config_1": NOISE,
    "csiro_data61_ozbot_atr_sensor_config_1": {"camera/aspect_ratio": 4, "sensor/alwaysOn": 1},
    "emesent_hovermap_sensor_config_1": NOISE,
    "explorer_ds1_sensor_config_1": NOISE,
    "robotika_freyja_sensor_config_1": NOISE,
}
"""Elements that SDF 1.6 does not know, by the element around them."""

FAULTS = {
    "explorer_ds1_sensor_config_1": [
        "<pose> has 7 values, expected 6 numbers",
        "<pose> has 8 values, expected 6 numbers",
    ]
}


def read(corpus: Path, package: str) -> Robot:
    text = decode((corpus / package / "model.sdf").read_bytes())
    (robot,) = read_sdf(document(text))
    return robot


def test_the_table_is_whole(corpus: Path) -> None:
    assert sorted(path.parent.name for path in corpus.glob("*/model.sdf")) == [m[0] for m in MODELS]


@pytest.mark.parametrize(("package", "links", "joints", "sensors", "mass"), MODELS)
def test_counts_and_mass(
    corpus: Path, package: str, links: int, joints: int, sensors: int, mass: float
) -> None:
    robot = read(corpus, package)
    assert (len(robot.links), len(robot.joints), len(robot.sensors)) == (links, joints, sensors)
    assert robot.mass == pytest.approx(mass, abs=1e-9)
    masses = [float(mass.text.value) for mass in robot.document.find_all("//inertial/mass")]
    assert robot.mass == pytest.approx(sum(masses), abs=1e-9)


@pytest.mark.parametrize("package", [model[0] for model in MODELS])
def test_unknown_elements(corpus: Path, package: str) -> None:
    root = read(corpus, package).document.root
    unknown = [element for element, kind in walk(root, "1.6") if kind is None]
    found = Counter(f"{e.parent.tag}/{e.tag}" for e in unknown if e.parent is not None)
    assert found == UNKNOWN.get(package, {})


@pytest.mark.parametrize("package", [model[0] for model in MODELS])
def test_faults_and_poses(corpus: Path, package: str) -> None:
    robot = read(corpus, package)
    assert messages(robot) == FAULTS.get(package, [])
    for joint in robot.joints:
        assert robot.pose_of_joint(joint) is not None
        for axis in joint.axes:
            assert robot.axis_in_model(joint, axis) is not None
    for link in robot.links:
        for shape in (*link.collisions, *link.visuals):
            assert robot.pose_of_part(link, shape.pose) is not None
