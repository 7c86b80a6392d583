"""What flattening writes: the author's lines, one step further out, with other names."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.cli.check.fix import fix_paths
from checker.finding import Safety
from checker.formats.sdf.flattening.flatten import obstacle
from checker.formats.sdf.flattening.names import FlatNames, mentions
from checker.rule_testing import write_example
from checker.source.text import SourceText
from tests.flattening.nested import flattened, read

NESTED = """<sdf version="1.6">
  <model name="rover">
    <link name="base_link"/>
    <!-- The arm, as it was bought. -->
    <model name="arm">
      <pose>1 0 0.5 0 0 1.5707963267948966</pose>
      <self_collide>1</self_collide>
      <link name="upper">
        <!-- as measured -->
        <pose frame="">0.10  0 0   0 0 0</pose>
      </link>

      <link name="hand"/>
      <joint name="wrist" type="revolute">
        <parent>upper</parent>
        <child>hand</child>
        <axis>
          <xyz>1 0 0</xyz>
          <use_parent_model_frame>1</use_parent_model_frame>
        </axis>
      </joint>
      <plugin filename="libx.so" name="JointController"><joint_name>wrist</joint_name></plugin>
      <gripper name="grip">
        <gripper_link>hand</gripper_link>
        <palm_link>upper</palm_link>
      </gripper>
    </model>
    <joint name="shoulder" type="fixed">
      <parent>base_link</parent>
      <child>arm::upper</child>
    </joint>
    <plugin filename="liby.so" name="DetachableJoint"><parent_link>arm::hand</parent_link></plugin>
  </model>
</sdf>
"""
FLAT = """<sdf version="1.6">
  <model name="rover">
    <link name="base_link"/>
    <!-- The arm, as it was bought. -->
    <link name="arm__upper">
      <!-- as measured -->
      <pose frame="">1  0.1 0.5   0 0 1.5707963267948966</pose>
    </link>

    <link name="arm__hand">
      <pose>1 0 0.5 0 0 1.5707963267948966</pose>
    </link>
    <joint name="arm__wrist" type="revolute">
      <parent>arm__upper</parent>
      <child>arm__hand</child>
      <axis>
        <xyz>0 1 0</xyz>
        <use_parent_model_frame>1</use_parent_model_frame>
      </axis>
    </joint>
    <plugin filename="libx.so" name="JointController"><joint_name>arm__wrist</joint_name></plugin>
    <gripper name="arm__grip">
      <gripper_link>arm__hand</gripper_link>
      <palm_link>arm__upper</palm_link>
    </gripper>
    <joint name="shoulder" type="fixed">
      <parent>base_link</parent>
      <child>arm__upper</child>
    </joint>
    <plugin filename="liby.so" name="DetachableJoint"><parent_link>arm__hand</parent_link></plugin>
  </model>
</sdf>
"""


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_lines_move_out_by_one_step(newline: str) -> None:
    assert flattened(NESTED.replace("\n", newline)) == FLAT.replace("\n", newline)


def test_since_frames_a_frame_stands_where_the_model_stood() -> None:
    text = """<sdf version="1.7">
<model name="rover">
  <link name="base_link"/>
  <model name="arm">
    <pose relative_to="base_link">1 0 0 0 0 0</pose>
    <link name="upper"/>
    <frame name="tip"><pose>0 0 1 0 0 0</pose></frame>
  </model>
  <frame name="eye" attached_to="arm::tip"/>
  <frame name="top" attached_to="arm"/>
</model>
</sdf>
"""
    assert (
        flattened(text)
        == """<sdf version="1.7">
<model name="rover">
  <link name="base_link"/>
  <frame name="arm" attached_to="arm__upper">
    <pose relative_to="__model__">1 0 0 0 0 0</pose>
  </frame>
  <link name="arm__upper">
    <pose relative_to="arm">0 0 0 0 0 0</pose>
  </link>
  <frame attached_to="arm" name="arm__tip"><pose>0 0 1 0 0 0</pose></frame>
  <frame name="eye" attached_to="arm__tip"/>
  <frame name="top" attached_to="arm"/>
</model>
</sdf>
"""
    )


def test_a_name_that_is_taken_gets_a_number() -> None:
    text = NESTED.replace(
        '<link name="base_link"/>', '<link name="base_link"/><link name="arm__hand"/>'
    )
    assert '<link name="arm__hand_2">' in flattened(text)
    assert "<child>arm__hand_2</child>" in flattened(text)


def test_one_file_may_be_included_twice_and_its_paths_start_at_the_robot() -> None:
    wheel = """<sdf version="1.5">
<model name="wheel">
    <link name="tyre">
    \t<visual name="v"><geometry><mesh><uri>../meshes/a.dae</uri></mesh></geometry></visual>
    </link>
</model>
</sdf>"""
    text = """<sdf version="1.6">
  <model name="rover">
    <include><uri>parts/wheel.sdf</uri><name>left</name></include>
    <include>
      <uri>parts/wheel.sdf</uri>
      <name>right</name>
      <plugin name="p" filename="libp.so"><joint>none</joint><link>tyre</link></plugin>
    </include>
  </model>
</sdf>
"""
    visual = '<visual name="v"><geometry><mesh><uri>meshes/a.dae</uri></mesh></geometry></visual>'
    assert (
        flattened(text, {"parts/wheel.sdf": wheel})
        == f"""<sdf version="1.6">
  <model name="rover">
    <link name="left__tyre">
      {visual}
    </link>
    <link name="right__tyre">
      {visual}
    </link>
    <plugin name="p" filename="libp.so"><joint>none</joint><link>right__tyre</link></plugin>
  </model>
</sdf>
"""
    )


@pytest.mark.parametrize(
    ("inside", "reason"),
    [
        ("<include><uri>model://arm</uri></include>", "model://arm is included, but not available"),
        ("<include><uri>new.sdf</uri></include>", "new.sdf is written in SDF 1.7, not in 1.6"),
        ("<model name='a'><link name=''/></model>", "a part has no name of its own"),
        ("<model name='a'><link name='b'/><link name='b'/></model>", "two parts are called a::b"),
    ],
)
def test_what_may_mean_something_else_is_left_to_the_author(inside: str, reason: str) -> None:
    text = f'<sdf version="1.6"><model name="rover"><link name="base"/>{inside}</model></sdf>'
    new = '<sdf version="1.7"><model name="new"><link name="a"/></model></sdf>'
    assert obstacle(read(text, {"new.sdf": new})) == reason


def test_other_files_name_nested_parts_by_scope_and_in_topics() -> None:
    names = FlatNames.from_robot(read(NESTED, {}))
    text = "rover::arm::hand /model/$(arg name)/model/arm/link/hand/sensor/eye arm::foot marm::hand"
    edits = [
        (scoped, edit.original, edit.replacement)
        for scoped, edit in mentions(SourceText("a.launch", text), names)
    ]
    assert edits == [
        ("arm::hand", "arm::hand", "arm__hand"),
        ("arm::hand", "model/arm/link/hand", "link/arm__hand"),
    ]


def test_the_command_flattens_and_edits_what_names_the_parts(tmp_path: Path) -> None:
    topic = "/model/$(arg name)/model/arm/link/hand"
    launch = f'<launch>\n<arg name="name"/>\n<arg name="t" value="{topic}"/>\n</launch>\n'
    package = write_example({"model.sdf": NESTED, "launch/vehicle_topics.launch": launch}, tmp_path)
    wishes = {"select": ("SDF010",)}
    for _ in range(2):
        (fixed,) = fix_paths([package], wishes, list(Safety), write=True)
    assert not fixed.fixed.files
    assert (package / "model.sdf").read_text("utf-8") == FLAT
    assert "/model/$(arg name)/link/arm__hand" in (
        package / "launch/vehicle_topics.launch"
    ).read_text("utf-8")
