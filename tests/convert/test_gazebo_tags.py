"""`<gazebo>` tags, materials and names in the SDF made of a URDF."""

from __future__ import annotations

import pytest
from lxml import etree

from checker.convert.conversion import Conversion
from checker.model.geometry.transform import Transform
from tests.convert.trees import converted

SOLID = """<inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"""
BOX = '<geometry><box size="1 1 1"/></geometry>'


def link(name: str, content: str = "", solid: str = SOLID) -> str:
    return f'<link name="{name}">{solid}{content}</link>'


def joint(child: str, kind: str = "fixed", parent: str = "base", more: str = "") -> str:
    return f"""<joint name="{child}_joint" type="{kind}"><parent link="{parent}"/>
    <child link="{child}"/><origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/>
    <axis xyz="0 0 1"/>{more}</joint>"""


def robot(*parts: str) -> Conversion:
    return converted(f'<robot name="r">{"".join(parts)}</robot>')


def text(conversion: Conversion, path: str) -> str:
    found = conversion.tree.xpath(f"string(model/{path})")
    assert isinstance(found, str)
    return found.strip()


def tag(reference: str, content: str) -> str:
    return f'<gazebo reference="{reference}">{content}</gazebo>'


@pytest.mark.parametrize(
    ("said", "path", "value"),
    [
        ("<mu1>0.7</mu1>", "link/collision/surface/friction/ode/mu", "0.7"),
        ('<mu1 value="0.8"/>', "link/collision/surface/friction/ode/mu", "0.8"),
        ("<mu2>0.6</mu2>", "link/collision/surface/friction/ode/mu2", "0.6"),
        ("<fdir1>1 0 0</fdir1>", "link/collision/surface/friction/ode/fdir1", "1 0 0"),
        ("<kp>1e6</kp>", "link/collision/surface/contact/ode/kp", "1e6"),
        ("<minDepth>0.01</minDepth>", "link/collision/surface/contact/ode/min_depth", "0.01"),
        ("<maxVel>0.1</maxVel>", "link/collision/surface/contact/ode/max_vel", "0.1"),
        ("<turnGravityOff>true</turnGravityOff>", "link/gravity", "false"),
        ("<turnGravityOff>false</turnGravityOff>", "link/gravity", "true"),
        ("<selfCollide>true</selfCollide>", "link/self_collide", "true"),
        ("<dampingFactor>0.2</dampingFactor>", "link/velocity_decay/angular", "0.2"),
        ("<material>Gazebo/Red</material>", "link/visual/material/diffuse", "1 0 0 1"),
        ("<visual><cast_shadows>0</cast_shadows></visual>", "link/visual/cast_shadows", "0"),
        ("<light name='l' type='spot'/>", "link/light/@name", "l"),
    ],
)
def test_what_a_tag_says_of_a_link(said: str, path: str, value: str) -> None:
    shapes = f"<visual>{BOX}</visual><collision>{BOX}</collision>"
    assert text(robot(link("base", shapes), tag("base", said)), path) == value


@pytest.mark.parametrize(
    ("said", "path", "value"),
    [
        ("<springStiffness>5</springStiffness>", "joint/axis/dynamics/spring_stiffness", "5"),
        ("<provideFeedback>1</provideFeedback>", "joint/physics/provide_feedback", "1"),
        ("<stopErp>0.2</stopErp>", "joint/physics/ode/limit/erp", "0.2"),
    ],
)
def test_what_a_tag_says_of_a_joint(said: str, path: str, value: str) -> None:
    made = robot(link("base"), link("arm"), joint("arm", "continuous"), tag("arm_joint", said))
    assert text(made, path) == value


def test_a_tag_about_a_lumped_link_reaches_its_own_shapes_alone() -> None:
    arm = link("arm", f"<collision>{BOX}</collision>")
    parts = (link("base", f"<collision>{BOX}</collision>"), arm, joint("arm"))
    made = robot(*parts, tag("arm", "<mu1>9</mu1><gravity>0</gravity>"))
    assert text(made, "link/collision[1]/surface") == ""
    assert text(made, "link/collision[2]/@name") == "base_fixed_joint_lump__arm_collision_1"
    assert text(made, "link/collision[2]//mu") == "9"
    assert text(made, "link/collision[2]/pose") == "1 0 0 0 0 1.5707963267948966"
    assert text(made, "link/gravity") == ""
    assert any("lumped" in note for note in made.notes)


def test_a_sensor_of_a_lumped_link_keeps_its_place() -> None:
    sensor = """<sensor name="eye" type="camera"><pose>0 2 0 0 0 0</pose>
    <plugin name="p" filename="libeye.so"><frameName>arm</frameName></plugin></sensor>"""
    made = robot(link("base"), link("arm"), joint("arm"), tag("arm", sensor))
    assert text(made, "link/sensor/pose") == "-1 0 0 0 0 1.5707963267948966"
    (plugin,) = made.plugins
    assert (plugin.plugin.filename.value, plugin.link, plugin.sensor, plugin.reference) == (
        "libeye.so", "base", "eye", "arm",
    )  # fmt: skip
    assert plugin.node.get("filename") == "libeye.so"
    plugin.remove()
    assert not list(made.tree.iter("plugin"))
    assert made.lumped["arm"].link == "base"
    assert made.lumped["arm"].pose.translation == (1, 0, 0)


def test_two_sensors_of_one_name_in_one_link() -> None:
    sensor = '<sensor name="imu" type="imu"/>'
    parts = (link("base"), link("arm"), joint("arm"))
    made = robot(*parts, tag("base", sensor), tag("arm", sensor))
    assert made.tree.xpath("model/link/sensor/@name") == ["imu", "imu_1"]
    assert any("imu_1" in note for note in made.notes)


def test_plugins_and_nested_models_of_the_whole_robot() -> None:
    content = """<plugin name="p" filename="libgazebo_ros_control.so"/><static>false</static>
    <model name="lamp"><link name="l"/></model>
    <joint name="j" type="fixed"><parent>arm</parent><child>lamp::l</child></joint><foo/>"""
    made = robot(link("base"), link("arm"), joint("arm"), f"<gazebo>{content}</gazebo>")
    assert [(each.link, each.sensor) for each in made.plugins] == [("", "")]
    assert text(made, "joint[@name='j']/parent") == "base"
    assert text(made, "model/@name") == "lamp"
    assert text(made, "static") == "false"
    assert any(note.endswith("<foo> of a <gazebo> tag is not carried over") for note in made.notes)


def test_the_namespace_goes_from_names_and_from_what_names_them() -> None:
    plugin = '<plugin name="p" filename="f"><body>X1/arm</body><topic>X1/odom</topic></plugin>'
    parts = (link("X1/base"), link("X1/arm"), joint("X1/arm", "continuous", "X1/base"))
    made = robot(*parts, f"<gazebo>{plugin}</gazebo>")
    assert made.tree.xpath("//link/@name") == ["base", "arm"]
    assert text(made, "joint/@name") == "arm_joint"
    assert text(made, "plugin/body") == "arm"
    assert text(made, "plugin/topic") == "X1/odom"


def test_names_that_only_a_prefix_tells_apart_keep_it() -> None:
    made = robot(link("X1/base"), link("base"), joint("base", "continuous", "X1/base"))
    assert made.tree.xpath("//link/@name") == ["X1/base", "base"]


def test_a_named_namespace() -> None:
    parts = link("X1/base") + link("b") + joint("b", "continuous", "X1/base")
    made = converted(f'<robot name="r">{parts}</robot>', namespace="X1")
    assert made.tree.xpath("//link/@name") == ["base", "b"]


@pytest.mark.parametrize(
    ("material", "defined", "diffuse"),
    [
        ('<material name="a"><color rgba="1 0 0.5 1"/></material>', "", "1 0 0.5 1"),
        (
            '<material name="a"/>',
            '<material name="a"><color rgba="0 0 1 1"/></material>',
            "0 0 1 1",
        ),
        ('<material name="a"><color rgba="255 0 51 1"/></material>', "", "1 0 0.2 1"),
        ('<material name="a"/>', "", ""),
    ],
)
def test_materials_of_urdf(material: str, defined: str, diffuse: str) -> None:
    made = robot(defined, link("base", f"<visual>{BOX}{material}</visual>"))
    assert text(made, "link/visual/material/diffuse") == diffuse
    assert text(made, "link/visual/material/ambient") == diffuse
    assert bool(diffuse) != any("defined nowhere" in note for note in made.notes)


def test_transparency_and_textures() -> None:
    material = """<material name="a"><color rgba="1 1 1 0.25"/>
    <texture filename="package://a/materials/textures/b.png"/></material>"""
    made = robot(link("base", f"<visual>{BOX}{material}</visual>"))
    assert text(made, "link/visual/transparency") == "0.75"
    assert text(made, "link/visual/material/pbr/metal/albedo_map") == "materials/textures/b.png"


def test_a_material_that_is_no_plain_colour() -> None:
    made = robot(
        link("base", f"<visual>{BOX}</visual>"), tag("base", "<material>Gazebo/Wood</material>")
    )
    assert made.tree.find("model/link/visual/material") is None
    assert any("Gazebo/Wood" in note for note in made.notes)


def test_links_without_mass() -> None:
    made = robot(
        link("base"),
        link("end", solid=""),
        joint("end", "continuous"),
        link("kept", solid=""),
        joint("kept"),
        tag("kept_joint", "<preserveFixedJoint>true</preserveFixedJoint>"),
        link("middle", solid=""),
        joint("middle", "continuous"),
        link("tip"),
        joint("tip", "continuous", "middle"),
    )
    assert made.tree.xpath("//link/@name") == ["base", "middle", "tip"]
    assert set(made.lumped) == {"base", "kept", "middle", "tip"}
    assert sum("has no mass" in note for note in made.notes) == 3


@pytest.mark.parametrize("keep", ["preserveFixedJoint", "disableFixedJointLumping"])
def test_fixed_joints_that_are_kept(keep: str) -> None:
    parts = (link("base"), link("arm"), joint("arm"))
    made = robot(*parts, tag("arm_joint", f"<{keep}>true</{keep}>"))
    assert text(made, "joint/@type") == "fixed"
    assert made.lumped["arm"].pose == Transform()


def test_joints_that_sdf_cannot_say() -> None:
    mimic = '<mimic joint="arm_joint"/><limit effort="1" velocity="1"/>'
    made = robot(
        link("base"),
        link("arm"),
        joint("arm", "continuous"),
        link("copy"),
        joint("copy", "revolute", more=mimic),
        link("sled"),
        joint("sled", "planar"),
    )
    assert made.tree.xpath("//joint/@name") == ["arm_joint", "copy_joint"]
    assert text(made, "joint[1]/axis/limit/lower") == "-1e+16"
    assert sum("mimics" in note or "planar" in note for note in made.notes) == 2
    assert all(note.startswith("robot.urdf:") for note in made.notes)


def test_a_capsule_is_a_cylinder_between_two_spheres() -> None:
    capsule = '<geometry><capsule radius="0.1" length="0.4"/></geometry>'
    made = robot(link("base", f"<collision>{capsule}</collision>"))
    shapes = [node.tag for node in made.tree.iterfind("model/link/collision/geometry/*")]
    assert shapes == ["cylinder", "sphere", "sphere"]
    assert text(made, "link/collision[2]/pose") == "0 0 0.2 0 0 0"


@pytest.mark.parametrize(
    "content",
    [
        "",
        '<link/><joint type="fixed"/>',
        joint("base"),
        link("a") + joint("a", parent="a"),
        link("a") + link("b") + joint("a", parent="b") + joint("b", parent="a"),
        link("world") + link("a") + joint("a", parent="world"),
        link("a", f"<visual>{BOX}<material/></visual><collision/>") + tag("a", "<sensor/>"),
        tag("nobody", "<mu1>1</mu1>"),
        link("a") + '<gazebo xmlns="urn:x"><plugin/></gazebo>',
        link("a", f"<visual>{BOX}</visual>")
        + tag("a", '<visual xmlns:x="urn:x"><x:y/></visual><plugin xmlns="urn:x"/>'),
        link("a", solid='<inertial><mass value="inf"/><inertia ixx="nan"/></inertial>'),
    ],
)
def test_odd_robots_do_no_harm(content: str) -> None:
    made = robot(content)
    assert isinstance(made.tree, etree._Element)
