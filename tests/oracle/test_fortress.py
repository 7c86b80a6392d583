"""Trials beside the same courses in the physics of Gazebo Fortress."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.trial.profile import Knots
from checker.rule_testing import write_example
from checker.rulebook.example_parts import rover
from support.fortress import Refused, driven
from support.fortress.comparison import Comparison, compared
from tests.mesh.normals import BARE, LIT
from tests.trial.six_wheels import on_struts, on_trailing_arms, rigid, rocker_bogie

SAMPLES = Path(__file__).parents[2] / "samples"


def comparison_of(folder: Path, program: Path, slope: float = 0.0) -> Comparison:
    with open_input(folder) as opened:
        package = opened.packages[0]
        robots = Subject(package).all(Robot)
        assert not isinstance(robots, NotAvailable)
        result = compared(program, package, robots[0], slope)
    assert isinstance(result, Comparison), result
    return result


@pytest.mark.parametrize(
    "sample",
    ["acme_scout", "husky_migration_sensor_config_1", "subtcheck_buggy_sensor_config_1"],
)
def test_a_robot_stands_drives_and_stops_as_in_gazebo(sample: str, fortress: Path) -> None:
    result = comparison_of(SAMPLES / sample, fortress)
    here, there = result.here, result.there
    assert here.sink == pytest.approx(there.sink, abs=0.002)
    assert here.speed == pytest.approx(there.speed, rel=0.01)
    assert here.full == pytest.approx(there.full, rel=0.01)
    assert here.stop == pytest.approx(there.stop, rel=0.05)


def test_a_steered_robot_drives_the_same_circle(fortress: Path) -> None:
    result = comparison_of(SAMPLES / "subtcheck_buggy_sensor_config_1", fortress)
    assert result.here.turn == pytest.approx(result.there.turn, rel=0.05)


@pytest.mark.parametrize("degrees", [-10, 10, 20])
@pytest.mark.parametrize("sample", ["acme_scout", "subtcheck_buggy_sensor_config_1"])
def test_a_robot_drives_up_and_down_a_slope_as_in_gazebo(
    sample: str, degrees: float, fortress: Path
) -> None:
    result = comparison_of(SAMPLES / sample, fortress, math.radians(degrees))
    assert result.here.speed == pytest.approx(result.there.speed, rel=0.01)
    assert result.here.stop == pytest.approx(result.there.stop, rel=0.05)


@pytest.mark.parametrize("limit", ["<velocity>2</velocity>", "<effort>0.05</effort>"])
def test_limits_of_wheels_slow_it_down_as_in_gazebo(
    limit: str, fortress: Path, tmp_path: Path
) -> None:
    text = rover(limit=f"<limit>{limit}</limit>")
    result = comparison_of(write_example(text, tmp_path), fortress)
    assert result.here.speed == pytest.approx(result.there.speed, rel=0.01)
    assert result.here.full == pytest.approx(result.there.full, rel=0.02)
    assert result.here.stop == pytest.approx(result.there.stop, rel=0.05)
    assert result.here.full < 0.3


def test_a_friction_direction_lets_wheels_slide_sideways_in_a_turn(
    fortress: Path, tmp_path: Path
) -> None:
    friction = "<ode><mu>0.5</mu><mu2>1</mu2><fdir1>0 1 0</fdir1></ode>"
    surface = f"<surface><friction>{friction}</friction></surface>"
    text = rover(0.15).replace("</sphere></geometry>", f"</sphere></geometry>{surface}")
    result = comparison_of(write_example(text, tmp_path), fortress)
    # MuJoCo limits both directions together: docs/oracles.md.
    assert result.here.turn == pytest.approx(result.there.turn, rel=0.2)
    assert result.here.speed == pytest.approx(result.there.speed, rel=0.01)


def test_what_gazebo_refuses_is_said(fortress: Path, tmp_path: Path) -> None:
    model = tmp_path / "model.sdf"
    model.write_text("<sdf version='1.9'><model name='m'/></sdf>")
    with pytest.raises(Refused, match="must have at least one link"):
        driven(fortress, model, 0.0, 0.1, {})


@pytest.mark.parametrize("name", [*LIT, *BARE])
def test_a_collision_mesh_without_normals_ends_gazebo(
    name: str, fortress: Path, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes({**LIT, **BARE}[name])
    model = tmp_path / "model.sdf"
    shape = f"<geometry><mesh><uri>{name}</uri></mesh></geometry>"
    link = f"<link name='l'><collision name='c'>{shape}</collision></link>"
    model.write_text(f"<sdf version='1.9'><model name='m'>{link}</model></sdf>")
    if name in BARE:
        with pytest.raises(Refused, match="does not have a normal count"):
            driven(fortress, model, 0.1, 0.1, {})
    else:
        assert driven(fortress, model, 0.1, 0.1, {}).poses


@pytest.mark.parametrize(
    "content",
    [
        on_struts(5e4, 300),
        on_struts(2e3, 60, -0.05),
        on_struts(2e3, 60, 0.05),
        on_struts(2e3, 60, lift=2e-3),
        on_trailing_arms(500, 5),
        on_trailing_arms(200, 4, 0.2),
        rocker_bogie(),
        rigid(2e-3),
    ],
)
def test_six_wheelers_stand_as_high_as_in_gazebo(
    content: str, fortress: Path, tmp_path: Path
) -> None:
    text = f'<sdf version="1.7"><model name="acme_six">{content}</model></sdf>'
    result = comparison_of(write_example(text, tmp_path), fortress)
    # Springs with much damping give way farther there: docs/oracles.md.
    assert result.here.sink == pytest.approx(result.there.sink, abs=0.0015)


SCREW = """
<link name="nut"><pose>0 0 0.5 0 0 0</pose><inertial><mass>2</mass><inertia><ixx>0.01</ixx>
  <iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>
<link name="base_link"><pose>0 0 0.1 0 0 0</pose><inertial><mass>20</mass></inertial>
  <collision name="c"><geometry><box><size>0.5 0.5 0.2</size></box></geometry></collision></link>
<joint name="spindle" type="screw"><parent>base_link</parent><child>nut</child>
  <thread_pitch>-100</thread_pitch><axis><xyz>0 0 1</xyz></axis></joint>"""


@pytest.mark.parametrize(
    ("commands", "drop"), [({"place": {"spindle": ((0.0, 0.0), (2.0, 0.0))}}, 0.0), ({}, 0.05)]
)
def test_a_screw_stays_where_something_holds_it(
    commands: dict[str, dict[str, Knots]], drop: float, fortress: Path, tmp_path: Path
) -> None:
    """The trial holds screws fixed; in Gazebo one without friction turns under its load."""
    model = tmp_path / "model.sdf"
    model.write_text(f"<sdf version='1.7'><model name='m'>{SCREW}</model></sdf>")
    drive = driven(fortress, model, 0.0, 1.0, commands)
    fell = drive.poses[0][2] - drive.poses[-1][2]
    assert fell >= drop
    assert drop or abs(fell) < 1e-4
