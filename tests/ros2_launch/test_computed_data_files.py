"""Files that a setup.py may install, which computes what it installs."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.settings import find_settings

MANIFEST = """<package format="3"><name>yard</name><export>
<build_type>ament_python</build_type></export></package>"""
SETUP = """from glob import glob
from setuptools import setup

setup(name="yard", data_files=[("share/yard/" + path[4:], [path]) for path in glob("src/**/*")])
"""
LAUNCH = """from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare("yard"), "parts", "@.launch.py"])
    return LaunchDescription([IncludeLaunchDescription(file)])
"""


@pytest.mark.parametrize(("name", "found"), [("posts", False), ("gates", True)])
def test_a_file_of_that_name_is_not_missing(tmp_path: Path, name: str, *, found: bool) -> None:
    package = tmp_path / "yard"
    (package / "launch").mkdir(parents=True)
    (package / "src/parts").mkdir(parents=True)
    (package / "src/parts/posts.launch.py").write_text("")
    (package / "package.xml").write_text(MANIFEST)
    (package / "setup.py").write_text(SETUP)
    (package / "launch/yard.launch.py").write_text(LAUNCH.replace("@", name))
    settings = find_settings([package]).with_overrides(trial=False, cache=False)
    (report,) = check_package(package, settings).packages
    assert any(each.rule == "LCH001" for each in report.findings) is found
    assert any(each.rule == "LCH001" for each in report.not_checked) is not found


@pytest.mark.parametrize(
    ("named", "severity"), [("launch", Severity.INFO), ("lib", Severity.ERROR)]
)
def test_a_setup_that_names_each_folder_leaves_only_an_info_unchecked(
    tmp_path: Path, named: str, severity: Severity
) -> None:
    package = tmp_path / "yard"
    (package / "launch").mkdir(parents=True)
    (package / "launch/yard.launch.py").write_text(LAUNCH)
    (package / "package.xml").write_text(MANIFEST)
    (package / "setup.py").write_text(SETUP.replace("src", named))
    settings = find_settings([package]).with_overrides(trial=False, cache=False)
    (report,) = check_package(package, settings).packages
    (left,) = (each for each in report.not_checked if each.rule == "PKG008")
    assert left.severity is severity
