"""Packages are found by the name of their folder, else by the one that their manifest declares."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.package.workspace import Workspace


@pytest.mark.parametrize(
    "manifest",
    [
        "<package><name>rover</name></package>",
        "<package><name>\n  rover <!-- not the folder's --></name></package>",
        "<package><version>1</version><name>rover</name>",
    ],
)
def test_a_package_is_found_by_its_declared_name(manifest: str, tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    (folder / "package.xml").write_text(manifest, "utf-8")
    found = Workspace((tmp_path,)).package("rover")
    assert found is not None
    assert found.root == folder


def test_a_package_comes_before_a_neighbour_that_declares_the_same_name(tmp_path: Path) -> None:
    """$(find rover) in one of two copies means that copy."""
    folders = [tmp_path / "backup", tmp_path / "current"]
    for folder in folders:
        folder.mkdir()
        (folder / "package.xml").write_text("<package><name>rover</name></package>", "utf-8")
    packages = map(Workspace((tmp_path,)).at, folders)
    found = [package.named("rover") for package in packages]
    assert [package.root for package in found if package] == folders


@pytest.mark.parametrize(
    "manifest",
    [b"", b"  \n", b"\0", b"rover", b"<", b"<!-- rover -->", b"\xff\xfe", b"<package><name/>"],
)
def test_a_manifest_without_a_name_declares_none(manifest: bytes, tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    (folder / "package.xml").write_bytes(manifest)
    assert Workspace((tmp_path,)).package("rover") is None


def test_entities_of_a_manifest_are_not_read(tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("rover", "utf-8")
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    entity = f"<!DOCTYPE p [<!ENTITY e SYSTEM 'file://{tmp_path}/secret'>]>"
    (folder / "package.xml").write_text(f"{entity}<p><name>&e;</name></p>", "utf-8")
    assert Workspace((tmp_path,)).package("rover") is None
