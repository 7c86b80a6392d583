"""Names that clients send: shown, telling of the kind, never a path."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.service.web.uploads.form import SUFFIXES, UnknownKind, safe_name

HOSTILE = st.text(max_size=300) | st.sampled_from(["../" * 9, "C:\\", "\0", "\u202e", "…", "💥"])


@pytest.mark.parametrize(
    ("given", "safe"),
    [
        ("x1_sensor_config_1.zip", "x1_sensor_config_1.zip"),
        ("My robot (2).tar.gz", "My_robot_2.tar.gz"),
        ("C:\\Users\\me\\robot.ZIP", "robot.zip"),
        ("../../etc/model.sdf", "model.sdf"),
        ("</script><script>.urdf", "script_script.urdf"),
        ("机器人.xacro", "机器人.xacro"),
        ("--help.zip", "help.zip"),
        (".zip", "upload.zip"),
        ("a" * 300 + ".tgz", "a" * 96 + ".tgz"),
    ],
)
def test_a_name_made_safe(given: str, safe: str) -> None:
    assert safe_name(given) == safe


@pytest.mark.parametrize("given", ["", "robot", "robot.rar", "zip", "robot.zip.exe", "robot.zip/"])
def test_an_ending_of_no_known_kind(given: str) -> None:
    with pytest.raises(UnknownKind, match=r"does not end in \.zip, \.tar\.gz, .* or \.mjcf$"):
        safe_name(given)


@given(HOSTILE, st.sampled_from(SUFFIXES))
def test_any_name_with_a_known_ending(stem: str, suffix: str) -> None:
    name = safe_name(stem + suffix)
    assert re.fullmatch(r"\w[\w.-]*", name)
    assert name.endswith(suffix)
    assert len(name.encode()) <= 100
    assert safe_name(name) == name
