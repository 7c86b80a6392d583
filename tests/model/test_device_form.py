"""Descriptions of devices: ours, and those of a user's settings, which may be anybody's."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.resources import table
from checker.model.devices.form import expression, problem_of_device, problem_of_match
from tests.effort import limited

DEVICE: dict[str, Any] = {
    "id": "acme_l1",
    "name": "Acme L1",
    "kind": "lidar3d",
    "match": r"\bacme[- ]?L1\b",
    "sdf_types": ["gpu_lidar"],
    "values": {"rows": 8, "vfov_deg": [-10, 10], "samples_by_rate": {"10": [360]}},
}


def test_our_own_devices_have_the_form_that_users_devices_must_have() -> None:
    devices = table("devices")["devices"]
    assert [problem_of_device(device) for device in devices] == [""] * len(devices)
    assert len({device["id"] for device in devices}) == len(devices)
    for device in devices:
        re.compile(device["match"], re.IGNORECASE)


def test_a_device_of_a_user() -> None:
    assert problem_of_device(DEVICE) == problem_of_match(DEVICE["match"]) == ""


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"colour": "red"}, "has the unknown key 'colour'"),
        ({"name": 5}, "has the name 5, expected a text"),
        ({"sdf_types": "gpu_lidar"}, "has the sdf_types 'gpu_lidar', expected a list of texts"),
        ({"values": []}, "has the values [], expected a table"),
        ({"values": {"row": 8}}, "has the unknown values.row"),
        ({"values": {"rows": "8"}}, "has the values.rows '8', expected a number"),
        ({"values": {"rows": True}}, "has the values.rows True"),
        ({"values": {"range_max": float("nan")}}, "has the values.range_max nan"),
        ({"values": {"range_max": 16**20}}, "has the values.range_max"),
        ({"values": {"range_max": 16**5000}}, "has the values.range_max as it is"),
        ({"values": {"vfov_deg": [1]}}, "expected the lowest and the highest angle"),
        ({"values": {"samples_by_rate": {"fast": [1]}}}, "expected a table from rates to samples"),
        ({"body": {"mass_kg": 0}}, "has the body.mass_kg 0, expected a positive number"),
        ({"body": {"size_mm": {"x": 1}}}, "expected a table of x, y and z, or of diameter"),
        ({"source_detail": {"rows": 5}}, "expected a table of texts"),
    ],
)
def test_what_is_wrong_is_said(change: dict[str, Any], problem: str) -> None:
    assert problem in problem_of_device({**DEVICE, **change})


def test_what_is_missing_is_said() -> None:
    without = {key: value for key, value in DEVICE.items() if key != "match"}
    assert problem_of_device(without) == "has no 'match'"
    assert problem_of_device("acme") == "is no table"


@pytest.mark.parametrize(
    ("match", "problem"),
    [
        ("", "0 characters"),
        ("a" * 201, "201 characters"),
        ("(a+)+$", "'+'"),
        ("a{9}", "'{'"),
        ("(?=a)", "'(?'"),
        (r"(a)\1", r"\1"),
        ("a?" * 11, "more than 10"),
        ("(a", "no regular expression"),
    ],
)
def test_an_expression_that_may_take_long_is_refused(match: str, problem: str) -> None:
    assert problem in problem_of_match(match)


@pytest.mark.parametrize("match", [r"\bL1\b", r"C\+\+", r"(?:a|b)[- ]?1", r"\\1", r"\d?\d"])
def test_plain_expressions_are_taken(match: str) -> None:
    assert problem_of_match(match) == ""


@given(st.text(alphabet="ab()|?[]\\^$.:d-", max_size=60))
def test_an_expression_that_is_taken_is_fast(match: str) -> None:
    if problem_of_match(match) == "":
        with limited(1):
            re.search(match, "ab" * 250, re.IGNORECASE)


@pytest.mark.filterwarnings("error")
def test_python_warns_nobody_of_what_an_expression_may_mean_one_day() -> None:
    assert expression("lidar[[]").search("a LIDAR[")
