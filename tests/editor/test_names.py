"""Names of a package: what mentions what, and the same name in all files after a rename."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.editor.names.index import names_of
from checker.editor.names.readers.expressions import may_come_to
from checker.editor.names.symbols import symbols_of
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.source.text import SourceText
from tests.editor.packages import edited, mention, package_of, places, refusal, renamed, texts
from tests.effort import limited

MODEL = """<?xml version="1.0"?>
<sdf version="1.9">
  <model name="rover" canonical_link="base_link">
    <frame name="mast" attached_to="base_link"/>
    <link name="base_link">
      <sensor name="front" type="gpu_lidar">
        <pose relative_to="mast">0 0 0 0 0 0</pose>
        <topic>front/scan</topic>
        <gz_frame_id>rover/base_link</gz_frame_id>
      </sensor>
      <sensor name="bump" type="contact">
        <contact><collision>arm::wrist::box</collision></contact>
      </sensor>
    </link>
    <link name="left_wheel"><pose relative_to="left_joint"/></link>
    <joint name="left_joint" type="revolute">
      <parent>base_link</parent>
      <child>left_wheel</child>
      <axis><xyz expressed_in="mast">0 1 0</xyz></axis>
    </joint>
    <model name="arm">
      <link name="wrist"/>
      <link name="base_link"/>
      <joint name="bend" type="revolute">
        <parent>base_link</parent>
        <child>wrist</child>
      </joint>
    </model>
    <joint name="hold" type="fixed"><parent>base_link</parent><child>arm::base_link</child></joint>
    <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
      <left_joint>left_joint</left_joint>
      <topic>/model/rover/cmd_vel</topic>
      <frame_id>odom</frame_id>
      <child_frame_id>rover/base_link</child_frame_id>
    </plugin>
  </model>
</sdf>
"""
SPAWNER = """def spawner(_name)
  # left_joint turns
  joint = 'left_joint'
  <<~XML
    <plugin name="ignition::gazebo::systems::JointController" filename="j.so">
      <joint_name>left_joint</joint_name>
      <topic>/model/#{_name}/cmd_vel</topic>
      <note>left_joint_2</note>
    </plugin>
    <command>roslaunch rover topics.launch name:=#{_name}</command>
  XML
end
"""
TOPICS = """<launch>
  <arg name="name"/>
  <arg name="lidar" value="/world/w/model/$(arg name)/link/base_link/sensor/front/scan"/>
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="front"
        args="/model/$(arg name)/cmd_vel@geometry_msgs/Twist]ignition.msgs.Twist
              /front/scan@sensor_msgs/LaserScan[ignition.msgs.LaserScan
              /front/scan/points@sensor_msgs/PointCloud2[ignition.msgs.PointCloudPacked">
    <remap from="/front/scan" to="scan"/>
  </node>
  <node pkg="tf" type="static_transform_publisher" name="t"
        args="0 0 0 0 0 0 $(arg name)/base_link laser 10"/>
</launch>
"""
BRIDGE = """- ros_topic_name: /front/scan
  gz_topic_name: front/scan
  ros_type_name: sensor_msgs/msg/LaserScan
"""
CONTROLLERS = """drive:
  ros__parameters:
    left_wheel_names: [left_joint]
    joints: ["left_joint"]
    base_frame_id: base_link
    odom_frame_id: odom
    gains:
      left_joint: {p: 1.0}
    gains.left_joint.d: 1.0
    note: about left_joint
"""
PYTHON = """from launch_ros.actions import Node


def generate_launch_description():
    text = "é"; joint = 'left_joint'
    return Node(package="left_joint", parameters=[{"joint": joint, "frame_id": "base_link"}])
"""
FILES = {
    "model.sdf": MODEL,
    "launch/spawner.rb": SPAWNER,
    "launch/topics.launch": TOPICS,
    "launch/rover.launch.py": PYTHON,
    "config/bridge.yaml": BRIDGE,
    "config/controllers.yaml": CONTROLLERS,
}


@pytest.fixture
def rover(tmp_path: Path) -> Package:
    """A rover in all formats."""
    return package_of(tmp_path, FILES)


def at(package: Package, path: str, text: str, number: int = 0) -> int:
    """Return the offset of the n-th occurrence of a text in a file."""
    source = package.read(path)
    assert isinstance(source, SourceText)
    offset = -1
    for _ in range(number + 1):
        offset = source.text.index(text, offset + 1)
    return offset


def test_a_joint_is_mentioned_in_all_files(rover: Package) -> None:
    index = names_of(rover)
    joint = mention(index, "joint", "left_joint")
    assert places(index, index.references(joint)) == {
        ("model.sdf", 16),
        ("model.sdf", 15),
        ("model.sdf", 31),
        ("launch/spawner.rb", 3),
        ("launch/spawner.rb", 6),
        ("config/controllers.yaml", 3),
        ("config/controllers.yaml", 4),
        ("config/controllers.yaml", 8),
        ("config/controllers.yaml", 9),
        ("launch/rover.launch.py", 5),
    }
    assert places(index, index.definitions(joint)) == {("model.sdf", 16)}


def test_a_mention_leads_to_its_definition(rover: Package) -> None:
    index = names_of(rover)
    for path, text, number, line in (
        ("config/controllers.yaml", "left_joint", 0, 16),
        ("config/controllers.yaml", "base_link", 0, 5),
        ("launch/topics.launch", "front/scan", 0, 6),
        ("launch/topics.launch", "base_link", 0, 5),
        ("launch/topics.launch", "base_link", 1, 5),
        ("launch/topics.launch", "cmd_vel", 0, 32),
        ("launch/spawner.rb", "left_joint", 1, 16),
        ("model.sdf", "wrist::box", 0, 22),
        ("model.sdf", "arm::base_link", 0, 21),
        ("model.sdf", "base_link</child>", 0, 23),
    ):
        found = index.at(path, at(rover, path, text, number))
        assert found is not None, (path, text, number)
        assert ("model.sdf", line) in places(index, index.definitions(found)), (path, text)


def test_a_name_within_a_word_or_a_comment_is_no_mention(rover: Package) -> None:
    index = names_of(rover)
    for path, text in (
        ("config/controllers.yaml", "about left_joint"),
        ("launch/spawner.rb", "left_joint turns"),
        ("launch/spawner.rb", "left_joint_2"),
        ("launch/rover.launch.py", 'left_joint", parameters'),
    ):
        assert index.at(path, at(rover, path, text) + 1) is None, text


def test_parts_of_nested_models_are_told_apart(rover: Package) -> None:
    after = renamed(rover, "link", "arm::base_link", "plate")["model.sdf"]
    assert '<link name="base_link">' in after
    assert '<link name="plate"/>' in after
    assert after.count("<parent>base_link</parent>") == 2
    assert "<child>arm::plate</child>" in after


def test_a_model_is_renamed_in_scoped_names(rover: Package) -> None:
    after = renamed(rover, "model", "arm", "tool")["model.sdf"]
    assert '<model name="tool">' in after
    assert "tool::wrist::box" in after
    assert "<child>tool::base_link</child>" in after
    assert "arm" not in after.replace("arms", "")


def test_a_joint_is_renamed_in_all_files(rover: Package) -> None:
    after = renamed(rover, "joint", "left_joint", "port")
    assert set(after) == {*FILES} - {"config/bridge.yaml", "launch/topics.launch"}
    assert after["model.sdf"].count("left_joint") == 2, "the parameter keeps its tag"
    assert "<note>left_joint_2</note>" in after["launch/spawner.rb"]
    assert "# left_joint turns" in after["launch/spawner.rb"]
    assert "joint = 'port'" in after["launch/rover.launch.py"]
    assert 'package="left_joint"' in after["launch/rover.launch.py"]
    assert "gains.port.d" in after["config/controllers.yaml"]


def test_a_link_is_renamed_as_a_frame(rover: Package) -> None:
    after = renamed(rover, "link", "base_link", "hull")
    assert "<gz_frame_id>rover/hull</gz_frame_id>" in after["model.sdf"]
    assert 'attached_to="hull"' in after["model.sdf"]
    assert 'canonical_link="hull"' in after["model.sdf"]
    assert "$(arg name)/hull laser" in after["launch/topics.launch"]
    assert "link/hull/sensor/front" in after["launch/topics.launch"]
    assert "base_frame_id: hull" in after["config/controllers.yaml"]


def test_a_sensor_is_renamed_in_its_default_topic(rover: Package) -> None:
    after = renamed(rover, "sensor", "base_link::front", "nose")
    assert "sensor/nose/scan" in after["launch/topics.launch"]
    assert 'name="front"' in after["launch/topics.launch"], "the node is another thing"
    assert "<topic>front/scan</topic>" in after["model.sdf"]


def test_a_topic_is_renamed_with_what_is_published_below_it(rover: Package) -> None:
    after = renamed(rover, "topic", "front/scan", "nose/scan")
    assert "<topic>nose/scan</topic>" in after["model.sdf"]
    assert "/nose/scan/points@" in after["launch/topics.launch"]
    assert '<remap from="/nose/scan" to="scan"/>' in after["launch/topics.launch"]
    assert "ros_topic_name: /nose/scan" in after["config/bridge.yaml"]
    assert "gz_topic_name: nose/scan" in after["config/bridge.yaml"]


def test_a_topic_of_the_model_is_compared_without_its_name(rover: Package) -> None:
    after = renamed(rover, "topic", "model/*/cmd_vel", "velocity")
    assert "<topic>/model/rover/velocity</topic>" in after["model.sdf"]
    assert "<topic>/model/#{_name}/velocity</topic>" in after["launch/spawner.rb"]
    assert "/model/$(arg name)/velocity@" in after["launch/topics.launch"]


def test_a_topic_has_the_namespace_of_its_plugin_in_front(tmp_path: Path) -> None:
    model = """<sdf version="1.6"><model name="m"><link name="l"/><plugin name="a::Motor">
<robotNamespace>model/m</robotNamespace><commandSubTopic>speed</commandSubTopic></plugin>
</model></sdf>"""
    ruby = """<plugin name="Motor"><robotNamespace>model/#{_name}</robotNamespace>
<commandSubTopic>speed</commandSubTopic></plugin>"""
    launch = """<launch><arg name="m" default="/model/$(arg name)"/>
<node args="/model/$(arg name)/speed@a]b other"><remap from="speed" to="x"/></node></launch>"""
    files = {"model.sdf": model, "launch/a.rb": ruby, "launch/a.launch": launch}
    after = renamed(package_of(tmp_path, files), "topic", "model/*/speed", "turns")
    assert "<commandSubTopic>turns<" in after["model.sdf"]
    assert "<commandSubTopic>turns<" in after["launch/a.rb"]
    assert "/model/$(arg name)/turns@a" in after["launch/a.launch"]
    assert 'from="speed"' in after["launch/a.launch"]


def test_a_sensor_is_named_behind_an_argument(tmp_path: Path) -> None:
    model = """<sdf version="1.6"><model name="m"><link name="l">
<sensor name="eye" type="camera"/></link></model></sdf>"""
    launch = """<launch><arg name="link" value="/model/$(arg name)/link/l"/>
<arg name="sensors" value="$(arg link)/sensor"/>
<node args="$(arg sensors)/eye/image"><remap from="$(arg sensors)/eye/image" to="eye"/></node>
<node args="$(arg other)/eye/image"/></launch>"""
    files = {"model.sdf": model, "launch/a.launch": launch}
    after = renamed(package_of(tmp_path, files), "sensor", "l::eye", "lens")["launch/a.launch"]
    assert after == launch.replace("sensors)/eye", "sensors)/lens")


def test_an_argument_that_a_name_is_composed_for_is_not_renamed(tmp_path: Path) -> None:
    xacro = """<robot name="r"><xacro:arg name="eye_width" default="1"/>
<xacro:camera name="eye"/><a b="$(arg ${name}_width)"/></robot>"""
    package = package_of(tmp_path, {"urdf/r.xacro": xacro})
    assert "'${name}_width'" in refusal(package, "argument", "eye_width", "w")


def test_an_argument_that_is_given_to_an_unknown_program_is_not_the_giver_s(tmp_path: Path) -> None:
    launch = '<launch><arg name="a"/><param name="p" command="./print a:=$(arg a)"/></launch>'
    after = renamed(package_of(tmp_path, {"launch/a.launch": launch}), "argument", "a", "b")
    assert 'command="./print a:=$(arg b)"' in after["launch/a.launch"]


def test_an_inherited_launch_file_names_topics(tmp_path: Path) -> None:
    model = '<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>'
    base = "../rover_sensor_config_1"
    spawner = """x = 'roslaunch rover_sensor_config_1 vehicle_topics.launch'
<plugin name="p"><topic>/model/#{_name}/gas</topic></plugin>"""
    launch = '<launch><node args="/model/$(arg name)/gas@a[b"/></launch>'
    files = {
        "launch/spawner.rb": spawner,
        f"{base}/model.sdf": model,
        f"{base}/launch/vehicle_topics.launch": launch,
    }
    package = package_of(tmp_path, files, "rover_sensor_config_2")
    reason = refusal(package, "topic", "model/*/gas", "smoke")
    assert f"{base}/launch/vehicle_topics.launch:1" in reason


def test_a_frame_that_a_plugin_makes_is_renamed(rover: Package) -> None:
    after = renamed(rover, "frame", "odom", "start")
    assert "<frame_id>start</frame_id>" in after["model.sdf"]
    assert "odom_frame_id: start" in after["config/controllers.yaml"]


def test_an_argument_is_renamed_where_it_is_passed(rover: Package) -> None:
    after = renamed(rover, "argument", "name", "robot")
    assert '<arg name="robot"/>' in after["launch/topics.launch"]
    assert "$(arg name)" not in after["launch/topics.launch"]
    assert "topics.launch robot:=#{_name}" in after["launch/spawner.rb"]


def test_a_new_name_must_be_valid_and_free(rover: Package) -> None:
    for kind, name, new, reason in (
        ("link", "base_link", "a b", "is not a name for a link"),
        ("link", "base_link", "world", "SDFormat reserves it"),
        ("link", "base_link", "12", "YAML"),
        ("link", "base_link", "a::b", "is not a name"),
        ("link", "base_link", "left_wheel", "already used at model.sdf:15"),
        ("link", "base_link", "left_joint", "already used"),
        ("link", "base_link", "odom", "already used"),
        ("joint", "left_joint", "hold", "already used at model.sdf:"),
        ("joint", "left_joint", "left.1", "has a dot, which makes other keys of config/contr"),
        ("topic", "front/scan", "/a//b", "is not a name for a topic"),
        ("topic", "front/scan", "front/scan/points", "already used"),
        ("argument", "name", "1", "is not a name"),
        ("argument", "name", "lidar", "already used"),
    ):
        assert reason in refusal(rover, kind, name, new), (kind, name, new)


def test_the_same_name_needs_no_edit(rover: Package) -> None:
    index = names_of(rover)
    assert index.rename(mention(index, "link", "base_link"), "base_link") == ()


def test_what_is_not_defined_is_not_renamed(tmp_path: Path) -> None:
    text = '<sdf version="1.9"><model name="m"><frame name="f" attached_to="gone"/></model></sdf>'
    package = package_of(tmp_path, {"model.sdf": text})
    assert refusal(package, "link", "gone", "x") == "link 'gone' is not defined in this package"


def test_a_text_that_may_name_two_things_is_not_renamed(tmp_path: Path) -> None:
    model = """<sdf version="1.6"><model name="m"><link name="base"/><link name="arm"/>
<joint name="arm" type="fixed"><parent>base</parent><child>arm</child></joint></model></sdf>"""
    package = package_of(tmp_path, {"model.sdf": model, "config/a.yaml": "part: arm\n"})
    reason = refusal(package, "link", "arm", "boom")
    assert "config/a.yaml:1 may name the link or the joint 'arm'" in reason


def test_a_file_that_cannot_be_read_and_may_name_it_refuses(tmp_path: Path) -> None:
    model = '<sdf version="1.9"><model name="m"><link name="hull"/></model></sdf>'
    files = {"model.sdf": model, "config/a.yaml": "frame: [hull\n"}
    reason = refusal(package_of(tmp_path, files), "link", "hull", "boom")
    assert "config/a.yaml may name 'hull' and cannot be read" in reason
    package = package_of(tmp_path, {**files, "config/a.yaml": "frame: [other\n"})
    assert "boom" in renamed(package, "link", "hull", "boom")["model.sdf"]


def test_a_model_that_is_included_is_looked_into(tmp_path: Path) -> None:
    arm = '<sdf version="1.9"><model name="arm_model"><link name="wrist"/></model></sdf>'
    outer = """<sdf version="1.9"><model name="m">
<include><uri>model://arm</uri><name>arm</name></include>
<link name="base"/>
<joint name="j" type="fixed"><parent>base</parent><child>arm::wrist</child></joint>
</model></sdf>"""
    inside = package_of(tmp_path / "a", {"model.sdf": outer, "models/arm/model.sdf": arm})
    after = renamed(inside, "link", "wrist", "hand")
    assert "<child>arm::hand</child>" in after["model.sdf"]
    assert '<link name="hand"/>' in after["models/arm/model.sdf"]
    beside = package_of(tmp_path / "b", {"model.sdf": outer, "../arm/model.sdf": arm})
    reason = refusal(beside, "link", "wrist", "hand")
    assert "is defined in another package, ../arm/model.sdf:1" in reason


def test_links_of_two_models_in_a_world_are_told_apart(tmp_path: Path) -> None:
    box = '<model name="{0}"><link name="link"/><frame name="f" attached_to="link"/></model>'
    world = f'<sdf version="1.9"><world name="w">{box.format("a")}{box.format("b")}</world></sdf>'
    package = package_of(tmp_path, {"worlds/w.sdf": world})
    after = renamed(package, "link", "a::link", "body")["worlds/w.sdf"]
    assert after == world.replace('"link"', '"body"', 2)


XACRO = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="wheel.xacro"/>
  <xacro:include filename="$(find rover)/urdf/names.xacro"/>
  <xacro:arg name="sim" default="true"/>
  <link name="base_link"/>
  <xacro:wheel side="left" parent="base_link" radius="${radius * 2}"/>
  <xacro:if value="$(arg sim)">
    <xacro:call macro="wheel" side="right" parent="base_link"/>
  </xacro:if>
  <gazebo reference="base_link"><sensor name="imu" type="imu"><topic>imu</topic></sensor></gazebo>
</robot>
"""
WHEEL = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="wheel" params="side parent radius:=0.1">
    <link name="${side}_wheel">
      <visual><geometry><sphere radius="${radius}"/></geometry></visual>
    </link>
    <joint name="${side}_joint" type="continuous">
      <parent link="${parent}"/>
      <child link="${side}_wheel"/>
    </joint>
    <transmission name="t"><joint name="${side}_joint"/></transmission>
  </xacro:macro>
</robot>
"""
NAMES = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="radius" value="0.2"/>
  <xacro:property name="double" value="${2 * radius + len('radius')}"/>
</robot>
"""
XACROS = {"urdf/r.urdf.xacro": XACRO, "urdf/wheel.xacro": WHEEL, "urdf/names.xacro": NAMES}


def test_a_property_is_shared_by_files_that_include_each_other(tmp_path: Path) -> None:
    after = renamed(package_of(tmp_path, XACROS), "property", "radius", "size")
    assert after["urdf/names.xacro"].splitlines()[1:3] == [
        '  <xacro:property name="size" value="0.2"/>',
        '  <xacro:property name="double" value="${2 * size + len(\'radius\')}"/>',
    ]
    assert 'radius="${size * 2}"' in after["urdf/r.urdf.xacro"]
    assert "urdf/wheel.xacro" not in after, "there it is a parameter"


def test_a_property_that_a_macro_takes_from_its_caller_is_not_renamed(tmp_path: Path) -> None:
    for params, reason in (
        ("side parent radius:=^", "urdf/wheel.xacro:2 composes a name that may be 'radius'"),
        ("side parent radius:=^|2", "urdf/wheel.xacro:2 composes a name that may be 'radius'"),
        ("side parent size", "'size' is already a parameter of a macro in urdf/wheel.xacro"),
    ):
        wheel = WHEEL.replace("side parent radius:=0.1", params)
        package = package_of(tmp_path, {**XACROS, "urdf/wheel.xacro": wheel})
        assert reason in refusal(package, "property", "radius", "size")


def test_a_macro_is_renamed_where_it_is_called(tmp_path: Path) -> None:
    closed = XACRO.replace('radius="${radius * 2}"/>', "></xacro:wheel>")
    package = package_of(tmp_path, {**XACROS, "urdf/r.urdf.xacro": closed})
    after = renamed(package, "macro", "wheel", "tyre")
    assert "<xacro:tyre side" in after["urdf/r.urdf.xacro"]
    assert "</xacro:tyre>" in after["urdf/r.urdf.xacro"]
    assert 'macro="tyre"' in after["urdf/r.urdf.xacro"]
    assert '<xacro:macro name="tyre"' in after["urdf/wheel.xacro"]
    assert "wheel.xacro" in after["urdf/r.urdf.xacro"]


def test_a_link_is_renamed_where_it_is_given_to_a_macro(tmp_path: Path) -> None:
    after = renamed(package_of(tmp_path, XACROS), "link", "base_link", "hull")
    assert after["urdf/r.urdf.xacro"].count("hull") == 4


def test_a_composed_name_keeps_its_expressions(tmp_path: Path) -> None:
    package = package_of(tmp_path, XACROS)
    after = renamed(package, "joint", "${side}_joint", "${side}_axle")["urdf/wheel.xacro"]
    assert after.count("${side}_axle") == 2
    reason = refusal(package, "joint", "${side}_joint", "axle")
    assert "must keep the expressions" in reason


def test_a_name_that_an_expression_composes_is_not_renamed(tmp_path: Path) -> None:
    files = {**XACROS, "config/c.yaml": "a:\n  joints: [left_joint]\n"}
    package = package_of(tmp_path, files)
    index = names_of(package)
    reason = refusal(package, "joint", "left_joint", "axle")
    assert "is composed by an expression at urdf/wheel.xacro:6" in reason
    reason = refusal(package, "joint", "${side}_joint", "${side}_axle")
    assert "config/c.yaml:2 names 'left_joint'" in reason
    composed = mention(index, "joint", "${side}_joint")
    assert ("config/c.yaml", 2) in places(index, index.references(composed))
    found = index.at("config/c.yaml", files["config/c.yaml"].index("left_joint"))
    assert found is not None
    assert places(index, index.definitions(found)) == {("urdf/wheel.xacro", 6)}


def test_a_name_that_ruby_may_compose_is_not_renamed(tmp_path: Path) -> None:
    model = (
        '<sdf version="1.6"><model name="m"><link name="l"/><joint name="LF_HAA"/></model></sdf>'
    )
    ruby = """%w[a].each { |x| x }
for leg in ['LF', 'RF']
  j = "#{leg}_#{part}"
end
"""
    parts = "for part in ['HAA']\nend\n"
    package = package_of(tmp_path, {"model.sdf": model, "launch/spawner.rb": parts + ruby})
    assert "launch/spawner.rb:5 composes a name" in refusal(package, "joint", "LF_HAA", "x")
    package = package_of(tmp_path, {"model.sdf": model, "launch/spawner.rb": ruby})
    assert renamed(package, "joint", "LF_HAA", "x")


def test_ruby_names_parts_in_escaped_quotes_and_lists_of_words(tmp_path: Path) -> None:
    model = '<sdf version="1.6"><model name="m"><link name="wheel"/></model></sdf>'
    ruby = """wheels = %w[wheel other]
xml = "<plugin name=\\"WheelSlip\\"><wheel link_name=\\"wheel\\"/></plugin>"
"""
    package = package_of(tmp_path, {"model.sdf": model, "launch/spawner.rb": ruby})
    after = renamed(package, "link", "wheel", "tyre")["launch/spawner.rb"]
    assert after == ruby.replace("%w[wheel", "%w[tyre").replace('\\"wheel\\"', '\\"tyre\\"')


def test_model_and_description_are_one_robot(tmp_path: Path) -> None:
    model = '<sdf version="1.6"><model name="m"><link name="base_link"/></model></sdf>'
    urdf = '<robot name="m"><link name="$(arg name)/base_link"/></robot>'
    package = package_of(tmp_path, {"model.sdf": model, "urdf/m.xacro": urdf})
    after = renamed(package, "link", "base_link", "hull")
    assert '"$(arg name)/hull"' in after["urdf/m.xacro"]


def test_robots_of_one_package_are_told_apart(tmp_path: Path) -> None:
    urdf = '<robot name="m"><link name="base_link"/></robot>'
    files = {"urdf/a.urdf": urdf, "urdf/b.urdf": urdf.replace('"m"', '"n"')}
    assert set(renamed(package_of(tmp_path / "1", files), "link", "base_link", "x")) == {
        "urdf/a.urdf"
    }
    joined = {**files, "config/nav.yaml": "base_frame: base_link\n"}
    after = renamed(package_of(tmp_path / "2", joined), "link", "base_link", "x")
    assert set(after) == {*joined}, "a text that tells of no robot means both"
    after = renamed(
        package_of(tmp_path / "3", {**files, "urdf/b.urdf": urdf}), "link", "base_link", "x"
    )
    assert set(after) == {*files}, "both describe the robot m"


def test_what_a_sibling_names_is_not_renamed(tmp_path: Path) -> None:
    model = '<sdf version="1.6"><model name="m"><link name="hull"/><link name="fin"/></model></sdf>'
    spawner = "x = 'roslaunch rover_sensor_config_1 d.launch'\nlink = 'hull'\n"
    other = "../rover_sensor_config_2/launch/spawner.rb"
    files = {"model.sdf": model, "launch/spawner.rb": "", other: spawner}
    package = package_of(tmp_path, files, "rover_sensor_config_1")
    assert f"{other}:2 in another package" in refusal(package, "link", "hull", "keel")
    assert renamed(package, "link", "fin", "keel")


def test_srdf_and_ros2_control_name_joints(tmp_path: Path) -> None:
    urdf = """<robot name="m"><link name="a"/><link name="b"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><mimic joint="k"/></joint>
<joint name="k" type="revolute"><parent link="a"/><child link="b"/></joint>
<ros2_control name="s" type="system"><joint name="k"/></ros2_control></robot>"""
    srdf = """<robot name="m"><group name="g"><joint name="k"/><chain base_link="a" tip_link="b"/>
</group><disable_collisions link1="a" link2="b" reason="Adjacent"/></robot>"""
    package = package_of(tmp_path, {"urdf/m.urdf": urdf, "config/m.srdf": srdf})
    after = renamed(package, "joint", "k", "knee")
    assert after["urdf/m.urdf"].count('"knee"') == 3
    assert '<joint name="knee"/>' in after["config/m.srdf"]
    after = renamed(package, "link", "a", "hull")
    assert after["config/m.srdf"].count('"hull"') == 2


def test_arguments_of_python_and_xacro(tmp_path: Path) -> None:
    python = """from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription


def generate_launch_description():
    DeclareLaunchArgument("world", default_value="yard.sdf")
    LaunchConfiguration("world")
    Command(["xacro ", "urdf/r.urdf.xacro", " sim:=true"])
    IncludeLaunchDescription("other.launch.py", launch_arguments={"world": "a"}.items())
"""
    other = 'DeclareLaunchArgument("world")\n'
    files = {**XACROS, "launch/a.launch.py": python, "launch/other.launch.py": other}
    package = package_of(tmp_path, files)
    after = renamed(package, "argument", "sim", "simulated")
    assert "' simulated:=true'" in after["launch/a.launch.py"].replace('"', "'")
    index = names_of(package)
    own = mention(index, "argument", "world", "launch/a.launch.py")
    assert places(index, index.references(own)) == {
        ("launch/a.launch.py", 5),
        ("launch/a.launch.py", 6),
    }
    theirs = mention(index, "argument", "world", "launch/other.launch.py")
    assert places(index, index.references(theirs)) == {
        ("launch/a.launch.py", 8),
        ("launch/other.launch.py", 1),
    }


def test_an_argument_that_is_handed_on_without_a_word_is_not_renamed(tmp_path: Path) -> None:
    outer = 'DeclareLaunchArgument("sim")\nIncludeLaunchDescription("inner.launch.py")\n'
    inner = 'DeclareLaunchArgument("sim")\n'
    files = {"launch/a.launch.py": outer, "launch/inner.launch.py": inner}
    package = package_of(tmp_path, files)
    assert "also declares 'sim'" in refusal(package, "argument", "sim", "simulated")


def test_only_a_changed_text_is_read_again(rover: Package) -> None:
    before = names_of(rover)
    changed = SourceText("model.sdf", MODEL.replace("left_joint", "port"))
    after = names_of(rover.with_texts({"model.sdf": changed}), before)
    for path, file in before.files.items():
        assert (after.files[path] is file) == (path != "model.sdf"), path
    assert mention(after, "joint", "port").is_definition
    fresh = names_of(rover.with_texts({"model.sdf": changed}))
    assert set(after.mentions) == set(fresh.mentions)


PARTS = st.sampled_from(("left_joint", "base_link", "left_wheel", "hold", "mast", "front/scan"))
WORDS = st.from_regex(r"[a-z][a-z0-9_.-]{0,12}", fullmatch=True)


@given(name=PARTS, new=WORDS)
def test_there_and_back_is_the_same_text(
    name: str, new: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    package = package_of(tmp_path_factory.mktemp("rover"), FILES)
    index = names_of(package)
    thing = next(it for it in index.mentions if it.name == name and it.is_definition)
    edits = index.rename(thing, new)
    if isinstance(edits, str):
        assert any(it in edits for it in ("is not a name", "already", "has a dot")), edits
        return
    after = edited(package, edits)
    again = names_of(after, index)
    moved = mention(again, thing.kind, new)
    back = again.rename(moved, name)
    assert not isinstance(back, str), back
    assert texts(edited(after, back)) == texts(package)


@given(
    pieces=st.lists(st.text("ab_", max_size=3), min_size=2, max_size=4),
    values=st.lists(st.text("ab_", max_size=3), min_size=1, max_size=4),
    data=st.data(),
)
def test_a_composed_name_may_come_to_what_its_values_make(
    pieces: list[str], values: list[str], data: st.DataObject
) -> None:
    filled = pieces[0] + "".join(data.draw(st.sampled_from(values)) + piece for piece in pieces[1:])
    assert may_come_to("${x}".join(pieces), filled, frozenset(values))
    assert not may_come_to("${x}".join(pieces), f"{filled}!", frozenset(values))


def test_every_reader_is_linear_in_hostile_texts(tmp_path: Path) -> None:
    size = 200_000
    hostile = {
        "launch/a.rb": "<!--" * (size // 4) + "<a>" + " " * size,
        "launch/b.rb": "<a " * (size // 3) + "a-" * (size // 2) + '"' * 1001,
        "launch/c.launch": f'<launch><arg name="a" value="{"$(eval " * 20_000}"/></launch>',
        "launch/d.launch": f'<launch><node args="{"a." * 9_000}" name="{"$(" * 9_000}"/></launch>',
        "urdf/e.xacro": f'<robot><link name="{"${" * 90_000}"/><x a="{"$(arg " * 9_000}"/></robot>',
        "config/f.yaml": f'a: "{"::" * 50_000}"\nb: "{"${a}" * 5000}"\n',
    }
    package = package_of(tmp_path, hostile)
    with limited(3):
        assert len(names_of(package).mentions) > 0


def test_the_samples_are_renamed_link_by_link(samples: Path) -> None:
    for folder in ("acme_scout", "husky_migration_sensor_config_1", "my_gurdy_description"):
        with open_input(samples / folder) as opened:
            package = opened.packages[0]
            index = names_of(package)
            changed = 0
            for thing in index.mentions:
                if (
                    thing.is_definition
                    and thing.kind in ("link", "joint")
                    and "$" not in thing.name
                ):
                    edits = index.rename(thing, "quite_new")
                    reasons = ("compose", "_config_2/")
                    assert not isinstance(edits, str) or any(it in edits for it in reasons), edits
                    changed += not isinstance(edits, str)
            assert changed >= 2, folder


@given(data=st.data())
def test_any_edit_of_a_text_is_read(
    data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    files = {**FILES, **XACROS}
    package = package_of(tmp_path_factory.mktemp("rover"), files)
    index = names_of(package)
    for _ in range(3):
        path = data.draw(st.sampled_from(sorted(files)))
        text = files[path]
        start = data.draw(st.integers(0, len(text)))
        end = min(len(text), start + data.draw(st.integers(0, 40)))
        new = data.draw(st.sampled_from(("", "x", "<", '"', "${", "::", "\n", text[start:end] * 2)))
        files[path] = text[:start] + new + text[end:]
        package = package.with_texts({path: SourceText(path, files[path])})
        index = names_of(package, index)
        assert set(index.mentions) == set(names_of(package).mentions)
        assert isinstance(symbols_of(package, path), tuple)
        for it in index.mentions:
            assert 0 <= it.start < it.end <= len(texts(package)[it.path])
            assert isinstance(index.rename(it, "quite_new"), str | tuple)
