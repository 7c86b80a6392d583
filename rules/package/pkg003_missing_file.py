"""A file or folder that a submission needs is not there.

Without model, spawner or manifest the robot cannot be started; without specifications.md no review
begins; the others are what a reviewer opens first. Parts that the package inherits from a sibling
count as there.

Fix: add the file; the guide's example package shows what each one holds.
Source: Model Migration Guide, final directory structure; Robot Model Checklist.
"""

import posixpath
from collections.abc import Iterator

from checker.package.inheritance import Found, Missing
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.references import Reference, ReferenceKind
from checker.rule import Finding, Findings, Severity, Unchecked, finding, rule, unchecked

MANIFESTS = {"package.xml": "the ROS manifest", "CMakeLists.txt": "the build file"}
REQUIRED = {
    "launch/spawner.rb": "which puts the robot into a world",
    "specifications.md": "without which no review begins",
}
EXPECTED = {
    "launch/description.launch": "which loads the robot description",
    "launch/example.ign": "which shows how to start the robot",
    "worlds/example.sdf": "which shows the robot in a world",
    "urdf": "the description for RViz",
    "thumbnails": "pictures of the robot",
}
TOPICS = "launch/vehicle_topics.launch"


@rule("PKG003", "missing-file", Severity.ERROR)
def check(package: Package) -> Findings:
    """Report what is missing, after inheritance."""
    if package.kind is PackageKind.SINGLE_FILE:
        return
    yield from _missing(package, MANIFESTS, Severity.ERROR)
    submission = package.kind in (PackageKind.ROBOT, PackageKind.CONFIGURATION)
    if submission or package.kind is PackageKind.BASE_MODEL:
        yield from _missing(package, {"model.config": "which names the model"}, Severity.ERROR)
        yield from _said(package, package.model_path, "model.sdf", "the model", Severity.ERROR)
    if submission:
        yield from _missing(package, REQUIRED, Severity.ERROR)
        yield from _missing(package, EXPECTED, Severity.WARNING)
        yield from _topics(package)


def _missing(
    package: Package, paths: dict[str, str], severity: Severity
) -> Iterator[Finding | Unchecked]:
    for path, purpose in paths.items():
        yield from _said(package, package.part(path), path, purpose, severity)


def _said(
    package: Package, part: Found | Missing, path: str, purpose: str, severity: Severity
) -> Iterator[Finding | Unchecked]:
    if isinstance(part, Found):
        return
    if part.package_not_at_hand:
        yield unchecked(part.reason)
    else:
        yield finding(
            package.folder_place(), f"{path} is missing, {purpose}", severity=severity, key=path
        )


def _topics(package: Package) -> Iterator[Finding | Unchecked]:
    """A robot whose spawner starts bridges from other files needs no vehicle_topics.launch."""
    started = [each for each in package.references if each.kind is ReferenceKind.ROSLAUNCH]
    if not any(_may_bridge(package, each) for each in started):
        yield from _missing(package, {TOPICS: "which bridges topics to ROS"}, Severity.ERROR)


def _may_bridge(package: Package, started: Reference) -> bool:
    """Say whether a launch file that is started is there and may bridge; unknown counts."""
    if started.file == "description.launch":
        return False
    own = started.package_name == package.name
    holder = package if own else package.workspace.package(started.package_name)
    if holder is None:
        return True
    return any(posixpath.basename(each.path) == started.file for each in holder.index.files)


GOOD = [{"specifications.md": "# Rover\n"}]
BAD = [
    {"specifications.md": None, "@reported": [".:1"]},
    {"launch/spawner.rb": None, "@reported": [".:1"]},
    {"thumbnails/1.png": None, "@reported": [".:1"]},
]
