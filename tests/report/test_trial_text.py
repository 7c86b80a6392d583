"""The trial as a person at a terminal reads it."""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import NO_TRIAL, Cause, NotChecked, PackageReport, Report
from checker.report.text_report import to_text

PLAIN = Palette(enabled=False)
PACKAGE = PackageReport("rover", "rover", "robot", ())


def figure(name: str, value: float, unit: str = "", **changes: Any) -> dict[str, Any]:
    said = {"label": name.replace("_", " "), "part": "", "other": "", "rule": "TRI003"}
    return {
        "name": name,
        "value": value,
        "unit": unit,
        "limits": {},
        "verdict": "ok",
        **said,
        **changes,
    }


def trial(*figures: dict[str, Any], **changes: Any) -> dict[str, Any]:
    course = [{"name": "settle", "start": 0.0, "end": 15.0, "linear": 0.0, "angular": 0.0}]
    plain = {"drive": "skid-steer drive", "versions": {"mujoco": "4.0.0"}, "course": course}
    nothing = {"refused": "", "refused_part": "", "repairs": [], "notes": [], "trouble": []}
    return {**plain, **nothing, "measurements": list(figures), "series": {}, **changes}


def lines(*figures: dict[str, Any], **changes: Any) -> list[str]:
    report = replace(PACKAGE, trial=trial(*figures, **changes))
    return to_text(Report((report,), {}), RenderSettings(PLAIN)).splitlines()[2:-1]


def test_a_line_for_each_figure_that_matters() -> None:
    tilt = figure("settle_tilt", 0.0123, "rad")
    drift = figure("turn_drift", 1.23, "m", verdict="warning", limits={"warning_above": 0.5})
    assert lines(figure("speed_ratio", 0.9953), tilt, drift) == [
        "trial: skid-steer drive, 15 s in MuJoCo 4.0.0",
        "    speed ratio  0.995   ok",
        "    settle tilt  0.705°  ok",
        "    turn drift   1.23 m  warning  ok up to 0.5 m",
    ]


def test_figures_of_several_parts_take_one_line_with_the_gravest_verdict() -> None:
    loads = [
        figure("load_share", value, part=part, verdict=verdict)
        for part, value, verdict in (("a", 1.2, "ok"), ("b", 0.01, "warning"), ("c", 0.9, "ok"))
    ]
    assert lines(*loads)[1] == "    load share  0.01…1.2  warning"


def test_several_parts_are_ok_only_if_each_is() -> None:
    torques = [
        figure("torque", value, "N·m", part=part, verdict=verdict)
        for part, value, verdict in (("a", 36.6, "not judged"), ("b", 0.5, "ok"))
    ]
    assert lines(*torques)[1] == "    torque  0.5…36.6 N·m  not judged"


def test_figures_that_only_inform_are_left_to_the_json() -> None:
    quiet = figure("stop_distance", 0.2, "m", verdict="not judged")
    fine = figure("settle_rise", 0.0, "m")
    loud = figure("settle_rise", 0.4, "m", verdict="error")
    assert len(lines(quiet, fine)) == 1
    assert "error" in lines(loud)[1]


def test_a_refusal_takes_the_place_of_the_table() -> None:
    assert lines(refused="'base' has no mass", course=[]) == [
        "trial: MuJoCo refuses the model: 'base' has no mass"
    ]


def test_notes_and_repairs_are_said() -> None:
    repairs = [{"part": "tip", "what": "has no mass; 0.001 kg is used", "serious": True}] * 2
    said = lines(notes=["A mesh is left out: arm."], repairs=repairs)
    assert said[1:] == [
        "    note: A mesh is left out: arm.",
        "    2 repairs to make the trial possible: tip has no mass; 0.001 kg is used",
    ]


def test_text_of_a_package_does_not_steer_the_terminal() -> None:
    said = "\n".join(lines(notes=["\x1b[31m"], refused_part="\x1b"))
    assert "\x1b" not in said


def test_the_verdict_says_that_no_trial_was_run() -> None:
    off = NotChecked("TRI001", NO_TRIAL, Cause.SWITCHED_OFF)
    other = NotChecked("SEN001", "switched off", Cause.SWITCHED_OFF)
    for reasons, end in (
        ((off,), "trial not run"),
        ((off, other), "trial not run, 1 rule switched off"),
    ):
        said = to_text(Report((replace(PACKAGE, not_checked=reasons),), {}), RenderSettings(PLAIN))
        assert said.endswith(f"rover: Ready: nothing to fix ({end})\n")
