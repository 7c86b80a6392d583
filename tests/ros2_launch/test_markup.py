"""What launch files in XML and YAML start: the same as in Python."""

from __future__ import annotations

from checker.launch.ros2.graph import LaunchFaultKind, Parameter, display_path
from tests.ros2_launch.conftest import NAME, Read

XML = f"""\
<launch>
  <arg name="gui" default="true" description="shown"><choice value="true"/></arg>
  <let name="folder" value="$(find-pkg-share {NAME})/config"/>
  <set_env name="A" value="b"/>
  <group>
    <push_ros_namespace namespace="r1"/>
    <node pkg="rviz2" exec="rviz2" name="view" if="$(var gui)"
          args="-d '$(var folder)/my view.rviz'">
      <param name="use_sim_time" value="true"/>
      <param name="robot_description" type="str"
             value="$(command 'xacro $(var folder)/a.xacro x:=1')"/>
      <param from="$(var folder)/p.yaml" allow_substs="true"/>
      <remap from="/tf" to="tf"/>
    </node>
  </group>
  <executable cmd="ros2 topic list" unless="$(eval '1 == 2')"/>
  <include file="$(dirname)/other.launch.xml"><arg name="x" value="1"/></include>
</launch>
"""
YAML = f"""\
launch:
- arg: {{name: gui, default: 'true', description: shown, choice: [{{value: 'true'}}]}}
- let: {{name: folder, value: $(find-pkg-share {NAME})/config}}
- set_env: {{name: A, value: b}}
- group:
  - push_ros_namespace: {{namespace: r1}}
  - node:
      pkg: rviz2
      exec: rviz2
      name: view
      args: -d '$(var folder)/my view.rviz'
      if: $(var gui)
      param:
      - {{name: use_sim_time, value: true}}
      - name: robot_description
        value: $(command 'xacro $(var folder)/a.xacro x:=1')
        type: str
      - {{from: $(var folder)/p.yaml, allow_substs: true}}
      remap:
      - {{from: /tf, to: tf}}
- executable: {{cmd: ros2 topic list, unless: $(eval '1 == 2')}}
- include:
    file: $(dirname)/other.launch.xml
    arg:
    - {{name: x, value: '1'}}
"""
OTHER = {"launch/other.launch.xml": '<launch><node pkg="p" exec="$(var x)"/></launch>'}


def test_xml_and_yaml_say_the_same(read: Read) -> None:
    share = f"$(find-pkg-share {NAME})/config"
    for file, text in (("launch/a.launch.xml", XML), ("launch/a.launch.yaml", YAML)):
        graph = read(text, file, OTHER)
        assert not graph.unread, file
        assert not graph.faults, file
        view, other = graph.nodes
        assert [display_path(word.value) for word in view.arguments] == [
            "-d",
            f"{share}/my view.rviz",
        ]
        assert (view.namespace, view.starts) == ("/r1", True)
        values = [
            (p.name, display_path(str(p.value)))
            for p in view.parameters
            if isinstance(p, Parameter)
        ]
        assert values[1] == ("robot_description", f"$(command xacro {share}/a.xacro x:=1)")
        assert [display_path(p.path) for p in view.parameter_files] == [f"{share}/p.yaml"]
        assert [(remap.source, remap.target) for remap in view.remaps] == [("/tf", "tf")]
        assert (other.executable.value, other.namespace) == ("1", "/")
        assert [word.value for word in graph.processes[0].words] == ["ros2", "topic", "list"]
        assert graph.processes[0].starts is True
        assert graph.includes[0].path == "launch/other.launch.xml"
        assert graph.arguments[0].choices == ("true",)


def test_places_in_xml_are_those_of_the_words(read: Read) -> None:
    graph = read(XML, "launch/a.launch.xml", OTHER)
    view = graph.nodes[0]
    assert view.arguments[0].span.text == "-d"
    assert view.span.line == 7


def test_substitutions_of_roslaunch_are_faults(read: Read) -> None:
    graph = read(
        '<launch>\n<node pkg="p" exec="$(arg x)"/>\n<let name="y" value="$(find p)/z"/>\n</launch>',
        "launch/a.launch.xml",
    )
    told = [(fault.kind, fault.name, fault.span.text) for fault in graph.faults]
    substitution = LaunchFaultKind.SUBSTITUTION
    assert told == [(substitution, "arg", "$(arg x)"), (substitution, "find", "$(find p)")]
