"""`subt-check robot`: facts of the robots of a package, and what could not be read of them."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import msgspec
import pytest

from checker.base import extras
from checker.base.record import Record
from checker.report import robot_facts
from checker.report.launched import Launched
from checker.report.robot_facts import JointFacts, LinkFacts, PackageFacts, RobotFacts
from checker.report.robot_mermaid import robots_mermaid
from checker.report.robot_text import tree_lines
from tests.command.conftest import BROKEN, Run
from tests.conftest import SAMPLES

PAGE = (SAMPLES.parent / "docs/robot.md").read_text("utf-8")
XACRO = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="mass" default="2"/>
  <link name="base_link">
    <inertial><mass value="$(arg mass)"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><box size="1 2 3"/></geometry></collision>
  </link>
</robot>
"""
WITH_MESH = """<robot name="cart">
  <link name="base_link">
    <visual><geometry><mesh filename="package://cart/cart.stl"/></geometry></visual>
  </link>
</robot>
"""


def facts(run: Run, *words: object) -> list[dict[str, Any]]:
    done = run("robot", *words, "--format", "json")
    assert (done.returncode, done.stderr) == (0, "")
    packages: list[dict[str, Any]] = json.loads(done.stdout)["packages"]
    return packages


def not_read(holder: dict[str, Any]) -> dict[str, str]:
    return {item["fact"]: item["reason"] for item in holder["not_read"]}


def test_the_facts_of_a_ros_2_robot(run: Run) -> None:
    package, _world = facts(run, SAMPLES / "acme_scout")
    (robot,) = package["robots"]
    assert (package["target"], robot["name"], robot["file"]) == (
        *("ros2", "scout", "urdf/scout.urdf.xacro"),
    )
    assert robot["overview"]["mass_kg"] == 7.4
    assert robot["overview"]["size_m"] == [0.4, 0.42, 0.2]
    assert robot["overview"]["drive"] == "differential drive"
    joints = {joint["name"]: joint for joint in robot["joints"]}
    assert joints["left_wheel_joint"] == {
        "name": "left_wheel_joint",
        "type": "continuous",
        "parent": "base_link",
        "child": "left_wheel_link",
        "connected": True,
        "axes": [
            {
                "xyz": [0.0, 1.0, 0.0],
                "unit": "rad",
                "lower": None,
                "upper": None,
                "velocity": 20.0,
                "effort": 5.0,
            }
        ],
        "mimics": [],
        "moved_by": "",
        "commands": ["velocity"],
    }
    assert joints["lidar_joint"]["axes"] == []
    (lidar,) = (each for each in robot["sensors"] if each["name"] == "lidar")
    assert (lidar["on"], lidar["rate_hz"], lidar["frame"]) == ("lidar_link", 10.0, "lidar_link")
    assert lidar["topics"] == ["/scan", "/scan/points"]
    (drive,) = robot["drives"]
    assert drive["moves"] == ["left_wheel_joint", "right_wheel_joint"]
    assert (drive["wheel_separation_m"], drive["wheel_radius_m"]) == (0.38, 0.08)
    assert "joint_state_broadcaster" in {each["name"] for each in robot["controllers"]}
    assert "/scan" in {topic["name"] for topic in package["launched"][0]["topics"]}
    positions = {link["name"]: link["position_m"] for link in robot["links"]}
    assert positions["left_wheel_link"] == [0.0, 0.19, 0.08]
    assert robot["not_read"] == package["not_read"] == []


def test_what_could_not_be_read_is_said(run: Run) -> None:
    (package,) = facts(run, SAMPLES / BROKEN)
    (robot,) = package["robots"]
    said = not_read(robot)
    assert said["size"] == "meshes/bracket.dae does not exist"
    assert "size_m" not in robot["overview"]
    assert said["ends of joint rear_right_joint"] == "no link is called 'rear_right_wheels'"
    assert "bumper_sonar" in said["topics"]
    shown = run("robot", SAMPLES / BROKEN).stdout
    for fact, reason in said.items():
        assert f"not read: {fact}: {reason}" in shown
    assert "→ rear_right_wheels, which does not exist" in shown


def test_a_package_without_a_robot(run: Run, tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>empty</name></package>")
    (package,) = facts(run, tmp_path)
    assert package["robots"] == []
    assert "no URDF, xacro, SDF or MJCF file of it is a robot" in not_read(package)["robots"]


def test_an_argument_of_xacro_counts(run: Run, tmp_path: Path) -> None:
    (tmp_path / "cart.urdf.xacro").write_text(XACRO)
    for words, mass in (((), 2.0), (("--xacro-arg", "mass:=5"), 5.0)):
        (package,) = facts(run, tmp_path / "cart.urdf.xacro", *words)
        (robot,) = package["robots"]
        assert robot["overview"]["mass_kg"] == mass
        assert robot["overview"]["size_m"] == [1.0, 2.0, 3.0]


def test_without_physics_the_size_of_meshes_is_not_read(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mesh.urdf").write_text(WITH_MESH)
    monkeypatch.setattr(extras, "_is_found", lambda _: False)
    (package,) = facts(run, tmp_path / "mesh.urdf")
    assert "physics is not installed" in not_read(package["robots"][0])["size"]


def test_one_of_several_robots(run: Run, tmp_path: Path) -> None:
    for name in ("cart", "truck"):
        (tmp_path / f"{name}.urdf.xacro").write_text(XACRO.replace("cart", name))
    (tmp_path / "package.xml").write_text(
        "<package><name>two</name><depend>urdf</depend></package>"
    )
    (package,) = facts(run, tmp_path)
    assert [robot["name"] for robot in package["robots"]] == ["cart", "truck"]
    for wanted in ("truck", "truck.urdf.xacro"):
        (package,) = facts(run, tmp_path, "--robot", wanted)
        assert [robot["name"] for robot in package["robots"]] == ["truck"]
    done = run("robot", tmp_path, "--robot", "train")
    assert (done.returncode, done.stdout) == (2, "")
    assert "'train'; there is cart (cart.urdf.xacro) and truck (truck.urdf.xacro)" in done.stderr


def _robot(*joints: tuple[str, str], links: str) -> RobotFacts:
    made = (
        JointFacts(f"{parent}_{child}", "fixed", parent, child, True) for parent, child in joints
    )
    named = tuple(LinkFacts(name, 1.0, None) for name in links.split())
    return RobotFacts("r", "r.sdf", "sdf", {}, named, tuple(made), (), (), (), (), ())


def test_the_tree_shows_each_joint_once() -> None:
    robot = _robot(("world", "a"), ("a", "b"), ("a", "c"), ("b", "c"), links="a b c")
    assert list(tree_lines(robot)) == [
        "world",
        "└─ world_a (fixed) → a 1 kg",
        "   ├─ a_b (fixed) → b 1 kg",
        "   │  └─ b_c (fixed) → c 1 kg",
        "   └─ a_c (fixed) → c 1 kg, shown above",
    ]
    loop = _robot(("a", "b"), ("b", "a"), links="a b")
    assert list(tree_lines(loop)) == [
        "a 1 kg",
        "└─ a_b (fixed) → b 1 kg",
        "   └─ b_a (fixed) → a 1 kg, shown above",
    ]


def test_a_long_chain_needs_no_recursion() -> None:
    names = [f"l{number}" for number in range(3000)]
    robot = _robot(*pairwise(names), links=" ".join(names))
    assert sum(1 for _ in tree_lines(robot)) == len(names)


def test_mermaid(run: Run) -> None:
    done = run("robot", SAMPLES / "acme_scout", "--format", "mermaid")
    lines = done.stdout.splitlines()
    assert lines[:2] == ["graph TD", '  subgraph r0["scout"]']
    assert '    r0_0 -->|"base_joint<br/>fixed"| r0_1' in lines
    ids = set(re.findall(r"^    (\w+)[\[(]", done.stdout, re.MULTILINE))
    assert set(re.findall(r"^    (\w+) -->", done.stdout, re.MULTILINE)) <= ids


def test_no_name_ends_a_label_of_mermaid() -> None:
    robot = _robot(('a"]\n%%;', "b"), links="b")
    text = robots_mermaid([PackageFacts("p", "p", "sdf", (robot,))])
    labels = re.sub(r'"[^"\n]*"', "", text)
    assert '"' not in labels
    assert "%%" not in labels
    assert "world" not in text


def test_to_a_file(run: Run, tmp_path: Path) -> None:
    assert run("robot", SAMPLES / "acme_scout", "--output", "facts.txt").stdout == ""
    assert (tmp_path / "facts.txt").read_text("utf-8").startswith("acme_scout  (")


def _members() -> Iterator[str]:
    kinds = [kind for kind in vars(robot_facts).values() if isinstance(kind, type)]
    for kind in (*kinds, Launched):
        if issubclass(kind, Record):
            yield from (field.name for field in msgspec.structs.fields(kind))


def test_the_page_has_each_member_of_the_json() -> None:
    assert [name for name in _members() if f"`{name}`" not in PAGE] == []


def test_the_parts_of_a_model_of_mujoco_are_shown(run: Run, tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(
        "<mujoco model='lift'><worldbody><body name='arm'><joint name='tilt' range='-90 90'/>"
        "<geom size='0.1'/></body></worldbody><actuator>"
        "<motor name='m' joint='tilt' forcerange='-2 2'/></actuator></mujoco>"
    )
    shown = run("robot", "arm.xml", "--format", "json").stdout
    (robot,) = json.loads(shown)["packages"][0]["robots"]
    (joint,) = robot["joints"]
    assert (robot["name"], robot["format"], joint["moved_by"]) == ("lift", "mjcf", "m")
    assert joint["axes"][0]["upper"] == pytest.approx(1.5708, abs=1e-5)
    assert joint["axes"][0]["effort"] == 2
