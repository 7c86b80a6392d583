"""Inertia that SDF 1.11 has the simulator work out from collisions."""

from __future__ import annotations

import math

import pytest

from checker.formats.sdf.reader import read_sdf
from checker.model.components import Inertial
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml

BOX = "<box><size>0.2 0.4 0.6</size></box>"
CYLINDER = "<cylinder><radius>0.1</radius><length>0.3</length></cylinder>"
MESH = "<mesh><uri>a.stl</uri></mesh>"


def inertial_of(inertial: str, *shapes: tuple[str, str, str]) -> Inertial:
    collisions = "".join(
        f'<collision name="c{number}"><pose>{pose}</pose>{density}'
        f"<geometry>{shape}</geometry></collision>"
        for number, (pose, density, shape) in enumerate(shapes)
    )
    text = (
        f'<sdf version="1.11"><model name="m"><link name="l">{inertial}{collisions}</link>'
        "</model></sdf>"
    )
    document = parse_xml(SourceText("model.sdf", text))
    assert isinstance(document, XmlDocument)
    (robot,) = read_sdf(document)
    found = robot.links[0].inertial
    assert found is not None
    return found


def numbers(inertial: Inertial) -> list[float]:
    return [moment.value for moment in inertial.moments]


def test_a_box_of_a_stated_density() -> None:
    found = inertial_of(
        '<inertial auto="true"><density>500</density></inertial>', ("1 0 0 0 0 0", "", BOX)
    )
    assert found.mass.value == pytest.approx(24.0)
    assert found.pose.transform.translation == pytest.approx((1.0, 0.0, 0.0))
    assert numbers(found) == pytest.approx([1.04, 0, 0, 0.8, 0, 0.4])


def test_a_turned_cylinder_lies() -> None:
    found = inertial_of(
        '<inertial auto="true"/>', (f"0 0 0 0 {math.pi / 2} 0", "<density>100</density>", CYLINDER)
    )
    mass = math.pi * 0.01 * 0.3 * 100
    along, across = mass * 0.01 / 2, mass * (3 * 0.01 + 0.09) / 12
    assert found.mass.value == pytest.approx(mass)
    assert numbers(found) == pytest.approx([along, 0, 0, across, 0, across], abs=1e-12)


def test_two_bodies_turn_about_their_common_centre() -> None:
    halves = [(f"0 0 {z} 0 0 0", "", "<box><size>0.2 0.4 0.3</size></box>") for z in (-0.15, 0.15)]
    found = inertial_of('<inertial auto="true"><density>500</density></inertial>', *halves)
    assert numbers(found) == pytest.approx([1.04, 0, 0, 0.8, 0, 0.4])


def test_a_stated_mass_is_kept() -> None:
    found = inertial_of('<inertial auto="true"><mass>12</mass></inertial>', ("", "", BOX))
    assert found.mass.value == 12.0
    assert numbers(found) == pytest.approx([0.52, 0, 0, 0.4, 0, 0.2])


def test_what_needs_a_mesh_is_not_known() -> None:
    assert math.isnan(inertial_of('<inertial auto="true"/>', ("", "", MESH)).mass.value)


def test_without_the_attribute_nothing_is_worked_out() -> None:
    assert inertial_of("<inertial><mass>3</mass></inertial>", ("", "", BOX)).mass.value == 3.0
