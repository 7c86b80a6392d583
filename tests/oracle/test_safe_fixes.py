"""After safe fixes libsdformat reads the same robot, but for the values that they are about."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import pytest
from lxml import etree

from checker.cli.check.fix import fix_paths
from checker.finding import Safety
from checker.model.geometry.transform import rotation_from_rpy
from checker.report.report import ReportedFinding
from support.real_packages import CORPUS, MODERN, judged_folders, needs
from tests.conftest import SAMPLES
from tests.oracle.conftest import Load

ABOUT: Mapping[str, str] = {
    "REF001": r"(uri|_map)",
    "REF004": r"(uri|_map)",
    "SDF003": r"/({tags})",
    "SDF004": r"/({tags})(\[[^]]*\])?@\w+",
    "SDF008": r"/({tags})",
    "SDF015": r"material/script(/.*)?",
    "SDF016": r"(ambient|diffuse|specular|emissive)",
    "SEN002": r"/sensor\[[^]]*\]@type",
    "SEN003": r"(min|max)_angle",
    "SEN005": r"resolution",
    "SEN008": r"/lens(/.*)?",
    "SEN009": r"/intrinsics/\w+",
    "SEN013": r"/imu/(angular_velocity|linear_acceleration)(/.*)?",
    "SEN014": r"/(imu|imu/enable_orientation|enable_orientation)",
    "SEN021": r"/visualize",
    "PLG003": r"/plugin\[[^]]*\]@name",
}
"""The values that a rule's fix is about: how their paths end; `tags` are those of its message."""
OF_SUBT = {"SEN014"}
"""Rules whose fixes follow SubT's rules, and are made nowhere else."""
WITHOUT_TRACE = ("GEO001", "SDF002", "SDF007", "SDF014")
"""Rules whose fixes change nothing, or angles by a trace."""
MODELS = (".sdf", ".world", ".urdf")
_TURNED, _WHEEL_TURNED = 1e-4, 2e-3
"""Radians by which GEO001 may turn a part, and a wheel's collision; so far directions differ."""


def packages(variable: str) -> Iterator[Path]:
    """Yield the folders of real packages."""
    for top in judged_folders(variable):
        for path in sorted(top.rglob("*")):
            if path.name in ("package.xml", "model.config"):
                yield path.parent


def values(text: str) -> dict[str, tuple[str, ...]]:
    """Return all values of a model by their paths; one path may stand for several places."""
    found: dict[str, tuple[str, ...]] = {}
    root = etree.fromstring(text.encode(), etree.XMLParser(recover=True))
    stack = [(root, "")]
    while stack:
        element, above = stack.pop()
        name = element.get("name")
        path = f"{above}/{element.tag}[{name}]" if name else f"{above}/{element.tag}"
        for place, value in (("", element.text or ""), *element.attrib.items()):
            key = f"{path}@{place}" if place else path
            found[key] = (*found.get(key, ()), value.strip())
        stack += [(child, path) for child in element.iterchildren("*")]
    return found


def changed(before: str, after: str) -> Iterator[str]:
    """Yield the paths of values that differ, except poses that became exact."""
    old, new = values(before), values(after)
    for path in sorted({**old, **new}):
        one, other = old.get(path, ()), new.get(path, ())
        turned = _WHEEL_TURNED if "/collision[" in path else _TURNED
        if one != other and not (path.endswith("/pose") and _near(one, other, turned)):
            yield path


def _near(one: Sequence[str], other: Sequence[str], turned: float) -> bool:
    """Return whether poses are nearly equal, however their rotations are written."""
    numbers = [[number for pose in poses for number in _entries(pose)] for poses in (one, other)]
    return len(numbers[0]) == len(numbers[1]) and all(
        abs(a - b) <= turned for a, b in zip(*numbers, strict=True)
    )


def _entries(pose: str) -> Iterator[float]:
    """Yield the position and the rotation matrix of a pose of six numbers."""
    x, y, z, *rpy = map(float, pose.split())
    yield from (x, y, z)
    for row in rotation_from_rpy(*rpy):
        yield from row


def about(findings: Iterable[ReportedFinding]) -> re.Pattern[str]:
    """Return what matches the paths of the values that fixes were about."""
    ends = [
        ABOUT[each.rule].replace("{tags}", "|".join(re.findall(r"<(\w+)>", each.message)))
        for each in findings
        if each.rule in ABOUT
    ]
    return re.compile("|".join(f"(?:.*{end})" for end in ends) or "(?!)")


def fixed_otherwise(package: Path, profile: str, libsdformat: Load) -> list[str]:
    """Fix a package, and return what its models say otherwise that no fix was about."""
    files = sorted(path for path in package.rglob("*") if path.suffix in MODELS)
    before = libsdformat(files, elements=True)
    settings = {"profile": profile, "select": (*ABOUT, *WITHOUT_TRACE)}
    fixes = fix_paths([package], settings, (Safety.SAFE,), write=True)
    found = [finding for each in fixes for finding in each.fixed.findings]
    meant = about(each for each in found if profile == "subt" or each.rule not in OF_SUBT)
    wrong = []
    for file, old, new in zip(files, before, libsdformat(files, elements=True), strict=True):
        if new.errors and not old.errors:
            wrong.append(f"{file} is refused: {new.reason}")
        elif not new.errors and not old.errors:
            paths = changed(old.elements, new.elements)
            wrong += [f"{file}: {path}" for path in paths if not meant.fullmatch(path)]
    return wrong


@pytest.mark.parametrize("sample", sorted(path.name for path in SAMPLES.glob("*_config_?")))
def test_samples_stay_the_same(sample: str, tmp_path: Path, libsdformat: Load) -> None:
    package = shutil.copytree(SAMPLES / sample, tmp_path / sample)
    assert not fixed_otherwise(package, "subt", libsdformat)


@pytest.mark.parametrize(
    ("variable", "profile"),
    [
        pytest.param(CORPUS, "subt", marks=needs(CORPUS), id="corpus"),
        pytest.param(MODERN, "gazebo-harmonic", marks=needs(MODERN), id="modern"),
    ],
)
def test_real_packages_stay_the_same(
    variable: str, profile: str, tmp_path: Path, libsdformat: Load
) -> None:
    wrong = []
    for number, package in enumerate(packages(variable)):
        copy = shutil.copytree(package, tmp_path / str(number) / package.name)
        wrong += fixed_otherwise(copy, profile, libsdformat)
    assert not wrong
