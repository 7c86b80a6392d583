"""What CMake installs is found under the path that it has then."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.package.installed import installed_as, leaves_out, left_out_folder, source_of
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
        assert not isinstance(subject.descriptions, NotAvailable)
        description = subject.descriptions[0]
        assert [link.name.value for link in description.robot.links] == ["hook"]
        subject.close()


AUTO = """project(hoist)
ament_auto_package(INSTALL_TO_SHARE launch description/urdf USE_SCOPED_HEADER_INSTALL_DIR)
"""
SETUP = """from glob import glob
from setuptools import setup
setup(data_files=[("share/hoist/urdf", glob("description/urdf/*")), ("share/hoist", ["a.txt"])])
"""


@pytest.mark.parametrize(
    ("build", "path", "left_out", "folder", "target"),
    [
        (("CMakeLists.txt", AUTO), "description/urdf/crane.xacro", True, "", "urdf/crane.xacro"),
        (("CMakeLists.txt", AUTO), "urdf/crane.xacro", False, "urdf", ""),
        (("CMakeLists.txt", AUTO), "notes.txt", True, "", ""),
        (("CMakeLists.txt", AUTO), "description/parts/hook.xacro", True, "description/parts", ""),
        (("CMakeLists.txt", f"include(x)\n{AUTO}"), "notes.txt", False, "", ""),
        (("CMakeLists.txt", f"configure_file(a b)\n{AUTO}"), "notes.txt", False, "", ""),
        (("CMakeLists.txt", f"set(A notes)\n{AUTO}"), "notes.txt", False, "", ""),
        (("setup.py", SETUP), "description/parts/hook.xacro", True, "description/parts", ""),
        (("setup.py", SETUP.replace("[(", "x + [(")), "notes.txt", False, "", ""),
        (("setup.py", SETUP), "absent.txt", False, "", ""),
    ],
)
def test_what_is_left_out(
    write: Write, build: tuple[str, str], path: str, left_out: bool, folder: str, target: str
) -> None:
    files = ("description/urdf/crane.xacro", "description/parts/hook.xacro", "notes.txt", "a.txt")
    texts = {**dict.fromkeys(files, "<robot/>"), "package.xml": "<package/>", build[0]: build[1]}
    with open_input(write({f"crane/{name}": text for name, text in texts.items()}) / "crane") as it:
        package = it.packages[0]
        assert leaves_out(package, path) is left_out
        assert left_out_folder(package, path) == folder
        assert installed_as(package, path) == target
