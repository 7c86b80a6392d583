"""Descriptions whose text launch files of ROS 1 load, without xacro."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings

_MANIFEST = (
    "<package format='2'><name>@</name><buildtool_depend>catkin</buildtool_depend></package>"
)
_ARM = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:include filename="$(find lenses)/lens.xacro"/><link name="base"><inertial>
<mass value="1"/><inertia ixx="-1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>"""
_CAT = "<param name='a' command=\"cat '$(find arm)/urdf/arm.urdf'\"/>"


@pytest.mark.parametrize("folder", ["arm", "arm_bringup"])
@pytest.mark.parametrize(
    ("loading", "is_read"),
    [
        (_CAT, True),
        ("<param name='a' textfile='$(find arm)/urdf/arm.urdf'/>", True),
        (_CAT + _CAT.replace("cat ", "xacro "), False),
        (_CAT.replace("cat ", "$(find arm)/expand.sh "), False),
    ],
)
def test_no_missing_package_keeps_a_text_that_is_loaded_from_being_read(
    folder: str, loading: str, is_read: bool, tmp_path: Path
) -> None:
    files = {
        "arm/package.xml": _MANIFEST.replace("@", "arm"),
        "arm/urdf/arm.urdf": _ARM,
        "arm_bringup/package.xml": _MANIFEST.replace("@", "arm_bringup"),
        f"{folder}/launch/a.launch": f"<launch>{loading}</launch>",
    }
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    report = check_package(tmp_path / "arm", Settings(select=("INE002",), trial=False))

    (package,) = report.packages
    assert bool(package.findings) is is_read
