"""Changed files and the packages that they belong to."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.errors import UnreadableInput
from checker.package.kind import changed_packages

Write = Callable[[Mapping[str, str]], Path]

MODEL = "<sdf version='1.6'><model name='rover'/></sdf>"
SPACE = {
    "repository/.git/HEAD": "ref",
    "repository/README.md": "hello",
    "repository/robots/a/package.xml": "<package/>",
    "repository/robots/a/meshes/body.dae": "<COLLADA/>",
    "repository/robots/a/parts/guard/model.sdf": MODEL,
    "repository/robots/b/model.sdf": MODEL,
    "package.xml": "<package/>",
}


def changed(here: Path, *files: str) -> list[str]:
    return [str(each) for each in changed_packages(map(Path, files), here)]


@pytest.fixture
def here(write: Write) -> Path:
    return write(SPACE) / "repository"


def test_each_package_once_in_the_order_of_the_files(here: Path) -> None:
    files = ("robots/b/model.sdf", "robots/a/package.xml", "robots/a/meshes/body.dae")
    assert changed(here, *files) == ["robots/b", "robots/a"]


@pytest.mark.parametrize("file", ["robots/a/gone.sdf", "robots/a/gone/with/its/folder.dae"])
def test_a_deleted_file_counts_for_its_package(here: Path, file: str) -> None:
    assert changed(here, file) == ["robots/a"]


@pytest.mark.parametrize("file", ["README.md", "robots/notes.md", "gone/package.xml"])
def test_files_outside_packages_are_passed_over(here: Path, file: str) -> None:
    assert changed(here, file) == []


@pytest.mark.parametrize("folder", ["robots", "robots/a", "robots/a/meshes", ".", "link"])
def test_a_folder_is_refused(here: Path, folder: str) -> None:
    (here / "link").symlink_to(here / "robots/a")
    with pytest.raises(UnreadableInput, match=r"is a folder.*leave out --files"):
        changed(here, folder)


def test_a_link_to_a_folder_within_a_package_is_a_file(here: Path) -> None:
    (here / "robots/b/meshes").symlink_to("../a/meshes")
    assert changed(here, "robots/b/meshes") == ["robots/b"]


def test_a_nested_model_belongs_to_the_robot_around_it(here: Path) -> None:
    assert changed(here, "robots/a/parts/guard/model.sdf") == ["robots/a"]


def test_a_package_above_the_repository_does_not_count(here: Path) -> None:
    assert changed(here, "../package.xml") == [str(here.parent)]
    assert changed(here, "x.md") == []


def test_from_within_the_package_and_from_elsewhere(here: Path) -> None:
    package = here / "robots/a"
    assert changed(package, "package.xml") == ["."]
    assert changed(package / "meshes", "body.dae", "../package.xml") == [str(package)]
    assert changed(here, str(package / "package.xml")) == ["robots/a"]


def test_a_repository_that_is_one_package(write: Write) -> None:
    space = write({"rover/.git/HEAD": "ref", "rover/package.xml": "<package/>"})
    assert changed(space / "rover", "launch/spawner.rb") == ["."]


def test_without_a_package_the_folder_of_loose_models_is_checked(write: Write) -> None:
    model = "<mujoco><include file='parts/arm.xml'/></mujoco>"
    files = {"r/.git/HEAD": "ref", "r/sim/scene.xml": model, "r/sim/parts/arm.xml": "<mujoco/>"}
    space = write({**files, "r/sim/meshes/arm.stl": "", "r/code.py": ""})
    assert changed(space / "r", "sim/parts/arm.xml", "sim/meshes/arm.stl", "code.py") == ["sim"]


@given(st.lists(st.text(st.characters(exclude_characters="\0"), max_size=300), max_size=20))
def test_any_name_is_answered(names: list[str]) -> None:
    relative = [Path(name.lstrip("/")) for name in names]
    assert changed_packages(relative, Path("/nowhere")) == []
