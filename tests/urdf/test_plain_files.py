"""A URDF file alone says less than a package: what it leaves open is no fault of its robot."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.settings import Settings
from tests.model.robots import urdf

_SOLID = """<inertial><origin xyz="0 0 {z}"/><mass value="{mass}"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 {z}"/><geometry><box size="0.3 0.3 {height}"/></geometry></collision>
<visual><origin xyz="0 0 {z}"/><geometry><box size="0.3 0.3 {height}"/></geometry></visual>"""
_BASE = f'<link name="base">{_SOLID.format(z=0.1, mass=1, height=0.2)}</link>'
_HINGE = """<joint name="{child}_joint" type="{type}">
<parent link="{parent}"/><child link="{child}"/><origin xyz="{x} 0 0.2"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="100" velocity="1"/></joint>"""


def hinge(child: str, parent: str = "base", x: float = 0.0, type_: str = "revolute") -> str:
    return _HINGE.format(child=child, parent=parent, x=x, type=type_)


def leaning(name: str) -> str:
    """Return a part that hangs far beside the base."""
    return f'<link name="{name}">{_SOLID.format(z=0.5, mass=9, height=1)}</link>' + hinge(name, x=1)


def checked(body: str, folder: Path, *, name: str = "crane", trial: bool = False) -> PackageReport:
    file = folder / "crane.urdf"
    file.write_text(f'<robot name="{name}">{body}</robot>')
    (report,) = check_package(file, Settings(trial=trial, cache=False)).packages
    return report


def severities(report: PackageReport) -> Mapping[str, Severity]:
    return {finding.rule: finding.severity for finding in report.findings}


def test_an_arm_is_mounted_and_a_rover_stands(tmp_path: Path) -> None:
    assert "INE009" not in severities(checked(_BASE + leaning("boom"), tmp_path))
    assert severities(checked(_BASE + leaning("wheel"), tmp_path))["INE009"] is Severity.ERROR


def test_a_robot_that_balances_falls_without_its_controller(tmp_path: Path) -> None:
    leaning_rover = checked(_BASE + leaning("wheel"), tmp_path, name="self_balancing")
    assert "INE009" not in severities(leaning_rover)


@pytest.mark.parametrize(("legs", "balances"), [("revolute", True), ("fixed", False)])
def test_two_wheels_at_the_ends_of_legs_balance(legs: str, balances: bool) -> None:
    parts = "".join(
        f"""<link name="{side}_leg"/><joint name="{side}_hip" type="{legs}">
<parent link="base_link"/><child link="{side}_leg"/><origin xyz="0 {y} 0"/><axis xyz="0 1 0"/>
</joint><link name="{side}_wheel"><collision><geometry><sphere radius="0.1"/></geometry>
</collision></link><joint name="{side}_axle" type="continuous"><parent link="{side}_leg"/>
<child link="{side}_wheel"/><origin xyz="0 0 -0.3"/><axis xyz="0 1 0"/></joint>"""
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    assert urdf(f'<link name="base_link"/>{parts}').balances is balances


def test_the_trial_holds_the_base_of_an_arm(tmp_path: Path) -> None:
    arm = checked(_BASE + leaning("boom"), tmp_path, trial=True)
    assert arm.trial is not None
    assert any("holds its base" in note for note in arm.trial["notes"])
    assert "TRI002" not in severities(arm)
    rover = checked(_BASE + leaning("wheel"), tmp_path, trial=True)
    assert rover.trial is not None
    assert not any("holds its base" in note for note in rover.trial["notes"])
    assert "TRI002" in severities(rover)


@pytest.mark.parametrize(("type_", "reported"), [("fixed", False), ("revolute", True)])
def test_a_link_without_mass_is_a_frame(type_: str, reported: bool, tmp_path: Path) -> None:
    nothing = '<mass value="0"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/>'
    frame = f'<link name="tip"><inertial>{nothing}</inertial></link>' + hinge("tip", type_=type_)
    found = severities(checked(_BASE + frame, tmp_path))
    assert "INE002" not in found
    assert ("URD007" in found) is reported


@pytest.mark.parametrize(
    ("tag", "severity"),
    [("", Severity.WARNING), ("<gazebo><static>false</static></gazebo>", Severity.ERROR)],
)
def test_what_gazebo_drops_counts_where_gazebo_is_meant(
    tag: str, severity: Severity, tmp_path: Path
) -> None:
    bare = '<link name="boom"/>' + hinge("boom") + f'<link name="tip">{_SOLID}</link>'
    body = bare.format(z=0, mass=1, height=1) + hinge("tip", "boom") + tag
    assert severities(checked(_BASE + body, tmp_path))["URD007"] is severity


def inertia(ixx: float, ixy: float = 0.0) -> str:
    numbers = f'ixx="{ixx}" iyy="0.1" izz="0.1" ixy="{ixy}" ixz="0" iyz="0"'
    return f'<inertial><mass value="0.5"/><inertia {numbers}/></inertial>'


@pytest.mark.parametrize(
    ("ixx", "type_", "severity"),
    [
        (0.2, "revolute", None),
        (0.2001, "revolute", None),  # rounded
        (0.25, "revolute", Severity.ERROR),
        (0.25, "fixed", Severity.WARNING),  # one body with the base, which has enough
        (9.0, "fixed", Severity.ERROR),
    ],
)
def test_impossible_moments(
    ixx: float, type_: str, severity: Severity | None, tmp_path: Path
) -> None:
    part = f'<link name="boom">{inertia(ixx)}</link>' + hinge("boom", type_=type_)
    assert severities(checked(_BASE + part, tmp_path)).get("INE002") is severity


def test_a_tag_for_a_link_that_is_not_there(tmp_path: Path) -> None:
    colour = '<gazebo reference="mast"><material>Gazebo/Red</material></gazebo>'
    friction = '<gazebo reference="mast"><mu1>0.1</mu1></gazebo>'
    direction = '<gazebo reference="mast"><fdir1>1 1 0</fdir1></gazebo>'
    assert severities(checked(_BASE + colour, tmp_path))["URD006"] is Severity.WARNING
    assert severities(checked(_BASE + friction, tmp_path))["URD006"] is Severity.WARNING
    assert severities(checked(_BASE + direction, tmp_path))["URD006"] is Severity.ERROR


@pytest.mark.parametrize(
    ("type_", "reported"),
    [("transmission_interface/SimpleTransmission", True), ("acme_mechanism/Motor", False)],
)
def test_an_interface_is_asked_of_ros_control_alone(
    type_: str, reported: bool, tmp_path: Path
) -> None:
    motor = (
        f'<transmission name="t" type="{type_}"><actuator name="m"/>'
        '<joint name="boom_joint"/></transmission>'
    )
    found = severities(checked(_BASE + leaning("boom") + motor, tmp_path))
    assert ("URD008" in found) is reported
    assert found["CTL006"] is Severity.INFO


def test_no_collision_matters_to_a_robot_that_stands(tmp_path: Path) -> None:
    bare = f'<link name="base">{inertia(0.1)}</link>'
    wheel = f'<link name="wheel">{inertia(0.1)}</link>' + hinge("wheel")
    assert severities(checked(bare, tmp_path))["GEO002"] is Severity.WARNING
    assert severities(checked(bare + wheel, tmp_path))["GEO002"] is Severity.ERROR
    held = '<joint name="h" type="fixed"><parent link="world"/><child link="base"/></joint>'
    fixture = f'<link name="world"/>{bare}{held}'
    assert severities(checked(fixture, tmp_path))["GEO002"] is Severity.INFO
