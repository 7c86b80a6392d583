"""Launch files of subt_ros where it lies beside the submissions: read, and shown where included."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.judge import Judge
from checker.engine.run import run_rules
from checker.engine.subject import Subject
from checker.finding import Severity
from checker.launch.ros1.graph import LaunchGraph
from checker.package.inputs import open_input
from checker.rule_testing import write_example
from checker.rulebook.discovery import all_rules
from checker.rulebook.example_files import NAME
from checker.rulebook.profiles import profile
from checker.settings import Settings

IMU = """<launch>
  <arg name="gazebo_topic"/>
  <arg name="ros_topic" default="imu/raw"/>
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="imu"
        args="$(arg gazebo_topic)@sensor_msgs/Imu[ignition.msgs.IMU">
    <remap from="$(arg gazebo_topic)" to="$(arg ros_topic)"/>
  </node>
</launch>
"""
TOPICS = """<launch>
  <arg name="name"/>
  <arg name="world_name"/>
  <include file="$(find subt_ros)/launch/models_common/imu.launch">
    <arg name="gazebo_topic" value="/world/w/model/m/link/base_link/sensor/imu/imu"/>
  </include>
</launch>
"""


def graph_in(workspace: Path, space: Path) -> LaunchGraph:
    example = {"launch/vehicle_topics.launch": TOPICS}
    package = write_example(example, workspace)
    launch = space / "subt_ros/launch/models_common/imu.launch"
    launch.parent.mkdir(parents=True)
    launch.write_text(IMU)
    (space / "subt_ros/package.xml").write_text("<package><name>subt_ros</name></package>")
    with open_input(package) as opened:
        graph = Subject(opened.packages[0]).one(LaunchGraph)
    assert not isinstance(graph, NotAvailable)
    return graph


@pytest.mark.parametrize("place", ["", "submitted_models", "submitted_models/team"])
def test_beside_and_above_the_submissions(place: str, tmp_path: Path) -> None:
    workspace = tmp_path / place
    workspace.mkdir(parents=True, exist_ok=True)
    graph = graph_in(workspace, tmp_path)
    (bridge,) = graph.bridges
    assert bridge.ros_topic == "/imu/raw"
    assert bridge.node.assumed_from == ""
    assert bridge.span.source.file == "launch/vehicle_topics.launch"
    assert bridge.span.text.startswith("<include")
    assert graph.unseen_bridges == ()


def test_it_is_no_undeclared_sibling(tmp_path: Path) -> None:
    graph_in(tmp_path, tmp_path)
    rules = [rule for rule in all_rules() if rule.id == "PKG007"]
    with open_input(tmp_path / NAME) as opened:
        outcome = run_rules(rules, Subject(opened.packages[0]), Judge(profile("subt"), Settings()))
    assert [found.severity for found in outcome.findings] == [Severity.INFO]


def test_no_other_package_above_is_looked_at(tmp_path: Path) -> None:
    workspace = tmp_path / "submitted_models"
    workspace.mkdir()
    (tmp_path / "other").mkdir()
    (tmp_path / "other/package.xml").write_text("<package/>")
    with open_input(write_example({}, workspace)) as opened:
        (package,) = opened.packages
        assert package.workspace.package("other") is None
        assert package.workspace.package("subt_ros") is None
        assert package.workspace.package(NAME) is package


def test_nothing_outside_an_archive_is_looked_at(tmp_path: Path) -> None:
    package = write_example({}, tmp_path)
    archive = shutil.make_archive(str(tmp_path / "upload"), "zip", tmp_path, package.name)
    with open_input(Path(archive)) as opened:
        workspace = opened.packages[0].workspace
        (place,) = workspace.directories
        beyond = place.parent / "subt_ros"
        beyond.mkdir()
        (beyond / "package.xml").write_text("<package/>")
        assert workspace.package("subt_ros") is None
