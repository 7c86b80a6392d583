"""Legged robots, arms and things without a drive: they hold the pose they start in."""

from __future__ import annotations

import pytest

from checker.model.robot import Robot
from tests.model.robots import sdf
from tests.trial.machines import box_inertia, chassis, plugin, sound, value


def quadruped(*, com: str = "0 0 0", hips: float = 0.25) -> Robot:
    """Four legs of two joints; the feet stand below the hips."""
    legs, controllers = "", ""
    for name, x, y in (
        ("lf", hips, 0.15),
        ("rf", hips, -0.15),
        ("lh", -hips, 0.15),
        ("rh", -hips, -0.15),
    ):
        parent = "base_link"
        for part, z in (("hip", 0.3), ("knee", 0.15)):
            foot = """<collision name="c"><pose>0 0 -0.13 0 0 0</pose><geometry><sphere>
              <radius>0.02</radius></sphere></geometry></collision>""" * (part == "knee")
            legs += f"""
<link name="{name}_{part}"><pose>{x} {y} {z} 0 0 0</pose><inertial><pose>0 0 -0.07 0 0 0</pose>
  <mass>0.5</mass>{box_inertia(0.5, 0.03, 0.03, 0.15)}</inertial>{foot}</link>
<joint name="{name}_{part}_joint" type="revolute"><parent>{parent}</parent>
  <child>{name}_{part}</child><axis><xyz>0 1 0</xyz><limit><lower>-2</lower><upper>2</upper>
  <effort>20</effort></limit></axis></joint>"""
            controllers += plugin(
                "JointPositionController", f"<joint_name>{name}_{part}_joint</joint_name>"
            )
            parent = f"{name}_{part}"
    return sdf(chassis(com=com, height=0.3) + legs + controllers)


def test_a_quadruped_stands() -> None:
    trial = sound(quadruped())
    assert trial.drive == "legs"
    (sag,) = trial.all("hold_sag")
    assert sag.value < 0.01
    assert sag.part.endswith(("_hip_joint", "_knee_joint"))
    assert abs(value(trial, "hold_sink")) < 0.005
    assert value(trial, "hold_tilt") < 0.01
    assert trial.value("speed_ratio") is None


def test_a_quadruped_whose_weight_is_ahead_of_its_feet_falls() -> None:
    trial = sound(quadruped(com="0.4 0 0"))
    assert max(value(trial, "hold_tilt"), value(trial, "settle_tilt")) > 0.2


ARM = """
<link name="arm"><pose>0 0 0.2 0 0 0</pose><inertial><pose>0.3 0 0 0 0 0</pose><mass>2</mass>
  {inertia}</inertial></link>
<joint name="shoulder" type="revolute"><parent>base_link</parent><child>arm</child>
  <axis><xyz>0 1 0</xyz>
    <limit><lower>-3</lower><upper>3</upper><effort>{effort}</effort></limit></axis>
</joint>"""


@pytest.mark.parametrize(("effort", "holds"), [("5", False), ("6", True)])
def test_an_arm_holds_if_its_motor_bears_its_weight_times_its_lever(
    effort: str, holds: bool
) -> None:
    foot = """<collision name="c"><geometry><box><size>1 1 0.1</size></box></geometry>
      </collision></link>"""
    base = chassis(height=0.05).replace("</link>", foot)
    arm = ARM.format(inertia=box_inertia(2, 0.6, 0.05, 0.05), effort=effort)
    trial = sound(sdf(base + arm))
    assert value(trial, "torque", "shoulder") == pytest.approx(2 * 9.81 * 0.3, rel=0.01)
    assert value(trial, "torque_limit", "shoulder") == float(effort)
    assert (value(trial, "hold_sag", "shoulder") < 0.01) is holds
