"""Scenes become GLB files that say the same."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from checker.model.geometry.transform import Transform
from checker.physics.mesh.surface import Surface
from checker.report.scene.glb import glb_of
from checker.report.scene.glb_meshes import linear
from checker.report.scene.primitives import box, cylinder
from checker.report.scene.scene import DisplayScene, Item, Layer, LinkNode, Tracks
from tests.display.glb_reader import read_glb
from tests.effort import examples

PLACES = st.tuples(*[st.floats(-100, 100)] * 3)
TURNS = st.tuples(*[st.floats(-3.2, 3.2)] * 3)
POSES = st.builds(Transform.from_xyz_rpy, PLACES, TURNS)
SCALES = st.tuples(*[st.floats(0.01, 10).flatmap(lambda size: st.sampled_from([size, -size]))] * 3)
COLOURS = st.tuples(*[st.floats(0, 1)] * 4)
HOSTILE = [
    '</script><script>alert("x")',
    "'\"\\\n\x00\x1b[2J",
    "\u202egnp.exe",
    "😀" * 300,
    "\ud800",
]
NAMES = st.one_of(st.sampled_from(HOSTILE), st.text(max_size=20))


@st.composite
def surfaces(draw: st.DrawFn) -> Surface:
    if draw(st.booleans()):
        return draw(st.sampled_from([box(), cylinder()]))
    count = draw(st.integers(3, 12))
    rows = st.lists(PLACES, min_size=count, max_size=count)
    vertices = np.array(draw(rows), dtype=np.float32)
    corner = st.integers(0, count - 1)
    faces = draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=9))
    byte = st.integers(0, 255)
    paint = draw(
        st.none() | st.lists(st.tuples(byte, byte, byte, byte), min_size=count, max_size=count)
    )
    colours = None if paint is None else np.array(paint, dtype=np.uint8)
    return Surface(vertices, np.array(faces, dtype=np.uint32), draw(COLOURS), colours)


ITEMS = st.builds(
    Item,
    layer=st.sampled_from(Layer),
    name=NAMES,
    element=NAMES,
    pose=POSES,
    surfaces=st.lists(surfaces(), min_size=1, max_size=3).map(tuple),
    scale=SCALES,
)


@st.composite
def scenes(draw: st.DrawFn) -> DisplayScene:
    count = draw(st.integers(0, 4))
    links = [
        LinkNode(f"l{i}", draw(NAMES), draw(POSES), tuple(draw(st.lists(ITEMS, max_size=3))))
        for i in range(count)
    ]
    links += [
        LinkNode(f"c{i}", "", draw(POSES), tuple(draw(st.lists(ITEMS, max_size=1))), f"l{i}")
        for i in range(draw(st.integers(0, count)))
    ]
    samples = draw(st.integers(0, 5))
    if not samples:
        return DisplayScene(draw(NAMES), tuple(links))
    number = st.floats(-1, 1, width=32)
    rows = st.lists(st.tuples(*[number] * 3, *[number] * 4), min_size=samples, max_size=samples)
    poses = {f"l{i}": np.array(draw(rows), dtype=np.float32) for i in range(count)}
    for each in poses.values():
        each[np.linalg.norm(each[:, 3:], axis=1) < 0.1, 3] = 1.0
    return DisplayScene(
        draw(NAMES), tuple(links), Tracks(np.arange(samples) / np.float32(20), poses)
    )


@settings(max_examples=examples(40))
@given(scenes())
def test_every_scene_is_a_valid_file(scene: DisplayScene) -> None:
    glb = read_glb(glb_of(scene))
    assert len(glb.find(kind="link")) == len(scene.links)
    moving = scene.tracks is not None and len(scene.tracks.time) > 1 and bool(scene.tracks.poses)
    assert ("animations" in glb.said) == moving


@settings(max_examples=examples(40))
@given(scenes())
def test_everything_stands_where_the_scene_has_it(scene: DisplayScene) -> None:
    glb, poses = read_glb(glb_of(scene)), scene.poses()
    links = glb.find(kind="link")
    for number, link in zip(
        links, sorted(scene.links, key=lambda link: link.name[0] == "c"), strict=True
    ):
        children = [each for each in glb.nodes[number].get("children", ()) if each not in links]
        for child, item in zip(children, link.items, strict=True):
            pose = poses[link.name] @ item.pose
            local = np.concatenate([each.vertices for each in item.surfaces]).astype(float)
            expected = (local * item.scale) @ np.array(pose.rotation).T + pose.translation
            np.testing.assert_allclose(glb.corners(child), expected, atol=1e-2)


def test_a_mesh_that_is_used_again_is_stored_once() -> None:
    vertices = np.eye(3, dtype=np.float32)
    one = Surface(vertices, np.array([[0, 1, 2]], dtype=np.uint32))
    items = [
        Item(Layer.VISUAL, str(size), "", Transform(), (one,), (size, 1.0, -1.0))
        for size in (1.0, 2.0)
    ]
    glb = read_glb(glb_of(DisplayScene("r", (LinkNode("l", "", Transform(), tuple(items)),))))
    assert len(glb.said["meshes"]) == len(glb.said["materials"]) == 1
    assert [glb.nodes[number]["scale"][0] for number in glb.find(layer="visual")] == [1.0, 2.0]


def test_colours_become_linear_and_only_clear_ones_are_blended() -> None:
    assert linear((0.5, 0.0, 1.0, 0.5)) == pytest.approx([0.21404, 0.0, 1.0, 0.5], abs=1e-5)
    paint = np.array([[188, 0, 255, 255]] * 8, dtype=np.uint8)
    surface = Surface(box().vertices, box().faces, (1.0, 1.0, 1.0, 1.0), paint)
    item = Item(Layer.VISUAL, "v", "", Transform(), (surface,))
    clear = Item(
        Layer.COLLISION,
        "c",
        "",
        Transform(),
        (Surface(box().vertices, box().faces, (1, 1, 1, 0.5)),),
    )
    glb = read_glb(glb_of(DisplayScene("r", (LinkNode("l", "", Transform(), (item, clear)),))))
    first = glb.said["meshes"][0]["primitives"][0]
    accessor = first["attributes"]["COLOR_0"]
    assert glb.array(accessor)[0].tolist() == [128, 0, 255, 255]
    assert glb.said["accessors"][accessor]["normalized"]
    modes = [material.get("alphaMode", "OPAQUE") for material in glb.said["materials"]]
    assert modes == ["OPAQUE", "BLEND"]
    assert all(material["doubleSided"] for material in glb.said["materials"])


def test_large_meshes_have_indices_of_four_bytes() -> None:
    count = 70_000
    vertices = np.zeros((count, 3), dtype=np.float32)
    faces = np.array([[0, 1, count - 1]], dtype=np.uint32)
    item = Item(Layer.VISUAL, "v", "", Transform(), (Surface(vertices, faces),))
    glb = read_glb(glb_of(DisplayScene("r", (LinkNode("l", "", Transform(), (item,)),))))
    indices = glb.said["meshes"][0]["primitives"][0]["indices"]
    assert glb.array(indices)[:, 0].tolist() == [0, 1, count - 1]


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_names_survive(name: str) -> None:
    scene = DisplayScene(name, (LinkNode(name, name, Transform(), ()),))
    (number,) = (glb := read_glb(glb_of(scene))).find(kind="link")
    said = glb.nodes[number]["extras"]["name"]
    assert said == name[:199] + "…" if len(name) > 200 else said == name.replace("\ud800", "?")


def test_a_track_turns_the_short_way_though_its_quaternion_changes_sign() -> None:
    turns = Rotation.from_euler("z", np.linspace(0.0, 6.0, 30)[:, None])
    poses = np.zeros((30, 7), dtype=np.float32)
    poses[:, 3:] = np.roll(turns.as_quat(), 1, axis=1) * np.resize([1, -1], 30)[:, None]
    tracks = Tracks(np.arange(30, dtype=np.float32), {"l": poses})
    glb = read_glb(glb_of(DisplayScene("r", (LinkNode("l", "", Transform(), ()),), tracks)))
    (animation,) = glb.said["animations"]
    rotation = glb.array(animation["samplers"][1]["output"])
    back = Rotation.from_quat(rotation)
    np.testing.assert_allclose((back * turns.inv()).magnitude(), 0.0, atol=1e-3)


def test_the_size_is_that_of_the_shapes_where_the_motion_begins() -> None:
    item = Item(Layer.VISUAL, "v", "", Transform(translation=(1.0, 0.0, 0.0)), (box(),), (2, 2, 2))
    far = Item(Layer.VIEW, "s", "", Transform(), (box(),), (100.0, 100.0, 100.0))
    poses = np.array([[0, 0, 5, 1, 0, 0, 0]] * 2, dtype=np.float32)
    tracks = Tracks(np.array([0, 1], dtype=np.float32), {"l": poses})
    scene = DisplayScene("r", (LinkNode("l", "", Transform(), (item, far)),), tracks)
    extras = read_glb(glb_of(scene)).extras
    assert extras["centre"] == [1.0, 0.0, 5.0]
    assert extras["size"] == pytest.approx(3**0.5)
