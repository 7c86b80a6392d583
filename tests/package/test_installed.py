"""What CMake installs is found under the path that it has then."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.package.installed import source_of
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
