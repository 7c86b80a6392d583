"""Meshes named by their path in the folder of an installation."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.formats.sdf.includes import ModelIncludes
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.package.uris import Unknown, own_path_on_machine, path_behind
from checker.source.text import Located, SourceText
from checker.source.xml import XmlDocument

_MANIFEST = "<package><name>{}</name></package>"


@pytest.fixture
def arm(tmp_path: Path) -> Iterator[Package]:
    for name in ("arm", "hand"):
        folder = tmp_path / name
        (folder / "meshes").mkdir(parents=True)
        (folder / "package.xml").write_text(_MANIFEST.format(f"{name}_description"))
        (folder / "meshes" / "base.stl").write_text("solid\nendsolid\n")
    with open_input(tmp_path / "arm") as opened:
        yield opened.packages[0]


@pytest.mark.parametrize(
    ("uri", "path"),
    [
        ("file:///home/me/ws/install/hand_description/share/hand_description/meshes/base.stl", 1),
        ("/ws/install/share/hand_description/meshes/base.stl", 1),
        ("/opt/ros/humble/share/hand_description/meshes/base.stl", 1),
        ("/ws/install/arm_description/share/arm_description/meshes/base.stl", 0),
        ("/ws/install/base/share/base_description/meshes/base.stl", "base_description"),
        ("/ws/share/hand_description/meshes/base.stl", ""),
    ],
)
def test_the_package_is_the_one_that_the_path_names(
    arm: Package, uri: str, path: int | str
) -> None:
    found = path_behind(arm, "urdf", uri)
    if isinstance(path, str):
        assert isinstance(found, Unknown)
        assert found.package == path
    else:
        assert found == ("meshes/base.stl", "../hand/meshes/base.stl")[path]


def test_a_file_of_the_same_name_is_not_that_of_another_package(arm: Package) -> None:
    installed = "/home/me/ws/install/hand_description/share/hand_description/meshes/base.stl"
    assert own_path_on_machine(arm, installed) == ""
    assert own_path_on_machine(arm, "/home/me/arm/meshes/base.stl") == "meshes/base.stl"


@pytest.mark.parametrize("scheme", ["", "file://"])
def test_an_included_model_is_read_where_its_package_has_it(
    arm: Package, tmp_path: Path, scheme: str
) -> None:
    crate = tmp_path / "hand/models/crate/model.sdf"
    crate.parent.mkdir(parents=True)
    crate.write_text("<sdf version='1.9'><model name='crate'/></sdf>")
    uri = f"{scheme}/home/me/ws/install/hand_description/share/hand_description/models/crate"
    read = ModelIncludes(arm)(Located(uri, SourceText("hall.sdf", uri).whole()))
    assert isinstance(read, XmlDocument)
