"""Batteries, and how long they last."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.battery import Battery, batteries, commented_out
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml
from tests.model.robots import sdf

UGV = {"initial_charge": "78.4", "power_load": "9.9"}
UAV = {"initial_charge": "18.0", "power_load": "13.2"}


def battery(more: str = "", **values: str) -> Battery:
    """Return a battery with the voltages that most packages have."""
    given_values = {
        "open_circuit_voltage_constant_coef": "12.694",
        "open_circuit_voltage_linear_coef": "-3.1424",
        **values,
    }
    parameters = "".join(f"<{tag}>{value}</{tag}>" for tag, value in given_values.items())
    (found,) = batteries(
        sdf(
            '<link name="b"/><plugin filename="p" name="a::LinearBatteryPlugin">'
            f"{parameters}{more}</plugin>"
        )
    )
    return found


@pytest.mark.parametrize(
    ("values", "minutes"),
    [
        (UGV, 60),
        ({**UGV, "power_load": "6.6"}, 90),
        ({**UGV, "power_load": "4.95"}, 120),
        (UAV, 10),
        ({**UAV, "power_load": "6.6"}, 20),
    ],
)
def test_standard_packs_last_as_long_as_reviewers_say(values: dict[str, str], minutes: float):
    assert battery(**values).minutes == pytest.approx(minutes, rel=0.05)


def test_half_the_charge_or_twice_the_load_lasts_half_as_long():
    whole = battery(**UGV).minutes
    assert whole is not None
    halves = (
        battery(**{**UGV, "initial_charge": "39.2"}),
        battery(**{**UGV, "power_load": "19.8"}),
    )
    assert [half.minutes for half in halves] == pytest.approx([whole / 2] * 2)


def test_the_capacity_is_the_charge_where_none_is_stated():
    assert battery(capacity="78.4", power_load="9.9").minutes == battery(**UGV).minutes


@pytest.mark.parametrize(
    "values",
    [{}, {"power_load": "9.9"}, {**UGV, "power_load": "0"}, {**UGV, "power_load": "much"}],
)
def test_without_its_figures_nothing_is_said(values: dict[str, str]):
    assert battery(**values).minutes is None


def test_a_plugin_that_drains_as_its_figures_say_is_left_out():
    assert battery("<fix_issue_225>true</fix_issue_225>", **UGV).minutes is None


@given(st.floats(), st.floats(), st.floats(), st.floats())
def test_any_figures_give_a_duration_or_none(
    charge: float, constant: float, linear: float, load: float
):
    minutes = battery(
        initial_charge=str(charge),
        open_circuit_voltage_constant_coef=str(constant),
        open_circuit_voltage_linear_coef=str(linear),
        power_load=str(load),
    ).minutes
    assert minutes is None or 0 < minutes < math.inf


def test_what_starts_it_is_read():
    topics = "<power_draining_topic>/a</power_draining_topic>" * 2
    found = battery(f"<start_on_motion>True</start_on_motion>{topics}")
    assert found.starts_on_motion
    assert [each.value for each in found.draining_topics] == ["/a", "/a"]


def test_a_class_is_found_in_comments_alone():
    text = '<a><!-- <p name="x::Battery"/> --><p name="x::Battery"/><!-- Battery --></a>'
    document = parse_xml(SourceText("model.sdf", text))
    assert isinstance(document, XmlDocument)
    (span,) = commented_out([document], "Battery")
    assert (span.text, span.start) == ("Battery", text.index("Battery"))
