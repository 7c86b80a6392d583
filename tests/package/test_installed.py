"""What CMake installs is found under the path that it has then."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.formats.urdf.description import UrdfDescription
from checker.package.inputs import open_input
from checker.package.installed import installed_as, left_out, source_of
from tests.package.conftest import Write

CMAKE = """project(crane)
install(DIRECTORY description/urdf description/parts/ DESTINATION share/${PROJECT_NAME})
install(FILES notes.txt DESTINATION share/crane/doc)
install(DIRECTORY code DESTINATION lib/crane)
"""


@pytest.fixture
def crane(write: Write) -> Path:
    files = ("description/urdf/crane.xacro", "description/parts/hook.xacro", "notes.txt", "code/x")
    manifest = {"package.xml": "<package><name>crane</name></package>", "CMakeLists.txt": CMAKE}
    robot = (
        '<robot name="crane" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:include filename="$(find crane)/hook.xacro"/></robot>'
    )
    texts = dict.fromkeys(files, "<robot><link name='hook'/></robot>") | {files[0]: robot}
    return write({f"crane/{path}": text for path, text in {**manifest, **texts}.items()}) / "crane"


@pytest.mark.parametrize(
    ("path", "source"),
    [
        ("urdf/crane.xacro", "description/urdf/crane.xacro"),
        ("hook.xacro", "description/parts/hook.xacro"),
        ("doc/notes.txt", "notes.txt"),
        ("urdf/other.xacro", None),
        ("code/x", None),
        ("../crane/notes.txt", None),
    ],
)
def test_the_source_of_what_is_installed(crane: Path, path: str, source: str | None) -> None:
    with open_input(crane) as opened:
        assert source_of(opened.packages[0], path) == source


def test_xacro_finds_what_is_installed(crane: Path) -> None:
    with open_input(crane) as opened:
        subject = Subject(opened.packages[0])
        assert not isinstance(subject.all(UrdfDescription), NotAvailable)
        description = subject.all(UrdfDescription)[0]
        assert [link.name.value for link in description.robot.links] == ["hook"]
        subject.close()


AUTO = """project(hoist)
ament_auto_package(INSTALL_TO_SHARE launch description/urdf USE_SCOPED_HEADER_INSTALL_DIR)
"""
SETUP = """from glob import glob
from setuptools import setup
setup(data_files=[("share/hoist/urdf", glob("description/urdf/*")), ("share/hoist", ["a.txt"])])
"""


ALONE = "exists only in the source"


@pytest.mark.parametrize(
    ("build", "path", "expected"),
    [
        (
            ("CMakeLists.txt", AUTO),
            "description/urdf/crane.xacro",
            "is installed as urdf/crane.xacro",
        ),
        (("CMakeLists.txt", AUTO), "urdf/crane.xacro", None),
        (("CMakeLists.txt", AUTO), "notes.txt", f"the file {ALONE}"),
        (
            ("CMakeLists.txt", AUTO),
            "description/parts/hook.xacro",
            f"folder description/parts/ {ALONE}",
        ),
        (("CMakeLists.txt", AUTO), "config/a.yaml", None),
        (("CMakeLists.txt", f"include(x)\n{AUTO}"), "notes.txt", None),
        (("CMakeLists.txt", f"configure_file(a b)\n{AUTO}"), "notes.txt", None),
        (("CMakeLists.txt", f"set(A notes)\n{AUTO}"), "notes.txt", None),
        # The source of a program makes no other file of its name.
        (
            ("CMakeLists.txt", f"add_library(lift src/notes.cpp)\n{AUTO}"),
            "notes.txt",
            f"the file {ALONE}",
        ),
        (("setup.py", SETUP), "description/parts/hook.xacro", f"folder description/parts/ {ALONE}"),
        (("setup.py", SETUP.replace("[(", "x + [(")), "notes.txt", None),
        (("setup.py", SETUP), "absent.txt", None),
    ],
)
def test_what_is_left_out(
    write: Write, build: tuple[str, str], path: str, expected: str | None
) -> None:
    files = ("description/urdf/crane.xacro", "description/parts/hook.xacro", "notes.txt", "a.txt")
    texts = {**dict.fromkeys(files, "<robot/>"), "package.xml": "<package/>", build[0]: build[1]}
    texts["config/a.yaml"] = "a: 1\n"
    with open_input(write({f"crane/{name}": text for name, text in texts.items()}) / "crane") as it:
        left = left_out(it.packages[0], it.packages[0], path)
        assert (left is None) is (expected is None)
        assert left is None or left.instead.endswith(str(expected))


def test_where_a_file_is_installed(crane: Path) -> None:
    with open_input(crane) as opened:
        package = opened.packages[0]
        assert installed_as(package, "description/parts/hook.xacro") == "hook.xacro"
        assert installed_as(package, "package.xml") == ""
