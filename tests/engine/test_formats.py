"""A format of another distribution: its files are checked like those of ours."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.formats import model_suffixes, robot_suffixes
from tests.engine.test_discovery import command

TOY = """
from subt_check.formats.content import Content
from subt_check.model.components import Link, Pose
from subt_check.model.conventions import Conventions
from subt_check.model.frames import MODEL_FRAME, FrameGraph, FrameNode
from subt_check.model.geometry.transform import Transform
from subt_check.model.robot import Robot
from subt_check.package.formats import Format
from subt_check.source.text import Located

FORMAT = Format("toy", (".toy",), ("toy",), reader="acme_toy:read")
CONVENTIONS = Conventions(
    joint_types="sdf",
    joint_posed_in="child",
    has_frames=True,
    has_default_axis=False,
    has_massless_links=False,
    merges_fixed_links=False,
    states_start=True,
    states_devices=True,
)


def read(document, package):
    root = document.root
    pose, graph = Pose(Transform(), "", (), root.span), FrameGraph()
    graph.add(MODEL_FRAME, FrameNode(None, Transform(), root.span, "the model"))
    links = []
    for brick in root.all("brick"):
        name = brick.attribute("name")
        graph.add(name.value, FrameNode(MODEL_FRAME, Transform(), brick.span, "a brick"))
        yes, no = Located(True, brick.span), Located(False, brick.span)
        links.append(Link(name, brick, name.value, pose, None, (), (), (), (), yes, no))
    name = root.attribute("name")
    return Content(
        (
            Robot(
                name, root, document, "toy", CONVENTIONS, "1", pose, tuple(links), (), (), (), (),
                graph,
            ),
        )
    )
"""
ROBOT = '<toy name="duck">\n  <brick name="body"/>\n</toy>\n'


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A folder like site-packages, with a distribution that brings a format."""
    folder = tmp_path / "site"
    about = folder / "acme_toy-1.0.dist-info"
    about.mkdir(parents=True)
    (folder / "acme_toy.py").write_text(TOY)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-toy\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[subt_check.formats]\ntoy = acme_toy:FORMAT\n")
    return folder


def test_a_file_of_another_format_is_checked_alone(site: Path, tmp_path: Path) -> None:
    (tmp_path / "duck.toy").write_text(ROBOT)
    done = command(site, str(tmp_path / "duck.toy"), "--info")
    assert "duck.toy:2:3 info INE001 no-inertia: link 'body' has no" in done.stdout, done.stdout
    assert "robot duck, mass 1 kg, 1 link, 0 joints" in done.stdout


def test_a_package_may_have_its_robot_in_another_format(site: Path, tmp_path: Path) -> None:
    package = tmp_path / "duck_description"
    package.mkdir()
    (package / "package.xml").write_text(
        "<package format='3'><name>duck_description</name><version>1.0.0</version></package>"
    )
    (package / "duck.toy").write_text(ROBOT)
    done = command(site, str(package), "--format", "json")
    assert '"rule": "INE001"' in done.stdout, done.stdout


def test_without_the_distribution_the_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "duck.toy").write_text(ROBOT)
    done = command(tmp_path, str(tmp_path / "duck.toy"))
    assert done.returncode == 2
    assert "is not a package, archive or model file" in done.stderr


def test_a_world_is_no_file_of_a_robot() -> None:
    assert "arm.sdf.xacro".endswith(robot_suffixes())
    assert not "yard.world".endswith(robot_suffixes())
    assert "yard.world".endswith(model_suffixes())
