"""One fault in a sound robot is one finding: what only follows from it is not checked."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings
from tests.physics import ackermann, multicopter
from tests.physics.fault import SPAWNER, Fault, Swap, put_into

BUGGY, QUADRO = ackermann.SAMPLE, multicopter.SAMPLE
WHEEL = "<child>rear_right_wheel</child>"
TWICE = f'<joint name="again" type="fixed"><parent>base_link</parent>{WHEEL}</joint>'
LOOSE = '<joint name="rear_left_wheel_joint" type="revolute">'
FIXED = '<joint name="rear_left_wheel_joint" type="fixed">'
FACTORY = '<plugin name="ignition::launch::GazeboFactory" filename="libgazebo-factory.so">'


def scaled(uri: str) -> tuple[Swap, ...]:
    """Return the edit that makes a mesh a thousand times larger wherever it is used."""
    whole = f"<uri>{uri}</uri>"
    return (Swap(whole, f"{whole}<scale>1000 1000 1000</scale>", everywhere=True),)


def swapped(old: str, new: str) -> tuple[Swap, ...]:
    return (Swap(old, new),)


BASE, ROTORS = "<mass>15.4</mass>", "<mass>1.92</mass>"
FAULTS = (
    (BUGGY, "KIN001", swapped(WHEEL, "<child>rear_right_whel</child>")),
    (QUADRO, "KIN001", swapped("<child>rotor_0</child>", "<child>rotor_9</child>")),
    (BUGGY, "KIN002", swapped('<link name="left_knuckle">', f'{TWICE}<link name="left_knuckle">')),
    (BUGGY, "GEO008", swapped("<radius>0.1</radius>", "<radius>0</radius>")),
    (BUGGY, "KIN009", swapped(LOOSE, FIXED)),
    (BUGGY, "MSH005", scaled("meshes/hull.dae")),
    (BUGGY, "MSH005", scaled("meshes/wheel.dae")),
    (QUADRO, "MSH005", scaled("meshes/body.dae")),
    (BUGGY, "SDF006", swapped(BASE, "<mass>15,4</mass>")),
    (BUGGY, "INE002", swapped(BASE, "<mass>-15.4</mass>")),
    (BUGGY, "INE002", swapped(BASE, "<mass>0</mass>")),
    (BUGGY, "INE002", swapped("<mass>1.2</mass>", "<mass>-1.2</mass>")),
    (QUADRO, "SDF006", swapped(ROTORS, "<mass>heavy</mass>")),
    (QUADRO, "INE002", swapped(ROTORS, "<mass>-1.92</mass>")),
    (
        BUGGY,
        "SPW007",
        (
            Swap('<spawn name="#{_name}">', FACTORY, file=SPAWNER),
            Swap("</spawn>", "</plugin>", file=SPAWNER),
        ),
    ),
)


def report_of(sample: str, edits: tuple[Swap, ...], folder: Path) -> PackageReport:
    (report,) = check_package(
        put_into(sample, Fault("", edits, (), ""), folder), Settings()
    ).packages
    return report


@pytest.mark.slow
@pytest.mark.parametrize(("sample", "rule", "edits"), FAULTS)
def test_one_fault_is_one_finding(
    sample: str, rule: str, edits: tuple[Swap, ...], tmp_path: Path
) -> None:
    report = report_of(sample, edits, tmp_path)
    assert [finding.rule for finding in report.findings] == [rule], [
        f"{finding.rule} {finding.message}" for finding in report.findings
    ]


def test_a_part_without_a_place_is_why_others_did_not_look(tmp_path: Path) -> None:
    edits = swapped(WHEEL, "<child>rear_right_whel</child>")
    report = report_of(BUGGY, edits, tmp_path)
    why = {each.rule: each.reason for each in report.not_checked}
    for rule in ("GEO015", "INE009", "TRI002", "TRI003", "TRI010"):
        assert why[rule] == "an end of joint 'rear_right_wheel_joint' is not known"


def test_an_unknown_mass_is_why_others_did_not_look(tmp_path: Path) -> None:
    report = report_of(QUADRO, swapped(ROTORS, "<mass>-1.92</mass>"), tmp_path)
    why = {each.rule: each.reason for each in report.not_checked}
    for rule in ("INE004", "INE005", "INE006", "INE008", "GEO002", "GEO014", "DRV010", "TRI010"):
        assert why[rule] == "the mass of link 'base_link' is not positive"


def test_how_a_robot_drives_that_never_rests_is_not_checked(tmp_path: Path) -> None:
    shifted = swapped("<pose>0.004805 0 0.04924 0 0 0</pose>", "<pose>0.9 0 0.04924 0 0 0</pose>")
    report = report_of(BUGGY, shifted, tmp_path)
    found = {finding.rule for finding in report.findings}
    assert "TRI002" in found
    assert not {rule for rule in found if rule.startswith("TRI")} - {"TRI002"}
    why = {each.rule: each.reason for each in report.not_checked}
    for rule in ("TRI003", "TRI004", "TRI006", "TRI007", "TRI008", "TRI009", "TRI018"):
        assert why[rule] == "the robot does not come to rest before it is driven"
