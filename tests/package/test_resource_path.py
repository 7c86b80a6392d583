"""What hooks and package.xml put on the path that Gazebo searches."""

from __future__ import annotations

import pytest

from checker.package.inputs import open_input
from checker.package.resource_path import mentions, searched_folders
from tests.package.conftest import Write

BUILD = """project(crane)
ament_environment_hooks("${CMAKE_CURRENT_SOURCE_DIR}/hooks/@")
"""
MANIFEST = "<package><name>crane</name><export>@</export></package>"
PLAIN = {"package.xml": MANIFEST.replace("@", "")}
ADD = "prepend-non-duplicate;GZ_SIM_RESOURCE_PATH"


@pytest.mark.parametrize(
    ("file", "text", "expected"),
    [
        ("a.dsv", f"{ADD};share", [("", True)]),
        ("a.dsv.in", f"{ADD};share/;@CMAKE_INSTALL_PREFIX@/share", [("", True)] * 2),
        ("a.dsv.in", f"{ADD};share/@PROJECT_NAME@/models", [("crane/models", True)]),
        ("a.dsv", f"{ADD};share/@PROJECT_NAME@/models", [("@PROJECT_NAME@/models", False)]),
        ("a.dsv", f"{ADD};lib/crane", [(None, True)]),
        ("a.dsv", "prepend-non-duplicate;GZ_SIM_SYSTEM_PLUGIN_PATH;lib", []),
        ("a.dsv", "source;share/crane/GZ_SIM_RESOURCE_PATH.sh", [(None, False)]),
        ("a.sh", 'ament_prepend_unique_value SDF_PATH "$AMENT_CURRENT_PREFIX/share"', [("", True)]),
        (
            "a.sh.in",
            "export GZ_SIM_RESOURCE_PATH=${GZ_SIM_RESOURCE_PATH}:@CMAKE_INSTALL_PREFIX@/share/x",
            [("x", True)],
        ),
        ("a.sh", "export GZ_SIM_RESOURCE_PATH=$HERE", [(None, False)]),
        ("a.sh", "# GZ_SIM_RESOURCE_PATH is set elsewhere", []),
    ],
)
def test_hooks(write: Write, file: str, text: str, expected: list[tuple[str | None, bool]]) -> None:
    files = {**PLAIN, "CMakeLists.txt": BUILD.replace("@", file), f"hooks/{file}": f"{text}\n"}
    folder = write({f"crane/{path}": content for path, content in files.items()}) / "crane"
    with open_input(folder) as opened:
        found = [*searched_folders(opened.packages[0])]
    assert [(each.folder, each.known) for each in found] == expected
    assert all(each.span.text == text for each in found)


def test_a_hook_that_nothing_registers_is_none_and_a_mention(write: Write) -> None:
    files = {
        **PLAIN,
        "CMakeLists.txt": BUILD.replace("@", "b.dsv"),
        "hooks/a.dsv": f"{ADD};share\n",
    }
    folder = write({f"crane/{path}": content for path, content in files.items()}) / "crane"
    with open_input(folder) as opened:
        package = opened.packages[0]
        assert not [*searched_folders(package)]
        assert [span.source.file for span in mentions(package)] == ["hooks/a.dsv"]


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("${prefix}/..", [("", True)]),
        ("${prefix}", [("crane", True)]),
        ("${prefix}/models:${prefix}/../", [("crane/models", True), ("", True)]),
        ("/usr/share:${HOME}", [(None, True), (None, False)]),
    ],
)
def test_exports(write: Write, path: str, expected: list[tuple[str | None, bool]]) -> None:
    export = f'<gazebo_ros plugin_path="${{prefix}}" gazebo_model_path="{path}"/>'
    folder = write({"crane/package.xml": MANIFEST.replace("@", export)}) / "crane"
    with open_input(folder) as opened:
        found = [*searched_folders(opened.packages[0])]
    assert [(each.folder, each.known) for each in found] == expected


def test_files_around_a_package_that_set_the_environment_are_mentions(write: Write) -> None:
    texts = {
        "pixi.toml": 'GZ_SIM_RESOURCE_PATH = "install/crane/share"',
        "notes.md": "GZ_SIM_RESOURCE_PATH",
    }
    top = write({"src/crane/package.xml": PLAIN["package.xml"], **texts})
    with open_input(top) as opened:
        (package,) = opened.packages
        files = [span.source.file for span in mentions(package)]
    assert files == ["../../pixi.toml"]
