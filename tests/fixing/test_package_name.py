"""A package is renamed in all of its files, or in none; its folder's name is no reason to."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from checker.cli.check.fix import fix_paths
from checker.finding import Safety
from checker.package.inputs import open_input
from checker.package.renaming import package_renamed
from checker.rule_testing import write_example
from tests.conftest import SAMPLES
from tests.each import of_each

OLD, NEW = "acme_rover_sensor_config_2", "acme_rover_sensor_config_1"
ROVER = {
    "package.xml": f"<package><name>{OLD}</name></package>\n",
    "CMakeLists.txt": f"project({OLD})\ninstall(DIRECTORY launch DESTINATION share/{OLD})\n",
    "launch/view.launch": f'<launch><include file="$(find {OLD})/launch/a.launch"/></launch>\n',
    "launch/a.launch": f'<launch><node pkg="{OLD}" type="a.py" name="a"/></launch>\n',
    "urdf/a.xacro": f'<robot name="a"><mesh filename="package://{OLD}/meshes/a.dae"/></robot>\n',
    "README.md": f"Start `roslaunch {OLD} view.launch`; see {NEW}.\n",
    "launch/example.ign": f"<%# ign launch competition.ign robotConfig1:={OLD.upper()} %>\n",
}


def renamed(folder: Path, files: dict[str, str | bytes], old: str = OLD) -> dict[str, str] | None:
    """Write a package, rename it, and return its new texts; None where it cannot be renamed."""
    package = write_example({"@name": NEW, **files}, folder)
    with open_input(package) as opened:
        fix = package_renamed(opened.packages[0], old, NEW)
    if fix is None:
        return None
    assert fix.safety is Safety.UNSAFE
    lines = {path: (package / path).read_text().splitlines(keepends=True) for path in files}
    for edit in sorted(fix.edits, key=lambda edit: (edit.place.line, -edit.place.column)):
        place = edit.place
        line = lines[place.file][place.line - 1]
        before, behind = line[: place.column - 1], line[place.end_column - 1 :]
        lines[place.file][place.line - 1] = before + edit.replacement + behind
    return {path: "".join(text) for path, text in lines.items()}


def test_every_mention_has_the_new_name(tmp_path: Path) -> None:
    texts = renamed(tmp_path, dict(ROVER))
    assert texts == {
        path: text.replace(OLD, NEW).replace(OLD.upper(), NEW.upper())
        for path, text in ROVER.items()
    }


@of_each(
    "more",
    [
        {f"urdf/{OLD}.urdf": "<robot/>"},
        {"urdf/b.xacro": f'<robot name="{OLD}_base"/>'},
        {"urdf/b.xacro": f'<robot name="{OLD.capitalize()}"/>'},
        {"meshes/a.glb": b"\0" + OLD.encode()},
        {f"../{OLD}/package.xml": "<package><name>other</name></package>"},
        {"../other/package.xml": f"<package><exec_depend>{OLD}</exec_depend></package>"},
    ],
)
def test_nothing_is_renamed_where_a_mention_is_left_over(
    more: dict[str, str | bytes], tmp_path: Path
) -> None:
    folder = tmp_path / str(hash(str(more)))
    assert renamed(folder, {**ROVER, **more}) is None


@pytest.mark.parametrize(("text", "can_be"), [("$(find scout)", True), ("a scout drives", False)])
def test_a_plain_word_is_renamed_only_where_it_is_the_package(
    text: str, can_be: bool, tmp_path: Path
) -> None:
    files = {path: content.replace(OLD, "scout") for path, content in ROVER.items()}
    files["README.md"] = text
    assert (renamed(tmp_path, files, "scout") is not None) is can_be


@pytest.mark.parametrize("folder", ["a copy", "{}-master", "{} (1)"])
def test_no_fix_follows_the_name_of_the_folder(folder: str, tmp_path: Path) -> None:
    sample = "subtcheck_buggy_sensor_config_1"
    package = shutil.copytree(SAMPLES / sample, tmp_path / folder.format(sample))
    (each,) = fix_paths([package], {}, list(Safety), write=False)
    changed = {file.path for file in each.fixed.files}
    assert changed.isdisjoint({"package.xml", "CMakeLists.txt", "launch/spawner.rb"})
