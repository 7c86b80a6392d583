"""Physical faults, one at a time, in robots that have none: each is found, and at the right part.

That nothing is said about the same robots as they are is a test of the samples.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import ReportedFinding
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from tests.effort import sampled
from tests.physics import ackermann, multicopter, skid_steer, tracked
from tests.physics.fault import Fault, Swap, put_into

ROBOTS = (skid_steer, ackermann, tracked, multicopter)
TABLE = [(robot.SAMPLE, fault) for robot in ROBOTS for fault in robot.FAULTS]


def title(row: Fault | str) -> str:
    return row.name if isinstance(row, Fault) else row.removesuffix("_sensor_config_1")


@pytest.mark.slow
@pytest.mark.parametrize(("sample", "fault"), sampled(TABLE), ids=title)
def test_a_physical_fault_is_found(sample: str, fault: Fault, tmp_path: Path) -> None:
    (report,) = check_package(put_into(sample, fault, tmp_path), Settings()).packages
    said = [each for each in report.findings if each.severity is not Severity.INFO]
    assert any(
        each.rule in fault.rules and fault.part in words
        for each in said
        for words in words_of(each)
    ), "\n".join(f"{each.rule} {each.message}" for each in said) or "nothing was said"


def words_of(finding: ReportedFinding) -> Iterator[str]:
    """Yield where a finding can name a part."""
    yield finding.message
    for place in finding.places:
        if not place.note:
            yield place.element or place.file


def test_faults_are_many_and_each_is_there_once() -> None:
    names = [(sample, fault.name) for sample, fault in TABLE]
    assert len(names) >= 40
    assert len(set(names)) == len(names)


def test_the_rules_that_shall_find_them_exist() -> None:
    known = {rule.id for rule in all_rules()}
    assert not sorted({rule for _, fault in TABLE for rule in fault.rules} - known)


def test_a_robot_that_drifts_is_told_that_its_centre_of_mass_is_why(tmp_path: Path) -> None:
    aside = Fault("", (Swap(tracked.CENTRE, tracked.CENTRE.replace(" 0 ", " 0.088 ", 1)),), (), "")
    (report,) = check_package(put_into(tracked.SAMPLE, aside, tmp_path), Settings()).packages
    (drift,) = [each for each in report.findings if each.severity is not Severity.INFO]
    assert drift.rule == "TRI018"
    assert "while turning in place" in drift.message
    assert "the centre of mass 55 mm left of the middle of the wheels explains" in drift.message
