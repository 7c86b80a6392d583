"""Templates of the challenge's own package: what they are assumed to start."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.resources import table
from checker.launch.ros1.assumed_files import assumed_bridges, assumed_nodes
from checker.launch.ros1.bridge import PROGRAMS, BridgeKind
from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.graph import LaunchGraph, UnresolvedInclude
from checker.source.text import SourceText, Span
from checker.source.xml import XmlDocument
from tests.launch.conftest import document

TEMPLATES = table("models_common")["templates"]
SENSOR = "/world/w/model/X1/link/base/sensor/front"


def expand(content: str) -> LaunchGraph:
    text = f'<launch><group ns="X1">{content}</group></launch>'
    main = document("launch/main.launch", text)
    return expand_launch(main, {}, not_at_hand)


def not_at_hand(package: str, path: str, from_file: str) -> XmlDocument | str:
    return f"{path} of {package}, included by {from_file}, is not available"


def include(file: str, **arguments: str) -> str:
    args = "".join(f'<arg name="{name}" value="{value}"/>' for name, value in arguments.items())
    return f'<include file="$(find subt_ros)/launch/models_common/{file}">{args}</include>'


def test_a_camera_template_bridges_image_and_camera_info() -> None:
    graph = expand(include("rgb_camera.launch", gazebo_topic=SENSOR, ros_topic="rear"))
    assert {(bridge.ign_topic, bridge.ros_topic) for bridge in graph.bridges} == {
        (f"{SENSOR}/image", "/X1/rear/image_raw"),
        (f"{SENSOR}/camera_info", "/X1/rear/camera_info"),
    }
    assert {bridge.node.assumed_from for bridge in graph.bridges} == {"rgb_camera.launch"}
    assert all(node.span.text.startswith("<include") for node in graph.nodes)
    assert graph.assumed_includes == graph.unresolved_includes
    assert graph.unseen_bridges == ()


def test_a_template_that_is_not_known_or_lacks_an_arg_leaves_the_bridges_unknown() -> None:
    for content in (include("radar.launch"), include("rgb_camera.launch", ros_topic="rear")):
        graph = expand(content)
        assert graph.bridges == graph.assumed_includes == ()
        assert len(graph.unseen_bridges) == 1


def test_a_template_that_is_switched_off_leaves_dormant_bridges() -> None:
    content = include("imu.launch", gazebo_topic=f"{SENSOR}/imu")
    graph = expand(content.replace("<include", '<include if="0"'))
    assert graph.bridges == ()
    assert [bridge.ign_topic for bridge in graph.dormant_bridges] == [f"{SENSOR}/imu"]


def test_an_include_that_is_switched_off_and_not_known_is_told() -> None:
    graph = expand('<include if="0" file="$(find other)/a.launch"/>')
    assert [each.file for each in graph.dormant_includes] == ["a.launch"]
    assert graph.unseen_bridges == ()


def test_remaps_around_an_include_reach_its_nodes() -> None:
    content = include("imu.launch", gazebo_topic="/imu", ros_topic="raw")
    (bridge,) = expand(f'<group><remap from="raw" to="imu"/>{content}</group>').bridges
    assert bridge.ros_topic == "/X1/raw"
    (bridge,) = expand(
        f'<group><remap from="/imu" to="x"/>'
        f"{include('imu.launch', gazebo_topic='/imu', ros_topic='y')}</group>"
    ).bridges
    assert bridge.ros_topic == "/X1/y"


@pytest.mark.parametrize("file", TEMPLATES)
def test_every_template_reads(file: str) -> None:
    template: dict[str, Any] = TEMPLATES[file]
    assert template["source"]
    arguments = {name: f"/{name}" for name in template["args"]}
    graph = expand(include(file, **arguments))
    assert len(graph.nodes) == len(template["nodes"])
    bridging = [node for node in graph.nodes if node.type in PROGRAMS]
    assert len(graph.bridges) == len(bridging)
    assert all("{" not in f"{node.name}{node.args}" for node in graph.nodes)
    for bridge in graph.bridges:
        assert bridge.kind is PROGRAMS[bridge.node.type]
        assert bridge.kind is BridgeKind.IMAGE or bridge.ros_topic != bridge.ign_topic


@given(st.sampled_from(sorted(TEMPLATES)), st.dictionaries(st.text(max_size=8), st.text()))
def test_no_argument_breaks_it(file: str, arguments: dict[str, str]) -> None:
    source = SourceText("a.launch", "<include/>")
    given_args = {"gazebo_topic": "", "name": "{ros_topic}", **arguments}
    path = f"launch/models_common/{file}"
    missing = UnresolvedInclude("subt_ros", path, given_args, "/", "", Span(source, 0, 10))
    for node in assumed_nodes(missing) or ():
        assumed_bridges(node)
