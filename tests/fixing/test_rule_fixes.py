"""The fix of every rule, tried on its bad examples: the fault goes, and nothing comes for it."""

from __future__ import annotations

import inspect
import sys
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from checker.base.cache import NO_CACHE
from checker.engine.review import findings_of
from checker.finding import Safety, Severity
from checker.fix.rounds import MAX_ROUNDS, fix_package
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.report.report import ReportedFinding
from checker.rule import Rule
from checker.rule_testing import Example, profile_of, write_example
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml

CASES = [
    pytest.param(rule, example, id=f"{rule.id}-{number}")
    for rule in all_rules()
    if "fix=" in inspect.getsource(sys.modules[rule.check.__module__])
    for number, example in enumerate(rule.bad, 1)
]
REVEALED = {
    "REF001": "MSH001",  # the mesh is found, and is empty
    "REF002": "MSH001",
    "SEN002": "ROS001",  # the lidar is simulated, and its scan is not bridged
    "GEO003": "GEO004",  # the radius of a wheel that lies right is compared with the drive's
    "GEO008": "INE009",  # the shape that it stands on is known
    "SDF010": "KIN003",  # the link is one of the robot's own, and no joint ties it
}
"""What another rule can see only once a fix is made."""


def judge(rule: Rule, example: Example, **wishes: Any) -> Settings:
    return Settings(trial=False, profile=profile_of(rule, example).name, **wishes)


Judged = list[tuple[ReportedFinding, ...]]
"""The findings of each round, those of the last one without any fix to make."""


def fixed(package: Package, settings: Settings) -> tuple[Package, Judged]:
    """Return the package with all fixes made, in memory, and what was found in each round."""
    judged: Judged = []

    def findings(each: Package) -> tuple[ReportedFinding, ...]:
        judged.append(findings_of(each, settings, NO_CACHE))
        return judged[-1]

    found = fix_package(package, findings, list(Safety))
    assert len(judged) <= MAX_ROUNDS
    texts = {file.path: replace(file.before, text=file.after) for file in found.files}
    return package.with_texts(texts), judged


def counted(findings: Iterable[ReportedFinding]) -> Counter[str]:
    """Count the places of errors and warnings by rule; `related` ones are none."""
    return Counter(
        each.rule
        for each in findings
        if each.severity is not Severity.INFO
        for place in each.places
        if not place.note
    )


@pytest.mark.parametrize(("rule", "example"), CASES)
def test_a_fix_mends_its_fault(rule: Rule, example: Any, tmp_path: Path) -> None:
    with open_input(write_example(example, tmp_path)) as opened:
        before = opened.packages[0]
        after, (faults, *rounds) = fixed(before, judge(rule, example, select=(rule.id,)))
        mended = {each.fingerprint for each in faults if each.fix}
        if mended:
            assert not mended & {each.fingerprint for each in rounds[-1]}
            assert_well_laid_out(before, after)


@pytest.mark.slow
@pytest.mark.parametrize(("rule", "example"), CASES)
def test_a_fix_brings_no_other_fault(rule: Rule, example: Any, tmp_path: Path) -> None:
    with open_input(write_example(example, tmp_path)) as opened:
        before, every = opened.packages[0], judge(rule, example)
        after, (faults, *_) = fixed(before, judge(rule, example, select=(rule.id,)))
        if not any(each.fix for each in faults):
            return
        new = counted(findings_of(after, every, NO_CACHE))
        new -= counted(findings_of(before, every, NO_CACHE))
        new.pop(REVEALED.get(rule.id, ""), None)
        assert not new


def assert_well_laid_out(before: Package, after: Package) -> None:
    """Nothing is cut off: no blank at an end of line or empty line that was not there."""
    for path in (file.path for file in before.index.files):
        texts = before.read(path), after.read(path)
        if not all(isinstance(text, SourceText) for text in texts):
            continue
        old, new = (text.text for text in texts if isinstance(text, SourceText))
        if old == new:
            continue
        assert untidy(new) <= untidy(old), path
        if isinstance(before.xml(path), XmlDocument):
            assert isinstance(parse_xml(SourceText(path, new)), XmlDocument)


def untidy(text: str) -> int:
    return sum(line != line.rstrip() or not line for line in text.splitlines())


def test_names_keep_their_prefix_where_a_text_would_still_mention_it(tmp_path: Path) -> None:
    (rule,) = (each for each in all_rules() if each.id == "SDF011")
    example = dict(rule.bad[0])
    for number, more in enumerate(
        ({"notes.md": "See X1/wheel."}, {"../other/package.xml": "<package>X1/wheel</package>"})
    ):
        with open_input(write_example({**example, **more}, tmp_path / str(number))) as opened:
            findings = findings_of(
                opened.packages[0], judge(rule, example, select=("SDF011",)), NO_CACHE
            )
            assert [each.fix for each in findings] == [None] * len(findings)
            assert findings


def safeties(example: Example, rule: str, folder: Path, profile: str = "subt") -> list[str]:
    """Return how safe the fixes are that a rule offers for an example."""
    settings = Settings(trial=False, profile=profile, select=(rule,))
    with open_input(write_example(example, folder)) as opened:
        found = findings_of(opened.packages[0], settings, NO_CACHE)
    return [each.fix.safety.value if each.fix else "none" for each in found]


@pytest.mark.parametrize(
    ("angle", "safety"), [("1.5708", "safe"), ("3.1416", "safe"), ("3.14", "unsafe")]
)
def test_a_safe_fix_moves_no_part(angle: str, safety: str, tmp_path: Path) -> None:
    lid = f'<link name="lid"><pose>0 0 0.1 0 0 {angle}</pose></link>'
    assert safeties(lid, "GEO001", tmp_path) == [safety]


@pytest.mark.parametrize(
    ("profile", "safety"), [("subt", "unsafe"), ("gazebo-harmonic", "none"), ("urdf", "none")]
)
def test_ray_0_of_a_lidar_stays_where_it_is(profile: str, safety: str, tmp_path: Path) -> None:
    lidar = """<sensor name="s" type="gpu_lidar"><lidar><scan><horizontal><samples>360</samples>
      <min_angle>0</min_angle><max_angle>6.28</max_angle></horizontal></scan></lidar></sensor>"""
    assert safeties(lidar, "SEN003", tmp_path, profile) == [safety]


def test_angles_that_the_file_does_not_state_have_no_fix(tmp_path: Path) -> None:
    lidar = """<sensor name="s" type="gpu_lidar"><lidar><scan><horizontal><samples>360</samples>
      <min_angle>-6.3</min_angle></horizontal></scan></lidar></sensor>"""
    assert safeties(lidar, "SEN003", tmp_path) == ["none"]


def installed(folder: Path, items: str, files: Mapping[str, str]) -> str:
    """Return CMakeLists.txt as PKG009 corrects it."""
    build = f"project(a)\ninstall({items} DESTINATION share/a)\n"
    with open_input(write_example({"CMakeLists.txt": build, **files}, folder)) as opened:
        settings = Settings(trial=False, profile="subt", select=("PKG009",))
        after, _ = fixed(opened.packages[0], settings)
        source = after.read("CMakeLists.txt")
    assert isinstance(source, SourceText)
    return source.text


def test_no_file_takes_the_place_of_a_folder(tmp_path: Path) -> None:
    assert "install(DIRECTORY launch DESTINATION" in installed(
        tmp_path, "DIRECTORY model launch", {}
    )


@pytest.mark.parametrize(
    ("before", "after"), [("halls", "media/halls"), ("halls/", "media/halls/")]
)
def test_a_folder_that_was_moved_is_installed_from_there(
    before: str, after: str, tmp_path: Path
) -> None:
    text = installed(tmp_path, f"DIRECTORY launch {before}", {"media/halls/one.sdf": "<sdf/>"})
    assert f"DIRECTORY launch {after} DESTINATION" in text


def test_what_moveit_finds_the_robot_by_stays_installed(tmp_path: Path) -> None:
    assert "FILES .setup_assistant" in installed(tmp_path, "FILES .setup_assistant", {})


def test_no_package_depends_on_its_own_former_name(tmp_path: Path) -> None:
    include = "<launch><include file='$(find rover_description)/launch/a.launch'/></launch>"
    example = {"launch/a.launch": "<launch/>", "launch/b.launch": include}
    assert safeties(example, "PKG007", tmp_path) == ["none"]
