"""The parts of a package: what they hold, and what they say when something is not at hand."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from checker.pipeline import check_package
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings
from tests.examples import NAME, SPAWNER, write_example

ARM = """<sdf version="1.6"><model name="arm"><link name="wrist">
<visual name="v"><geometry><mesh><uri>meshes/a.dae</uri></mesh></geometry></visual>
</link></model></sdf>"""


def checked(example: Any, workspace: Path, *select: str) -> PackageReport:
    package = write_example(example, workspace)
    (report,) = check_package(package, Settings(select=select)).packages
    return report


def including(uri: str) -> str:
    return f"<include><uri>{uri}</uri></include>"


@pytest.mark.parametrize(
    ("uri", "files"),
    [
        ("arm", {"arm/model.sdf": ARM}),
        ("arm/hand.sdf", {"arm/hand.sdf": ARM}),
        (
            "arm",
            {"arm/model.config": "<model><sdf>hand.sdf</sdf></model>", "arm/hand.sdf": ARM},
        ),
        (f"model://{NAME}/arm", {"arm/model.sdf": ARM}),
        ("model://arm", {"../arm/model.sdf": ARM, "../arm/meshes/a.dae": "<COLLADA/>"}),
    ],
)
def test_an_included_model_is_found_and_its_meshes_beside_it(
    uri: str, files: dict[str, str], tmp_path: Path
) -> None:
    if not uri.startswith("model://arm"):
        files = {**files, "arm/meshes/a.dae": "<COLLADA/>"}
    report = checked({"@fragment": including(uri), **files}, tmp_path, "REF002", "KIN001")
    assert report.facts["links"] == 2
    assert not report.findings
    assert not report.not_checked


def test_what_compares_with_the_whole_robot_waits_for_an_include(tmp_path: Path) -> None:
    example = {
        "@fragment": including("model://battery"),
        "specifications.md": "# R\n### Sensors\n* VLP-16, modeled by gpu_lidar\n"
        "### Cost and Scale\nIts weight is 50 kg.\n",
        "launch/vehicle_topics.launch": '<launch><node pkg="b" type="image_bridge" name="n" '
        'args="/world/w/model/m/link/l/sensor/s/image"/></launch>',
    }
    report = checked(example, tmp_path, "INE008", "DOC003", "ROS002")
    assert not report.findings
    assert {each.rule for each in report.not_checked} == {"INE008", "DOC003", "ROS002"}
    assert all("model://battery" in each.reason for each in report.not_checked)
    assert report.verdict is VerdictKind.INCOMPLETE


@pytest.mark.parametrize("version", ["", "1.3", "1.13", "../../x", "9" * 50])
def test_an_sdf_version_that_is_not_known_stops_no_rule(version: str, tmp_path: Path) -> None:
    model = f'<sdf version="{version}"><model name="m"><link name="l"/></model></sdf>'
    report = checked({"model.sdf": model}, tmp_path, "SDF", "KIN")
    assert not report.crashed


def test_a_second_model_is_no_second_robot(tmp_path: Path) -> None:
    two = """<sdf version="1.6"><model name="rover"><link name="base_link">
    <sensor name="imu" type="imu"/></link></model>
    <model name="box"><link name="l"/></model></sdf>"""
    topics = """<launch><node pkg="b" type="parameter_bridge" name="n"
      args="/world/w/model/m/link/base_link/sensor/imu/imu@a/B[c.D"/></launch>"""
    report = checked({"model.sdf": two, "launch/vehicle_topics.launch": topics}, tmp_path, "ROS002")
    assert not report.findings


ROS = "def rosExecutables(_name, _worldName)\n"
UNREAD = {
    "a launch file that is missing": (
        {"launch/vehicle_topics.launch": None},
        "launch/vehicle_topics.launch does not exist",
    ),
    "a package that is not at hand": (
        {"launch/spawner.rb": SPAWNER.replace(f"{NAME} vehicle", "acme_topics vehicle")},
        "package acme_topics is not at hand",
    ),
    "an include that is not at hand": (
        {
            "launch/vehicle_topics.launch": '<launch><arg name="name"/><arg name="world_name"/>'
            '<include file="$(find acme)/launch/a.launch"/></launch>'
        },
        "package acme is not at hand",
    ),
    "a command that cannot be read": (
        {"launch/spawner.rb": SPAWNER.replace(ROS, f"{ROS}  system('rm')\n")},
        "system",
    ),
    "a launch file in another encoding": (
        {"launch/vehicle_topics.launch": "<launch>\0</launch>"},
        "launch/vehicle_topics.launch cannot be read",
    ),
}


@pytest.mark.parametrize("case", UNREAD)
def test_bridges_that_are_not_known_are_not_passed(case: str, tmp_path: Path) -> None:
    changes, reason = UNREAD[case]
    report = checked(changes, tmp_path, "ROS002")
    assert report.verdict is VerdictKind.INCOMPLETE
    assert any(reason in each.reason for each in report.not_checked)


def test_a_launch_file_is_found_by_its_exact_name_in_any_folder(tmp_path: Path) -> None:
    started = SPAWNER.replace("vehicle_topics.launch", "Topics.launch")
    bridge = """<launch><node pkg="b" type="image_bridge" name="n"
      args="/world/w/model/m/link/l/sensor/s/image"/></launch>"""
    example = {"launch/spawner.rb": started, "launch/sub/Topics.launch": bridge}
    (finding,) = checked(example, tmp_path, "ROS002").findings
    assert finding.places[0].file == "launch/sub/Topics.launch"


def test_a_file_that_is_started_and_missing_bridges_nothing(tmp_path: Path) -> None:
    report = checked({"launch/vehicle_topics.launch": None}, tmp_path, "PKG003")
    assert [each.message for each in report.findings] == [
        "launch/vehicle_topics.launch is missing, which bridges topics to ROS"
    ]


def test_a_sentence_with_other_words_still_says_the_mass(tmp_path: Path) -> None:
    sheet = "# R\n### Cost and Scale\nIt is 1 m long with its sensors, and weighs 56 kg.\n"
    (finding,) = checked({"specifications.md": sheet}, tmp_path, "INE008").findings
    assert "56 kg" in finding.message


def test_text_that_gazebo_cannot_decode_is_an_error(tmp_path: Path) -> None:
    package = write_example("", tmp_path)
    model = package / "model.sdf"
    model.write_bytes(model.read_text("utf-8").encode("utf-16"))
    (report,) = check_package(package, Settings(select=("SDF001",))).packages
    assert "UTF-16" in report.findings[0].message
