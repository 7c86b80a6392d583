"""Samples and real packages as GLB: whole, small, and where the robot is."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import trimesh

from checker.base.cache import Cache
from checker.engine.display import BYTES, display_of, without_layers
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.trial.trial import Trial
from checker.report.scene.builder import scene_of
from checker.report.scene.glb import glb_of
from checker.report.scene.mesh_files import MeshFiles, NoSurfaces
from checker.report.scene.scene import Layer
from tests.conftest import SAMPLES
from tests.display.glb_reader import Glb, read_glb
from tests.trial.machines import trial_in_child

NAMES = sorted(folder.name for folder in SAMPLES.iterdir() if (folder / "package.xml").is_file())
HUSKY = "husky_migration_sensor_config_1"


@contextmanager
def robot_of(folder: Path, cache: Path) -> Iterator[Robot]:
    with open_input(folder) as opened:
        subject = Subject(opened.packages[0], Cache(cache))
        try:
            robots = subject.all(Robot)
            assert isinstance(robots, tuple)
            yield robots[0]
        finally:
            subject.close()


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("kept")


def trial_of(robot: Robot, cache: Path) -> Trial:
    trial = trial_in_child(robot, Cache(cache))
    assert isinstance(trial, Trial)
    return trial


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_every_sample_is_shown_as_large_as_it_is(name: str, kept: Path) -> None:
    with robot_of(SAMPLES / name, kept) as robot:
        assert isinstance(robot.meshes, PackageMeshes)
        surfaces = MeshFiles(robot.meshes)
        scene = scene_of(robot, None, surfaces)
        marks = set(Layer) - {Layer.VISUAL, Layer.COLLISION}
        shown = trimesh.load(io.BytesIO(glb_of(without_layers(scene, marks))), file_type="glb")
        boxes = [robot.box_of(link) for link in robot.links if link.visuals or link.collisions]
        # What a broken sample cannot show has no box either.
        known = [box for box in boxes if box is not None]
        if len(known) < len(boxes):
            return
        (x, y, z), (a, b, c) = (
            np.min([box.low for box in known], axis=0),
            np.max([box.high for box in known], axis=0),
        )
        np.testing.assert_allclose(shown.bounds, [(x, z, -b), (a, c, -y)], rtol=0, atol=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_every_part_leads_to_an_element(name: str, kept: Path) -> None:
    with robot_of(SAMPLES / name, kept) as robot:
        display = display_of(robot, None, NoSurfaces())
        assert display is not None
        documents = (robot.document, *(model.definition.document for model in robot.models))
        there = {element.path for document in documents for element in document.elements}
        glb = read_glb(display.glb)
        shown = {node["extras"]["element"] for node in glb.nodes if "extras" in node}
        assert shown
        assert shown <= there
        assert {link.element.path for link in robot.links} <= shown


@pytest.fixture(scope="module")
def husky(kept: Path) -> tuple[Robot, Trial, Glb]:
    with robot_of(SAMPLES / HUSKY, kept) as robot:
        trial = trial_of(robot, kept)
        display = display_of(robot, trial, NoSurfaces())
        assert display is not None
        return robot, trial, read_glb(display.glb)


def track(glb: Glb, node: int) -> dict[str, np.ndarray]:
    """Return the keys of an animated node by path."""
    (animation,) = glb.said["animations"]
    samplers = animation["samplers"]
    return {
        channel["target"]["path"]: glb.array(samplers[channel["sampler"]]["output"])
        for channel in animation["channels"]
        if channel["target"]["node"] == node
    }


def test_links_start_where_the_robot_has_them(husky: tuple[Robot, Trial, Glb]) -> None:
    robot, _, glb = husky
    (base,) = glb.find(kind="link", name="base_link")
    wheels = [link.scoped_name for link in robot.wheels]
    assert len(wheels) == 4
    for name in wheels:
        (node,) = glb.find(kind="link", name=name)
        away = track(glb, node)["translation"][0] - track(glb, base)["translation"][0]
        pose, of_base = robot.pose_of(name), robot.pose_of("base_link")
        assert pose is not None
        assert of_base is not None
        expected = np.subtract(pose.translation, of_base.translation)
        np.testing.assert_allclose(away, expected, atol=2e-3)
        np.testing.assert_allclose(
            glb.nodes[node]["translation"], track(glb, node)["translation"][0]
        )


def test_wheels_turn_as_far_as_the_robot_drives(husky: tuple[Robot, Trial, Glb]) -> None:
    robot, trial, glb = husky
    drive = next(leg for leg in trial.legs if leg.name == "drive")
    assert trial.replay is not None
    time = np.array(trial.replay.time)
    # When it has the commanded speed, and before it stops.
    during = (time > drive.start + 0.5 * (drive.end - drive.start)) & (time < drive.end)
    (base,) = glb.find(kind="link", name="base_link")
    places = track(glb, base)["translation"][during]
    driven = np.linalg.norm(np.diff(places, axis=0), axis=1).sum()
    for wheel in robot.locomotion.wheels:
        (node,) = glb.find(kind="link", name=wheel.link.scoped_name)
        turns = track(glb, node)["rotation"][during]
        steps = np.abs((turns[1:] * turns[:-1]).sum(axis=1))
        turned = 2 * np.arccos(np.clip(steps, 0.0, 1.0)).sum()
        assert turned * wheel.radius == pytest.approx(driven, rel=0.03)


def test_what_is_fixed_hangs_on_what_carries_it(husky: tuple[Robot, Trial, Glb]) -> None:
    _, trial, glb = husky
    assert trial.replay is not None
    for name in trial.replay.poses:
        (node,) = glb.find(kind="link", name=name)
        assert glb.nodes[glb.parents[node]]["name"] == "world"
    for name, carrier in trial.replay.carriers.items():
        (node,) = glb.find(kind="link", name=name)
        assert glb.nodes[glb.parents[node]]["name"] == carrier
        assert not track(glb, node)


def test_real_packages_are_shown_within_the_limit(corpus: Path, kept: Path) -> None:
    with open_input(corpus) as opened:
        for package in opened.packages:
            subject = Subject(package, Cache(kept))
            try:
                robots = subject.all(Robot)
                if not isinstance(robots, tuple):
                    continue
                assert isinstance(robots[0].meshes, PackageMeshes)
                surfaces = MeshFiles(robots[0].meshes)
                display = display_of(robots[0], trial_of(robots[0], kept), surfaces)
                assert display is not None, package.name
                assert len(display.glb) <= BYTES, package.name
                glb = read_glb(display.glb)
                for layer in Layer:
                    assert glb.find(layer=str(layer)), f"{package.name}: {layer}"
            finally:
                subject.close()
