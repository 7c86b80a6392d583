"""The real launch files: they expand, and every bridge in them is read."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.graph import LaunchFaultKind, LaunchGraph
from checker.launch.ros1.launch_file import MissingLaunchFile
from checker.source.text import SourceText
from checker.source.text_file import decode
from checker.source.xml import XmlDocument, parse_xml
from support.real_packages import CORPUS, named_folder, needs

FOLDER = named_folder(CORPUS)
FILES = sorted(FOLDER.glob("*/launch/*.launch")) if FOLDER else []
BRIDGES = {
    "cerberus_anymal_c_sensor_config_1": 28,
    "coro_crystal_sensor_config_1": 16,
    "coro_jeanine_sensor_config_1": 24,
    "coro_mike_sensor_config_1": 24,
    "coro_pam_sensor_config_1": 22,
    "coro_rocky_sensor_config_1": 21,
    "costar_husky_sensor_config_1": 13,
    "csiro_data61_ozbot_atr_sensor_config_1": 20,
    "ctu_cras_norlab_absolem_sensor_config_1": 21,
    "emesent_hovermap_sensor_config_1": 17,
    "explorer_ds1_sensor_config_1": 25,
    "robotika_freyja_sensor_config_1": 29,
    "x1_sensor_config_6": 12,
    "x2_sensor_config_7": 12,
}
pytestmark = needs(CORPUS)


def read(path: Path, file: str) -> XmlDocument:
    document = parse_xml(SourceText(file, decode(path.read_bytes())))
    assert isinstance(document, XmlDocument), document
    return document


def expand(path: Path, **arguments: str) -> LaunchGraph:
    folder = path.parent.parent

    def read_launch(package: str, file: str, from_file: str) -> XmlDocument | str:
        assert from_file
        if package:
            return f"package {package} is not available"
        target = folder / file
        return read(target, file) if target.exists() else MissingLaunchFile(file)

    return expand_launch(read(path, f"launch/{path.name}"), arguments, read_launch)


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parts[-3]}/{path.name}")
def test_every_real_launch_file_expands_without_a_fault_that_is_not_real(path):
    given = {
        "vehicle_topics.launch": {"name": "X", "world_name": "w", "breadcrumbs": "1"},
        "description.launch": {"name": "X"},
        "flipper_control.launch": {"robot_name": "X", "joint_prefix": "front_left"},
    }.get(path.name, {})
    graph = expand(path, **given)
    faults = [(fault.kind, fault.span.text) for fault in graph.faults]
    real = []
    if (path.parts[-3], path.name) == ("coro_mike_sensor_config_1", "vehicle_topics.launch"):
        # The file asks for an arg `thermal` that it does not declare.
        real = [(LaunchFaultKind.UNDECLARED_ARG, "$(arg thermal)")]
    assert faults == real


@pytest.mark.parametrize("package", sorted(BRIDGES))
def test_every_bridge_is_read_and_marked_where_it_is_written(package, corpus):
    path = corpus / package / "launch/vehicle_topics.launch"
    graph = expand(path, name="X", world_name="w", breadcrumbs="1")
    written = [bridge for bridge in graph.bridges if not bridge.node.assumed_from]
    assert len(written) == BRIDGES[package]
    programs = {"parameter_bridge", "image_bridge"}
    assert len(graph.bridges) == sum(node.type in programs for node in graph.nodes)
    for bridge in written:
        # Every arg that stands in the text has its value in the topic.
        around = re.split(r"\$\([^)]*\)", bridge.span.text)
        assert all(part in bridge.ign_topic for part in around)
        assert bridge.ros_topic.startswith("/X/"), "each topic is remapped into the namespace"
        if "/sensor/" in bridge.ign_topic:
            assert bridge.sensor is not None
            assert (bridge.sensor.world, bridge.sensor.model) == ("w", "X")
