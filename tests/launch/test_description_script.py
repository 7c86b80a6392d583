"""Scripts that print a description: what their text says of xacro."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.inputs import open_input
from checker.ros.description_script import DescriptionScript, read_description_script

SHELL = "#!/bin/bash\n"
PYTHON = "#!/usr/bin/env python3\n"


def read(folder: Path, text: str, path: str = "scripts/describe") -> DescriptionScript | None:
    files = {
        "package.xml": "<package><name>rover</name></package>",
        "urdf/rover.xacro": "<robot/>",
        "urdf/left/wheel.xacro": "<robot/>",
        "urdf/right/wheel.xacro": "<robot/>",
        path: text,
    }
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(content)
    with open_input(folder) as opened:
        return read_description_script(opened.packages[0], path)


@pytest.mark.parametrize(
    ("text", "takes"),
    [
        (f'{SHELL}xacro urdf/rover.xacro "$@"\n', True),
        (f"{SHELL}xacro urdf/rover.xacro ${{*}}\n", True),
        (f"{SHELL}# all of $@\nxacro urdf/rover.xacro $ARGS\n", False),
        (f"{PYTHON}import xacro, sys\nxacro.main('urdf/rover.xacro', sys.argv)\n", True),
        (f"{PYTHON}import xacro\nprint(xacro.process_file('urdf/rover.xacro').toxml())\n", False),
    ],
)
def test_whether_a_script_takes_its_arguments(tmp_path: Path, text: str, takes: bool) -> None:
    script = read(tmp_path, text)
    assert script is not None
    assert script.takes_arguments is takes
    assert script.files == ("urdf/rover.xacro",)


@pytest.mark.parametrize(
    "line", [". ./common", "source common", "import os; os.environ['NAME']", "rosparam get name"]
)
def test_a_script_may_know_values_from_elsewhere(tmp_path: Path, line: str) -> None:
    script = read(tmp_path, f"{SHELL}{line}\nxacro urdf/rover.xacro $ARGS\n")
    assert script is not None
    assert script.learns_more
    assert not script.takes_arguments


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("name:=rover", "rover"),
        ("'name:=rover'", "rover"),
        ("name:=$1", None),
        ('"name:=" + name', None),
        ('"name:=%s" % name', None),
        ('f"name:={name}"', None),
    ],
)
def test_what_a_script_gives_by_itself(tmp_path: Path, written: str, value: str | None) -> None:
    script = read(tmp_path, f"{SHELL}xacro urdf/rover.xacro {written}\n")
    assert script is not None
    assert script.arguments == {"name": value}


@pytest.mark.parametrize(
    ("text", "path"),
    [
        ("<robot>xacro</robot>", "scripts/describe"),
        (f"{SHELL}cat urdf/rover.xacro\n", "scripts/describe"),
        (f"{SHELL}# xacro\ncat out.urdf\n", "scripts/describe"),
        ("#!/usr/bin/perl\nsystem('xacro')\n", "scripts/describe"),
    ],
)
def test_other_files_are_no_such_scripts(tmp_path: Path, text: str, path: str) -> None:
    assert read(tmp_path, text, path) is None


def test_a_suffix_makes_a_script_and_a_name_of_two_files_means_neither(tmp_path: Path) -> None:
    script = read(tmp_path, "xacro wheel.xacro\n", "scripts/describe.sh")
    assert script is not None
    assert script.files == ()
