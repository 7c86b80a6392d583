"""The Husky of the guide, from Gazebo 9 to a package that can be submitted."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.migrate.migration import Migrated, migrate
from checker.migrate.options import MigrationOptions
from checker.pipeline import check_package
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.migrate.conftest import speed_ratio

NAME = "acme_husky_sensor_config_2"
LEFT_TO_THE_AUTHOR = {
    "DOC002": "every TODO of the sheet",
    "SPW014": "every TODO of the spawner",
    "DOC007": "what the real robot costs",
    "DOC008": "datasheets",
}
WITHOUT_OPENGL = {"PKG013": "thumbnails", "PKG003": "their folder"}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Migrated:
    wishes = MigrationOptions(organization="Acme", config=2)
    return migrate(SAMPLES / "husky_description", tmp_path_factory.mktemp("made"), wishes)


@pytest.fixture(scope="module")
def report(made: Migrated) -> PackageReport:
    (package,) = check_package(made.folder, Settings()).packages
    return package


@pytest.mark.slow
def test_it_has_the_tree_of_the_guide(made: Migrated) -> None:
    files = {
        path.relative_to(made.folder).as_posix()
        for path in made.folder.rglob("*")
        if path.is_file() and path.parent.name not in ("thumbnails", "meshes")
    }
    assert made.folder.name == NAME
    assert files == {
        "CMakeLists.txt",
        "launch/description.launch",
        "launch/example.ign",
        "launch/spawner.rb",
        "launch/vehicle_topics.launch",
        "model.config",
        "model.sdf",
        "package.xml",
        "specifications.md",
        "urdf/acme_husky.orig.urdf",
        "urdf/robot_from_sdf.xacro",
        "worlds/example.sdf",
    }


def test_only_meshes_that_are_used_are_copied(made: Migrated) -> None:
    there = {path.name for path in (SAMPLES / "husky_description/meshes").iterdir()}
    assert {path.name for path in (made.folder / "meshes").iterdir()} == there - {"meshes.txt"}


def test_it_is_drawn_from_five_sides_or_that_is_left_to_the_author(made: Migrated) -> None:
    drawn = sorted((made.folder / "thumbnails").glob("*.png"))
    if drawn:
        assert [each.name for each in drawn] == ["1.png", "2.png", "3.png", "4.png", "5.png"]
        assert len({each.read_bytes() for each in drawn}) == 5
        assert all(each.read_bytes().startswith(b"\x89PNG") for each in drawn)
    else:
        assert any("not drawn: the process that draws" in each for each in made.open_points)


def test_it_is_ready_but_for_what_the_author_alone_knows(
    made: Migrated, report: PackageReport
) -> None:
    rules = {finding.rule for finding in report.findings}
    drawn = (made.folder / "thumbnails").is_dir()
    assert rules - (set() if drawn else WITHOUT_OPENGL.keys()) == LEFT_TO_THE_AUTHOR.keys()
    assert report.verdict is VerdictKind.NOT_READY
    errors = {each.rule for each in report.findings if each.severity is Severity.ERROR}
    assert errors == {"DOC002", "SPW014"}
    assert not report.blind_spots


def test_no_figure_is_invented_and_every_todo_is_listed(made: Migrated) -> None:
    spawner = (made.folder / "launch/spawner.rb").read_text("utf-8")
    battery = spawner.partition("<battery_name>")[2].partition("<power_draining_topic>")[0]
    assert len(re.findall(r"<\w+>TODO</\w+>", battery)) == 8
    assert not re.search(r"\d", battery)
    for path in ("launch/spawner.rb", "specifications.md", "package.xml", "model.config"):
        lines = (made.folder / path).read_text("utf-8").splitlines()
        wanted = [number for number, line in enumerate(lines, 1) if "TODO" in line]
        listed = [each.split(":")[1] for each in made.to_do if each.startswith(f"{path}:")]
        assert listed == list(map(str, wanted))
    sheet = (made.folder / "specifications.md").read_text("utf-8")
    first, last = (spawner[: spawner.index(tag)].count("\n") + 1 for tag in ("<volt", "<power_l"))
    assert f"its figures in launch/spawner.rb (lines\n{first} to {last})" in sheet


def test_it_is_ready_when_every_todo_is_filled_in(made: Migrated, tmp_path: Path) -> None:
    filled = shutil.copytree(made.folder, tmp_path / made.folder.name)
    figures = iter(("12.694", "12.694", "-3.1424", "78.4", "78.4", "0.061523", "1.9499", "9.9"))
    spawner = filled / "launch/spawner.rb"
    text = re.sub(r">TODO<", lambda _: f">{next(figures)}<", spawner.read_text("utf-8"))
    spawner.write_text(text, "utf-8")
    sheet = filled / "specifications.md"
    known = "The battery lasts 3600 seconds"
    text = sheet.read_text("utf-8").replace("TODO: how many seconds the battery", known)
    sheet.write_text(re.sub(r"\bTODO\b:?", "", text), "utf-8")
    (package,) = check_package(filled, Settings(trial=False)).packages
    assert {each.rule for each in package.findings if each.severity is Severity.ERROR} == set()
    assert package.verdict is VerdictKind.READY


def test_it_drives_at_the_commanded_speed(report: PackageReport) -> None:
    assert report.trial is not None
    assert 0.97 <= speed_ratio(report.trial) <= 1.03


def test_no_name_of_gazebo_9_is_left(made: Migrated) -> None:
    model = (made.folder / "model.sdf").read_text("utf-8")
    for old in (
        "gazebo_ros",
        "hector",
        "gpu_ray",
        "<ray>",
        "package://",
        "robot_name/",
        "1.57079<",
    ):
        assert old not in model
    assert "0 0 0 1.5707963267948966 0 0" in model


def test_the_sensors_are_those_of_the_guide(made: Migrated) -> None:
    model = (made.folder / "model.sdf").read_text("utf-8")
    for sensor in (
        '<sensor name="imu_sensor" type="imu">',
        '<sensor name="front_laser" type="gpu_lidar">',
        '<sensor name="velodyne" type="gpu_lidar">',
        '<sensor name="sonar_rear" type="gpu_lidar">',
        '<sensor name="camera_front" type="rgbd_camera">',
        '<sensor name="camera_rear" type="rgbd_camera">',
    ):
        assert model.count(sensor) == 1
    assert model.count("<sensor ") == 6


def test_the_sheet_names_the_lines_of_the_limits(made: Migrated) -> None:
    sheet = (made.folder / "specifications.md").read_text("utf-8")
    spawner = (made.folder / "launch/spawner.rb").read_text("utf-8").splitlines()
    (first, second) = (number for number, line in enumerate(spawner, 1) if "_velocity>" in line)
    assert f"lines {first} and {second}" in sheet
    assert "It weighs 57.34 kg" in sheet


def test_every_plugin_that_the_guide_names_is_decided_about(made: Migrated) -> None:
    said = "\n".join(made.notes)
    for plugin in (
        "libLightVisualPlugin.so is removed",
        "libRosFlashLightPlugin.so is removed",
        "libgazebo_ros_control.so is removed",
        "libhector_gazebo_ros_imu.so is replaced by a sensor of type imu",
        "libgazebo_ros_p3d.so is removed",
        "libgazebo_ros_openni_kinect.so is replaced by a sensor of type rgbd_camera",
        "libgazebo_ros_velodyne_gpu_laser.so is replaced by a sensor of type gpu_lidar",
        "libhector_gazebo_ros_gps.so is removed",
        "libgazebo_ros_range.so is replaced by a sensor of type gpu_lidar",
        "librealsense_gazebo_plugin.so is replaced by a sensor of type rgbd_camera",
    ):
        assert plugin in said
    assert "lights left_headlight, right_headlight are darker" in said
    assert "urdf/sensors.xacro:" in said


@pytest.mark.slow
@pytest.mark.parametrize("sample", ["my_gurdy_description", "ouster_description"])
def test_robots_without_wheels_come_out_too(sample: str, tmp_path: Path) -> None:
    made = migrate(SAMPLES / sample, tmp_path / "made", MigrationOptions(organization="acme"))
    (report,) = check_package(made.folder, Settings(trial=False)).packages
    errors = {each.rule for each in report.findings if each.severity is Severity.ERROR}
    assert errors <= {"DOC002", "SPW014"}
    assert any("joints" in each for each in made.open_points)
