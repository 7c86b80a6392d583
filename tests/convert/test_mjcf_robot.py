"""The exported robot in MuJoCo: it stands, its servos move it, and the checker finds no fault."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from lxml import etree

from checker.cli import main
from support.real_packages import MODERN, named_folder, needs

SAMPLES = [
    "acme_scout",
    "husky_description",
    "husky_migration_sensor_config_1",
    "my_gurdy_description",
    "ouster_description",
    "subtcheck_buggy_sensor_config_1",
    "subtcheck_crawler_sensor_config_1",
    "subtcheck_quadro_sensor_config_1",
]
DEMOS = "gz_ros2_control/gz_ros2_control_demos"
MODERN_ROBOTS = {
    "andino/andino_description": "",
    "Universal_Robots_ROS2_Description": "",
    "mycobot_ros2/mycobot_description": "",
    "moveit_resources/panda_description": "urdf/panda.urdf",
    "create3_sim/irobot_create_common/irobot_create_description": "urdf/create3.urdf.xacro",
    DEMOS: "urdf/test_gripper_mimic_joint_effort.xacro.urdf",
}
"""Packages, and the file of one of their robots where there are several."""
STEP = {mujoco.mjtJoint.mjJNT_HINGE: 0.05, mujoco.mjtJoint.mjJNT_SLIDE: 0.003}
"""rad and m by which a servo is commanded to move."""


class Made:
    """An exported robot on the ground of its scene."""

    def __init__(self, package: Path, folder: Path, robot: str = "") -> None:
        self.folder = folder / "made"
        command = ["export", str(package), "--format", "mjcf", "--output", f"{self.folder}/"]
        assert main([*command, *(("--robot", robot) if robot else ())]) == 0
        self.model: Any = mujoco.MjModel.from_xml_path(str(self.folder / "scene.xml"))
        self.data: Any = mujoco.MjData(self.model)
        self.reset()

    def reset(self) -> None:
        mujoco.mj_resetDataKeyframe(self.model, self.data, self.model.key("home").id)
        mujoco.mj_forward(self.model, self.data)

    def step(self, seconds: float) -> None:
        for _ in range(round(seconds / self.model.opt.timestep)):
            mujoco.mj_step(self.model, self.data)
            assert np.abs(self.data.qvel).max(initial=0.0) < 20.0
        assert not any(warning.number for warning in self.data.warning)

    @property
    def height(self) -> float:
        """Height of the base, metres."""
        return float(self.data.xpos[1, 2])

    def place(self, joint: int) -> float:
        return float(self.data.qpos[self.model.jnt_qposadr[joint]])


def assert_holds(made: Made) -> None:
    """It stays where it is, and joints that copy others follow."""
    height = made.height
    made.step(2.0)
    assert made.height > height - 0.01
    assert_coupled(made)


def assert_coupled(made: Made) -> None:
    model = made.model
    for number in range(model.neq):
        follower, leader = int(model.eq_obj1id[number]), int(model.eq_obj2id[number])
        offset, ratio = model.eq_data[number, :2]
        expected = offset + ratio * made.place(leader)
        assert made.place(follower) == pytest.approx(expected, abs=5e-3)
        assert follower not in model.actuator_trnid[:, 0]


def assert_servos_reach(made: Made) -> None:
    """Each position servo moves its joint by a small step, and stays there.

    What stands on its own is lifted off the ground, without gravity.
    """
    model, data = made.model, made.data
    free = model.nq > 0 and model.jnt_type[0] == mujoco.mjtJoint.mjJNT_FREE
    model.opt.gravity[2] *= not free
    servos = [n for n in range(model.nu) if model.actuator_biasprm[n, 1] < 0.0]
    for number in servos:
        made.reset()
        if free:
            data.qpos[2] += 1.0
        joint = int(model.actuator_trnid[number, 0])
        most = STEP[mujoco.mjtJoint(model.jnt_type[joint])]
        low, high = model.actuator_ctrlrange[number]
        way = most if data.ctrl[number] + most <= high else -most
        made.step(0.5)
        start = made.place(joint)
        data.ctrl[number] = np.clip(data.ctrl[number] + way, low, high)
        made.step(1.0)
        near = made.place(joint)
        places = []
        for _ in range(25):
            made.step(0.02)
            places.append(made.place(joint))
        name = model.joint(joint).name
        assert near - start == pytest.approx(way, abs=0.4 * most), name
        assert max(places) - min(places) < 0.05 * most, name
        limit = model.actuator_forcerange[number, 1]
        assert not limit or abs(data.actuator_force[number]) <= limit


def assert_drives(made: Made) -> None:
    """What has wheels moves on if they turn."""
    model, data = made.model, made.data
    names = [model.actuator(number).name for number in range(model.nu)]
    wheels = [number for number, name in enumerate(names) if "wheel" in name]
    speeds = [number for number in wheels if model.actuator_biasprm[number, 1] == 0.0]
    made.reset()
    data.ctrl[speeds] = np.minimum(0.5 * model.actuator_ctrlrange[speeds, 1], 5.0)
    start = data.xpos[1].copy()
    made.step(2.0)
    assert not speeds or np.linalg.norm(data.xpos[1] - start) > 0.1


def assert_no_finding(made: Made, capsys: pytest.CaptureFixture[str]) -> None:
    capsys.readouterr()
    # MJC015 is about inertias, which are those of the description.
    options = ["--ignore", "MJC015", "--fail-on", "warning", "--no-cache"]
    code = main([str(made.folder), *options])
    assert code == 0, capsys.readouterr().out


def assert_good(made: Made, capsys: pytest.CaptureFixture[str]) -> None:
    assert_holds(made)
    assert_drives(made)
    assert_servos_reach(made)
    assert_no_finding(made, capsys)


@pytest.mark.slow
@pytest.mark.parametrize("name", SAMPLES)
def test_samples(
    samples: Path, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert_good(Made(samples / name, tmp_path), capsys)


def test_corpus(corpus: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in sorted(corpus.glob("*_config_*")):
        assert_good(Made(path, tmp_path / path.name), capsys)


@pytest.mark.parametrize("name", MODERN_ROBOTS)
@pytest.mark.parametrize("variable", [pytest.param(MODERN, marks=needs(MODERN))])
def test_modern(
    variable: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = named_folder(variable)
    assert folder is not None
    made = Made(folder / name, tmp_path, MODERN_ROBOTS[name])
    assert_good(made, capsys)
    driven = made.model.actuator_trnid[:, 0]
    # Suspensions are left to their springs.
    assert not made.model.jnt_stiffness[driven].any()


JOINT = """<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{0}_link"/>
<origin xyz="{3}"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="{4}" velocity="2"/>
<dynamics damping="0.1" friction="0.05"/>{5}</joint>"""
LINK = """<link name="{}"><inertial><mass value="1"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
<collision><geometry><box size="0.1 0.1 0.3"/></geometry></collision></link>"""


def arm(interface: str = "") -> str:
    """Return a URDF: a base, a joint `one` on it, and `two`, which copies it."""
    copies = '<mimic joint="one" multiplier="-0.5" offset="0.1"/>'
    control = f"""<ros2_control name="c" type="system"><joint name="one">
<command_interface name="{interface}"/></joint></ros2_control>"""
    links = "".join(map(LINK.format, ("base", "one_link", "two_link")))
    one = JOINT.format("one", "revolute", "base", "0 0 0.2", 50, "")
    two = JOINT.format("two", "revolute", "one_link", "0.2 0 0.2", 50, copies)
    return f'<robot name="arm">{links}{one}{two}{control if interface else ""}</robot>'


@pytest.mark.parametrize("interface", ["", "position", "velocity", "effort"])
def test_actuators(interface: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "arm.urdf").write_text(arm(interface))
    made = Made(tmp_path / "arm.urdf", tmp_path)
    tree = etree.parse(tmp_path / "made/arm.xml")
    (actuator,) = tree.find("actuator")
    tag = {"": "position", "effort": "motor"}.get(interface, interface)
    assert (actuator.tag, actuator.get("name"), actuator.get("joint")) == (tag, "one", "one")
    limit = {"position": (-1.0, 1.0), "velocity": (-2.0, 2.0), "motor": (-50.0, 50.0)}[tag]
    assert tuple(made.model.actuator_ctrlrange[0]) == limit
    if tag != "motor":
        assert tuple(made.model.actuator_forcerange[0]) == (-50.0, 50.0)
    joint = made.model.joint("one")
    assert (joint.damping, joint.frictionloss) == (0.1, 0.05)
    (coupled,) = tree.find("equality")
    assert (coupled.get("joint1"), coupled.get("joint2")) == ("two", "one")
    assert coupled.get("polycoef") == "0.1 -0.5 0 0 0"
    excluded = [(it.get("body1"), it.get("body2")) for it in tree.iter("exclude")]
    assert ("base", "one_link") in excluded
    assert tree.find(".//freejoint") is None
    assert_holds(made)
    assert_servos_reach(made)
    assert_no_finding(made, capsys)


def test_a_robot_on_legs_is_free(tmp_path: Path) -> None:
    names = [f"{leg}_{part}" for leg in ("fl", "fr", "rl", "rr") for part in ("hip", "knee")]
    text = LINK.format("trunk") + "".join(LINK.format(f"{name}_link") for name in names)
    for name in names:
        leg, part = name.split("_")
        x, y = (0.3 if leg[0] == "f" else -0.3), (0.2 if leg[1] == "l" else -0.2)
        above, at = ("trunk", f"{x} {y} -0.3") if part == "hip" else (f"{leg}_hip_link", "0 0 -0.4")
        text += JOINT.format(name, "revolute", above, at, 50, "")
    (tmp_path / "dog.urdf").write_text(f'<robot name="dog">{text}</robot>')
    made = Made(tmp_path / "dog.urdf", tmp_path)
    assert made.model.joint("trunk").type == mujoco.mjtJoint.mjJNT_FREE
    assert_holds(made)
    assert made.height > 0.7
    assert_servos_reach(made)


def test_it_can_be_part_of_a_scene(samples: Path, tmp_path: Path) -> None:
    made = Made(samples / "husky_description", tmp_path)
    (tmp_path / "made/own.xml").write_text(
        '<mujoco><include file="husky_description.xml"/><worldbody>'
        '<body pos="3 0 0.5"><freejoint/><geom name="ball" size="0.1"/></body>'
        "</worldbody></mujoco>"
    )
    spec = mujoco.MjSpec.from_file(str(tmp_path / "made/husky_description.xml"))
    assert spec.compile().nbody == made.model.nbody
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "made/own.xml"))
    assert model.body_mass[-1] == pytest.approx(1000 * 4 / 3 * np.pi * 0.1**3)
    robot_mass = made.model.body_subtreemass[0]
    assert model.body_subtreemass[0] == pytest.approx(robot_mass + model.body_mass[-1])
