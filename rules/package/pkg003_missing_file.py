"""A file or folder that a submission needs is missing.

Without model, spawner or package.xml the robot cannot start. Without specifications.md no review
begins. The other files are what a reviewer opens first. Parts that the package inherits from a
sibling count as present.

Fix: add the file; the guide's example package shows the content of each.
Source: Model Migration Guide, final directory structure; Robot Model Checklist.
"""

import posixpath
import re
from collections.abc import Iterator

from checker.package.inheritance import Found, Missing
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.references import Reference, ReferenceKind
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.source.text import SourceText

MANIFESTS = {
    "package.xml": "which ROS needs to find the package",
    "CMakeLists.txt": "which builds and installs the package",
}
REQUIRED = {
    "launch/spawner.rb": "which spawns the robot in a world",
    "specifications.md": "without which no review begins",
}
EXPECTED = {
    "launch/example.ign": "which shows how to start the robot",
    "worlds/example.sdf": "which shows the robot in a world",
    "urdf": "which describes the robot for RViz",
    "thumbnails": "which holds pictures of the robot",
}
TOPICS = "launch/vehicle_topics.launch"
DESCRIPTION = {"launch/description.launch": "which loads the robot description"}
_LOADS = re.compile(r"\brobot_description\b|\bdescription\w{0,40}\.launch\b")


@rule("PKG003", "missing-file", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report what is missing, including inherited parts in the search."""
    if package.kind is PackageKind.SINGLE_FILE:
        return
    yield from _missing(package, MANIFESTS, Severity.ERROR)
    submission = package.kind in (PackageKind.ROBOT, PackageKind.CONFIGURATION)
    if submission or package.kind is PackageKind.BASE_MODEL:
        yield from _missing(package, {"model.config": "which names the model"}, Severity.ERROR)
        yield from _missing_part(
            package, package.model_path, "model.sdf", "which holds the model", Severity.ERROR
        )
    if submission:
        yield from _missing(package, REQUIRED, Severity.ERROR)
        yield from _missing(package, EXPECTED, Severity.WARNING)
        yield from _topics(package)
        if not any(_LOADS.search(text) for text in _started_elsewhere(package)):
            yield from _missing(package, DESCRIPTION, Severity.WARNING)


def _started_elsewhere(package: Package) -> Iterator[str]:
    """Yield the texts of the launch files of other names that the spawner starts."""
    for started in package.references:
        own = started.package_name == package.name
        holder = package if own else package.workspace.package(started.package_name)
        if started.kind is not ReferenceKind.ROSLAUNCH or holder is None:
            continue
        for file in holder.index.with_suffix(".launch"):
            source = holder.read(file.path)
            if posixpath.basename(file.path) == started.file and isinstance(source, SourceText):
                yield source.text


def _missing(
    package: Package, paths: dict[str, str], severity: Severity
) -> Iterator[Finding | Unchecked]:
    for path, purpose in paths.items():
        yield from _missing_part(package, package.part(path), path, purpose, severity)


def _missing_part(
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
    """Return no vehicle_topics.launch if the spawner starts bridges from other files."""
    started = [
        reference for reference in package.references if reference.kind is ReferenceKind.ROSLAUNCH
    ]
    if not any(_may_bridge(package, node) for node in started):
        yield from _missing(package, {TOPICS: "which bridges topics to ROS"}, Severity.ERROR)


def _may_bridge(package: Package, started: Reference) -> bool:
    """Whether a started launch file may start bridges; an unknown one counts."""
    if started.file == "description.launch":
        return False
    own = started.package_name == package.name
    holder = package if own else package.workspace.package(started.package_name)
    if holder is None:
        return True
    return any(posixpath.basename(file.path) == started.file for file in holder.index.files)


GOOD = [{"specifications.md": "# Rover\n"}]
BAD = [
    {"specifications.md": None, "@reported": [".:1"]},
    {"launch/spawner.rb": None, "@reported": [".:1"]},
    {"thumbnails/1.png": None, "@reported": [".:1"]},
]
