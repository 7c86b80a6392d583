"""Numbers and poses as they are written."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from checker.convert.xml_writer import document_text, exact, number, six_numbers, tidy
from checker.model.geometry.transform import Transform, rotation_from_rpy
from tests.model.robots import sdf

NUMBERS = st.floats(allow_nan=False, allow_infinity=False)


@given(NUMBERS)
def test_an_exact_number_reads_back_as_the_same(value: float) -> None:
    assert float(exact(value)) == value
    assert not exact(value).endswith(".0")


@given(NUMBERS)
def test_a_length_reads_back_but_for_what_rounding_leaves(value: float) -> None:
    assert abs(float(number(value)) - value) <= 1e-14


@given(NUMBERS)
def test_a_tidy_sum_reads_back_but_for_its_last_digits(value: float) -> None:
    assert math.isclose(float(tidy(value)), value, rel_tol=1e-13)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (-0.0, "0"),
        (6.123233995736766e-17, "0"),
        (1e-5, "0.00001"),
        (0.1 + 0.2, "0.3"),
        (-1.0, "-1"),
        (math.pi, "3.141592653589793"),
        (math.pi / 2, "1.5707963267948966"),
        (1e16, "1e+16"),
    ],
)
def test_the_shortest_decimal(value: float, text: str) -> None:
    assert number(value) == text


@given(
    st.floats(-3.1, 3.1),
    st.one_of(
        st.floats(-1.6, 1.6),
        st.floats(0, 15).map(lambda digits: math.pi / 2 - 10.0**-digits),
        st.sampled_from([1.5707, 1.57079, 1.570796, 1.5707963, -1.57079632679]),
    ),
    st.floats(-3.1, 3.1),
)
def test_angles_give_the_rotation_back_even_near_the_pole(r: float, p: float, y: float) -> None:
    rotation = rotation_from_rpy(r, p, y)
    again = rotation_from_rpy(*Transform(rotation).rpy)
    for row, other in zip(rotation, again, strict=True):
        assert row == pytest.approx(other, abs=1e-11)


def test_a_document_is_indented_by_two_blanks() -> None:
    tree = etree.fromstring("<a>\n<b><c>1</c></b></a>")
    assert document_text(tree) == (
        '<?xml version="1.0" encoding="utf-8"?>\n<a>\n  <b>\n    <c>1</c>\n  </b>\n</a>\n'
    )


def test_a_pose_in_degrees_is_written_in_radians() -> None:
    robot = sdf("""<link name="l0"><collision name="c"><pose degrees="true">1 2 3 90 0 -45</pose>
      <geometry><sphere><radius>1</radius></sphere></geometry></collision></link>""")
    (shape,) = robot.links[0].collisions
    place, angles = six_numbers(shape.pose.transform, shape.pose)
    assert place == "1 2 3"
    assert [float(each) for each in angles.split()] == pytest.approx([math.pi / 2, 0, -math.pi / 4])
