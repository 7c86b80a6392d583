"""Small descriptions for Gazebo 9, written for one test each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.migrate import migration
from checker.migrate.thumbnails import Thumbnails

MANIFEST = """<package format="2"><name>rover_description</name><version>1.0.0</version>
<description>A rover</description><maintainer email="a@example.org">A</maintainer>
<license>MIT</license><buildtool_depend>catkin</buildtool_depend></package>"""

Write = Callable[[str | Mapping[str, str]], Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write a package of a robot's XML (below <robot>), or of files by their path."""

    def write(robot: str | Mapping[str, str]) -> Path:
        folder = tmp_path / "rover_description"
        files = {"urdf/rover.urdf": urdf(robot)} if isinstance(robot, str) else robot
        for path, text in {"package.xml": MANIFEST, **files}.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text, "utf-8")
        return folder

    return write


@pytest.fixture
def no_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw nothing: for tests that look at other files."""
    monkeypatch.setattr(migration, "thumbnails_of", lambda *_: Thumbnails(trouble="not drawn"))


def speed_ratio(trial: Mapping[str, Any]) -> float:
    (ratio,) = [each["value"] for each in trial["measurements"] if each["name"] == "speed_ratio"]
    return float(ratio)


def urdf(robot: str, name: str = "rover") -> str:
    return f'<?xml version="1.0"?>\n<robot name="{name}">\n{robot}\n</robot>\n'


def body(name: str = "base_link", mass: float = 10.0) -> str:
    moment = mass * 0.02
    return f"""<link name="{name}">
  <inertial><mass value="{mass}"/>
    <inertia ixx="{moment}" ixy="0" ixz="0" iyy="{moment}" iyz="0" izz="{moment}"/></inertial>
  <collision><geometry><box size="0.6 0.3 0.1"/></geometry></collision>
  <visual><geometry><box size="0.6 0.3 0.1"/></geometry></visual>
</link>"""


def wheel(
    name: str,
    x: float,
    y: float,
    *,
    parent: str = "base_link",
    axis: str = "0 1 0",
    kind: str = "continuous",
    at: str = "",
    turned: str = "1.5707963267948966 0 0",
) -> str:
    """A wheel of radius 0.1 m, and the joint `<name>_joint` that turns it."""
    return f"""<link name="{name}">
  <inertial><mass value="1"/>
    <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial>
  <collision><origin xyz="0 0 0" rpy="{turned}"/>
    <geometry><cylinder radius="0.1" length="0.05"/></geometry></collision>
  <visual><origin xyz="0 0 0" rpy="{turned}"/>
    <geometry><cylinder radius="0.1" length="0.05"/></geometry></visual>
</link>
<joint name="{name}_joint" type="{kind}">
  <parent link="{parent}"/><child link="{name}"/><origin xyz="{at or f"{x} {y} 0"}"/>
  <axis xyz="{axis}"/><limit effort="20" velocity="20"/>
</joint>"""


def knuckle(name: str, x: float, y: float, kind: str = "revolute") -> str:
    """A part that turns about the vertical, and its joint `<name>_joint`."""
    return f"""<link name="{name}">
  <inertial><mass value="0.5"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
</link>
<joint name="{name}_joint" type="{kind}">
  <parent link="base_link"/><child link="{name}"/><origin xyz="{x} {y} 0"/>
  <axis xyz="0 0 1"/><limit lower="-0.5" upper="0.5" effort="20" velocity="2"/>
</joint>"""


FOUR = "".join(
    wheel(f"{side}_{end}", x, y)
    for end, x in (("front", 0.2), ("rear", -0.2))
    for side, y in (("left", 0.2), ("right", -0.2))
)
"""Two wheels on each side."""
