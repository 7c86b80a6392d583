"""Figures about robots that every report shows; nothing is read or weighed for their sake."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar

from msgspec.structs import replace

from checker.base.parts import NotAvailable
from checker.engine.mujoco_facts import model_overview
from checker.engine.run import Outcome
from checker.engine.subject import Subject
from checker.finding import Place, Severity
from checker.model.components import Collision, Visual
from checker.model.mesh import Mesh
from checker.model.robot import Robot
from checker.physics.compiled.model import CompiledModel
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.trial.measures.figures import MEASURES, Measure
from checker.physics.trial.robot_trial import RobotTrial
from checker.physics.trial.run import RobotTrials
from checker.physics.trial.trial import Measurement, Trial
from checker.report.figures import NOT_JUDGED
from checker.robots.urdf_files import UrdfFiles
from checker.rule import Rule

# A trial as the report shows it: every figure with its limits and a verdict.


_SERIES_DIGITS = 6


def trials_of(
    subject: Subject, outcome: Outcome, known: Sequence[Rule]
) -> tuple[dict[str, Any], ...]:
    """Return the trials of a package; of several robots, each states which one it is about."""
    driven, robots = subject.cached_parts(RobotTrial), subject.all(Robot)
    if isinstance(robots, NotAvailable) or len(robots) < 2:
        return tuple(trial_facts(each, outcome, known) for each in driven)
    numbers = {id(robot): number for number, robot in enumerate(robots)}
    return tuple(
        {"robot": numbers[id(each.robot)], **trial_facts(each, outcome, known, alone=False)}
        for each in driven
    )


def trial_facts(
    driven: RobotTrial, outcome: Outcome, known: Sequence[Rule], *, alone: bool = True
) -> dict[str, Any]:
    """Return what JSON can express of a trial and of what the rules stated about its figures.

    Args:
        driven: The robot and its trial.
        outcome: The outcome of the rules.
        known: All rules.
        alone: Whether all that they stated is about this robot.
    """
    judges = _judges(known)
    verdicts = _verdicts(outcome, known)
    if not alone:
        verdicts = _about(driven, verdicts)
    trial = driven.trial
    data = replace(trial, replay=None).as_json()
    said = {"not_driven": trial.not_driven, "moved": trial.moved}
    return {
        **{name: text for name, text in said.items() if text},
        "drive": trial.drive,
        "versions": dict(trial.versions),
        "course": data["legs"],
        "refused": trial.refused,
        "refused_part": trial.refused_part,
        "measurements": list(_measurements(driven, outcome, verdicts, judges)),
        "repairs": data["repairs"],
        "notes": list(trial.notes),
        "trouble": list(trial.trouble),
        "series": _series(trial),
    }


def _judges(known: Sequence[Rule]) -> dict[str, str]:
    """Return the rule of each figure; of several that judge it, the first one."""
    ordered = sorted(known, key=lambda rule: rule.id, reverse=True)
    return {name: rule.id for rule in ordered for name in rule.judges}


def _measurements(
    driven: RobotTrial, outcome: Outcome, verdicts: _Verdicts, judges: Mapping[str, str]
) -> Iterator[dict[str, Any]]:
    for measurement in driven.trial.measurements:
        measure = MEASURES.get(measurement.name, Measure(measurement.name.replace("_", " ")))
        if not math.isfinite(measurement.value):
            continue
        rule = judges.get(measurement.name, "")
        options = outcome.looked.get(rule, {})
        looked = rule in outcome.looked and not _is_excused(measurement, driven, options)
        yield {
            "name": measurement.name,
            "label": measure.label,
            "value": _rounded_value(measurement.value),
            "unit": measure.unit,
            "part": measurement.part,
            "other": measurement.other,
            "rule": rule,
            "limits": _limits(measurement.name, options),
            "verdict": _verdict(measurement, driven, verdicts, looked),
        }


_Verdicts = dict[str, list[tuple[Severity, frozenset[tuple[str, int, int]]]]]
"""For each figure, by name: severity and places of each finding about it."""


def _verdicts(outcome: Outcome, known: Sequence[Rule]) -> _Verdicts:
    verdicts: _Verdicts = {}
    judging = {rule.id for rule in known if rule.judges}
    # A figure is out of its limits also where that does not count, or where its cause is reported.
    aside = (item.finding for item in outcome.suppressed)
    for finding in (*outcome.findings, *aside, *outcome.covered):
        if finding.rule in judging:
            places = frozenset(map(_start, finding.places))
            for name in finding.key.split():
                verdicts.setdefault(name, []).append((finding.severity, places))
    return verdicts


def _about(driven: RobotTrial, verdicts: _Verdicts) -> _Verdicts:
    """Return what was stated about one of several robots: some place of it is one of its parts."""
    robot = driven.robot
    parts = (driven.drive, robot, *robot.links, *robot.joints, *robot.all_plugins)
    own = {_start(part.span.place()) for part in parts}
    return {
        name: [(severity, places) for severity, places in said if not own.isdisjoint(places)]
        for name, said in verdicts.items()
    }


def _start(place: Place) -> tuple[str, int, int]:
    return place.file, place.line, place.column


def _verdict(
    measurement: Measurement, driven: RobotTrial, verdicts: _Verdicts, looked: bool
) -> str:
    """Return the most severe verdict on a figure; `ok` when its rule ran without a finding."""
    judged = verdicts.get(measurement.name, [])
    if measurement.part:
        start = _start(driven.part(measurement.part).span.place())
        judged = [(severity, places) for severity, places in judged if start in places]
    if judged:
        return str(min((severity for severity, _ in judged), key=lambda severity: severity.rank))
    return "ok" if looked and MEASURES[measurement.name].silence_is_ok else NOT_JUDGED


def _is_excused(measurement: Measurement, driven: RobotTrial, options: Mapping[str, Any]) -> bool:
    """Return whether a torque exceeds its effort limit, so that a silent rule does not count."""
    if measurement.name not in ("torque", "move_torque"):
        return False
    efforts = {limit.part: limit.value for limit in driven.trial.all("torque_limit")}
    most: float = options.get("warning_above", 1.0) * efforts.get(measurement.part, math.inf)
    return abs(measurement.value) > most


def _limits(name: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the options that are about a figure, without its name in front.

    A rule of several figures names its options after them, as `settle_tilt_above`.
    """
    own = {key: value for key, value in options.items() if key.startswith(f"{name}_")}
    if own:
        return {key.removeprefix(f"{name}_"): value for key, value in own.items()}
    return {key: value for key, value in options.items() if not _names_a_figure(key)}


def _names_a_figure(option: str) -> bool:
    return any(option.startswith(f"{name}_") for name in MEASURES)


def _series(trial: Trial) -> dict[str, list[float | None]]:
    return {
        name: [_rounded_value(value) if math.isfinite(value) else None for value in values]
        for name, values in trial.series.items()
    }


def _rounded_value(value: float) -> float:
    """Return a figure with as many digits as can be distinguished."""
    return float(f"{value:.{_SERIES_DIGITS}g}")


_DIGITS = 6
ROBOTS_LIMIT = 100
"""Robots of one file or package whose figures are reported."""
_T = TypeVar("_T")


def facts_of(subject: Subject) -> tuple[dict[str, Any], ...]:
    """Return what is known by now of each robot; nothing without any.

    Masses in kg, lengths in m, angles in degrees, inertia in kg·m². Results of meshes, Pinocchio or
    the trial are included when a rule has requested them.
    """
    robots = subject.all(Robot)
    if isinstance(robots, NotAvailable):
        return tuple(map(model_overview, subject.cached_parts(CompiledModel)[:ROBOTS_LIMIT]))
    weighed, driven = subject.cached_parts(MassProperties), subject.cached_parts(RobotTrial)
    facts = [
        dict(
            _finite(
                _facts(
                    robot,
                    robot.document.source.file if len(robots) > 1 else None,
                    _at(weighed, number),
                    next((each for each in driven if each.robot is robot), None),
                )
            )
        )
        for number, robot in enumerate(robots[:ROBOTS_LIMIT])
    ]
    if len(robots) > 1:
        undriven = next((trials.undriven for trials in subject.cached_parts(RobotTrials)), {})
        for number, known in enumerate(facts):
            if number in undriven:
                known["not_driven"] = undriven[number]
    for known, robot in zip(facts, robots, strict=False):
        known.update(_arguments(subject, robot))
    return tuple(facts)


def _arguments(subject: Subject, robot: Robot) -> Iterator[tuple[str, str]]:
    """Yield the values of arguments that are not given, and others that count."""
    files = subject.one(UrdfFiles) if robot.document.root.tag == "robot" else None
    if not isinstance(files, UrdfFiles):
        return
    file = robot.document.source.file
    if assumed := files.assumed.get(file):
        yield "assumed", assumed
    if tried := ", ".join(other.values for other in files.others if other.file == file):
        yield "also_tried", tried


def _at(items: Sequence[_T], number: int) -> _T | None:
    """Return an item; None beyond the last."""
    return items[number] if number < len(items) else None


def _facts(
    robot: Robot, file: str | None, masses: MassProperties | None, driven: RobotTrial | None
) -> dict[str, Any]:
    known: dict[str, Any] = {
        "robot": robot.name.value[:200],
        "file": file,
        "mass_kg": robot.mass,
        "links": len(robot.links),
        "joints": len(robot.joints),
        "sensors": len(robot.sensors),
        "plugins": len(robot.all_plugins),
        "drive": str(robot.locomotion.kind),
    }
    if _meshes_are_known(robot):
        known |= {"size_m": _size(robot), **_triangles(robot)}
    if masses is not None:
        known |= _balance(masses)
    if driven is not None:
        known["thrust_to_weight"] = driven.trial.value("thrust_to_weight")
    return known


def _balance(masses: MassProperties) -> Mapping[str, Any]:
    tip = masses.tip_angle if masses.robot.stands_alone else None
    return {
        "centre_of_mass_m": masses.centre,
        "inertia_kg_m2": masses.inertia,
        "tip_angle_deg": None if tip is None else math.degrees(tip),
    }


def _meshes_are_known(robot: Robot) -> bool:
    meshes = robot.meshes
    return isinstance(meshes, PackageMeshes) and meshes.read


def _size(robot: Robot) -> list[float] | None:
    """Return the sides of the box around the robot; None if a part's extent is not known."""
    shaped = [link for link in robot.links if link.collisions or link.visuals]
    boxes = [box for link in shaped if (box := robot.box_of(link)) is not None]
    if not boxes or len(boxes) < len(shaped):
        return None
    return [
        max(box.high[axis] for box in boxes) - min(box.low[axis] for box in boxes)
        for axis in range(3)
    ]


def _triangles(robot: Robot) -> dict[str, int]:
    """Return how many triangles the meshes of collisions and of visuals have."""
    return {
        "collision_triangles": sum(
            _triangles_of(robot, shape) for link in robot.links for shape in link.collisions
        ),
        "visual_triangles": sum(
            _triangles_of(robot, shape) for link in robot.links for shape in link.visuals
        ),
    }


def _triangles_of(robot: Robot, shape: Collision | Visual) -> int:
    mesh = robot.mesh_of(shape)
    return mesh.triangles if isinstance(mesh, Mesh) else 0


def _finite(known: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield what JSON can express and people can read: finite numbers of few digits."""
    for name, value in known.items():
        if isinstance(value, int | str):
            yield name, value
        elif value is not None and (figures := _rounded(value)) is not None:
            yield name, figures


def _rounded(value: float | Sequence[Any]) -> float | list[Any] | None:
    if isinstance(value, float):
        return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None
    rounded = [_rounded(item) for item in value]
    return None if None in rounded else rounded
