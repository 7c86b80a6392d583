"""Joints start within their limits, and robots where their joints and the world hold them."""

from __future__ import annotations

import math

import pytest

from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from tests.model.robots import sdf, urdf
from tests.trial.machines import box_inertia, chassis, sound, value

WEIGHT = 2 * 9.81 * 0.3
"""N·m, of the arm when it is level."""


def arm(low: float, high: float, start: str = "", more: str = "") -> Robot:
    """Return an arm that is level at 0 and rises with negative angles."""
    foot = """<collision name="c"><geometry><box><size>1 1 0.1</size></box></geometry>
      </collision></link>"""
    return sdf(
        chassis(height=0.05).replace("</link>", foot)
        + f"""
<link name="arm"><pose>0 0 0.2 0 0 0</pose><inertial><pose>0.3 0 0 0 0 0</pose><mass>2</mass>
  {box_inertia(2, 0.6, 0.05, 0.05)}</inertial></link>
<joint name="shoulder" type="revolute"><parent>base_link</parent><child>arm</child>
  <axis><xyz>0 1 0</xyz>{start}
    <limit><lower>{low}</lower><upper>{high}</upper></limit></axis>
</joint>{more}"""
    )


@pytest.mark.parametrize(
    ("low", "high", "angle"),
    [(-1.0, 1.0, 0.0), (0.5, 1.5, 0.51), (-1.5, -0.5, -0.51), (-1.0, 0.0, -0.01), (0.0, 1.0, 0.01)],
)
def test_a_motor_bears_what_a_stop_would_otherwise(low: float, high: float, angle: float) -> None:
    trial = sound(arm(low, high))
    assert trial.series["joint:shoulder"][0] == pytest.approx(angle)
    assert value(trial, "torque", "shoulder") == pytest.approx(WEIGHT * math.cos(angle), rel=0.01)
    assert value(trial, "hold_sag", "shoulder") < 0.01


def test_a_joint_starts_where_the_file_says() -> None:
    trial = sound(arm(-1.0, 1.0, "<initial_position>0.8</initial_position>"))
    assert trial.series["joint:shoulder"][0] == pytest.approx(0.8)


CONTROL = """<ros2_control name="c" type="system"><joint name="shoulder">
  <command_interface name="position"/>
  <state_interface name="{}"><param name="initial_value">{}</param></state_interface>
</joint></ros2_control>"""


def controlled(interface: str, start: str, kind: str = "revolute") -> Robot:
    return urdf(f"""
<link name="base"/><link name="arm"><inertial><origin xyz="0.3 0 0"/><mass value="2"/>
  <inertia ixx="0.01" iyy="0.06" izz="0.06" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="shoulder" type="{kind}"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="90" velocity="1"/></joint>
{CONTROL.format(interface, start)}""")


def test_a_joint_starts_where_its_hardware_says() -> None:
    plan = plan_of(controlled("position", "0.8"))
    assert plan.starts == {"shoulder": 0.8}
    assert plan.places["shoulder"][0] == (0.0, 0.8)
    (note,) = plan.notes
    assert "initial positions" in note
    assert "shoulder 0.8" in note


def test_hardware_does_not_move_a_joint_beyond_its_limits() -> None:
    assert plan_of(controlled("position", "3")).starts == {"shoulder": 0.99}


def test_a_joint_without_limits_starts_there_too() -> None:
    robot = controlled("position", "3", "continuous")
    assert plan_of(robot).starts == {"shoulder": 3.0}


@pytest.mark.parametrize(
    ("interface", "start"),
    [("velocity", "0.8"), ("position", "inf"), ("position", "home"), ("position", "")],
)
def test_other_states_of_the_hardware_are_no_place(interface: str, start: str) -> None:
    assert plan_of(controlled(interface, start)).starts == {}


def test_what_is_fixed_to_the_world_stays_there() -> None:
    anchor = '<joint name="a" type="fixed"><parent>world</parent><child>base_link</child></joint>'
    trial = sound(arm(-1.0, 1.0, more=anchor))
    assert set(trial.series["z"]) == {0.0}


def test_a_robot_stands_on_the_feet_of_bent_legs() -> None:
    leg = """
<link name="{name}"><pose>{x} {y} 0.3 0 0 0</pose><inertial><pose>0 0 -0.15 0 0 0</pose>
  <mass>0.2</mass><inertia><ixx>1e-3</ixx><iyy>1e-3</iyy><izz>1e-3</izz></inertia></inertial>
  <collision name="c"><pose>0 0 -0.3 0 0 0</pose>
    <geometry><sphere><radius>0.02</radius></sphere></geometry></collision></link>
<joint name="{name}_hip" type="revolute"><parent>base_link</parent><child>{name}</child>
  <axis><xyz>0 1 0</xyz><limit><lower>{low}</lower><upper>{high}</upper></limit></axis></joint>"""
    legs = "".join(
        leg.format(name=f"leg{x}{y}", x=0.3 * x, y=0.2 * y, low=0.5 * x - 0.3, high=0.5 * x + 0.3)
        for x in (1, -1)
        for y in (1, -1)
    )
    trial = sound(sdf(chassis(height=0.3) + legs))
    assert value(trial, "settle_drop") == pytest.approx(0.01, abs=0.003)
    assert value(trial, "hold_tilt") < 0.02
