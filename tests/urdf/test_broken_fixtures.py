"""Files in folders of tests that a reader must refuse."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import VerdictKind
from checker.settings import Settings

_ROBOT = """<robot name="a"><link name="a"><inertial><mass value="1"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
<collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>"""


@pytest.mark.parametrize(
    ("file", "severity", "verdict"),
    [
        ("test/urdf/invalid_tree.urdf", Severity.INFO, VerdictKind.READY),
        ("urdf/invalid_tree.urdf", Severity.ERROR, VerdictKind.NOT_READY),
        ("test/urdf/tree.urdf", Severity.WARNING, VerdictKind.READY),
    ],
)
def test_a_fixture_that_a_test_expects_to_fail_is_no_error(
    tmp_path: Path, file: str, severity: Severity, verdict: VerdictKind
) -> None:
    files = {
        "package.xml": "<package><name>a</name></package>",
        "urdf/a.urdf": _ROBOT,
        file: _ROBOT.replace("</link>", ""),
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    settings = Settings(profile="urdf", select=("SDF001", "URD001"), cache=False)
    (report,) = check_package(tmp_path, settings).packages
    (found,) = report.findings
    assert (found.severity, report.verdict) == (severity, verdict)
