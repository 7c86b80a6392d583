"""The outline of a file: each element once, links as the robot is built."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.editor.names.outline.symbol import Symbol, SymbolKind
from checker.editor.names.symbols import symbols_of
from checker.package.inputs import open_input
from checker.package.package import Package
from support.real_packages import CORPUS, MODERN, judged_folders, needed_folder
from tests.editor.packages import package_of

Shown = tuple[object, ...]


def shown(symbols: Sequence[Symbol]) -> list[Shown]:
    """Return symbols as `kind name`, each with those within."""
    return [
        (f"{it.kind} {it.name}", *shown(it.children)) if it.children else (f"{it.kind} {it.name}",)
        for it in symbols
    ]


def all_of(symbols: Sequence[Symbol]) -> Iterator[Symbol]:
    for it in symbols:
        yield it
        yield from all_of(it.children)


def outline(folder: Path, path: str, text: str) -> tuple[Symbol, ...]:
    package = package_of(folder, {path: text})
    symbols = symbols_of(package, path)
    assert_sound(symbols, package, path)
    return symbols


def assert_sound(symbols: Sequence[Symbol], package: Package, path: str) -> None:
    """Each place is one symbol, and its name stands within it."""
    source = package.read(path)
    length = len(source.text) if hasattr(source, "text") else 0
    places = Counter((it.start, it.end, it.kind) for it in all_of(symbols))
    assert all(number == 1 for number in places.values()), path
    for it in all_of(symbols):
        assert 0 <= it.start <= it.name_start <= it.name_end <= it.end <= length, (path, it)
        assert it.name, path


ROBOT = """<sdf version="1.9"><model name="m">
  <joint name="j" type="revolute"><parent>base</parent><child>wheel</child></joint>
  <link name="wheel"><sensor name="s" type="imu"/></link>
  <link name="base"/>
  <frame name="f"/>
  <joint name="fix" type="fixed"><parent>world</parent><child>pole</child></joint>
  <link name="pole"/>
  <plugin name="gz::sim::systems::DiffDrive" filename="drive"/>
  <model name="arm"><link name="hand"/></model>
</model></sdf>"""


def test_links_are_below_the_joints_that_carry_them(tmp_path: Path) -> None:
    symbols = outline(tmp_path, "model.sdf", ROBOT)
    assert shown(symbols) == [
        (
            "model m",
            ("link base", ("joint j", ("link wheel", ("sensor s",)))),
            ("frame f",),
            ("joint fix", ("link pole",)),
            ("plugin DiffDrive",),
            ("model arm", ("link hand",)),
        )
    ]
    joint = symbols[0].children[0].children[0]
    assert joint.detail == "revolute"
    assert ROBOT[joint.name_start : joint.name_end] == "j"


def test_faulty_robots_show_each_part_once(tmp_path: Path) -> None:
    def joint(name: str, parent: str, child: str) -> str:
        return f'<joint name="{name}"><parent>{parent}</parent><child>{child}</child></joint>'

    for number, (parts, expected) in enumerate(
        (
            (
                '<link name="a"/><link name="b"/>' + joint("x", "a", "b") + joint("y", "b", "a"),
                [("link a", ("joint x", ("link b", ("joint y",))))],
            ),
            ('<link name="a"/>' + joint("x", "a", "a"), [("link a", ("joint x",))]),
            (
                '<link name="a"/>' + joint("x", "gone", "a"),
                [("joint x", ("link a",))],
            ),
            ('<link name="a"/><link name="a"/><link/>', [("link a",), ("link a",), ("link link",)]),
            (
                '<link name="a"/><link name="b"/>' + joint("x", "a", "b") + joint("y", "a", "b"),
                [("link a", ("joint x", ("link b",)), ("joint y",))],
            ),
            ("<joint/>", [("joint joint",)]),
        )
    ):
        text = f'<sdf version="1.9"><model name="m">{parts}</model></sdf>'
        (model,) = outline(tmp_path / str(number), "model.sdf", text)
        assert shown(model.children) == expected


@given(ends=st.lists(st.tuples(st.sampled_from("abcdex"), st.sampled_from("abcdex")), max_size=9))
def test_any_joints_show_each_part_once(
    ends: list[tuple[str, str]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    links = "".join(f'<link name="{name}"/>' for name in "abcde")
    joints = "".join(
        f'<joint name="j{number}"><parent link="{parent}"/><child link="{child}"/></joint>'
        for number, (parent, child) in enumerate(ends)
    )
    text = f'<robot name="r">{links}{joints}</robot>'
    symbols = outline(tmp_path_factory.mktemp("robot"), "urdf/r.urdf", text)
    kinds = Counter(it.kind for it in all_of(symbols))
    assert kinds[SymbolKind.LINK] == 5
    assert kinds[SymbolKind.JOINT] == len(ends)


def test_a_long_chain_of_links_is_shown(tmp_path: Path) -> None:
    part = '<link name="l{1}"/><joint name="j"><parent>l{0}</parent><child>l{1}</child></joint>'
    parts = '<link name="l0"/>' + "".join(part.format(i - 1, i) for i in range(1, 2000))
    text = f'<sdf version="1.9"><model name="m">{parts}</model></sdf>'
    symbols = outline(tmp_path, "model.sdf", text)
    assert sum(it.kind is SymbolKind.LINK for it in all_of(symbols)) == 2000


def test_a_world_shows_its_models(tmp_path: Path) -> None:
    text = """<sdf version="1.9"><world name="w">
<plugin name="gz::sim::systems::Physics" filename="p"/>
<include><uri>model://rover</uri><name>X1</name></include>
<include><uri>https://fuel/models/Sun</uri></include>
<model name="box"><link name="l"/></model>
</world></sdf>"""
    assert shown(outline(tmp_path, "worlds/w.sdf", text)) == [
        (
            "world w",
            ("plugin Physics",),
            ("include X1",),
            ("include Sun",),
            ("model box", ("link l",)),
        )
    ]


def test_xacro_shows_what_it_knows(tmp_path: Path) -> None:
    text = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:include filename="a.xacro"/>
<xacro:arg name="sim" default="true"/>
<xacro:property name="size" value="2"/>
<xacro:macro name="wheel" params="side
   parent">
  <link name="${side}"/>
  <joint name="${side}_j"><parent link="${parent}"/><child link="${side}"/></joint>
</xacro:macro>
<xacro:if value="true"><link name="base"/></xacro:if>
<gazebo reference="base"><sensor name="imu" type="imu"/></gazebo>
<gazebo><plugin name="drive" filename="d.so"/></gazebo>
<gazebo reference="gone"><sensor name="lost" type="imu"/></gazebo>
</robot>"""
    (robot,) = outline(tmp_path, "urdf/r.xacro", text)
    assert shown([robot]) == [
        (
            "robot r",
            ("include a.xacro",),
            ("argument sim",),
            ("property size",),
            ("macro wheel", ("joint ${side}_j", ("link ${side}",))),
            ("link base", ("sensor imu",)),
            ("plugin drive",),
            ("sensor lost",),
        )
    ]
    details = {it.name: it.detail for it in all_of([robot])}
    assert details["wheel"] == "side parent"
    assert details["size"] == "2"


def test_other_files_show_what_they_start_or_set(tmp_path: Path) -> None:
    launch = """<launch><arg name="a" default="1"/>
<group><node pkg="p" type="t" name="n"/></group>
<include file="$(find p)/b.launch"><arg name="a" value="2"/></include></launch>"""
    assert shown(outline(tmp_path / "a", "launch/a.launch", launch)) == [
        ("argument a",),
        ("node n",),
        ("include $(find p)/b.launch",),
    ]
    yaml = "top:\n  inner:\n    deep: 1\n  other: [1]\nlast: 2\n"
    assert shown(outline(tmp_path / "b", "config/a.yaml", yaml)) == [
        ("key top", ("key inner",), ("key other",)),
        ("key last",),
    ]
    bridge = "- topic_name: clock\n  direction: GZ_TO_ROS\n"
    assert shown(outline(tmp_path / "c", "config/b.yaml", bridge)) == [
        ("key clock", ("key topic_name",), ("key direction",)),
    ]
    ruby = "def spawner(_name)\n  1\nend\ndef self.other\nend\n"
    assert shown(outline(tmp_path / "d", "launch/spawner.rb", ruby)) == [
        ("function spawner",),
        ("function other",),
    ]
    python = 'é = "é"; \ndef a():\n    pass\nclass B:\n    def c(self): pass\n'
    assert shown(outline(tmp_path / "e", "launch/a.launch.py", python)) == [
        ("function a",),
        ("class B", ("function c",)),
    ]


def test_a_file_that_cannot_be_read_has_no_outline(tmp_path: Path) -> None:
    for number, (path, text) in enumerate(
        (
            ("model.sdf", "<sdf><model"),
            ("launch/a.launch.py", "def (:"),
            ("config/a.yaml", "a: [b\n"),
            ("urdf/a.urdf", ""),
            ("readme.xml", "<other/>"),
        )
    ):
        assert outline(tmp_path / str(number), path, text) == ()
    assert symbols_of(package_of(tmp_path, {}), "gone.sdf") == ()


def test_the_samples_have_sound_outlines(samples: Path) -> None:
    for folder in sorted(it for it in samples.iterdir() if it.is_dir() and it.name[0] != "."):
        with open_input(folder) as opened:
            for package in opened.packages:
                for file in package.index.files:
                    if file.path.endswith((".sdf", ".urdf", ".xacro", ".launch", ".rb", ".py")):
                        assert_sound(symbols_of(package, file.path), package, file.path)


@pytest.mark.corpus
@pytest.mark.parametrize("variable", [CORPUS, MODERN])
def test_real_packages_have_sound_outlines(variable: str) -> None:
    needed_folder(variable)
    seen = 0
    for folder in judged_folders(variable):
        with open_input(folder) as opened:
            for package in opened.packages:
                for file in package.index.with_suffix(".sdf", ".urdf", ".xacro", ".yaml", ".rb"):
                    symbols = symbols_of(package, file.path)
                    assert_sound(symbols, package, file.path)
                    seen += len(symbols)
    assert seen > 100
