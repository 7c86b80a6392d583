"""Findings on real packages that people judged, and the present findings there.

Each file `<source>.json` lists findings with a verdict: `true`, a fault that the target suffers
from, at this severity; `false`, none, or one of a lesser severity; `arguable`.
"""

from __future__ import annotations

import json
from collections import defaultdict
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from checker.finding import Severity
from checker.pipeline import check_package
from checker.report.report import ReportedFinding
from checker.settings import Settings
from support.real_packages import CORPUS, MODERN, URDFS, named_folder

HERE = Path(__file__).parent / "judged"
_URDFS = "example-robot-data"
_RANK = {Severity.INFO: 0, Severity.WARNING: 1, Severity.ERROR: 2}


@dataclass(frozen=True)
class Place:
    """Place at which a rule reports something."""

    rule: str
    file: str
    line: int


@dataclass(frozen=True)
class Judgement:
    """One judged finding.

    Attributes:
        path: The checked path, below the folder of the source.
        profile: The profile of the check.
        severity: The judged severity.
        place: The place where it is, or was, reported.
        verdict: `true`, `false` or `arguable`.
        reason: The reason, in a sentence.
        still_reported: Whether a false one is reported to this day.
    """

    path: str
    profile: str
    severity: Severity
    place: Place
    verdict: str
    reason: str
    still_reported: bool = False

    @property
    def expected(self) -> bool | None:
        """True if the rules must report it; None if undecided."""
        if self.verdict == "arguable":
            return None
        return self.verdict == "true" or self.still_reported


def folder_of(source: str) -> Path | None:
    """Return the folder of a source of packages; None if it is not there."""
    if source == "urdf":
        if (named := named_folder(URDFS)) is not None:
            return named
        try:
            root = distribution(_URDFS).locate_file("cmeel.prefix/share/example-robot-data/robots")
        except PackageNotFoundError:
            return None
        return Path(str(root))
    return named_folder({"corpus": CORPUS, "modern": MODERN}[source])


def judgements(source: str) -> list[Judgement]:
    """Return what is judged of a source."""
    entries = json.loads((HERE / f"{source}.json").read_text("utf-8"))["findings"]
    return [
        Judgement(
            entry["path"],
            entry["profile"],
            Severity(entry["severity"]),
            Place(entry["rule"], entry["file"], entry["line"]),
            entry["verdict"],
            entry["reason"],
            entry.get("still_reported", False),
        )
        for entry in entries
    ]


def by_check(source: str) -> dict[tuple[str, str], list[Judgement]]:
    """Return the judgements of a source by what is checked: path and profile."""
    groups: dict[tuple[str, str], list[Judgement]] = defaultdict(list)
    for judgement in judgements(source):
        groups[judgement.path, judgement.profile].append(judgement)
    return dict(groups)


@cache
def findings(source: str, path: str, profile: str, *, trial: bool) -> tuple[ReportedFinding, ...]:
    """Return what the rules report now.

    Args:
        source: The source of the package.
        path: The path below the folder of the source.
        profile: The profile to judge by.
        trial: Whether the robot is driven.
    """
    folder = folder_of(source)
    assert folder is not None, f"the packages of {source} are not there"
    # What is judged for ROS 2 is judged for Jazzy and Harmonic, whatever a package says of itself.
    distro = "jazzy" if profile == "ros2" else ""
    settings = Settings(profile=profile, profile_chosen=True, distro=distro, trial=trial)
    report = check_package(folder / path, settings)
    found = (finding for package in report.packages for finding in package.findings)
    return tuple(finding for finding in found if not is_of_the_copy(source, finding))


def is_reported(judgement: Judgement, found: tuple[ReportedFinding, ...]) -> bool:
    """Return whether a judged finding is reported, at its severity or above."""
    return any(
        finding.rule == judgement.place.rule
        and _RANK[finding.severity] >= _RANK[judgement.severity]
        and judgement.place in places(finding)
        for finding in found
    )


def places(finding: ReportedFinding) -> list[Place]:
    """Return the places of a finding, without those that only have to do with it."""
    return [Place(finding.rule, at.file, at.line) for at in finding.places if not at.note]


@cache
def _left_out(folder: Path) -> frozenset[str]:
    """Return the names of meshes and textures that copies of real packages lack."""
    lists = (file.read_text("utf-8") for file in folder.rglob("missing_meshes.txt"))
    return frozenset(
        Path(word).name for text in lists for word in text.split() if "." in Path(word).name
    )


def is_of_the_copy(source: str, finding: ReportedFinding) -> bool:
    """Return whether a finding is about a file that only the copy of the package lacks."""
    folder = folder_of(source)
    if folder is None or finding.rule != "REF002":
        return False
    words = finding.message.split()
    return any(Path(word).name in _left_out(folder) for word in words)
