"""What is offered at a caret: elements, values, names, plugins, files and what xacro reads."""

from __future__ import annotations

import random
import re
import statistics
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest
from hypothesis import given, strategies

from checker.editor.completion.completion import completions_at
from checker.editor.completion.item import Completion, CompletionKind
from checker.editor.completion.snippet import sdf_element
from checker.editor.language import place_of
from checker.editor.schema import schema_type
from checker.engine.subject import Subject
from checker.formats.sdf.schema import VERSIONS, sdf_root
from checker.source.text import SourceText
from checker.source.xml import Element, XmlDocument, parse_xml
from support.real_packages import CORPUS, MODERN, judged_files, judged_folders, needs
from tests.each import of_each
from tests.editor.subjects import CARET, offered, subject_of, text_of, written
from tests.effort import examples, seconds, slowness

_MODEL = """<?xml version="1.0"?>
<sdf version="1.9">
  <model name="rover">
    <link name="base"><inertial><mass>8</mass></inertial></link>
    <link name="wheel"/>
    <joint name="axle" type="revolute"><parent>base</parent><child>wheel</child></joint>
    <frame name="mount" attached_to="base"/>
  </model>
</sdf>
"""
_XACRO = """<?xml version="1.0"?>
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="side" default="left"/>
  <xacro:property name="reach" value="0.5"/>
  <xacro:macro name="finger" params="prefix length:=0.1 *origin">
    <link name="${prefix}_finger"/>
  </xacro:macro>
  <link name="palm"/>
</robot>
"""


@pytest.fixture
def rover(tmp_path: Path) -> Subject:
    files = {"model.sdf": _MODEL, "model.config": "<model/>", "meshes/hull.dae": "<COLLADA/>"}
    return written(tmp_path / "rover", {**files, "meshes/notes.txt": "", "worlds/a.png": ""})


@pytest.fixture
def arm(tmp_path: Path) -> Subject:
    manifest = "<package><name>arm_description</name></package>"
    files = {"package.xml": manifest, "urdf/arm.urdf.xacro": _XACRO, "meshes/palm.stl": "solid"}
    return written(tmp_path / "arm_description", files)


def _in_model(inside: str) -> str:
    return _MODEL.replace('<link name="wheel"/>', f'<link name="wheel"/>\n    {inside}')


def _in_link(inside: str) -> str:
    return _in_model(f"<link name='new'>{inside}")


def _sdf(subject: Subject, marked: str) -> dict[str, Completion]:
    return offered(subject, "model.sdf", marked)


def _xacro(subject: Subject, inside: str) -> dict[str, Completion]:
    marked = _XACRO.replace("</robot>", f"{inside}\n</robot>")
    return offered(subject, "urdf/arm.urdf.xacro", marked)


# SDF: what the schema knows.


def test_elements_that_the_schema_allows_are_offered(rover: Subject) -> None:
    items = _sdf(rover, _in_link(f"<{CARET}"))
    assert {"collision", "visual", "sensor", "inertial", "pose"} <= items.keys()
    assert "joint" not in items


def test_what_may_occur_once_and_is_there_is_left_out(rover: Subject) -> None:
    items = _sdf(rover, _in_link(f"<pose/><visual name='a'/><{CARET}\n<inertial/></link>"))
    assert "pose" not in items
    assert "inertial" not in items
    assert "visual" in items


def test_what_is_required_comes_first_and_is_filled_in(rover: Subject) -> None:
    items = _sdf(rover, _in_model(f"<joint name='j' type='fixed'><{CARET}"))
    assert sorted(list(items)[:2]) == ["child", "parent"]
    assert items["parent"].insert == "parent>$1</parent>"
    assert items["parent"].is_snippet
    collision = _sdf(rover, _in_link(f"<{CARET}"))["collision"]
    assert collision.insert.startswith('collision name="$1">')


def test_the_word_at_the_caret_is_replaced(rover: Subject) -> None:
    marked = _in_link(f"<vis{CARET}")
    item = _sdf(rover, marked)["visual"]
    assert marked.replace(CARET, "")[item.start : item.end] == "vis"


def test_a_tag_that_has_its_rest_is_only_renamed(rover: Subject) -> None:
    item = _sdf(rover, _in_link(f"<vis{CARET} name='a'></visual>"))["visual"]
    assert (item.insert, item.is_snippet) == ("visual", False)


def test_between_tags_elements_come_with_their_bracket(rover: Subject) -> None:
    assert _sdf(rover, _in_link(f"\n  {CARET}\n"))["pose"].insert.startswith("<pose>")


def test_attributes_and_their_words(rover: Subject) -> None:
    items = _sdf(rover, _in_link(f"<sensor name='a' {CARET}"))
    assert [*items] == ["type"]
    assert items["type"].insert == 'type="$1"'
    types = _sdf(rover, _in_link(f'<sensor name="a" type="{CARET}'))
    assert {"camera", "gpu_lidar", "imu"} <= types.keys()
    joints = _sdf(rover, _in_model(f'<joint name="a" type="{CARET}"'))
    assert {"revolute", "prismatic", "fixed"} <= joints.keys()
    unquoted = _sdf(rover, _in_link(f"<sensor name='a' type={CARET}"))
    assert unquoted["camera"].insert == '"camera"'


def test_the_part_that_a_sensor_asks_for_comes_first(rover: Subject) -> None:
    items = _sdf(rover, _in_link(f"<sensor name='a' type='gpu_lidar'><{CARET}"))
    assert next(iter(items)) == "lidar"
    assert "gz_frame_id" in items


def test_values_of_texts(rover: Subject) -> None:
    assert [*_sdf(rover, _in_link(f"<gravity>{CARET}"))] == ["false", "true"]
    assert "0 0 0 0 0 0" in _sdf(rover, _in_link(f"<pose>{CARET}</pose>"))


def test_an_end_tag_closes_the_innermost_element(rover: Subject) -> None:
    items = _sdf(rover, _in_link(f"<visual name='a'></{CARET}"))
    assert [*items][:3] == ["visual", "link", "model"]
    assert items["visual"].insert == "visual>"


def test_an_empty_file_begins_with_its_root(rover: Subject) -> None:
    assert [*_sdf(rover, f"<{CARET}")] == ["sdf"]
    assert _sdf(rover, CARET)["sdf"].insert.startswith('<sdf version="')


# Names.


def test_names_stand_where_they_are_asked_for(rover: Subject) -> None:
    ends = _sdf(rover, _in_model(f"<joint name='j' type='fixed'><parent>{CARET}"))
    assert {"base", "wheel", "mount", "world"} <= ends.keys()
    assert ends["base"].kind is CompletionKind.LINK
    frames = _sdf(rover, _in_link(f'<pose relative_to="{CARET}"/>'))
    assert {"base", "axle", "mount", "__model__"} <= frames.keys()


def test_names_just_written_count(rover: Subject) -> None:
    marked = _in_model(f"<link name='new'/><joint name='j' type='fixed'><child>{CARET}")
    assert "new" in _sdf(rover, marked)


def test_names_inside_a_nested_model_are_its_own(tmp_path: Path) -> None:
    inner = "<model name='arm'><link name='wrist'/><joint name='j' type='fixed'><child>¦</child>"
    start = "<sdf version='1.9'><model name='m'><link name='base'/>"
    model = f"{start}{inner}</joint></model></model></sdf>"
    subject = written(tmp_path / "nested", {"model.sdf": model})
    items = _sdf(subject, model)
    assert next(iter(items)) == "wrist"
    assert "arm::wrist" not in items


_ARM = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="hand"/>
  <joint name="wrist" type="revolute"><parent link="base"/><child link="hand"/></joint>
</robot>
"""


@pytest.mark.parametrize(
    ("written_there", "links", "joints"),
    [
        (f'<group name="g"><chain base_link="{CARET}"', True, False),
        (f'<group name="g"><chain base_link="base" tip_link="{CARET}"', True, False),
        (f'<group name="g"><link name="{CARET}"', True, False),
        (f'<group name="g"><joint name="{CARET}"', False, True),
        (f'<group name="{CARET}"', False, False),
        (f'<group_state name="s" group="g"><joint name="{CARET}"', False, True),
        (f'<passive_joint name="{CARET}"', False, True),
        (f'<end_effector name="e" parent_link="{CARET}"', True, False),
        (f'<virtual_joint name="v" type="fixed" child_link="{CARET}"', True, False),
        (f'<enable_collisions link1="{CARET}"', True, False),
        (f'<disable_default_collisions link="{CARET}"', True, False),
    ],
)
def test_names_in_srdf(tmp_path: Path, written_there: str, links: bool, joints: bool) -> None:
    srdf = "<robot name='arm'>{}</robot>"
    files = {"package.xml": "<package><name>arm_config</name></package>", "urdf/arm.urdf": _ARM}
    subject = written(tmp_path / "arm_config", {**files, "config/arm.srdf": srdf.format("")})
    items = offered(subject, "config/arm.srdf", srdf.format(written_there + "/>"))
    assert ({"base", "hand"} <= items.keys()) is links
    assert ("wrist" in items) is joints


# Plugins.


def test_plugins_of_the_target_are_offered(rover: Subject) -> None:
    libraries = _sdf(rover, _in_model(f'<plugin filename="{CARET}"'))
    assert "libgz-sim-diff-drive-system.so" in libraries
    classes = _sdf(rover, _in_model(f'<plugin filename="gz-sim-diff-drive-system" name="{CARET}"'))
    assert [*classes] == ["gz::sim::systems::DiffDrive"]


def test_parameters_of_a_plugin_are_offered(rover: Subject) -> None:
    start = '<plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">'
    items = _sdf(rover, _in_model(f"{start}<{CARET}"))
    assert {"left_joint", "right_joint", "wheel_separation"} <= items.keys()
    assert "axle" in _sdf(rover, _in_model(f"{start}<left_joint>{CARET}"))


# Files.


def test_files_are_offered_folder_by_folder(rover: Subject) -> None:
    start = "<collision name='c'><geometry><mesh><uri>"
    items = _sdf(rover, _in_link(f"{start}{CARET}"))
    assert {"meshes", "meshes/hull.dae", "model://"} <= items.keys()
    below = _sdf(rover, _in_link(f"{start}meshes/{CARET}"))
    assert [*below] == ["hull.dae", "notes.txt"]
    named = _sdf(rover, _in_link(f"{start}model://{CARET}"))
    assert "rover" in named
    deep = _in_link(f"{start}model://rover/meshes/hu{CARET}</uri>")
    hull = _sdf(rover, deep)["hull.dae"]
    assert deep.replace(CARET, "")[hull.start : hull.end] == "hu"


def test_nothing_outside_of_the_workspace_is_offered(rover: Subject) -> None:
    start = "<collision name='c'><geometry><mesh><uri>"
    for typed in ("/", "/etc/", "../", "../../", "file:///", "model://../", "meshes/../../"):
        items = _sdf(rover, _in_link(f"{start}{typed}{CARET}"))
        assert not any(it.kind is CompletionKind.FILE for it in items.values()), typed


# URDF and xacro.


def test_elements_and_attributes_of_urdf(arm: Subject) -> None:
    inside = _xacro(arm, f"<link name='a'><{CARET}")
    assert {"visual", "collision", "inertial"} <= inside.keys()
    joint = _xacro(arm, f"<joint name='j' type='fixed'><{CARET}")
    assert {"parent", "child", "origin", "axis", "limit"} <= joint.keys()
    assert joint["parent"].insert == 'parent link="$1"/>'
    assert "lower" in _xacro(arm, f"<joint name='j' type='revolute'><limit {CARET}")
    assert "continuous" in _xacro(arm, f'<joint name="j" type="{CARET}"')
    assert "palm" in _xacro(arm, f'<joint name="j" type="fixed"><parent link="{CARET}"')


def test_gazebo_tags_hold_sdf(arm: Subject) -> None:
    items = _xacro(arm, f"<gazebo reference='palm'><{CARET}")
    assert {"sensor", "mu1", "material", "selfCollide"} <= items.keys()
    assert "plugin" in _xacro(arm, f"<gazebo><{CARET}")
    assert "camera" in _xacro(arm, f"<gazebo reference='palm'><sensor name='a' type=\"{CARET}\"")
    assert "palm" in _xacro(arm, f'<gazebo reference="{CARET}"')


def test_macros_are_called_with_what_they_need(arm: Subject) -> None:
    items = _xacro(arm, f"<{CARET}")
    assert items["xacro:finger"].insert.startswith('xacro:finger prefix="$1">')
    assert "xacro:if" in items
    assert {"prefix", "length"} == _xacro(arm, f"<xacro:finger {CARET}").keys()


def test_what_stands_in_a_macro_is_known_by_its_own_tags(arm: Subject) -> None:
    start = '<xacro:macro name="m" params="size">'
    assert "xyz" in _xacro(arm, f"{start}<origin {CARET}")
    assert {"mass", "inertia"} <= _xacro(arm, f"{start}<inertial><{CARET}").keys()
    block = _xacro(arm, f'<xacro:finger prefix="a"><{CARET}')["origin"]
    assert block.insert == 'origin xyz="$1" rpy="$2"/>'
    assert "origin" in _xacro(
        arm, f'<xacro:macro name="m" params="*origin"><xacro:insert_block name="{CARET}"/>'
    )


def test_expressions_offer_properties_arguments_and_packages(arm: Subject) -> None:
    assert "reach" in _xacro(arm, f'<link name="${{{CARET}"/>')
    inside = _xacro(arm, f'<xacro:macro name="m" params="size"><link name="${{si{CARET}}}"/>')
    assert "size" in inside
    assert "side" in _xacro(arm, f'<link name="$(arg {CARET})"/>')
    assert "arm_description" in _xacro(arm, f'<xacro:include filename="$(find {CARET}"/>')
    assert "arg" in _xacro(arm, f'<link name="$({CARET})"/>')


def test_files_of_urdf_are_named_by_their_package(arm: Subject) -> None:
    start = '<link name="a"><visual><geometry><mesh filename="'
    items = _xacro(arm, f'{start}{CARET}"')
    assert "package://arm_description/meshes/palm.stl" in items
    assert "palm.stl" in _xacro(arm, f"{start}package://arm_description/meshes/{CARET}")
    found = _xacro(arm, f'<xacro:include filename="$(find arm_description)/{CARET}"')
    assert {"urdf", "meshes"} <= found.keys()


def test_hardware_of_ros2_control_is_offered(arm: Subject) -> None:
    items = _xacro(arm, f"<ros2_control name='c' type='system'><hardware><plugin>{CARET}")
    assert "mock_components/GenericSystem" in items
    joint = _xacro(arm, f"<ros2_control name='c' type='system'><joint name='a'><{CARET}")
    assert {"command_interface", "state_interface"} <= joint.keys()


# Snippets.


def _filled(snippet: str) -> str:
    """Return what an editor writes where nothing is filled in."""
    text = re.sub(r"\$\{\d+:((?:\\.|[^}])*)\}", r"\1", snippet)
    return re.sub(r"\\([$}\\])", r"\1", re.sub(r"(?<!\\)\$\d+", "", text))


@of_each("version", VERSIONS)
def test_elements_of_sdf_are_well_formed_and_state_what_they_must(version: str) -> None:
    waiting, seen = [sdf_root(version)], 0
    while waiting and seen < 800:
        kind = waiting.pop()
        seen += 1
        waiting += kind.children.values()
        document = parse_xml(SourceText("a.sdf", f"<{_filled(sdf_element(kind))}"))
        assert isinstance(document, XmlDocument), kind.name
        needed = {name for name, (_, _, needed) in kind.attributes.items() if needed == "1"}
        assert needed == document.root.attributes.keys(), kind.name
        wanted = {it.name for it in kind.required_children if it.value_type and not kind.value_type}
        assert {it.tag for it in document.root.children} == wanted, kind.name


# Any text at all.


@pytest.fixture(scope="module")
def nowhere(tmp_path_factory: pytest.TempPathFactory) -> Subject:
    """A folder without files."""
    return subject_of(tmp_path_factory.mktemp("nowhere"))


@given(
    pieces=strategies.lists(
        strategies.sampled_from(
            [
                *("<sdf version='1.9'>", "<model name='m'>", "<link ", "<", ">", "</", "'", '"'),
                *("<plugin filename='", "${", "$(find ", "$(arg ", "<uri>", "model://", "\n", "="),
                *("<robot xmlns:xacro='u'>", "<gazebo>", "<xacro:macro params='a:=", "<!--", "é"),
            ]
        ),
        max_size=25,
    ),
    share=strategies.floats(0.0, 1.0),
)
def test_any_text_can_be_completed(nowhere: Subject, pieces: list[str], share: float) -> None:
    text = "".join(pieces)
    offset = round(share * len(text))
    for path in ("model.sdf", "robot.urdf.xacro"):
        for item in completions_at(nowhere, path, text, offset):
            assert 0 <= item.start <= item.end <= len(text)


# Real packages.


def _paths(variable: str, *suffixes: str) -> list[tuple[Subject, str]]:
    found = [
        (subject_of(package), entry.path)
        for package in judged_folders(variable)
        for entry in subject_of(package).package.index.with_suffix(*suffixes)
        if entry.size > 1000
    ]
    return found[:: max(1, len(found) // 25)]


def _cut_anywhere(files: list[tuple[Subject, str]], number: int) -> list[float]:
    """Complete at random places of files whose end is cut off; return how long each takes."""
    dice = random.Random(7)  # noqa: S311 - places to cut at
    taken = []
    for _ in range(number):
        subject, path = dice.choice(files)
        text = text_of(subject, path)
        cut = text[: dice.randrange(len(text))]
        work = partial(completions_at, subject, path, cut, len(cut))
        work()  # what is read once stays read
        taken.append(seconds(work))
    return taken


class TestCorpus:
    pytestmark = needs(CORPUS)

    def test_completion_at_any_cut_is_quick(self) -> None:
        taken = _cut_anywhere(_paths(CORPUS, ".sdf", ".xacro", ".urdf"), examples(200))
        assert statistics.median(taken) < 0.05 * slowness()

    def test_what_was_deleted_is_offered(self) -> None:
        tried = 0
        for model in judged_files(CORPUS, "model.sdf"):
            tried += _check_deletions(subject_of(model.parent), "model.sdf")
        assert tried > 300


class TestModern:
    pytestmark = needs(MODERN)

    def test_completion_at_any_cut_is_quick(self) -> None:
        taken = _cut_anywhere(_paths(MODERN, ".sdf", ".xacro", ".urdf"), examples(200))
        assert statistics.median(taken) < 0.05 * slowness()

    def test_elements_of_robots_of_today_are_offered(self) -> None:
        offered_ones = [
            element.tag in labels
            for subject, path in _paths(MODERN, ".sdf", ".xacro", ".urdf")
            if ".srdf" not in path  # elements of SRDF are not offered yet
            for element, labels in _deleted(subject, path)
        ]
        assert len(offered_ones) > 100
        assert sum(offered_ones) > 0.95 * len(offered_ones)


def _deleted(subject: Subject, path: str) -> Iterator[tuple[Element, set[str]]]:
    """Yield elements of a robot with what is offered where each was."""
    document = subject.package.xml(path)
    if not isinstance(document, XmlDocument) or document.root.tag not in ("robot", "sdf"):
        return
    text = document.source.text
    for element in document.elements[1::9]:
        span = element.whole_span
        rest = f"{text[: span.start]}<{text[span.end :]}"
        items = completions_at(subject, path, rest, span.start + 1)
        yield element, {item.label for item in items}


def _check_deletions(subject: Subject, path: str) -> int:
    """Delete elements that the schema knows, one at a time: its tag is offered at its place."""
    text = text_of(subject, path)
    document = parse_xml(SourceText(path, text))
    assert isinstance(document, XmlDocument)
    tried = 0
    for element in document.elements[1::7]:
        if not _is_known(element):
            continue
        span = element.whole_span
        rest = text[: span.start] + text[span.end :]
        labels = {item.label for item in completions_at(subject, path, rest, span.start)}
        assert element.tag in labels, element.path
        with_bracket = f"{text[: span.start]}<{text[span.end :]}"
        items = completions_at(subject, path, with_bracket, span.start + 1)
        assert element.tag in {item.label for item in items}, element.path
        tried += 1
    return tried


def _is_known(element: Element) -> bool:
    """Whether the schema has the element, and no twin of it stays where it is deleted."""
    tags: list[str] = []
    at: Element | None = element
    while at is not None:
        tags.insert(0, at.tag)
        at = at.parent
    version = element.document.root.get("version") or ""
    kind = schema_type(place_of(tags).tags, version)
    around = element.parent
    alone = around is not None and len(around.all(element.tag)) == 1
    return kind is not None and (alone or kind.occurs in ("*", "+"))
