"""Joints that controllers move: which ones, how far, and the torque that this needs."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from checker.convert.mjcf_files import scene_of_trial
from checker.model.robot import Robot
from checker.physics.mass.pinocchio_model import pin_model
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.measures.motion import Motion
from checker.physics.trial.plan import Plan
from checker.physics.trial.profile import smoothed
from checker.physics.trial.robot_trial import SettledTrial
from checker.physics.trial.simulation.contacts import ContactQuery
from checker.physics.trial.simulation.paths import with_path
from checker.physics.trial.trial import Trial
from checker.physics.trial.worker import driven
from checker.rule import Finding
from rules.trial.tri009_effort_limit_exceeded import check
from tests.model.controlled import controlled
from tests.model.robots import sdf
from tests.trial.machines import STEP, plugin, trial_in_child, value

GRAVITY = 9.8
MASS, LENGTH, INERTIA = 3.0, 0.8, 0.02
JTC = "joint_trajectory_controller/JointTrajectoryController"


def link(
    name: str,
    joint: str,
    *,
    parent: str = "base_link",
    at: str = "0 0 0",
    axis: str = "0 1 0",
    kind: str = "revolute",
    limit: str = 'lower="-1" upper="1" effort="100" velocity="2"',
    more: str = "",
) -> str:
    """Return a link whose mass is `LENGTH` ahead of its joint."""
    return f"""<link name="{name}"><inertial><origin xyz="{LENGTH} 0 0"/><mass value="{MASS}"/>
<inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="{LENGTH / 2} 0 0"/><geometry><box size="{LENGTH} 0.1 0.1"/></geometry>
</collision></link>
<joint name="{joint}" type="{kind}"><parent link="{parent}"/><child link="{name}"/>
<origin xyz="{at}"/><axis xyz="{axis}"/><limit {limit}/>{more}</joint>"""


def arm(folder: Path, links: str, joints: str, kind: str = JTC) -> Robot:
    return controlled(folder, links, kind, f"    joints: [{joints}]\n")


def moved(robot: Robot) -> Trial:
    trial = trial_in_child(robot)
    assert isinstance(trial, Trial), trial
    assert not trial.not_driven
    assert not trial.trouble
    return trial


def motion_of(robot: Robot) -> Motion:
    scene, plan = scene_of_trial(robot)
    motion, _ = driven(scene, with_path(ContactQuery(scene), plan)[0], STEP)
    return motion


def test_an_arm_that_is_held_level_needs_m_g_l(tmp_path: Path) -> None:
    trial = moved(arm(tmp_path, link("boom", "tilt"), "tilt"))
    assert trial.moved == "1 joint by JointTrajectoryController 'base'"
    assert value(trial, "torque", "tilt") == pytest.approx(MASS * GRAVITY * LENGTH, rel=0.01)
    assert value(trial, "move_error", "tilt") < 1e-4


def test_an_arm_without_shapes_is_moved_where_the_world_holds_it() -> None:
    inertia = "<ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz>"
    content = f"""<link name="base_link"/>
<joint name="mount" type="fixed"><parent>world</parent><child>base_link</child></joint>
<link name="boom"><inertial><pose>{LENGTH} 0 0 0 0 0</pose><mass>{MASS}</mass>
  <inertia>{inertia}</inertia></inertial></link>
<joint name="tilt" type="revolute"><parent>base_link</parent><child>boom</child>
  <axis><xyz>0 1 0</xyz><limit><lower>0.5</lower><upper>1.5</upper></limit></axis></joint>"""
    trial = moved(sdf(content + plugin("JointPositionController", "<joint_name>tilt</joint_name>")))
    held = MASS * GRAVITY * LENGTH * math.cos(0.5)
    assert value(trial, "torque", "tilt") == pytest.approx(held, rel=0.01)


def least_jerk(share: float) -> tuple[float, float]:
    """Return the way and the acceleration of a step of 1 in 1 s."""
    return (
        10 * share**3 - 15 * share**4 + 6 * share**5,
        60 * share - 180 * share**2 + 120 * share**3,
    )


def test_a_pendulum_on_a_smooth_path_needs_its_equation_of_motion(tmp_path: Path) -> None:
    motion = motion_of(arm(tmp_path, link("boom", "tilt", axis="0 -1 0"), "tilt"))
    begins, step = 6.0, 0.3
    forces = np.array(motion.run.forces)[:, 0]
    for share in (0.1, 0.2, 0.4, 0.6, 0.9):
        way, gain = least_jerk(share)
        level = MASS * GRAVITY * LENGTH * math.cos(step * way)
        needed = (INERTIA + MASS * LENGTH**2) * step * gain + level
        after = round((begins + share) / STEP)
        assert forces[after] == pytest.approx(needed, rel=0.01)
        needs = motion.run.needed
        stated = np.interp(begins + share, needs.times, needs.torques[:, 0])
        assert stated == pytest.approx(needed, rel=0.01)


THREE = (
    link("one", "turn", at="0 0 0.5", axis="0 0 1")
    + link("two", "lift", parent="one", at=f"{LENGTH} 0 0")
    + link("three", "roll", parent="two", at=f"{LENGTH} 0 0", axis="0.6 0 0.8")
)


def test_pinocchio_and_mujoco_need_the_same_torques(tmp_path: Path) -> None:
    robot = arm(tmp_path, THREE, "turn, lift, roll")
    motion = motion_of(robot)
    known = pin_model(robot)
    data, names = known.model.createData(), list(motion.plan.moves)
    columns = {degree.part: number for number, degree in enumerate(known.degrees)}
    needs = motion.run.needed
    stated = needs.torques[:, [motion.run.rig.names.index(name) for name in names]]
    lines = [smoothed(motion.plan.places[name], needs.times) for name in names]
    for number in range(0, len(needs.times), 7):
        q, v, a = pin.neutral(known.model), np.zeros(known.model.nv), np.zeros(known.model.nv)
        for name, (places, speeds, gains) in zip(names, lines, strict=True):
            column = columns[name]
            joint = next(j for j in known.model.joints if j.idx_v == column and j.nv == 1)
            q[joint.idx_q], v[column], a[column] = places[number], speeds[number], gains[number]
        known.model.gravity.linear = np.array((0.0, 0.0, -9.81))
        torques = pin.rnea(known.model, data, q, v, a)[[columns[name] for name in names]]
        np.testing.assert_array_less(
            np.abs(torques - stated[number]), 0.01 * np.abs(stated).max(axis=0)
        )


def test_the_servo_gives_what_inverse_dynamics_states(tmp_path: Path) -> None:
    motion = motion_of(arm(tmp_path, THREE, "turn, lift, roll"))
    needs, moved = motion.run.needed, [n in motion.plan.moves for n in motion.run.rig.names]
    largest = np.abs(needs.torques).max(axis=0)[moved]
    given = np.abs(motion.run.forces)[round(needs.times[0] / STEP) :].max(axis=0)[moved]
    assert (largest > 1.0).all()
    np.testing.assert_allclose(given, largest, rtol=0.01)


def corners(plan: Plan, joint: str) -> list[float]:
    return [round(place, 6) for _, place in plan.places[joint]]


def test_each_joint_goes_towards_the_middle_of_its_range_and_back(tmp_path: Path) -> None:
    low = link("one", "near", limit='lower="-0.2" upper="0.8" effort="9" velocity="2"')
    high = link("two", "far", limit='lower="-9" upper="0.1" effort="9" velocity="2"')
    plan = plan_of(arm(tmp_path, low + high, "near, far"))
    assert corners(plan, "near") == [0.0, 0.0, 0.2, 0.0, 0.0]
    assert corners(plan, "far") == [0.0, 0.0, -0.3, 0.0, 0.0]
    times = {name: [time for time, _ in plan.places[name]] for name in ("near", "far")}
    assert times["near"][3] == times["far"][1]


def test_no_joint_is_faster_than_its_limit(tmp_path: Path) -> None:
    slow = link("one", "slow", limit='lower="-1" upper="1" effort="900" velocity="0.05"')
    robot = arm(tmp_path, slow + link("two", "fast", parent="one"), "slow, fast")
    motion = motion_of(robot)
    times = np.arange(6.0, motion.plan.seconds, 0.001)
    _, speeds, _ = smoothed(motion.plan.places["slow"], times)
    assert 0.04 < np.abs(speeds).max() <= 0.05 + 1e-9


def test_joints_that_cannot_move_are_named(tmp_path: Path) -> None:
    stuck = link("one", "stuck", limit='lower="-1" upper="1" effort="9" velocity="0"')
    plan = plan_of(arm(tmp_path, stuck + link("two", "free"), "stuck, free"))
    assert list(plan.moves) == ["free"]
    assert any("so these joints are not moved: stuck" in note for note in plan.notes)


def test_a_finger_follows_the_one_that_it_mimics(tmp_path: Path) -> None:
    other = link("two", "other", more='<mimic joint="finger" multiplier="-0.5"/>')
    plan = plan_of(arm(tmp_path, link("one", "finger") + other, "finger"))
    assert corners(plan, "finger")[2] == 0.3
    assert corners(plan, "other")[2] == -0.15
    assert plan.moved == "1 joint by JointTrajectoryController 'base'"


def test_of_many_joints_several_move_at_once(tmp_path: Path) -> None:
    names = [f"j{number}" for number in range(24)]
    links = "".join(link(f"l{name}", name) for name in names)
    plan = plan_of(arm(tmp_path, links, ", ".join(names)))
    assert len(plan.moves) == 24
    assert plan.seconds == pytest.approx(6.0 + 2 * 10 + 4.5)


def test_a_robot_with_a_drive_only_drives(tmp_path: Path) -> None:
    plan = plan_of(arm(tmp_path, link("boom", "tilt"), "tilt", "diff_drive_controller/Other"))
    assert plan.moves
    wheels = "".join(
        f'<link name="{side}_wheel"><pose>0 {y} 0.1 0 0 0</pose><collision name="c"><geometry>'
        f'<sphere><radius>0.1</radius></sphere></geometry></collision></link><joint name="{side}" '
        f'type="revolute"><parent>base_link</parent><child>{side}_wheel</child><axis>'
        "<xyz>0 1 0</xyz></axis></joint>"
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    mast = (
        '<link name="mast"/><joint name="pan" type="revolute"><parent>base_link</parent>'
        "<child>mast</child><axis><xyz>0 0 1</xyz></axis></joint>"
    )
    base = f'<link name="base_link"/>{mast}' + plugin(
        "JointPositionController", "<joint_name>pan</joint_name>"
    )
    drive = plugin("DiffDrive", "<left_joint>left</left_joint><right_joint>right</right_joint>")
    assert list(plan_of(sdf(base)).moves) == ["pan"]
    driving = plan_of(sdf(base + wheels + drive))
    assert driving.speeds
    assert not driving.moves
    assert not driving.moved


@pytest.mark.parametrize(
    ("content", "joints"), [("<joint_name>pan</joint_name>", ["pan"]), ("", ["pan", "tilt"])]
)
def test_a_trajectory_plugin_without_joints_moves_all(content: str, joints: list[str]) -> None:
    links = "".join(
        f'<link name="{name}_link"/><joint name="{name}" type="revolute"><parent>base_link'
        f"</parent><child>{name}_link</child><axis><xyz>0 0 1</xyz></axis></joint>"
        for name in ("pan", "tilt")
    )
    trajectory = plugin("JointTrajectoryController", content)
    assert list(plan_of(sdf(f'<link name="base_link"/>{links}{trajectory}')).moves) == joints


def said(robot: Robot) -> list[Finding]:
    return list(check.check(SettledTrial(robot, moved(robot)), None))


def test_a_motor_too_weak_for_its_path_is_reported(tmp_path: Path) -> None:
    # It hangs down at its start, and needs torque only once it is moved.
    hanging = link("boom", "tilt").replace(f'xyz="{LENGTH} 0 0"', f'xyz="0 0 -{LENGTH}"')
    needed = MASS * GRAVITY * LENGTH * math.sin(0.6)
    strong = hanging.replace('effort="100"', f'effort="{1.1 * needed:.3f}"')
    assert not said(arm(tmp_path / "strong", strong, "tilt"))
    weak = hanging.replace('effort="100"', 'effort="3"')
    (finding,) = said(arm(tmp_path / "weak", weak, "tilt"))
    assert "needs" in finding.message
    assert "N·m for steps of 0.3 rad from its start and stays" in finding.message
    assert "rad behind, but its effort limit is 3 N·m: write 8." in finding.message


def test_a_weak_joint_stays_within_its_limit(tmp_path: Path) -> None:
    hanging = link("boom", "tilt").replace(f'xyz="{LENGTH} 0 0"', f'xyz="0 0 -{LENGTH}"')
    motion = motion_of(arm(tmp_path, hanging.replace('effort="100"', 'effort="3"'), "tilt"))
    forces = np.abs(np.array(motion.run.forces))
    assert forces.max() <= 3.0 * 1.001
    assert forces[-2250:].max() > 2.9


def test_parts_that_meet_on_the_path_of_all_joints_are_measured(tmp_path: Path) -> None:
    limit = 'lower="-1" upper="0" effort="9" velocity="9"'
    left = link("left", "yaw", at="0 0.2 0.5", axis="0 0 1", limit=limit)
    apart = link("right", "other", at="0 -0.7 0.5", axis="0 0 1")
    near = apart.replace("-0.7", "0.05")
    assert not moved(arm(tmp_path / "apart", left + apart, "yaw")).all("path_overlap")
    (overlap,) = moved(arm(tmp_path / "near", left + near, "yaw")).all("path_overlap")
    assert {overlap.part, overlap.other} == {"left", "right"}


def test_paths_touch_only_corners_that_they_share(tmp_path: Path) -> None:
    scene, plan = scene_of_trial(arm(tmp_path, THREE, "turn, lift, roll"))
    path, _ = with_path(ContactQuery(scene), plan)
    again, _ = with_path(ContactQuery(scene), plan)
    assert path == again
    for line in path.places.values():
        assert all(before < after for (before, _), (after, _) in pairwise(line))
