"""A model folder of Gazebo whose model.config names a URDF file."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings

CONFIG = """<?xml version="1.0"?>
<model>
  <name>pole</name>
  <version>1.0</version>
  <sdf>pole.urdf</sdf>
  <author><name>A. Person</name><email>a@example.org</email></author>
  <description>A pole.</description>
</model>
"""
URDF = """<robot name="pole">
  <link name="base">
    <inertial>
      <mass value="{mass}"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    <visual><geometry><mesh filename="{mesh}"/></geometry></visual>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
  </link>
</robot>
"""
CUBE = """v 0 0 0\nv 0.2 0 0\nv 0 0.2 0\nv 0 0 0.2
f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4
"""


def checked(
    folder: Path, *, mass: float = 1.0, mesh: str = "file://meshes/pole.obj"
) -> PackageReport:
    """Check a model folder with this URDF."""
    model = folder / "pole"
    (model / "meshes").mkdir(parents=True)
    (model / "meshes" / "pole.obj").write_text(CUBE)
    (model / "model.config").write_text(CONFIG)
    (model / "pole.urdf").write_text(URDF.format(mass=mass, mesh=mesh))
    (report,) = check_package(model, Settings(trial=False)).packages
    return report


def test_its_robot_is_judged_for_gazebo(tmp_path: Path) -> None:
    report = checked(tmp_path, mass=-1.0)
    assert report.profile == "gazebo-harmonic"
    assert report.facts is not None
    assert "INE002" in {finding.rule for finding in report.findings}


@pytest.mark.parametrize("path", ["meshes/pole.obj", "models/pole/meshes/pole.obj"])
def test_a_mesh_on_the_resource_path_is_found(path: str, tmp_path: Path) -> None:
    report = checked(tmp_path, mesh=f"file://{path}")
    rules = {finding.rule for finding in report.findings}
    assert rules.isdisjoint({"REF001", "REF002", "URD002"})
    assert not [it for it in report.not_checked if "outside" in it.reason]


def test_a_mesh_on_one_machine_is_not(tmp_path: Path) -> None:
    report = checked(tmp_path, mesh="file:///home/me/pole.obj")
    assert {"REF001", "URD002"} & {finding.rule for finding in report.findings}
