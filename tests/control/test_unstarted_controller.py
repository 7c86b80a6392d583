"""An interface that a controller does not get is an error only where something starts it."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.settings import Settings
from rules.control import ctl003_controller_interface_mismatch as ctl003


@pytest.mark.parametrize(
    ("started", "severity"),
    [
        ("shoulder_controller", Severity.ERROR),
        ("shoulder_controler", Severity.ERROR),
        ("state_controller", Severity.WARNING),
    ],
)
def test_severity(tmp_path: Path, started: str, severity: Severity) -> None:
    files = ctl003._config("position_controllers/JointPositionController")
    launch = ctl003._LAUNCH.replace("@", started)
    folder = write_example({**files, "launch/control.launch": launch}, tmp_path)
    settings = Settings(trial=False, select=("CTL003",))
    (report,) = check_package(folder, settings).packages
    assert [finding.severity for finding in report.findings] == [severity]
