"""Largest loads of joints, against closed forms."""

from __future__ import annotations

import math
from collections.abc import Mapping

import pytest

from checker.physics.mass.arm_loads import ArmLoads, arm_loads, load_bounds
from checker.physics.mass.robot_mass import weigh
from tests.model.robots import sdf

G = 9.81
UPPER, LOWER = 1.2, 0.25
"""kg·m about the shoulder and about the elbow, of an arm of 2 and 1 kg."""


def loads(
    elbow: str = "", payload: float = 0.0, kind: str = "revolute", axis: str = "0 1 0"
) -> Mapping[str, float]:
    """Return the largest loads of the joints."""
    arms = _arms(elbow, kind, axis)
    assert not arms.unknown
    assert arms.tool == "hand"
    found = list(arms.loads(payload))
    bounds = load_bounds(arms.masses, arms.tool, payload)
    assert all(load.effort <= bounds[load.joint] * (1 + 1e-9) for load in found)
    return {load.joint.name.value: load.effort for load in found}


def _arms(elbow: str, kind: str, axis: str) -> ArmLoads:
    """Return an arm that hangs down at 0; all motors are weak."""
    robot = sdf(
        f"""
<link name="base"><inertial><mass>50</mass></inertial>
  <collision name="c"><geometry><box><size>1 1 0.1</size></box></geometry></collision></link>
<link name="upper"><pose>0 0 2 0 0 0</pose>
  <inertial><pose>0 0 -0.3 0 0 0</pose><mass>2</mass></inertial></link>
<link name="lower"><pose>0 0 1.4 0 0 0</pose>
  <inertial><pose>0 0 -0.25 0 0 0</pose><mass>1</mass></inertial></link>
<link name="hand"><pose>0 0 0.9 0 0 0</pose><inertial><mass>1e-9</mass></inertial></link>
<joint name="shoulder" type="revolute"><parent>base</parent><child>upper</child>
  <axis><xyz>0 1 0</xyz><limit><effort>0.01</effort></limit></axis></joint>
<joint name="elbow" type="{kind}"><parent>upper</parent><child>lower</child>
  <axis><xyz>{axis}</xyz><limit>{elbow}<effort>0.01</effort></limit></axis></joint>
<joint name="wrist" type="fixed"><parent>lower</parent><child>hand</child></joint>"""
    )
    return arm_loads(weigh(robot))


def test_an_arm_is_stretched_out() -> None:
    found = loads()
    assert found["shoulder"] == pytest.approx(G * (UPPER + LOWER), rel=1e-4)
    assert found["elbow"] == pytest.approx(G * LOWER, rel=1e-4)


def test_limits_keep_it_bent() -> None:
    found = loads("<lower>1</lower><upper>2</upper>")
    bent = math.hypot(UPPER + LOWER * math.cos(1), LOWER * math.sin(1))
    assert found["shoulder"] == pytest.approx(G * bent, rel=1e-4)


def test_a_payload_is_added_at_the_tool() -> None:
    found = loads(payload=3.0)
    assert found["shoulder"] == pytest.approx(G * (UPPER + LOWER + 3 * 1.1), rel=1e-4)
    assert found["elbow"] == pytest.approx(G * (LOWER + 3 * 0.5), rel=1e-4)


def test_a_slide_reaches_out() -> None:
    found = loads("<lower>-0.5</lower><upper>0.5</upper>", kind="prismatic", axis="1 0 0")
    # The slide moves the lower arm across; turned up by the shoulder, it holds its weight.
    reach = math.hypot(UPPER + LOWER, 0.5)
    assert found["shoulder"] == pytest.approx(G * reach, rel=1e-4)
    assert found["elbow"] == pytest.approx(G, rel=1e-4)


def test_angles_of_endless_joints_are_the_nearest_to_zero() -> None:
    poses = [load.pose for load in _arms("", "continuous", "0 1 0").loads()]
    assert max(abs(angle) for pose in poses for angle in pose.values()) <= math.pi + 1e-9


_FREE = {"x": "prismatic", "y": "prismatic", "z": "prismatic", "rx": "revolute", "ry": "revolute"}


def _floating(mass: float) -> set[str]:
    """Return which joints of a pillar that turns about its axis, behind six more, hold a load."""
    parts = f'<link name="root"><inertial><mass>{mass}</mass></inertial></link>'
    above = "root"
    for name, kind in {**_FREE, "rz": "revolute", "turn": "revolute"}.items():
        solid = {"rz": 10, "turn": 20}.get(name, mass)
        centre = "0.2 0 0.5" if name == "turn" else "0 0 0"
        axis = {"x": "1 0 0", "y": "0 1 0"}.get(name.removeprefix("r"), "0 0 1")
        parts += f"""<link name="{name}"><inertial><pose>{centre} 0 0 0</pose><mass>{solid}</mass>
</inertial></link><joint name="to_{name}" type="{kind}"><parent>{above}</parent>
<child>{name}</child>
<axis><xyz>{axis}</xyz><limit><lower>-1.57</lower><upper>1.57</upper><effort>0.01</effort></limit>
</axis></joint>"""
        above = name
    arms = arm_loads(weigh(sdf(parts)))
    assert not arms.unknown
    return {load.joint.name.value for load in arms.loads() if load.effort > 1e-6}


def test_a_floating_base_stays_upright() -> None:
    assert _floating(0.001) == set()
    assert "to_turn" in _floating(1.0)
