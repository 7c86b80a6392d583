"""Every version of SDF, by one small model in its way of writing."""

from __future__ import annotations

import pytest

from checker.formats.sdf.document import sdf_version
from checker.formats.sdf.reader import read_sdf
from checker.formats.sdf.schema import VERSIONS, walk
from tests.model.robots import Matrix, assert_pose, document, pose, sdf

A, B = pose(1, 2, 3, 0.1, 0.2, 0.3), pose(-1, 0.5, 0, -0.4, 0.5, 0.6)

PLAIN = """<link name="a"><pose>1 2 3 0.1 0.2 0.3</pose></link>
    <link name="b"><pose>-1 0.5 0 -0.4 0.5 0.6</pose></link>"""
CHAIN = """<link name="a"><pose>1 2 3 0.1 0.2 0.3</pose></link>
    <link name="b"><pose {}="a">-1 0.5 0 -0.4 0.5 0.6</pose></link>"""
NESTED = """<model name="m"{}><pose>1 2 3 0.1 0.2 0.3</pose>
    <link name="b"><pose>-1 0.5 0 -0.4 0.5 0.6</pose></link></model>"""

# version, content, the last link's name and pose
TABLE: list[tuple[str, str, str, Matrix]] = [
    ("1.4", PLAIN, "b", B),
    ("1.5", PLAIN, "b", B),
    ("1.6", CHAIN.format("frame"), "b", A @ B),
    ("1.7", CHAIN.format("relative_to"), "b", A @ B),
    ("1.8", NESTED.format(' placement_frame="b"'), "m::b", A),
    ("1.9", PLAIN.replace("<pose>", '<pose degrees="false">'), "b", B),
    ("1.10", NESTED.format(""), "m::b", A @ B),
    ("1.11", CHAIN.format("relative_to"), "b", A @ B),
    ("1.12", CHAIN.format("relative_to"), "b", A @ B),
]


def test_the_table_has_every_version() -> None:
    assert tuple(row[0] for row in TABLE) == VERSIONS


@pytest.mark.parametrize(("version", "content", "name", "expected"), TABLE)
def test_version(version: str, content: str, name: str, expected: Matrix) -> None:
    robot = sdf(content, version)
    assert robot.version == version
    assert robot.faults == ()
    assert robot.links[-1].scoped_name == name
    assert_pose(robot.pose_of(name), expected)
    unknown = [element for element, kind in walk(robot.document.root, version) if kind is None]
    assert unknown == []


@pytest.mark.parametrize(
    ("written", "read"),
    [("1.10", (1, 10)), (" 1.7 ", (1, 7)), ("", (1, 6)), ("1", (1, 6)), ("a.b", (1, 6))],
)
def test_the_version_as_written(written: str, read: tuple[int, int]) -> None:
    assert sdf_version(document(f'<sdf version="{written}"/>')) == read


def test_models_of_a_world_and_a_bare_model() -> None:
    in_world = '<sdf version="1.6"><world name="w"><model name="a"/></world><model name="b"/></sdf>'
    assert [robot.name.value for robot in read_sdf(document(in_world))] == ["b", "a"]
    assert [robot.name.value for robot in read_sdf(document('<model name="c"/>'))] == ["c"]
