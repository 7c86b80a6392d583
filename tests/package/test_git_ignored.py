"""Meshes and sources that `.gitignore` keeps out of a repository."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings
from rules.package import pkg009_installs_nothing as pkg009
from rules.references import ref002_file_not_found as ref002


@pytest.mark.parametrize(
    ("ignored", "severity"),
    [
        ("", Severity.ERROR),
        ("*.obj\n", Severity.ERROR),
        ("*.obj\n*.dae\n", Severity.WARNING),
        ("arm.dae\n", Severity.WARNING),
        ("*.dae\n!shapes/**/*.dae\n", Severity.ERROR),
        ("!shapes/*.dae\n*.dae\n", Severity.WARNING),
    ],
)
def test_a_mesh_that_its_author_has_is_a_warning(
    ignored: str, severity: Severity, tmp_path: Path
) -> None:
    files = {**ref002._ARM, "shapes/arm.dae": None, "shapes/a.txt": "", ".gitignore": ignored}
    package = write_example(files, tmp_path)
    (report,) = check_package(package, Settings(trial=False)).packages
    found = [it for it in report.findings if it.rule == "REF002"]
    assert {it.severity for it in found} == {severity}
    kept = any("keeps it out of the repository" in it.message for it in found)
    assert kept is (severity is Severity.WARNING)


@pytest.mark.parametrize(
    ("ignored", "severity"),
    [("other.cpp\n", Severity.ERROR), ("driver.cpp\n", Severity.WARNING)],
)
def test_a_source_that_may_be_made_before_the_build_is_a_warning(
    ignored: str, severity: Severity, tmp_path: Path
) -> None:
    build = f"{pkg009._INSTALL}add_library(driver SHARED src/driver.cpp)\n"
    files = {"package.xml": pkg009._AMENT, "CMakeLists.txt": build, "src/.gitignore": ignored}
    package = write_example(files, tmp_path)
    (report,) = check_package(package, Settings(trial=False)).packages
    found = [it for it in report.findings if it.rule == "PKG009" and "driver" in it.message]
    assert [it.severity for it in found] == [severity]
