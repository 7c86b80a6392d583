"""Xacro files become robots, whatever they include and whoever gives their arguments."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.base.cache import Cache
from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.formats.xacro.fault import XacroFaultKind
from checker.model.robot import Robot
from checker.robots.candidates import CANDIDATES_LIMIT
from checker.robots.urdf_files import UrdfFiles
from tests.urdf.conftest import NAME, Describe, robot

FILE = f"{NAME}/urdf/acme.urdf.xacro"
BASE = '<link name="base"/>'


def files_of(subject: Subject) -> UrdfFiles:
    files = subject.one(UrdfFiles)
    assert not isinstance(files, NotAvailable)
    return files


def links(subject: Subject) -> list[str]:
    return [
        link.name.value
        for description in files_of(subject).descriptions
        for link in description.robot.links
    ]


def launch(words: str) -> str:
    return f'<launch><param name="robot_description" command="{words}"/></launch>'


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<xacro:property name="n" value="arm"/><link name="${n}"/>', ["arm"]),
        ('<xacro:arg name="n" default="arm"/><link name="$(arg n)"/>', ["arm"]),
        ('<link name="$(eval 1 + 2)"/>', ["3"]),
        ('<link name="$(optenv ACME_MISSING laser)"/>', ["laser"]),
        ('<link name="a${2 * 3}"/><xacro:if value="${1 > 2}"><link name="b"/></xacro:if>', ["a6"]),
        (
            '<xacro:macro name="m" params="s *o"><link name="${s}"><xacro:insert_block name="o"/>'
            '</link></xacro:macro><xacro:m s="l"><visual/></xacro:m><xacro:m s="r"><visual/>'
            "</xacro:m>",
            ["l", "r"],
        ),
    ],
)
def test_expressions_and_macros(describe: Describe, body: str, expected: list[str]) -> None:
    assert links(describe({FILE: robot(body)})) == expected


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("wheel.xacro", {f"{NAME}/urdf/wheel.xacro": ""}),
        ("../parts/wheel.xacro", {f"{NAME}/parts/wheel.xacro": ""}),
        (f"$(find {NAME})/parts/wheel.xacro", {f"{NAME}/parts/wheel.xacro": ""}),
        ("$(find acme_parts)/wheel.xacro", {"acme_parts/wheel.xacro": ""}),
        ("${'whe' + 'el'}.xacro", {f"{NAME}/urdf/wheel.xacro": ""}),
        ("$(find acme_${'parts'})/wheel.xacro", {"acme_parts/wheel.xacro": ""}),
        ("whe*.xacro", {f"{NAME}/urdf/wheel.xacro": ""}),
    ],
)
def test_includes_are_found(describe: Describe, name: str, others: Mapping[str, str]) -> None:
    files = dict.fromkeys(others, robot('<link name="wheel"/>').replace(' name="acme"', ""))
    include = f'<xacro:include filename="{name}"/>{BASE}'
    assert links(describe({FILE: robot(include), **files})) == ["wheel", "base"]


def test_yaml_is_read_beside_the_file(describe: Describe) -> None:
    body = (
        """<xacro:property name="y" value="${load_yaml('links.yaml')}"/><link name="${y['a']}"/>"""
    )
    yaml = {f"{NAME}/urdf/links.yaml": "a: mast\n"}
    assert links(describe({FILE: robot(body), **yaml})) == ["mast"]


def test_arguments_come_from_the_launch_file(describe: Describe) -> None:
    command = f"$(find xacro)/xacro $(find {NAME})/urdf/acme.urdf.xacro laser:=true"
    body = f'{BASE}<xacro:if value="$(arg laser)"><link name="laser"/></xacro:if>'
    subject = describe({FILE: robot(body), f"{NAME}/launch/show.launch": launch(command)})
    assert links(subject) == ["base", "laser"]


def test_the_file_that_a_launch_file_loads_counts_first(describe: Describe) -> None:
    other = f"{NAME}/urdf/other.urdf"
    subject = describe(
        {
            FILE: robot(BASE),
            other: '<robot name="o"><link name="other"/></robot>',
            f"{NAME}/launch/show.launch": launch(f"cat $(find {NAME})/urdf/other.urdf"),
        }
    )
    assert links(subject) == ["other", "base"]


def test_several_robots_are_each_one(describe: Describe) -> None:
    second = f"{NAME}/urdf/second.xacro"
    subject = describe({FILE: robot(BASE), second: robot('<link name="other"/>')})
    assert sorted(links(subject)) == ["base", "other"]


def test_macros_alone_are_no_robot_and_no_fault(describe: Describe) -> None:
    macro = '<xacro:macro name="m" params="n"><link name="${n}"/></xacro:macro>'
    subject = describe({FILE: robot(macro)})
    assert files_of(subject) == files_of(subject)
    assert not files_of(subject).faults
    robots = subject.all(Robot)
    assert isinstance(robots, NotAvailable)
    assert not robots.applicable


def test_an_argument_that_nobody_gives_is_not_known(describe: Describe) -> None:
    files = files_of(describe({FILE: robot('<link name="$(arg side)"/>')}))
    assert not files.faults
    assert "arg side" in files.unread[0]


def test_a_package_that_is_not_at_hand_is_no_fault(describe: Describe) -> None:
    body = f'<xacro:include filename="$(find elsewhere)/a.xacro"/>{BASE}'
    files = files_of(describe({FILE: robot(body)}))
    assert not files.faults
    assert "elsewhere is not available" in files.unread[0]


@pytest.mark.parametrize("only", ["urdf/acme.urdf.xacro"])
def test_a_lone_file_finds_what_it_includes(describe: Describe, only: str) -> None:
    body = f'<xacro:include filename="$(find acme_parts)/wheel.xacro"/>{BASE}'
    parts = {"acme_parts/wheel.xacro": robot('<link name="wheel"/>')}
    subject = describe({FILE: robot(body), **parts}, only)
    assert subject.package.is_urdf
    assert links(subject) == ["wheel", "base"]


@pytest.mark.parametrize("start", ["file://", "file:///"])
def test_meshes_of_a_found_package_are_those_of_the_package(describe: Describe, start: str) -> None:
    mesh = f'<mesh filename="{start}$(find {NAME})/meshes/a.stl"/>'
    body = f'<link name="a"><visual><geometry>{mesh}</geometry></visual></link>'
    subject = describe({FILE: robot(body)})
    (uri,) = files_of(subject).descriptions[0].robot.file_uris
    assert uri.value == f"package://{NAME}/meshes/a.stl"


def test_what_was_expanded_is_kept(
    describe: Describe, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = describe({FILE: robot('<link name="${1 + 1}"/>')}).package
    cache = Cache(tmp_path / "cache")
    assert links(Subject(package, cache)) == ["2"]
    monkeypatch.setattr("checker.base.background.Child", None)
    assert links(Subject(package, cache)) == ["2"]


def test_a_plain_urdf_needs_no_process(describe: Describe, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.base.background.Child", None)
    plain = f'<robot name="acme">{BASE}</robot>'
    assert links(describe({f"{NAME}/urdf/acme.urdf": plain})) == ["base"]


def test_an_empty_file_that_is_loaded_is_a_fault(describe: Describe) -> None:
    command = f"$(find xacro)/xacro $(find {NAME})/urdf/acme.urdf.xacro"
    files = files_of(describe({FILE: "", f"{NAME}/launch/show.launch": launch(command)}))
    assert [fault.kind for fault in files.faults] == [XacroFaultKind.EMPTY]


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<link name="${map(str, [1, 2])[1]}"/>', ["2"]),
        ('<link name="${sum(filter(lambda n: n > 1, [1, 2, 3]))}"/>', ["5"]),
        ('<link name="${(range(2) + [7])[-1]}"/>', ["7"]),
        (
            '<property name="n" value="a"/><macro name="leg" params="s"><link name="${s}"/></macro>'
            '<leg s="${n}"/><if value="0"><link name="no"/></if>',
            ["a"],
        ),
    ],
)
def test_what_only_melodic_expands_is_a_robot(
    describe: Describe, body: str, expected: list[str]
) -> None:
    subject = describe({FILE: robot(body)})
    assert links(subject) == expected
    assert files_of(subject).faults == ()
    assert len(files_of(subject).old) == 1


def test_what_no_release_expands_is_reported_as_the_newer_one_does(describe: Describe) -> None:
    files = files_of(describe({FILE: robot('<xacro:leg/><link name="a"/>')}))
    assert files.old == ()
    assert [fault.message for fault in files.faults] == ["unknown macro name: xacro:leg"]


def loading(folder: str) -> str:
    """Return what loads a YAML file of a folder that is not there."""
    return (
        f'<xacro:property name="file" value="$(find {NAME})/config/{folder}/limits.yaml"/>'
        '<xacro:property name="limits" value="${xacro.load_yaml(file)}"/>'
        "<link name=\"${limits['a']}\"/>"
    )


def test_a_file_that_another_argument_would_name_is_not_checked(describe: Describe) -> None:
    body = '<xacro:arg name="kind" default="none"/>' + loading("$(arg kind)")
    files = files_of(describe({FILE: robot(body)}))
    assert not files.faults
    assert any("another value of the argument 'kind'" in reason for reason in files.unread)


@pytest.mark.parametrize(
    "body",
    [
        '<xacro:arg name="kind" default="none"/>' + loading("$(arg kind)"),
        f'<xacro:include filename="$(find elsewhere)/a.xacro"/>{BASE}',
    ],
)
def test_why_a_file_is_not_known_is_kept(
    describe: Describe, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, body: str
) -> None:
    package = describe({FILE: robot(body)}).package
    cache = Cache(tmp_path / "cache")
    unread = files_of(Subject(package, cache)).unread
    assert unread
    assert cache.is_whole
    monkeypatch.setattr("checker.base.background.Child", None)
    assert files_of(Subject(package, cache)).unread == unread


def test_a_file_that_is_not_there_is_named(describe: Describe) -> None:
    (fault,) = files_of(describe({FILE: robot(loading("kind"))})).faults
    assert f"{NAME}/config/kind/limits.yaml does not exist" in fault.message


DRIVER = '<xacro:include filename="$(find elsewhere)/driver.xacro"/>'
CALLED = '<xacro:if value="@"><xacro:driver/></xacro:if>'
ELBOW = (
    '<link name="arm"/><joint name="elbow" type="revolute"><parent link="base"/>'
    '<child link="arm"/></joint>'
)
DANGLING = '<joint name="j" type="fixed"><parent link="base"/><child link="palm"/></joint>'
FIXED = (
    '<link name="@"/><joint name="of_@" type="fixed"><parent link="$"/><child link="@"/></joint>'
)
ON_LENS = "".join(
    FIXED.replace("@", child).replace("$", parent)
    for child, parent in [("rim", "hood"), ("hood", "lens")]
)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (CALLED.replace("@", "false"), ["base"]),
        (CALLED.replace("@", "true"), []),
        (CALLED.replace("@", "false") + DANGLING, []),
        (CALLED.replace("@", "false") + '<link name="${length}"/>', []),
        ("", []),
        (CALLED.replace("@", "true") + ELBOW, ["base", "arm"]),
        ('<link name="lid"><xacro:driver/></link>' + ELBOW, []),
        (CALLED.replace("@", "true") + ELBOW + DANGLING, ["base", "arm"]),
        (CALLED.replace("@", "true") + ELBOW + ON_LENS, ["base", "arm"]),
        (CALLED.replace("@", "true") + ON_LENS + ELBOW.replace('"base"', '"hood"'), []),
        (CALLED.replace("@", "true") + ELBOW + '<gazebo reference="lens"/>', ["base", "arm"]),
    ],
    ids=[
        *("macro is not called", "called", "link is there", "property is there", "may be links"),
        *("called beside a robot", "called in a link", "called for a child", "called for parents"),
        "called for all that moves",
        "called for a link of an extension",
    ],
)
def test_a_package_that_is_not_available_may_be_needless(
    describe: Describe, body: str, expected: list[str]
) -> None:
    subject = describe({FILE: robot(DRIVER + BASE + body)})
    assert links(subject) == expected
    (reason,) = files_of(subject).unread
    assert "elsewhere" in reason
    assert "not available" in reason


def test_robots_are_read_before_objects_where_there_are_many(describe: Describe) -> None:
    objects = {f"{NAME}/urdf/box{n}.urdf": robot(BASE) for n in range(CANDIDATES_LIMIT)}
    subject = describe({**objects, f"{NAME}/urdf/robot.urdf": robot(BASE + ELBOW)})
    assert "arm" in links(subject)
    (reason,) = (it for it in files_of(subject).unread if "not read" in it)
    assert "box" in reason


def test_a_file_is_read_by_its_root_whatever_its_name(describe: Describe) -> None:
    assert links(describe({f"{NAME}/acme.sdf": robot(BASE)}, only="acme.sdf")) == ["base"]


def test_sdf_in_a_file_of_urdf_is_said_to_be_unread(describe: Describe) -> None:
    model = '<sdf version="1.9"><model name="lid"><link name="lid"/></model></sdf>'
    files = files_of(describe({FILE: robot(BASE), f"{NAME}/urdf/lid.urdf": model}))
    assert files.unread == (
        "urdf/lid.urdf is SDF by its root element, and is not read: name it .sdf",
    )
