"""A package may install folders that are beside it: their files are where they are installed."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.inputs import open_input
from checker.package.installed_from_outside import is_from_outside, may_be_from_outside
from checker.package.package import Package
from checker.pipeline import check_package
from checker.settings import Settings
from tests.package.conftest import Write

CMAKE = """project(crane)
get_filename_component(TOP ${CMAKE_CURRENT_SOURCE_DIR}/../.. ABSOLUTE)
get_filename_component(SOURCES ${CMAKE_CURRENT_SOURCE_DIR} DIRECTORY)
install(DIRECTORY ${TOP}/launch DESTINATION share/${PROJECT_NAME})
install(DIRECTORY ../../config/ DESTINATION share/${PROJECT_NAME}/parameters)
install(FILES ${SOURCES}/notes.txt DESTINATION share/crane)
install(DIRECTORY ${PICTURES}/shots DESTINATION share/crane)
install(DIRECTORY ../../../beyond DESTINATION share/crane)
ament_package()
"""
MANIFEST = """<package format="3"><name>crane</name><export>
<build_type>ament_cmake</build_type></export></package>"""
LAUNCH = """<launch>
  <include file="$(find-pkg-share crane)/launch/lift.launch.xml"/>
  <include file="$(find-pkg-share crane)/launch/lower.launch.xml"/>
</launch>
"""
README = "`ros2 launch crane crane.launch.xml` `ros2 launch crane lower.launch.xml`\n"


@pytest.fixture
def top(write: Write) -> Path:
    texts = {
        "src/crane/launch/crane.launch.xml": LAUNCH,
        "launch/lift.launch.xml": "<launch/>",
        "config/crane.yaml": "{}\n",
        "README.md": README,
        "src/notes.txt": "",
        "src/crane/package.xml": MANIFEST,
        "src/crane/CMakeLists.txt": CMAKE,
    }
    return write({f"yard/{path}": text for path, text in texts.items()}) / "yard"


@pytest.mark.parametrize(
    ("path", "is_there", "unknown"),
    [
        ("launch/lift.launch.xml", True, ""),
        ("launch/lower.launch.xml", False, ""),
        ("parameters/crane.yaml", True, ""),
        ("config/crane.yaml", False, ""),
        ("notes.txt", True, ""),
        ("shots/side.png", False, "CMakeLists.txt:7 of crane"),
        ("beyond/crane.yaml", False, "CMakeLists.txt:8 of crane"),
    ],
)
def test_what_is_beside_the_package(top: Path, path: str, is_there: bool, unknown: str) -> None:
    with open_input(top) as opened:
        (crane,) = (it for it in opened.packages if _is_crane(it))
        assert is_from_outside(crane, path) is is_there
        assert may_be_from_outside(crane, path).startswith(unknown)
        assert bool(may_be_from_outside(crane, path)) is bool(unknown)


def _is_crane(package: Package) -> bool:
    return package.declared_name == "crane"


def test_only_files_that_are_not_there_are_missing(top: Path) -> None:
    settings = Settings(trial=False, select=("LCH001", "PKG026"))
    found = [it for report in check_package(top, settings).packages for it in report.findings]
    assert {it.rule for it in found} == {"LCH001", "PKG026"}
    assert all("lower.launch.xml" in it.message for it in found)
