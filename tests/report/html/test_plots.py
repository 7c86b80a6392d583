"""What the plots of a trial show."""

from __future__ import annotations

import json
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from checker.report.html.plots import Plot, TrialPlots, plots_of

LEGS = [("settle", 0.0, 1.0, 0.0), ("drive", 1.0, 4.0, 1.0)]
FLIGHT = [("settle", 0.0, 1.0, 0.0), ("hover", 1.0, 3.0, 0.0), ("climb", 3.0, 5.0, 0.5)]


def figure(name: str, value: float, **limits: float) -> dict[str, Any]:
    return {"name": name, "value": value, "limits": limits}


def trial(
    legs: list[tuple[str, float, float, float]] = LEGS, *figures: dict[str, Any], **series: Any
) -> dict[str, Any]:
    course = [
        {"name": name, "start": start, "end": end, "linear": speed, "angular": 0.0}
        for name, start, end, speed in legs
    ]
    count = max((len(values) for values in series.values()), default=0)
    time = [legs[-1][2] * n / count for n in range(count)]
    return {"course": course, "series": {"time": time, **series}, "measurements": list(figures)}


def plots(known: dict[str, Any], mass: float | None = None) -> TrialPlots:
    drawn = plots_of(known, mass)
    assert drawn is not None
    return drawn


def named(known: dict[str, Any], title: str) -> Plot:
    return next(plot for plot in plots(known).plots if plot.title == title)


def test_without_samples_there_is_no_plot() -> None:
    assert plots_of(trial()) is None
    assert plots_of({"course": [], "series": {}, "measurements": []}) is None


def test_the_page_gets_the_legs_and_a_value_for_each_moment() -> None:
    read = json.loads(plots(trial(z=[0.1, None, 0.1, 0.1])).json)
    assert [leg["name"] for leg in read["legs"]] == ["settle", "drive"]
    (height,) = read["plots"]
    assert height["curves"][0]["values"] == [0.1, None, 0.1, 0.1]
    assert len(read["time"]) == 4


def test_that_a_copter_is_put_into_the_air_does_not_flatten_its_climb() -> None:
    heights = [0.05] * 20 + [1.05] * 40 + [1.05 + 0.025 * n for n in range(40)]
    known = trial(FLIGHT, z=heights, command_linear=[0.0] * 60 + [0.5] * 40)
    rate = named(known, "Climb rate")
    assert rate.high < 0.7
    assert "At 1 s the copter is put into the air" in rate.note


def test_a_short_peak_does_not_flatten_the_rest_and_is_told() -> None:
    loads = [40.0] * 100
    loads[2] = 900.0
    load = named(trial(**{"load:wheel": loads}), "Load on the ground")
    assert load.high < 80.0
    assert "A peak of 900 N is beyond the scale" in load.note


def test_noise_far_below_the_limit_stays_flat() -> None:
    known = trial(
        LEGS,
        figure("settle_tilt", 0.0, above=0.26),
        roll=[1e-4 * (-1) ** n for n in range(50)],
    )
    tilt = named(known, "Tilt")
    assert tilt.high - tilt.low > 100 * 0.0057
    assert "the limit of 14.9 °" in tilt.note
    assert {curve.kind for curve in tilt.curves} == {"measured"}


def test_limits_near_the_curve_are_drawn_where_they_hold() -> None:
    known = trial(
        LEGS,
        figure("speed_ratio", 1.0, warning_beyond=0.05),
        figure("full_speed_limit", 1.5),
        speed=[0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
        command_linear=[0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
    )
    speed = named(known, "Speed")
    limits = {curve.name: curve.values for curve in speed.curves if curve.kind == "limit"}
    assert limits["least allowed"] == (None, None, *[0.95] * 6)
    assert limits["most allowed"] == (None, None, *[1.05] * 6)
    assert limits["velocity limit"] == (1.5,) * 8
    assert speed.high > 1.5


def test_the_torque_says_how_it_is_averaged() -> None:
    known = trial(LEGS, figure("torque_limit", 5.0), **{"torque:wheel": [4.0] * 8})
    torque = named(known, "Torque")
    assert "Mean over 0.1 s, as in the table" in torque.note
    assert [curve.values[0] for curve in torque.curves if curve.kind == "limit"] == [5.0, -5.0]


def test_of_many_parts_those_with_the_greatest_values_are_drawn() -> None:
    loads = {f"load:wheel{number}": [number + 1.0, number + 1.0] for number in range(20)}
    plot = named(trial(**loads), "Load on the ground")
    assert [curve.name for curve in plot.curves] == [f"wheel{number}" for number in range(12, 20)]
    assert "12 parts of lower values are not drawn" in plot.note


@given(
    st.lists(
        st.none() | st.floats(-1e9, 1e9, allow_nan=False), min_size=2, max_size=90
    ).filter(lambda values: any(value is not None for value in values))
)  # fmt: skip
def test_every_scale_holds_most_of_its_curve(values: list[float | None]) -> None:
    (plot,) = plots(trial(z=values)).plots
    known = [value for value in values if value is not None]
    within = [value for value in known if plot.low <= value <= plot.high]
    assert plot.low < plot.high
    assert len(within) >= 0.97 * len(known)
    assert (len(within) < len(known)) <= ("is beyond the scale" in plot.note)
