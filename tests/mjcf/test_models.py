"""Models of MuJoCo: which files are one, what is read of them, and where findings stand."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import Cause, Report, VerdictKind
from checker.settings import Settings

ARM = "<worldbody><body name='arm'><joint name='tilt'{}/><geom size='0.1'/></body></worldbody>"
TWISTED = ARM.format(" range='90 -90'")


def checked(folder: Path, files: Mapping[str, str], given: str = "") -> Report:
    for path, text in files.items():
        place = folder / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
    return check_package(folder / given, Settings(display=False))


def places(report: Report) -> list[str]:
    return [
        f"{finding.rule} {package.name} {place.file}:{place.line}"
        for package in report.packages
        for finding in package.findings
        for place in finding.places
    ]


def test_a_folder_of_models_is_a_unit_and_so_is_each_folder_beside(tmp_path: Path) -> None:
    model = f"<mujoco>{ARM.format('')}</mujoco>"
    files = dict.fromkeys(("a/arm.xml", "a/parts/hand.xml", "b/arm.xml"), model)
    report = checked(tmp_path, {**files, "b/note.xml": "<n/>"})
    assert [package.name for package in report.packages] == ["a", "b"]
    assert {package.kind for package in report.packages} == {"mujoco_model"}
    assert {package.verdict for package in report.packages} == {VerdictKind.READY}


def test_a_scene_without_a_body_is_no_robot(tmp_path: Path) -> None:
    track = (
        "<mujoco model='track'><worldbody><geom type='plane' size='1 1 1'/></worldbody></mujoco>"
    )
    report = checked(tmp_path, {"arm.xml": f"<mujoco>{ARM.format('')}</mujoco>", "b.xml": track})
    (package,) = report.packages
    arm, scene = package.facts, *package.other_robots
    assert (arm["robot"], arm["links"]) == ("arm.xml", 1)
    assert (scene["scene"], "robot" in scene, "links" in scene) == ("track", False, False)


def test_a_robot_in_two_scenes_is_reported_once_at_its_own_line(tmp_path: Path) -> None:
    scene = "<mujoco>\n<worldbody><geom type='plane' size='1 1 1'/></worldbody>\n{}</mujoco>"
    include = "<include file='arm.xml'/>\n"
    files = {
        "arm.xml": f"<mujoco>\n{TWISTED}</mujoco>",
        "one.xml": scene.format(include),
        "two.xml": scene.format(include),
    }
    report = checked(tmp_path / "arm", files)
    assert places(report) == ["MJC004 arm arm.xml:2"]


def test_one_run_shows_all_that_mujoco_refuses(tmp_path: Path) -> None:
    motor = "<actuator>\n<motor joint='tilted'/>\n</actuator>"
    text = f"<mujoco>\n<option apirate='1'/>\n{TWISTED}\n{motor}</mujoco>"
    report = checked(tmp_path / "arm", {"arm.xml": text})
    found = ["MJC001 arm arm.xml:2", "MJC001 arm arm.xml:5", "MJC004 arm arm.xml:3"]
    assert sorted(places(report)) == found


def test_an_attached_model_brings_its_own_places(tmp_path: Path) -> None:
    files = {
        "scene.xml": "<mujoco><asset><model name='m' file='hand/hand.xml'/></asset><worldbody>\n"
        "<frame><attach model='m' body='hand' prefix='h_'/></frame></worldbody></mujoco>",
        "hand/hand.xml": "<mujoco>\n<worldbody><body name='hand'>\n<joint armature='1' "
        "range='-200 200'/><geom size='0.1'/></body></worldbody></mujoco>",
    }
    report = checked(tmp_path / "hands", files)
    assert report.packages[0].verdict is VerdictKind.READY
    assert not places(report)


def test_a_missing_mesh_leaves_the_rest_judged(tmp_path: Path) -> None:
    text = (
        "<mujoco>\n<asset><mesh name='m' file='gone.stl'/></asset>\n<worldbody><body>\n"
        "<joint range='1 -1'/><geom type='mesh' mesh='m'/></body></worldbody></mujoco>"
    )
    report = checked(tmp_path / "arm", {"arm.xml": text})
    assert sorted(places(report)) == ["MJC002 arm arm.xml:2", "MJC004 arm arm.xml:4"]
    (unseen,) = [it for it in report.packages[0].blind_spots if it.rule == "MJC007"]
    assert "gone.stl is missing" in unseen.reason


def test_includes_in_a_circle_and_out_of_the_folder_are_findings(tmp_path: Path) -> None:
    outside = tmp_path / "secret.xml"
    outside.write_text("<mujoco><worldbody><geom size='1'/></worldbody></mujoco>")
    files = {
        "a.xml": f"<mujoco><include file='b.xml'/><include file='{outside}'/></mujoco>",
        "b.xml": "<mujoco><include file='a.xml'/><worldbody><geom size='1'/></worldbody></mujoco>",
    }
    report = checked(tmp_path / "arm", files, "a.xml")
    assert sorted({place.split()[0] for place in places(report)}) == ["MJC002"]
    assert not any("secret.xml:" in place for place in places(report))


def test_what_an_earlier_version_reads_is_a_warning_where_it_is_stated(tmp_path: Path) -> None:
    text = f"<mujoco>\n<option apirate='1'/>\n{ARM.format('')}</mujoco>"
    files = {"arm.xml": text, "requirements.txt": "numpy\nmujoco==2.3.5\n"}
    (found,) = checked(tmp_path / "arm", files).packages[0].findings
    assert found.severity is Severity.WARNING
    assert "requirements.txt:2 has mujoco==2.3.5" in found.message


def test_includes_that_nest_deeply_are_no_crash(tmp_path: Path) -> None:
    depth, files = 200, {"f9.xml": "<mujoco><worldbody/></mujoco>"}
    for number in range(9):
        inner = f"<include file='f{number + 1}.xml'/>"
        nested = "<frame>" * depth + inner + "</frame>" * depth
        files[f"f{number}.xml"] = f"<mujoco><worldbody>{nested}</worldbody></mujoco>"
    (package,) = checked(tmp_path / "deep", files).packages
    assert not [it for it in package.not_checked if it.cause is Cause.CRASHED]
    assert package.verdict is VerdictKind.INCOMPLETE


@pytest.mark.slow
def test_models_beyond_the_limit_are_named(tmp_path: Path) -> None:
    model = "<mujoco><worldbody><geom size='1'/></worldbody></mujoco>"
    files = {f"m{number}.xml": model for number in range(42)}
    settings = Settings(display=False, select=("MJC003",))
    for path, text in files.items():
        (tmp_path / path).write_text(text)
    (package,) = check_package(tmp_path, settings).packages
    assert "2 are not" in " ".join(spot.reason for spot in package.blind_spots)


def test_what_cmake_installs_from_another_package_is_not_missing(tmp_path: Path) -> None:
    build = "install(DIRECTORY ${parts_DIR}/meshes DESTINATION share/arm)\n"
    files = {
        "arm.xml": "<mujoco><include file='meshes/hand.xml'/></mujoco>",
        "CMakeLists.txt": f"project(arm)\n{build}",
    }
    report = checked(tmp_path / "arm", files)
    assert places(report) == []
    (reason,) = (it.reason for it in report.packages[0].not_checked if it.rule == "MJC002")
    assert reason.startswith("CMakeLists.txt:2 installs files of another place")
