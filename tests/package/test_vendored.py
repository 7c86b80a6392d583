"""Packages of a released repository that was copied beside the user's own."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.settings import Settings

_MANIFEST = """<package format="3"><name>{0}</name><version>1.0.0</version>
<description>{0}</description><maintainer email="a@example.org">A</maintainer>
<license>MIT</license><depend>turtlesim</depend></package>
"""
_LAUNCH = '<launch><include file="$(find-pkg-share {})/launch/all.launch.xml"/></launch>\n'
_COPY = "ws/turtles"


@pytest.mark.parametrize(
    ("licence", "name", "used", "severity"),
    [
        (f"{_COPY}/LICENSE", "turtlesim", "other", Severity.INFO),
        (f"{_COPY}/LICENSE.md", "turtlesim", "turtlesim_tools", Severity.INFO),
        (f"{_COPY}/LICENSE", "turtlesim", "turtlesim", Severity.WARNING),  # it is used
        (f"{_COPY}/LICENSE", "acme_turtles", "other", Severity.WARNING),  # no distribution has it
        ("ws/LICENSE", "turtlesim", "other", Severity.WARNING),  # of the whole
    ],
)
def test_a_copy_that_nothing_uses_counts_less_and_is_last(
    licence: str, name: str, used: str, severity: Severity, tmp_path: Path
) -> None:
    for path, text in {
        licence: "MIT",
        f"{_COPY}/{name}/package.xml": _MANIFEST.format(name),
        f"{_COPY}/{name}/meshes/old body.dae": "<COLLADA/>",
        "ws/zebra/package.xml": _MANIFEST.format("zebra"),
        "ws/zebra/launch/all.launch.xml": _LAUNCH.format(used),
    }.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, "utf-8")
    report = check_package(tmp_path, Settings(trial=False, select=("PKG015",)))
    names = [package.name for package in report.packages]
    copied = severity is Severity.INFO
    assert names == (["zebra", name] if copied else [name, "zebra"])
    (found,) = (found for package in report.packages for found in package.findings)
    assert found.severity is severity
    assert ("in turtles/, a copied repository" in found.message) is copied


def test_a_copied_repository_that_is_given_itself_counts_in_full(tmp_path: Path) -> None:
    folder = tmp_path / _COPY / "turtlesim"
    (folder / "meshes").mkdir(parents=True)
    (folder.parent / "LICENSE").write_text("MIT")
    (folder / "package.xml").write_text(_MANIFEST.format("turtlesim"))
    (folder / "meshes/old body.dae").write_text("<COLLADA/>")
    (report,) = check_package(folder.parent, Settings(trial=False, select=("PKG015",))).packages
    assert [found.severity for found in report.findings] == [Severity.WARNING]
