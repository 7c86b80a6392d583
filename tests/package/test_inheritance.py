"""Kinds of packages, and the parts that they take from their siblings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from checker.package.inheritance import Found, Missing, Part
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.references import blank_comments, spawner_references
from checker.package.workspace import Workspace
from checker.source.text import SourceText
from tests.effort import limited

Write = Callable[[Mapping[str, str]], Path]

MODEL = "<sdf version='1.6'><model name='rover'/></sdf>"
SPAWNER = "launch/spawner.rb"
ONE = "rover_sensor_config_1"
TWO = "rover_sensor_config_2"
THREE = "rover_sensor_config_3"
ROSLAUNCH = "<command>roslaunch --wait {} description.launch name:=x</command>"


def package(write: Write, files: Mapping[str, str], name: str = TWO) -> Package:
    space = write(files)
    found = Workspace((space,)).package(name)
    return found or Workspace((space,)).at(space / name)


def names(ruby: str) -> list[str]:
    return [reference.package_name for reference in spawner_references(SourceText("s.rb", ruby))]


DESCRIPTION = PackageKind.URDF_DESCRIPTION
BESIDE = {"r/model.sdf": MODEL, "r/package.xml": "", "r/urdf/r.xacro": ""}


@pytest.mark.parametrize(
    ("files", "kind"),
    [
        ({"r/model.sdf": MODEL, f"r/{SPAWNER}": ""}, PackageKind.ROBOT),
        ({f"r/{SPAWNER}": "", "r/package.xml": "<package/>"}, PackageKind.ROBOT),
        ({"r/model.sdf": MODEL, "r/launch/vehicle_topics.launch": ""}, PackageKind.ROBOT),
        ({"r/model.sdf": MODEL}, PackageKind.BASE_MODEL),
        ({f"r/{SPAWNER}": ROSLAUNCH.format(ONE)}, PackageKind.CONFIGURATION),
        ({"r/lib/libdrive.so": "", "r/package.xml": "<package/>"}, PackageKind.PLUGIN),
        ({"r/CMakeLists.txt": "add_library(drive a.cc)", "r/package.xml": ""}, PackageKind.PLUGIN),
        ({"r/CMakeLists.txt": "# add_library(drive)", "r/package.xml": ""}, PackageKind.UNKNOWN),
        ({"r/urdf/r.urdf.xacro": "", "r/package.xml": ""}, PackageKind.URDF_DESCRIPTION),
        ({"r/package.xml": "<package/>"}, PackageKind.UNKNOWN),
        ({**BESIDE, "r/launch/start.launch.py": "'urdf/' + name + '.xacro'"}, DESCRIPTION),
        ({**BESIDE, "r/launch/start.launch.py": "'models/yard/model.sdf'"}, PackageKind.BASE_MODEL),
    ],
)
def test_kinds(write: Write, files: Mapping[str, str], kind: PackageKind) -> None:
    assert package(write, files, "r").kind is kind


def test_forgotten_spawner_does_not_excuse_itself(write: Write) -> None:
    assert package(write, {f"{ONE}/model.sdf": MODEL}, ONE).kind is PackageKind.ROBOT


@pytest.mark.parametrize(
    ("config", "path"),
    [
        ("<model><sdf version='1.6'>lily.sdf</sdf></model>", "lily.sdf"),
        ("<model><sdf version='1.6'>./sub/../lily.sdf</sdf></model>", "lily.sdf"),
        ("<model><sdf version='1.4'>model.sdf</sdf><sdf version='1.6'>lily.sdf</sdf></model>",
         "lily.sdf"),
        ("<model><sdf version='1.10'>lily.sdf</sdf><sdf version='1.6'>model.sdf</sdf></model>",
         "lily.sdf"),
        ("<model><sdf>nowhere.sdf</sdf></model>", "model.sdf"),
        ("<model><sdf>../other/model.sdf</sdf></model>", "model.sdf"),
        ("<model><sdf>/etc/passwd</sdf></model>", "model.sdf"),
        ("<model>", "model.sdf"),
    ],
)  # fmt: skip
def test_model_that_model_config_names(write: Write, config: str, path: str) -> None:
    files = {"r/model.config": config, "r/model.sdf": MODEL, "r/lily.sdf": MODEL}
    found = package(write, {**files, "other/model.sdf": MODEL}, "r").model_path
    assert isinstance(found, Found)
    assert (found.path, found.is_inherited) == (path, False)


def test_only_sdf_file_is_the_model(write: Write) -> None:
    files = {"r/package.xml": "", "r/lily.sdf": MODEL, "r/worlds/example.sdf": MODEL}
    found = package(write, files, "r").model_path
    assert isinstance(found, Found)
    assert found.path == "lily.sdf"


@pytest.mark.parametrize(
    "ruby",
    [
        f"require_relative '../../{ONE}/launch/common.rb'",
        f"require_relative '../../{ONE}/launch/common'",
        f"load File.join(__dir__, '..', '..', '{ONE}', 'launch', 'common.rb')",
        f'load "#{{__dir__}}/../../{ONE}/launch/common.rb"',
        f"dir = `rospack find {ONE}`.chomp\nload dir + '/launch/common.rb'",
        f"dir = %x(rospack find {ONE}).chomp",
        ROSLAUNCH.format(ONE),
        f"roslaunch {ONE} vehicle_topics.launch",
        f"roslaunch --wait -v {ONE}  description.launch",
        f'"  <command>roslaunch {ONE} a.launch x:=#{{_n}}</command>\\n"\\',
    ],
)
def test_ways_to_name_a_sibling(ruby: str) -> None:
    assert names(ruby) == [ONE]


@pytest.mark.parametrize(
    "ruby",
    [
        f"# require_relative '../../{ONE}/launch/common.rb'",
        f"x = 1 # roslaunch {ONE} description.launch",
        f"<!-- <command>roslaunch {ONE} description.launch</command> -->",
        f"<!-- see # \n roslaunch {ONE} description.launch -->",
        f"=begin\nroslaunch {ONE} description.launch\n=end\n",
        f"x = 1\n__END__\nroslaunch {ONE} description.launch\n",
        "require_relative 'common.rb'",
        "require 'yaml'",
        "roslaunch #{pkg} description.launch",
        f"roslaunch {ONE} name:=x",
    ],
)
def test_what_names_no_sibling(ruby: str) -> None:
    assert names(ruby) == []


def test_comments_are_blanked_in_place() -> None:
    text = 'a # b\n"#{_x}" <!-- é -->"\nx#y <!-- open\nroslaunch p_1 a.launch\n'
    blank = blank_comments(text)
    assert blank == 'a    \n"#{_x}"           "\nx#y <!-- open\nroslaunch p_1 a.launch\n'


@pytest.mark.parametrize(
    "text",
    [
        "<!-- " * 100_000,
        "=begin\n" * 80_000,
        "roslaunch -" * 50_000,
        "roslaunch " * 50_000,
        "roslaunch a " + "x" * 500_000,
        "require " * 60_000,
        "../a" * 100_000,
        "`rospack " * 50_000,
        " " * 500_000,
        "load '.." + "a" * 500_000,
    ],
)
def test_no_text_makes_the_search_slow(text: str) -> None:
    with limited(2):
        names(text)


def test_alias_takes_everything_from_its_sibling(write: Write) -> None:
    two = package(
        write,
        {
            f"{ONE}/model.sdf": MODEL,
            f"{ONE}/specifications.md": "# Rover",
            f"{ONE}/launch/description.launch": "<launch/>",
            f"{ONE}/launch/vehicle_topics.launch": "<launch/>",
            f"{TWO}/{SPAWNER}": ROSLAUNCH.format(ONE),
        },
    )
    assert two.model_path == Found(two.workspace.package(ONE), f"../{ONE}/model.sdf")  # type: ignore[arg-type]  # None would fail as well
    found = two.part("specifications.md")
    assert isinstance(found, Found)
    assert found.is_inherited
    assert two.exists(found.path)
    assert {(item.part, item.package_name, item.at_hand) for item in two.inherited} == {
        (part, ONE, True) for part in Part if part is not Part.SPAWNER
    }
    assert {(item.how.file, item.how.line) for item in two.inherited} == {(SPAWNER, 1)}


def test_each_launch_file_comes_from_where_roslaunch_says(write: Write) -> None:
    ruby = f"{ROSLAUNCH.format(ONE)}\nroslaunch other_robot vehicle_topics.launch"
    two = package(
        write,
        {
            f"{ONE}/model.sdf": MODEL,
            f"{ONE}/launch/vehicle_topics.launch": "<launch/>",
            "other_robot/launch/vehicle_topics.launch": "<launch/>",
            "other_robot/package.xml": "<package/>",
            f"{TWO}/{SPAWNER}": ruby,
        },
    )
    found = two.part("launch/vehicle_topics.launch")
    assert isinstance(found, Found)
    assert found.path == "../other_robot/launch/vehicle_topics.launch"


@pytest.mark.parametrize("tag", ["exec_depend", "run_depend", "depend"])
def test_dependency_on_a_submission_lends_the_model(write: Write, tag: str) -> None:
    manifest = f"<package><{tag}>xacro</{tag}><{tag}>{ONE}</{tag}></package>"
    files = {f"{TWO}/package.xml": manifest, f"{TWO}/{SPAWNER}": "", f"{ONE}/model.sdf": MODEL}
    found = package(write, files).model_path
    assert isinstance(found, Found)
    assert found.path == f"../{ONE}/model.sdf"


def test_build_dependency_lends_nothing(write: Write) -> None:
    manifest = f"<package><build_depend>{ONE}</build_depend></package>"
    files = {f"{TWO}/package.xml": manifest, f"{TWO}/{SPAWNER}": "", f"{ONE}/model.sdf": MODEL}
    two = package(write, files)
    assert two.model_path == Missing("model", f"{TWO} has no model")
    assert two.kind is PackageKind.ROBOT


def test_own_parts_come_first_and_paperwork_is_never_inherited(write: Write) -> None:
    two = package(
        write,
        {
            f"{ONE}/model.sdf": MODEL,
            f"{ONE}/CMakeLists.txt": "",
            f"{ONE}/specifications.md": "",
            f"{TWO}/specifications.md": "",
            f"{TWO}/{SPAWNER}": ROSLAUNCH.format(ONE),
        },
    )
    found = two.part("specifications.md")
    assert isinstance(found, Found)
    assert not found.is_inherited
    assert two.part("CMakeLists.txt") == Missing("CMakeLists.txt", f"{TWO} has no CMakeLists.txt")


@pytest.mark.parametrize("name", ["specification.md", "Specifications.md", "robot_specs.md"])
def test_a_sheet_is_found_under_another_spelling_of_its_name(write: Write, name: str) -> None:
    one = package(write, {f"{ONE}/model.sdf": MODEL, f"{ONE}/{name}": ""}, ONE)
    found = one.part("specifications.md")
    assert isinstance(found, Found)
    assert found.path == name


@pytest.mark.parametrize("name", ["README.md", "inspection.md", "doc/specification.md"])
def test_another_text_is_no_sheet(write: Write, name: str) -> None:
    one = package(write, {f"{ONE}/model.sdf": MODEL, f"{ONE}/{name}": ""}, ONE)
    assert isinstance(one.part("specifications.md"), Missing)


def test_the_right_name_of_a_sheet_counts_first(write: Write) -> None:
    files = {f"{ONE}/model.sdf": MODEL, f"{ONE}/spec.md": "", f"{ONE}/specifications.md": ""}
    found = package(write, files, ONE).part("specifications.md")
    assert isinstance(found, Found)
    assert found.path == "specifications.md"


def test_robot_with_its_own_model_inherits_no_specification(write: Write) -> None:
    two = package(
        write,
        {
            f"{ONE}/specifications.md": "",
            f"{ONE}/model.sdf": MODEL,
            f"{TWO}/model.sdf": MODEL,
            f"{TWO}/{SPAWNER}": f"require_relative '../../{ONE}/launch/common.rb'",
        },
    )
    assert isinstance(two.part("specifications.md"), Missing)
    assert [(item.part, item.package_name) for item in two.inherited] == [(Part.SPAWNER, ONE)]
    assert two.kind is PackageKind.ROBOT


@pytest.mark.parametrize(
    "ruby",
    [
        "require_relative 'common'",
        'load "#{__dir__}/common.rb"',
        "load File.join(__dir__, 'common.rb')",
    ],
)
def test_what_a_loaded_file_starts_counts(write: Write, ruby: str) -> None:
    two = package(
        write,
        {
            f"{ONE}/model.sdf": MODEL,
            f"{ONE}/launch/vehicle_topics.launch": "<launch/>",
            f"{TWO}/{SPAWNER}": ruby,
            f"{TWO}/launch/common.rb": ROSLAUNCH.format(ONE),
        },
    )
    assert isinstance(two.part("launch/vehicle_topics.launch"), Found)
    assert [(item.package_name, item.by_sibling) for item in two.references] == [(ONE, False)]


def test_what_a_siblings_file_starts_is_known_as_its_own(write: Write) -> None:
    files = {
        f"{ONE}/model.sdf": MODEL,
        f"{ONE}/launch/common.rb": f"roslaunch {THREE} description.launch",
        f"{TWO}/{SPAWNER}": f"require_relative '../../{ONE}/launch/common.rb'",
    }
    two = package(write, files)
    assert [(item.package_name, item.by_sibling) for item in two.references] == [
        (ONE, False),
        (THREE, True),
    ]
    assert two.base is not None
    assert two.base.package_name == ONE


@pytest.mark.parametrize(
    "element",
    [
        f'<param name="d" command="xacro $(find {ONE})/urdf/rover.xacro"/>',
        f'<include file="$(find {ONE})/launch/description.launch"/>',
    ],
)
def test_urdf_comes_from_where_the_launch_file_loads_it(write: Write, element: str) -> None:
    load = f"<launch>{element}</launch>"
    two = package(
        write,
        {
            f"{ONE}/urdf/rover.xacro": "<robot/>",
            f"{ONE}/package.xml": "<package/>",
            f"{TWO}/model.sdf": MODEL,
            f"{TWO}/launch/description.launch": load,
            f"{TWO}/{SPAWNER}": "",
        },
    )
    found = two.part("urdf")
    assert isinstance(found, Found)
    assert found.path == f"../{ONE}/urdf"


def test_chain_of_siblings(write: Write) -> None:
    three = package(
        write,
        {
            f"{ONE}/model.sdf": MODEL,
            f"{TWO}/{SPAWNER}": ROSLAUNCH.format(ONE),
            f"{THREE}/{SPAWNER}": ROSLAUNCH.format(TWO),
        },
        THREE,
    )
    found = three.model_path
    assert isinstance(found, Found)
    assert found.path == f"../{ONE}/model.sdf"
    spec = three.part("specifications.md")
    assert spec == Missing(
        "specifications.md", f"{THREE} and {TWO} and {ONE} have no specifications.md"
    )


def test_circle_of_siblings(write: Write) -> None:
    two = package(
        write,
        {f"{TWO}/{SPAWNER}": ROSLAUNCH.format(THREE), f"{THREE}/{SPAWNER}": ROSLAUNCH.format(TWO)},
    )
    found = two.model_path
    assert isinstance(found, Missing)
    assert found.reason.endswith(f"{TWO} → {THREE} → {TWO}")
    assert found.package_not_at_hand is None


def test_sibling_at_the_end_of_a_chain_is_not_at_hand(write: Write) -> None:
    files = {f"{TWO}/{SPAWNER}": ROSLAUNCH.format(ONE), f"{THREE}/{SPAWNER}": ROSLAUNCH.format(TWO)}
    three = package(write, files, THREE)
    reason = f"model is inherited from {ONE}, which is not available"
    assert three.model_path == Missing("model", reason, ONE)
    assert all(item.package_name == ONE and not item.at_hand for item in three.inherited)


def test_sibling_is_found_by_the_name_in_its_package_xml(write: Write) -> None:
    two = package(
        write,
        {
            "checkout/package.xml": f"<package><name>{ONE}</name></package>",
            "checkout/model.sdf": MODEL,
            f"{TWO}/{SPAWNER}": ROSLAUNCH.format(ONE),
        },
    )
    found = two.model_path
    assert isinstance(found, Found)
    assert found.path == "../checkout/model.sdf"
    assert two.exists(found.path)


@pytest.mark.parametrize("name", ["", ".", "..", "a/b", "../space", "a\\b", "a\0b", "n" * 300])
def test_workspace_takes_plain_names_only(write: Write, name: str) -> None:
    assert Workspace((write({"a/b/model.sdf": MODEL}),)).package(name) is None


def test_sibling_that_is_a_link_out_of_the_workspace_is_not_at_hand(write: Write) -> None:
    space = write({"in/a/model.sdf": MODEL, "out/b/model.sdf": MODEL})
    (space / "in" / "b").symlink_to(space / "out" / "b")
    (space / "in" / "c").symlink_to("a")
    workspace = Workspace((space / "in",))
    assert workspace.package("b") is None
    assert workspace.package("c") is workspace.package("a")
