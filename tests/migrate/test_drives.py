"""Which wheels drive a robot, and what is written into its drive plugin."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.migrate.migration import Migrated, migrate
from checker.migrate.options import MigrationOptions, NotMigrated
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings
from tests.migrate.conftest import FOUR, Write, body, knuckle, speed_ratio, wheel

ACME = MigrationOptions(organization="acme")
TO_FILL_IN = ("DOC002", "SPW014")
pytestmark = pytest.mark.usefixtures("no_pictures")


def spawner(made: Migrated) -> str:
    return (made.folder / "launch/spawner.rb").read_text("utf-8")


def values(text: str, tag: str) -> list[str]:
    return re.findall(rf"<{tag}>(.*)</{tag}>", text)


def errors(folder: Path, *, trial: bool = False) -> list[str]:
    return [
        f"{each.rule}: {each.message}"
        for each in checked(folder, trial=trial).findings
        if each.severity is Severity.ERROR
    ]


def checked(folder: Path, *, trial: bool) -> PackageReport:
    (package,) = check_package(folder, Settings(trial=trial)).packages
    return package


def test_four_wheels_skid(write: Write, tmp_path: Path) -> None:
    made = migrate(write(body() + FOUR), tmp_path / "made", ACME)
    text = spawner(made)
    assert values(text, "left_joint") == ["left_front_joint", "left_rear_joint"]
    assert values(text, "right_joint") == ["right_front_joint", "right_rear_joint"]
    assert values(text, "wheel_separation") == ["0.4"]
    assert set(values(text, "wheel_radius")) == {"0.1"}
    # 14 kg on four wheels, at 9.8 m/s²
    assert values(text, "wheel_normal_force") == ["34.3"] * 4
    assert values(text, "max_velocity") == ["1"]


def test_two_wheels_and_a_caster(write: Write, tmp_path: Path) -> None:
    driven = wheel("left", 0.1, 0.2) + wheel("right", 0.1, -0.2)
    caster = knuckle("fork", -0.2, 0, "continuous") + wheel("roller", 0, 0, parent="fork")
    made = migrate(write(body() + driven + caster), tmp_path / "made", ACME)
    text = spawner(made)
    assert values(text, "left_joint") == ["left_joint"]
    assert "WheelSlip" not in text


def test_steered_wheels_make_an_ackermann_drive(write: Write, tmp_path: Path) -> None:
    front = "".join(
        knuckle(f"{side}_knuckle", 0.2, y) + wheel(f"{side}_front", 0, 0, parent=f"{side}_knuckle")
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    rear = wheel("left_rear", -0.2, 0.2) + wheel("right_rear", -0.2, -0.2)
    made = migrate(write(body() + front + rear), tmp_path / "made", ACME)
    text = spawner(made)
    assert values(text, "left_steering_joint") == ["left_knuckle_joint"]
    assert values(text, "wheel_base") == ["0.4"]
    assert values(text, "kingpin_width") == ["0.4"]
    assert values(text, "steering_limit") == ["0.5"]
    assert "WheelSlip" not in text
    assert not [
        each for each in errors(made.folder) if not each.startswith(("SEN022", *TO_FILL_IN))
    ]
    assert not any("steering joints state no limits" in each for each in made.open_points)


def test_wheels_that_turn_the_other_way_are_turned_round(write: Write, tmp_path: Path) -> None:
    backwards = wheel("left", 0, 0.2, axis="0 -1 0") + wheel("right", 0, -0.2)
    made = migrate(write(body() + backwards), tmp_path / "made", ACME)
    assert (made.folder / "model.sdf").read_text("utf-8").count("<xyz>0 1 0</xyz>") == 2
    assert any("left_joint are reversed" in note for note in made.notes)


def test_it_drives_in_the_trial(write: Write, tmp_path: Path) -> None:
    backwards = FOUR.replace('<axis xyz="0 1 0"/>', '<axis xyz="0 -1 0"/>')
    made = migrate(write(body() + backwards), tmp_path / "made", ACME)
    trial = checked(made.folder, trial=True).trial
    assert trial is not None
    assert 0.97 <= speed_ratio(trial) <= 1.03


def test_slow_wheels_limit_the_speed(write: Write, tmp_path: Path) -> None:
    slow = FOUR.replace('velocity="20"', 'velocity="5"')
    made = migrate(write(body() + slow), tmp_path / "made", ACME)
    assert values(spawner(made), "max_velocity") == ["0.5"]


def test_limits_that_are_asked_for(write: Write, tmp_path: Path) -> None:
    wishes = MigrationOptions(organization="acme", max_velocity=0.7, max_acceleration=1.5)
    text = spawner(migrate(write(body() + FOUR), tmp_path / "made", wishes))
    assert values(text, "min_velocity") == ["-0.7"]
    assert values(text, "max_acceleration") == ["1.5"]


def test_wheels_that_the_author_names(write: Write, tmp_path: Path) -> None:
    wishes = MigrationOptions(
        organization="acme",
        left_wheels=("left_rear_joint",),
        right_wheels=("right_rear_joint",),
    )
    text = spawner(migrate(write(body() + FOUR), tmp_path / "made", wishes))
    assert values(text, "left_joint") == ["left_rear_joint"]


def test_wheels_that_the_old_plugin_names(write: Write, tmp_path: Path) -> None:
    plugin = """<gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so">
      <leftJoint>left_rear_joint</leftJoint><rightJoint>right_rear_joint</rightJoint>
    </plugin></gazebo>"""
    text = spawner(migrate(write(body() + FOUR + plugin), tmp_path / "made", ACME))
    assert values(text, "left_joint") == ["left_rear_joint"]


@pytest.mark.parametrize(
    ("robot", "wishes", "said"),
    [
        (body() + FOUR + wheel("left_spare", 0, 0.2), ACME, "without a partner: left_spare_joint"),
        (body() + wheel("one", 0, 0.2), ACME, "left: one_joint; right: none"),
        (
            body() + FOUR,
            MigrationOptions(left_wheels=("nobody",), right_wheels=("right_rear_joint",)),
            "'nobody' is not a joint that turns a wheel; joints that turn: left_front_joint",
        ),
        (
            body() + FOUR,
            MigrationOptions(left_wheels=("right_rear_joint",), right_wheels=("left_rear_joint",)),
            "are the sides swapped",
        ),
        (
            body() + FOUR,
            MigrationOptions(left_wheels=("left_rear_joint",)),
            "no wheel on the right",
        ),
    ],
    ids=["spare wheel", "one wheel", "no such joint", "swapped", "one side"],
)
def test_what_is_unclear_is_said(
    write: Write, tmp_path: Path, robot: str, wishes: MigrationOptions, said: str
) -> None:
    with pytest.raises(NotMigrated, match=re.escape(said)):
        migrate(write(robot), tmp_path / "made", wishes)
    assert not (tmp_path / "made").exists()


def test_what_spins_above_the_ground_is_no_wheel(write: Write, tmp_path: Path) -> None:
    brush = wheel("brush", 0, 0, at="0.3 0 0.3")
    made = migrate(write(body() + FOUR + brush), tmp_path / "made", ACME)
    assert "brush" not in spawner(made)


LENSES = "".join(
    f"""<gazebo reference="base_link"><sensor name="{name}" type="{kind}"/></gazebo>"""
    for name, kind in (
        ("cam_color", "camera"),
        ("cam_ired1", "camera"),
        ("cam_depth", "depth"),
        ("rear", "camera"),
    )
)


@pytest.mark.parametrize("said", ["<prefix>cam_</prefix>", "<cameraName>cam</cameraName>", ""])
def test_the_cameras_of_a_realsense_become_one(write: Write, tmp_path: Path, said: str) -> None:
    name = "librealsense_gazebo_plugin.so"
    plugin = f'<gazebo><plugin name="r" filename="{name}">{said}</plugin></gazebo>'
    made = migrate(write(body() + FOUR + LENSES + plugin), tmp_path / "made", ACME)
    model = (made.folder / "model.sdf").read_text("utf-8")
    assert model.count('type="rgbd_camera"') == 1
    assert model.count('type="camera"') == 1


def test_what_the_rules_can_mend_is_mended(write: Write, tmp_path: Path) -> None:
    light = """<gazebo reference="base_link"><light name="lamp" type="point">
      <diffuse>255 255 255 1</diffuse></light></gazebo>"""
    made = migrate(write(body() + FOUR + light), tmp_path / "made", ACME)
    assert "<diffuse>1 1 1 1</diffuse>" in (made.folder / "model.sdf").read_text("utf-8")
    assert any(note.startswith("SDF016 is fixed") for note in made.notes)


def test_plugins_of_unknown_purpose_are_left_to_the_author(write: Write, tmp_path: Path) -> None:
    plugin = '<gazebo><plugin name="x" filename="libmy_arm.so"/></gazebo>'
    made = migrate(write(body() + FOUR + plugin), tmp_path / "made", ACME)
    assert any("libmy_arm.so" in each for each in made.open_points)
    assert "libmy_arm" not in (made.folder / "model.sdf").read_text("utf-8")
