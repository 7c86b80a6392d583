"""Meshes that `.gitignore` keeps out of a repository."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings
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
