"""URD027 and libsdformat agree on which collisions of a URDF get their friction."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings
from tests.oracle.conftest import Load

_MASS = """<inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"""
_BALL = "<geometry><sphere radius='0.1'/></geometry>"
SETTINGS = Settings(
    profile="urdf", profile_chosen=True, select=("URD027",), trial=False, cache=False
)
NAMES = ("", "ball", "ball_collision", "ball_1", "my_ball", "body", "base_link", "base_link_1")


def _robot(name: str, joint: str) -> str:
    named = f' name="{name}"' if name else ""
    return f"""<robot name="rover">
<link name="base_link">{_MASS}<collision>{_BALL}</collision></link>
<link name="ball">{_MASS}<collision{named}>{_BALL}</collision></link>
<joint name="axle" type="{joint}"><parent link="base_link"/><child link="ball"/></joint>
<gazebo reference="ball"><mu1>0.125</mu1></gazebo>
</robot>
"""


@pytest.mark.parametrize("joint", ["fixed", "continuous"])
@pytest.mark.parametrize("name", NAMES)
def test_a_named_collision(name: str, joint: str, libsdformat: Load, tmp_path: Path) -> None:
    file = tmp_path / "rover.urdf"
    file.write_text(_robot(name, joint))
    (loaded,) = libsdformat([file], elements=True)
    (report,) = check_package(file, SETTINGS).packages
    assert not loaded.errors
    kept = re.search(r"<mu>0.125</mu>", loaded.elements) is not None
    assert kept == (not report.findings)
