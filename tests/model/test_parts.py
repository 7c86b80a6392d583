"""Shapes, materials, plugins and drives, as both formats write them."""

from __future__ import annotations

import pytest

from checker.model.locomotion.drive import drive_name
from checker.model.robot import Robot
from tests.model.robots import messages, sdf, urdf


def sizes(robot: Robot) -> dict[str, list[float]]:
    geometry = robot.links[0].collisions[0].geometry
    return {name: [n.value for n in numbers] for name, numbers in geometry.sizes.items()}


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        ("<box><size>1 2 3</size></box>", {"size": [1, 2, 3]}),
        ("<box/>", {"size": [1, 1, 1]}),
        ("<sphere><radius>2</radius></sphere>", {"radius": [2]}),
        ("<cylinder><length>3</length></cylinder>", {"radius": [1], "length": [3]}),
        ("<capsule/>", {"radius": [0.5], "length": [1]}),
        ("<ellipsoid/>", {"radii": [1, 1, 1]}),
        ("<plane/>", {"normal": [0, 0, 1], "size": [1, 1]}),
        ("<mesh><uri>a.dae</uri></mesh>", {"scale": [1, 1, 1]}),
        ("<triangle/>", {}),
    ],
)
def test_shapes_of_sdf(shape: str, expected: dict[str, list[float]]) -> None:
    content = f'<collision name="c"><geometry>{shape}</geometry></collision>'
    assert sizes(sdf(f'<link name="a">{content}</link>')) == expected


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        ('<box size="1 2 3"/>', {"size": [1, 2, 3]}),
        ('<sphere radius="2"/>', {"radius": [2]}),
        ('<cylinder radius="2" length="3"/>', {"radius": [2], "length": [3]}),
        ('<mesh filename="a.dae" scale="2 2 2"/>', {"scale": [2, 2, 2]}),
    ],
)
def test_shapes_of_urdf(shape: str, expected: dict[str, list[float]]) -> None:
    content = f"<collision><geometry>{shape}</geometry></collision>"
    assert sizes(urdf(f'<link name="a">{content}</link>')) == expected


def test_files_that_a_robot_names() -> None:
    robot = sdf(
        """<link name="a"><visual name="v"><geometry><mesh><uri>meshes/a.dae</uri></mesh></geometry>
        <material><diffuse>1 0 0 1</diffuse><script><uri>file://media/x</uri></script>
        <pbr><metal><albedo_map>a.png</albedo_map></metal></pbr></material></visual></link>"""
    )
    assert [uri.value for uri in robot.file_uris] == ["meshes/a.dae", "a.png"]
    material = robot.links[0].visuals[0].material
    assert material is not None
    assert [uri.value for uri in material.scripts] == ["file://media/x"]
    assert [number.value for number in material.colours["diffuse"]] == [1, 0, 0, 1]


def test_moments_and_their_defaults() -> None:
    inertia = "<inertia><ixx>2</ixx><ixy>0.1</ixy><izz>4</izz></inertia>"
    robot = sdf(f'<link name="a"><inertial>{inertia}</inertial></link><link name="b"/>')
    inertial = robot.links[0].inertial
    assert inertial is not None
    assert [moment.value for moment in inertial.moments] == [2, 0.1, 0, 1, 0, 4]
    assert [moment.stated for moment in inertial.moments] == [True, True, False, False, False, True]
    assert robot.mass == 2


WHEELS = """<link name="left"/><link name="wheel_2"/><link name="wheel_mount"/><link name="body"/>
    <joint name="j"><parent>body</parent><child>left</child></joint>"""
DRIVE = '<plugin name="{}::DiffDrive" filename="f"><left_joint>j</left_joint></plugin>'


def test_wheels_are_what_a_drive_turns_or_what_is_called_so() -> None:
    assert messages(sdf(WHEELS)) == []
    assert [link.name.value for link in sdf(WHEELS).wheels] == ["wheel_2"]
    driven = sdf(WHEELS + DRIVE.format("ignition::gazebo::systems"))
    assert [link.name.value for link in driven.wheels] == ["left", "wheel_2"]
    assert drive_name(driven.plugins) == "differential or skid-steer drive"
    assert drive_name(()) == "no drive detected"


def test_wheels_of_a_nested_model() -> None:
    plugin = DRIVE.format("gz::sim::systems").replace(">j<", ">m::j<")
    robot = sdf(f'<model name="m">{WHEELS}</model>{plugin}', "1.8")
    assert [link.scoped_name for link in robot.wheels] == ["m::left", "m::wheel_2"]


@pytest.mark.parametrize("version", ["1.6", "1.7"])
def test_what_a_joint_may_tie(version: str) -> None:
    robot = sdf(
        """<link name="a"/><frame name="f"/><joint name="j"><child>a</child></joint>
        <model name="m"><link name="b"/></model>""",
        version,
    )
    models = {"m", "m::__model__", "__model__"}
    assert robot.attachable_names == {"a", "f", "j", "m::b"} | models
