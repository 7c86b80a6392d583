"""Files that the static models of a world name."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport, VerdictKind
from checker.settings import Settings

_WORLD = """<sdf version="1.7">
<world name="hall">
  <model name="walls">
    <static>true</static>
    <link name="link">
      <visual name="v"><geometry><mesh><uri>@</uri></mesh></geometry></visual>
    </link>
  </model>
</world>
</sdf>
"""


def _check(tmp_path: Path, uri: str) -> PackageReport:
    world = tmp_path / "hall.world"
    world.write_text(_WORLD.replace("@", uri))
    return check_package(world, Settings(select=("REF002", "REF004"), trial=False)).packages[0]


@pytest.mark.parametrize(
    ("uri", "expected"),
    [
        ("file:///home/ann/ws/src/hall/walls.stl", "on its author's machine"),
        ("meshes/walls.stl", "does not exist"),
        ("https://fuel.gazebosim.org/1.0/acme/models/walls/walls.stl", "is not of the form"),
    ],
)
def test_a_file_that_a_static_model_names_and_that_is_not_there(
    tmp_path: Path, uri: str, expected: str
) -> None:
    (found,) = _check(tmp_path, uri).findings
    assert expected in found.message
    assert found.severity is not Severity.INFO


@pytest.mark.parametrize(
    ("shape", "has", "severity"),
    [
        ("visual", "", Severity.WARNING),
        ("collision", "", Severity.ERROR),
        ("visual", '<plugin name="p" filename="libdoor.so"/>', Severity.ERROR),
    ],
)
def test_a_mesh_of_scenery_that_is_only_seen_is_no_error(
    shape: str, has: str, severity: Severity, tmp_path: Path
) -> None:
    text = _WORLD.replace("visual", shape).replace("@", "absent.stl")
    (tmp_path / "hall.world").write_text(text.replace("<static>true</static>", has))
    settings = Settings(
        select=("REF002",), trial=False, profile="gazebo-harmonic", profile_chosen=True
    )
    report = check_package(tmp_path / "hall.world", settings).packages[0]
    assert [it.severity for it in report.findings] == [severity]


def test_a_file_that_is_there(tmp_path: Path) -> None:
    (tmp_path / "walls.stl").touch()
    report = _check(tmp_path, "walls.stl")
    assert not report.findings
    assert not report.blind_spots


def test_a_file_of_a_model_that_is_not_there_is_not_checked(tmp_path: Path) -> None:
    report = _check(tmp_path, "model://cafe/meshes/cafe.dae")
    assert not report.findings
    assert [it.reason for it in report.blind_spots] == ["model://cafe is not available"]
    assert report.verdict is VerdictKind.READY


@pytest.mark.parametrize(("name", "reasons"), [("sun", 0), ("cafe", 1)])
def test_a_model_that_a_world_includes_and_that_is_not_there_is_not_checked(
    tmp_path: Path, name: str, reasons: int
) -> None:
    include = f"<include><uri>model://{name}</uri></include>"
    (tmp_path / "hall.world").write_text(
        f"<sdf version='1.7'><world name='a'>{include}</world></sdf>"
    )
    settings = Settings(select=("REF002",), trial=False)
    report = check_package(tmp_path / "hall.world", settings).packages[0]
    assert len(report.blind_spots) == reasons


def test_the_name_of_a_world_is_reported_once(tmp_path: Path) -> None:
    package = tmp_path / "acme_hall"
    (package / "worlds").mkdir(parents=True)
    manifest = "<package format='3'><name>acme_hall</name></package>"
    (package / "package.xml").write_text(manifest)
    (package / "worlds/hall copy.world").write_text(_WORLD)
    settings = Settings(select=("PKG015",), trial=False)
    reports = check_package(package, settings).packages
    assert len(reports) == 2
    assert sum(len(report.findings) for report in reports) == 1
