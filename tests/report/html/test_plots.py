"""Curves of a trial."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from checker.report.html.plots import HEIGHT, WIDTH, plots_of, spans_of

COURSE = [
    {"name": "settle", "start": 0.0, "end": 1.0, "linear": 0.0, "angular": 0.0},
    {"name": "drive", "start": 1.0, "end": 4.0, "linear": 1.0, "angular": 0.0},
]


def trial(**series: list[float | None]) -> dict[str, Any]:
    return {"course": COURSE, "series": series}


def test_legs_fill_the_axis() -> None:
    spans = spans_of(COURSE)
    assert [(span.name, span.start, span.width) for span in spans] == [
        ("settle", 0.0, 25.0),
        ("drive", 25.0, 75.0),
    ]


def test_a_gap_parts_a_curve() -> None:
    (plot,) = plots_of(trial(time=[0.0, 1.0, 2.0, 3.0, 4.0], z=[0.1, 0.2, None, 0.1, 0.1]))
    (line,) = plot.lines
    assert [len(piece.split()) for piece in line.pieces] == [2, 2]


def test_a_copter_is_told_how_fast_to_climb() -> None:
    climb = [{"name": "climb", "start": 0.0, "end": 2.0, "linear": 0.5, "angular": 0.0}]
    series = {"time": [0.0, 1.0, 2.0], "z": [0.0, 0.5, 1.0], "command_linear": [0.5] * 3}
    rate = plots_of({"course": climb, "series": series})[0]
    assert rate.title == "Climb rate"
    reached, commanded = rate.lines
    assert reached.pieces[0].split()[0] == commanded.pieces[0].split()[0]


def test_without_samples_there_is_no_plot() -> None:
    assert plots_of(trial()) == []
    assert plots_of({"course": [], "series": {}}) == []


def test_many_parts_are_counted() -> None:
    loads = {f"load:wheel{number}": [1.0, 2.0] for number in range(20)}
    (plot,) = plots_of(trial(time=[0.0, 4.0], **loads))
    assert (len(plot.lines), plot.more) == (8, 12)


@given(
    st.lists(
        st.none() | st.floats(-1e9, 1e9, allow_nan=False), min_size=2, max_size=30
    ).filter(lambda values: any(value is not None for value in values))
)  # fmt: skip
def test_every_point_and_tick_lies_in_the_plot(values: list[float | None]) -> None:
    time: list[float | None] = [4.0 * n / len(values) for n in range(len(values))]
    (plot,) = plots_of(trial(time=time, z=values))
    for line in plot.lines:
        for x, y in (point.split(",") for piece in line.pieces for point in piece.split()):
            assert 0 <= float(x) <= WIDTH
            assert 0 <= float(y) <= HEIGHT
    assert all(0 <= tick.top <= 100 for tick in plot.ticks)
    assert plot.ticks
