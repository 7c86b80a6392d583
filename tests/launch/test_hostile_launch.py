"""Launch files that mean harm end within limits, and what is wrong with them is said."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from checker.launch.ros1.attributes import MAX_STEPS, Reader
from checker.launch.ros1.expansion import MAX_DEPTH
from checker.launch.ros1.graph import LaunchFaultKind as Kind
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.ros.robot_description import robot_descriptions
from checker.rule_testing import write_example
from checker.settings import Settings
from checker.source.xml import Element
from tests.effort import limited

TOPICS = "launch/vehicle_topics.launch"
SECONDS = 30.0
"""Of work: the most that one of them may be."""


def checked(tmp_path: Path, files: dict[str, str], *rules: str) -> PackageReport:
    package = write_example(files, tmp_path)
    with limited(SECONDS):
        (report,) = check_package(package, Settings(select=rules or ("ROS", "SDF001"))).packages
    assert not [each for each in report.not_checked if each.cause.name == "CRASHED"]
    return report


def reasons(report: PackageReport, rule: str) -> str:
    return "; ".join(each.reason for each in report.not_checked if each.rule == rule)


def messages(report: PackageReport, rule: str) -> list[str]:
    return [each.message for each in report.findings if each.rule == rule]


def launch(content: str) -> str:
    return f'<launch><arg name="name"/><arg name="world_name"/>{content}</launch>\n'


def test_a_file_that_includes_itself_is_reported(tmp_path):
    text = launch('<include file="$(dirname)/vehicle_topics.launch" pass_all_args="true"/>')
    assert "includes itself" in messages(checked(tmp_path, {TOPICS: text}), "ROS010")[0]


def test_a_file_that_includes_itself_with_a_growing_arg_is_not_followed_for_ever(tmp_path):
    text = launch(
        '<arg name="n" default="x"/><include file="$(dirname)/vehicle_topics.launch">'
        '<arg name="name" value="a"/><arg name="world_name" value="w"/>'
        '<arg name="n" value="$(arg n)$(arg n)"/></include>'
    )
    report = checked(tmp_path, {TOPICS: text})
    assert "not read completely" in reasons(report, "ROS010")


@pytest.mark.slow
def test_a_long_chain_of_includes_is_followed_to_a_limit(tmp_path):
    files = {
        f"launch/l{n}.launch": f'<launch><include file="$(dirname)/l{n + 1}.launch"/></launch>\n'
        for n in range(10_000)
    }
    files[TOPICS] = launch('<include file="$(dirname)/l0.launch"/>')
    package = checked(tmp_path, files, "ROS010")
    assert f"more than {MAX_DEPTH} levels" in reasons(package, "ROS010")


@pytest.mark.slow
def test_a_file_that_includes_another_many_times_over_ends(tmp_path, monkeypatch):
    files = {
        f"launch/l{n}.launch": "<launch>"
        + f'<include file="$(dirname)/l{n + 1}.launch"/>' * 10
        + "</launch>\n"
        for n in range(20)
    }
    files["launch/l20.launch"] = "<launch/>\n"
    files[TOPICS] = launch('<include file="$(dirname)/l0.launch"/>')
    followed = Counter[str]()
    charge = Reader.charge

    def count(reader: Reader, element: Element, steps: int) -> bool:
        followed[element.tag] += 1
        return charge(reader, element, steps)

    monkeypatch.setattr(Reader, "charge", count)
    assert "steps to evaluate" in reasons(checked(tmp_path, files, "ROS010"), "ROS010")
    assert 0 < followed["include"] <= 3 * MAX_STEPS


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    [
        '<node pkg="p" type="t" name="n" args="{}"/>',
        '<param name="$(arg name)/robot_description" command="{}"/>',
        '<remap from="a" to="{}"/>',
        '<node>pkg="p" type="t" name="{}"></node>',
    ],
)
def test_texts_of_a_megabyte_take_no_longer_than_others(tmp_path, line):
    for filling in ("x" * 1_000_000, "$(arg name) " * 80_000, "a:=b " * 200_000):
        checked(tmp_path / filling[:4].strip("$("), {TOPICS: launch(line.format(filling))})


def test_entities_are_not_expanded(tmp_path):
    entities = '<!ENTITY a "ha">' + "".join(
        f'<!ENTITY {chr(98 + n)} "{f"&{chr(97 + n)};" * 10}">' for n in range(12)
    )
    text = f"<?xml version='1.0'?><!DOCTYPE launch [{entities}]><launch>&m;</launch>\n"
    report = checked(tmp_path, {TOPICS: text})
    assert messages(report, "SDF001")


def test_many_unknown_tags_and_attributes_are_reported_in_time(tmp_path):
    unknown = "".join(f'<nod{n} a{n}="1"/><remap srom{n}="a" to="b"/>' for n in range(5_000))
    assert messages(checked(tmp_path, {TOPICS: launch(unknown)}), "ROS009")


def test_many_nodes_of_one_name_are_one_finding(tmp_path):
    nodes = '<node pkg="p" type="t" name="n"/>' * 5_000
    (finding,) = [
        each
        for each in checked(tmp_path, {TOPICS: launch(nodes)}).findings
        if each.rule == "ROS008"
    ]
    assert "5000 nodes" in finding.message
    assert len(finding.places) < 50


def test_an_arg_that_is_only_given_can_be_used(expand):
    node = '<node pkg="p" type="t" name="n" args="$(arg thermal)"/>'
    graph = expand(node, {"thermal": "1"})
    assert [each.args for each in graph.nodes] == ["1"]
    assert not graph.faults
    assert [each.kind for each in expand(node).faults] == [Kind.UNDECLARED_ARG]


@pytest.mark.parametrize(
    ("command", "files", "arguments"),
    [
        ("$(find xacro)/xacro '$(find p)/urdf/a.xacro' name:=x", [("p", "urdf/a.xacro")], "x"),
        ('xacro "$(find p)/a b.xacro" name:=', [("p", "a b.xacro")], ""),
        ("$(dirname)/../scripts/make name:=x", [("", "scripts/make")], "x"),
        ("cat /somewhere/else.urdf", [], None),
        ("'", [], None),
    ],
)
def test_the_command_of_a_description_is_taken_apart(expand, command, files, arguments):
    escaped = command.replace('"', "&quot;")
    graph = expand(f'<param name="x/robot_description" command="{escaped}"/>')
    (description,) = robot_descriptions(graph)
    assert [(file.package, file.path) for file in description.files] == files
    assert description.arguments.get("name") == arguments
    assert description.namespace == "/x"
