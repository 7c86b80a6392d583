"""`subt-check export`: what it writes can be loaded."""

from __future__ import annotations

import shutil
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from checker.cli import main
from checker.cli.export import package_uris
from checker.convert.sdf_to_urdf import xacro_of
from checker.convert.xml_writer import document_text
from checker.engine.subject import Subject
from checker.formats.urdf.description import UrdfDescription
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.mass.pinocchio_model import pin_model
from checker.physics.trial.mjcf.scene import build_scene
from tests.model.robots import sdf

HUSKY = "husky_migration_sensor_config_1"


def robot_of(path: Path) -> tuple[Robot, str]:
    """Return a package's robot and its name."""
    with open_input(path) as opened:
        robots = Subject(opened.packages[0]).all(Robot)
        assert isinstance(robots, tuple)
        return robots[0], opened.packages[0].name


def exported(path: Path, form: str, output: Path) -> Path:
    assert main(["export", str(path), "--format", form, "--output", str(output)]) == 0
    _, name = robot_of(path)
    return output / f"{name}.{'xml' if form == 'mjcf' else form}"


def assert_loads(path: Path, tmp_path: Path) -> None:
    robot, name = robot_of(path)
    folder = tmp_path / name
    folder.mkdir()
    model = mujoco.MjModel.from_xml_path(str(exported(path, "mjcf", folder)))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for link in robot.links:
        # What the trial had to repair, its own tests look at.
        assert mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, link.scoped_name) > 0
    text = exported(path, "urdf", folder).read_text("utf-8").partition("?>")[2]
    urdf = pin.buildModelFromXML(text, pin.JointModelFreeFlyer())
    expected = pin.computeTotalMass(pin_model(robot).model)
    assert pin.computeTotalMass(urdf) == pytest.approx(expected)


@pytest.mark.parametrize(
    "name",
    [
        HUSKY,
        "subtcheck_buggy_sensor_config_1",
        "subtcheck_crawler_sensor_config_1",
        "subtcheck_quadro_sensor_config_1",
        "my_gurdy_description",
    ],
)
def test_samples(samples: Path, name: str, tmp_path: Path) -> None:
    assert_loads(samples / name, tmp_path)


def test_real_packages(corpus: Path, tmp_path: Path) -> None:
    found = sorted(corpus.glob("*_config_*"))
    assert len(found) >= 18
    for path in found:
        assert_loads(path, tmp_path)


def test_meshes_beside_the_mjcf_are_those_of_the_trial(corpus: Path, tmp_path: Path) -> None:
    path = corpus / "emesent_hovermap_sensor_config_1"
    model = mujoco.MjModel.from_xml_path(str(exported(path, "mjcf", tmp_path)))
    robot, _ = robot_of(path)
    inline = mujoco.MjModel.from_xml_string(build_scene(robot).mjcf)
    assert list((tmp_path / "meshes").iterdir())
    touching = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    # The first shape of the scene is the ground.
    sizes, expected = np.sort(model.geom_rbound[touching]), np.sort(inline.geom_rbound[1:])
    np.testing.assert_allclose(sizes, expected, rtol=1e-5)


def test_to_standard_output(samples: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(samples / HUSKY), "--format", "urdf"]) == 0
    out = capsys.readouterr().out
    assert out.startswith('<?xml version="1.0" encoding="utf-8"?>\n<robot name="')
    assert f'filename="package://{HUSKY}/meshes/' in out


@pytest.mark.parametrize(
    ("path", "said"),
    [("nowhere", "does not exist"), ("packages", "choose one"), ("plugin", "has no robot")],
)
def test_what_cannot_be_written(
    path: str, said: str, samples: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for number in (1, 2):
        name = f"husky_migration_sensor_config_{number}"
        shutil.copytree(samples / name, tmp_path / "packages" / name)
    (tmp_path / "plugin").mkdir()
    (tmp_path / "plugin/package.xml").write_text("<package><name>plugin</name></package>")
    assert main(["export", str(tmp_path / path), "--format", "urdf"]) == 2
    assert said in capsys.readouterr().err


def test_a_folder_that_cannot_be_written(
    samples: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    output = tmp_path / "file/robot.urdf"
    arguments = ["export", str(samples / HUSKY), "--format", "urdf", "--output", str(output)]
    assert main(arguments) == 2
    assert "cannot be written" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("uri", "expected"),
    [
        ("meshes/wheel.dae", f"package://{HUSKY}/meshes/wheel.dae"),
        ("meshes/../meshes/none.dae", f"package://{HUSKY}/meshes/none.dae"),
        (f"model://{HUSKY}/meshes/none.dae", f"package://{HUSKY}/meshes/none.dae"),
        ("package://other/meshes/a.dae", "package://other/meshes/a.dae"),
        ("https://example.org/a.dae", "https://example.org/a.dae"),
    ],
)
def test_uris(samples: Path, uri: str, expected: str) -> None:
    with open_input(samples / HUSKY) as opened:
        assert package_uris(opened.packages[0], sdf(""))(uri) == expected


def test_the_xacro_expands_to_links_below_the_robots_name(samples: Path, tmp_path: Path) -> None:
    path = shutil.copytree(samples / HUSKY, tmp_path / HUSKY)
    robot, name = robot_of(path)
    text = document_text(xacro_of(robot, name=name, mesh_uri=lambda uri: f"package://{name}/{uri}"))
    (path / "urdf/robot_from_sdf.xacro").write_text(text, "utf-8")
    assert '<xacro:arg name="name"' in text
    with open_input(path) as opened:
        found = Subject(opened.packages[0]).all(UrdfDescription)
        assert isinstance(found, tuple)
        read = next(each.robot for each in found if each.file.endswith("robot_from_sdf.xacro"))
    prefixes = {link.name.value.partition("/")[0] for link in read.links}
    assert len(prefixes) == 1
    names = {link.name.value.partition("/")[2] for link in read.links}
    assert names == set(robot.links_by_name)
    assert read.mass == pytest.approx(robot.mass)


def test_what_looks_like_xacro_in_a_name_is_left_as_it_is() -> None:
    content = '<link name="${1+1}"/>'
    text = document_text(xacro_of(sdf(content), name="p", mesh_uri=str))
    assert '<link name="${name}/$${1+1}"' in text


TWO = """<robot name="{}" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="mass" default="1"/>
<link name="base_link">
  <inertial>
    <mass value="$(arg mass)"/>
    <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/>
  </inertial>
  <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
</link>
</robot>
"""


LAUNCH = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share two)/urdf/new.urdf.xacro')"/>
  </node>
</launch>
"""
MANIFEST = """<package format="3">
  <name>two</name><export><build_type>ament_cmake</build_type></export>
</package>
"""


def test_what_no_launch_file_loads_is_written_only_by_its_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {f"urdf/{name}.urdf.xacro": TWO.format(name) for name in ("new", "old")}
    files |= {"package.xml": MANIFEST, "launch/show.launch.xml": LAUNCH}
    for name, text in files.items():
        path = tmp_path / "two" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    command = ["export", str(tmp_path / "two"), "--format", "urdf"]
    assert main(command) == 0
    assert '<robot name="new"' in capsys.readouterr().out
    assert main([*command, "--robot", "old"]) == 0
    assert '<robot name="old"' in capsys.readouterr().out


def test_one_of_several_robots_beside_a_world(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = tmp_path / "two_description"
    for name, text in {
        "package.xml": "<package format='3'><name>two_description</name></package>",
        "urdf/one.urdf.xacro": TWO.format("one"),
        "urdf/other.urdf.xacro": TWO.format("other"),
        "worlds/hall.sdf": "<sdf version='1.9'><world name='hall'/></sdf>",
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text, "utf-8")
    command = ["export", str(package), "--format", "urdf"]
    assert main(command) == 2
    assert "one (urdf/one.urdf.xacro) and other (urdf/other.urdf.xacro)" in capsys.readouterr().err
    assert main([*command, "--robot", "third"]) == 2
    assert "'third'" in capsys.readouterr().err
    assert main([*command, "--robot", "other", "--xacro-arg", "mass:=3"]) == 0
    written = capsys.readouterr().out
    assert '<robot name="other"' in written
    assert '<mass value="3"/>' in written
    assert main([*command, "--robot", "urdf/one.urdf.xacro"]) == 0
    assert '<robot name="one"' in capsys.readouterr().out
