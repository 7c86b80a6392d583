"""setup.py is read and never run: what `data_files` installs, and when that is not known."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.package.inputs import open_input
from checker.package.installed import source_of
from checker.source.setup_py import Pattern, read_setup
from checker.source.text import SourceText

SETUP = """import os
from glob import glob
from setuptools import setup

package_name = 'arm'
setup(
    name=package_name,
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        (os.path.join('share', package_name, 'launch'), glob('launch/*.launch.py')),
        (f'share/{package_name}/meshes', glob(os.path.join('meshes/**', '*.stl'), recursive=True)),
    ],
)
"""


def read(text: str) -> object:
    return read_setup(SourceText("setup.py", text))


def test_the_usual_forms_are_read() -> None:
    setup = read_setup(SourceText("setup.py", SETUP))
    assert setup is not None
    assert setup.complete
    assert [
        (entry.destination, *(file.value for file in entry.files), *entry.patterns)
        for entry in setup.data_files
    ] == [
        ("share/ament_index/resource_index/packages", "resource/arm"),
        ("share/arm", "package.xml"),
        ("share/arm/launch", Pattern("launch/*.launch.py")),
        ("share/arm/meshes", Pattern("meshes/**/*.stl", recursive=True)),
    ]
    assert setup.data_files[0].files[0].span.text == "'resource/' + package_name"
    assert setup.data_files[1].span.text == "('share/' + package_name, ['package.xml'])"


@pytest.mark.parametrize("character", ["\f", "\x1c", "\u2028", "\x85"])
def test_characters_that_end_no_line_of_python_move_no_place(character: str) -> None:
    """`str.splitlines` takes them for line ends."""
    text = f"title = 'a{character}b'\n{character if character == chr(12) else ''}{SETUP}"
    setup = read_setup(SourceText("setup.py", text))
    assert setup is not None
    assert setup.data_files[1].span.text == "('share/' + package_name, ['package.xml'])"


def test_executables_are_read() -> None:
    text = """setup(entry_points={
    'console_scripts': ['talker = arm.nodes.talker:main', computed(), 'tool=arm.tool'],
    'pytest11': ['plugin = arm.plugin'],
})"""
    setup = read_setup(SourceText("setup.py", text))
    assert setup is not None
    assert setup.plain
    assert [(it.name, it.module, it.function) for it in setup.executables] == [
        ("talker", "arm.nodes.talker", "main"),
        ("tool", "arm.tool", ""),
    ]
    assert setup.executables[1].span.text == "'tool=arm.tool'"


@pytest.mark.parametrize(
    "given_files",
    ["files()", "[('share/arm', list_of())]", "[(x, ['package.xml'])]", "[*more]", "f'{1:>9}'"],
)
def test_what_is_computed_is_incomplete(given_files: str) -> None:
    setup = read_setup(SourceText("setup.py", f"setup(data_files={given_files})"))
    assert setup is not None
    assert not setup.complete


@pytest.mark.parametrize(
    "change",
    [
        "files += [('share/arm', ['a'])]",
        "files.append(('share/arm', ['a']))",
        "for x in os.walk('meshes'):\n    files.append((x[0], x[2]))",
        "add_folder(files, 'meshes')",
        "if True:\n    files = found()",
    ],
)
def test_a_list_that_changes_is_incomplete(change: str) -> None:
    text = (
        "name = 'arm'\nfiles = [('share/' + name, ['b'])]\n@\nprint(name)\nsetup(data_files=files)"
    )
    plain, changed = (
        read_setup(SourceText("setup.py", text.replace("@", x))) for x in ("", change)
    )
    assert plain is not None
    assert plain.complete
    assert changed is not None
    assert not changed.complete


@pytest.mark.parametrize("text", ["", "def setup(:", "print('é')", "x = setup", "\0"])
def test_what_calls_no_setup_is_none(text: str) -> None:
    assert read(text) is None


def test_names_in_a_circle_and_deep_expressions_end() -> None:
    circle = "a = b\nb = a\nsetup(data_files=a)"
    deep = "setup(data_files=[('share/arm', [" + "'a' + " * 3000 + "'b'])])"
    for text in (circle, deep):
        setup = read_setup(SourceText("setup.py", text))
        assert setup is None or not setup.complete


@given(st.text(max_size=200))
def test_any_text_is_read_without_an_exception(text: str) -> None:
    read(f"setup(data_files={text})")


def test_installed_files_lead_to_their_source(tmp_path: Path) -> None:
    files = ("package.xml", "launch/arm.launch.py", "launch/notes.txt", "meshes/a/b.stl", "x.stl")
    for file in files:
        (tmp_path / "arm" / file).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "arm" / file).write_text("<package><name>arm</name></package>")
    (tmp_path / "arm/setup.py").write_text(SETUP)
    with open_input(tmp_path / "arm") as opened:
        (package,) = opened.packages
        assert source_of(package, "launch/arm.launch.py") == "launch/arm.launch.py"
        assert source_of(package, "meshes/b.stl") == "meshes/a/b.stl"
        assert source_of(package, "launch/notes.txt") is None
        assert source_of(package, "x.stl") is None
