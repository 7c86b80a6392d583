"""Launch files whose text is not UTF-8: Python imports them if only comments are affected."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.settings import Settings

_LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node

# direcci\xf3n
def generate_launch_description():
    name = "{}"
    return LaunchDescription([Node(package="acme_base", executable="drive", node_name=name)])
"""
_MANIFEST = """<package format="3">
  <name>acme_base</name>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""


@pytest.mark.parametrize(("word", "is_read"), [("drive", True), ("direcci\xf3n", False)])
def test_a_launch_file_that_is_not_utf_8(tmp_path: Path, word: str, is_read: bool) -> None:
    package = tmp_path / "acme_base"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(_MANIFEST)
    text = _LAUNCH.format(word).encode("latin-1")
    (package / "launch/drive.launch.py").write_bytes(text)
    settings = Settings(select=("LCH004",), trial=False, profile="ros2", profile_chosen=True)
    (report,) = check_package(package, settings).packages
    reasons = [it.reason for it in report.not_checked if "drive.launch.py" in it.reason]
    assert bool(report.findings) is is_read
    assert [reason.split(":")[0] for reason in reasons] == (
        [] if is_read else ["launch/drive.launch.py is not UTF-8 text"]
    )
