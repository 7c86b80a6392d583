"""What a rule shows alone, the whole check shows too, or names as a repeat."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace

from checker.base.cache import NO_CACHE
from checker.engine.judge import Judge
from checker.engine.review import run_and_set_aside
from checker.engine.run import Outcome
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.report.report import ReportedFinding
from checker.rulebook.profiles import profile
from checker.rulebook.rule_index import rules
from checker.settings import Settings
from tests.conftest import SAMPLES

BROKEN = [path for path in sorted(SAMPLES.glob("broken_*")) if path.is_dir()]
Said = tuple[str, str, tuple[tuple[str, int], ...]]


def said(finding: ReportedFinding) -> Said:
    places = tuple((place.file, place.line) for place in finding.places)
    return finding.rule, finding.message, places


def told(outcome: Outcome) -> tuple[set[Said], set[tuple[str, str]]]:
    """Return the findings of the whole check, and what these repeat."""
    aside = (each.finding for each in outcome.suppressed)
    repeats = (each for finding in outcome.findings for each in finding.repeats)
    shown = {said(finding) for finding in (*outcome.findings, *aside)}
    return shown, {(each.rule, each.message) for each in repeats}


@pytest.mark.slow
@pytest.mark.parametrize("sample", BROKEN, ids=lambda path: path.name)
def test_the_whole_check_shows_what_each_rule_shows_alone(sample: Path) -> None:
    with open_input(sample) as opened:
        for package in opened.packages:
            compare(package)


def compare(package: Package) -> None:
    known = rules(NO_CACHE)
    settings = Settings(trial=False, cache=False).for_package(package)
    judge = Judge.from_settings(settings)
    subject = Subject(package)
    shown, repeats = told(run_and_set_aside(known, known, subject, judge))
    for rule in (each for each in known if judge.profile.includes(each)):
        alone = Judge(judge.profile, replace(settings, select=(rule.id,)))
        outcome = run_and_set_aside([rule], known, subject, alone)
        for finding in outcome.findings:
            assert said(finding) in shown or (rule.id, finding.message) in repeats
    subject.close()


@pytest.mark.parametrize("name", ["ros2", "urdf", "subt", "gazebo-harmonic"])
def test_what_stops_a_build_is_told_for_every_kind_of_package(name: str, tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package format='3'><name>a</name></package>")
    (tmp_path / "CMakeLists.txt").write_text("install(DIRECTORY none DESTINATION share/a)\n")
    with open_input(tmp_path) as opened:
        subject = Subject(opened.packages[0])
        settings = Settings(trial=False, profile=name)
        outcome = run_and_set_aside(
            rules(NO_CACHE), rules(NO_CACHE), subject, Judge(profile(name), settings)
        )
        subject.close()
    assert "PKG009" in {finding.rule for finding in outcome.findings}
