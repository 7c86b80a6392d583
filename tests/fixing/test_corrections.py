"""Fixes of numbers: what they write, what is not theirs to change, and what `--prove` keeps."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from checker.base.cache import NO_CACHE
from checker.engine.review import findings_of
from checker.finding import Safety
from checker.fix.rounds import Fixed, fix_package
from checker.formats.corrections import along_z, number_text
from checker.package.inputs import open_input
from checker.rule_testing import profile_of, write_example
from checker.rulebook.discovery import all_rules
from checker.settings import Settings

ROBOT = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<link name="base_link"/>
<xacro:macro name="arm" params="side size">
  <link name="${{side}}_arm">
    {inertial}
    <collision><geometry><box size="${{size}} 0.2 0.1"/></geometry></collision>
  </link>
  <joint name="${{side}}_joint" type="continuous">
    <parent link="base_link"/><child link="${{side}}_arm"/><axis xyz="0 1 0"/>
  </joint>
</xacro:macro>
<xacro:arm side="left" size="0.4"/>
<xacro:arm side="right" size="{other}"/>
</robot>
"""
UNIT = """<inertial>
      <mass value="2"/>
      <inertia ixx="{}" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>"""
MADE = 'ixx="0.00833333" ixy="0" ixz="0" iyy="0.0283333" iyz="0" izz="0.0333333"'


def fixed(
    folder: Path, text: str, *rules: str, prove: bool = False, profile: str = "urdf"
) -> tuple[str, Fixed]:
    """Return the text of a robot after all fixes of some rules, and what was done."""
    path = folder / "arm.urdf.xacro"
    path.write_text(text, "utf-8")
    settings = Settings(trial=False, profile=profile)
    chosen = Settings(trial=False, profile=profile, select=rules)
    with open_input(path) as opened:
        done = fix_package(
            opened.packages[0],
            lambda each: findings_of(each, chosen, NO_CACHE),
            list(Safety),
            (lambda each: findings_of(each, settings, NO_CACHE)) if prove else None,
        )
    return (done.files[0].after if done.files else text), done


@pytest.mark.parametrize("prove", [False, True])
def test_a_macro_of_like_links_gets_their_moments(tmp_path: Path, prove: bool) -> None:
    text = ROBOT.format(inertial=UNIT.format(1), other="0.4")
    after, done = fixed(tmp_path, text, "INE004", prove=prove)
    assert MADE in after
    assert done.rounds == 1


def test_a_macro_of_unlike_links_stays(tmp_path: Path) -> None:
    text = ROBOT.format(inertial=UNIT.format(1), other="0.9")
    after, done = fixed(tmp_path, text, "INE004")
    assert after == text
    assert not done.left
    assert done.rounds == 0


def test_a_computed_number_stays(tmp_path: Path) -> None:
    text = ROBOT.format(inertial=UNIT.format("${2 / 2}"), other="0.4")
    assert fixed(tmp_path, text, "INE004")[0] == text


def test_a_macro_without_inertial_gets_one(tmp_path: Path) -> None:
    after, _ = fixed(tmp_path, ROBOT.format(inertial="", other="0.4"), "URD007")
    assert after.count('<mass value="8"/>') == 1
    assert after.count("<inertial>") == 1


SENSOR = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="measures" params="name">
  <link name="${name}"/>
  <gazebo reference="${name}">
    <sensor name="${name}_sensor" type="KIND">
      <BLOCK>
        WRITTEN<update_rate/>
      </BLOCK>
    </sensor>
  </gazebo>
</xacro:macro>
<xacro:measures name="base_link"/>
</robot>
"""
VIEW = """<horizontal_fov>1</horizontal_fov>
        <image><width>1280</width><height>960</height></image>
        """


@pytest.mark.parametrize(
    ("rule", "kind", "block", "written", "new"),
    [
        ("SEN013", "imu", "imu", "", '<imu>\n        <angular_velocity>\n          <x>\n'),
        (
            "SEN009", "camera", "camera", f"{VIEW}<lens><intrinsics/></lens>",
            "<lens><intrinsics><fx>1171.51</fx><fy>1171.51</fy>",
        ),
    ],
)  # fmt: skip
def test_what_a_sensor_lacks_is_written_into_its_macro(
    tmp_path: Path, rule: str, kind: str, block: str, written: str, new: str
) -> None:
    text = SENSOR.replace("KIND", kind).replace("BLOCK", block).replace("WRITTEN", written)
    after, done = fixed(tmp_path, text, rule, profile="subt")
    assert new in after
    assert done.rounds == 1
    assert not done.left


@pytest.mark.parametrize(
    ("value", "text"),
    [(math.pi / 2, "1.5707963267948966"), (-math.pi, "-3.141592653589793"), (1 / 3, "0.333333"),
     (0.0, "0"), (1e-9, "1e-09"), (2.0, "2")],
)  # fmt: skip
def test_numbers_have_six_digits_but_quarter_turns_all(value: float, text: str) -> None:
    assert number_text(value) == text


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0.6, 0, -0.8)])
def test_z_lies_along_a_line(axis: tuple[float, float, float]) -> None:
    x, y, z = along_z(axis).rotate((0.0, 0.0, 1.0))
    assert abs(x * axis[0] + y * axis[1] + z * axis[2]) == pytest.approx(1.0)


def test_a_fix_that_brings_an_error_is_not_kept_when_it_must_be_proven(tmp_path: Path) -> None:
    """A wheel that lies right has a radius to compare with the drive's, which is another one."""
    (rule,) = (each for each in all_rules() if each.id == "GEO003")
    with open_input(write_example(rule.bad[0], tmp_path)) as opened:
        package = opened.packages[0]
        chosen, every = (
            Settings(trial=False, profile=profile_of(rule, rule.bad[0]).name, select=select)
            for select in (("GEO003",), ())
        )
        done = fix_package(
            package,
            lambda each: findings_of(each, chosen, NO_CACHE),
            list(Safety),
            lambda each: findings_of(each, every, NO_CACHE),
        )
    assert not done.files
    assert [each.rule for each in done.unproven] == ["GEO003"]
