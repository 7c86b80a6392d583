"""A file or folder that a submission needs is missing.

Without model, spawner or package.xml the robot cannot start. A review requires specifications.md.
Reviewers open the other files first. Parts that the package inherits from a sibling count as
present. If a sibling of the same robot has a specifications.md that names this configuration, its
absence here is a warning; and so is a name such as `specification.md`, which is also read. Missing
thumbnails are infos.

Fix: add the file; the guide's example package shows the content of each.
Source: Model Migration Guide, final directory structure; Robot Model Checklist.
"""

import posixpath
import re
from collections.abc import Iterator
from functools import partial

from checker.package.configuration import configuration_number
from checker.package.inheritance import SHEET, Found, Missing, own_sheet
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.references import Reference, ReferenceKind
from checker.package.submissions import is_same_robot
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.source.text import SourceText

MANIFESTS = {
    "package.xml": "which ROS needs to find the package",
    "CMakeLists.txt": "which builds and installs the package",
}
REQUIRED = {"launch/spawner.rb": "which spawns the robot in a world"}
EXPECTED = {
    "launch/example.ign": "which shows how to start the robot",
    "worlds/example.sdf": "which shows the robot in a world",
    "urdf": "which describes the robot for RViz",
}
PICTURES = {"thumbnails": "which holds pictures of the robot"}
TOPICS = "launch/vehicle_topics.launch"
DESCRIPTION = {"launch/description.launch": "which loads the robot description"}
_LOADS = re.compile(r"\brobot_description\b|\bdescription\w{0,40}\.launch\b")


_CONFIGURATION = re.compile(r"(?<![a-z])config(?:uration)?[\s_#]{1,8}(\d{1,4})\b", re.IGNORECASE)


@rule("PKG003", "missing-file", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report what is missing, including inherited parts in the search."""
    if package.only:
        return
    yield from _missing(package, MANIFESTS, Severity.ERROR)
    submission = package.kind in (PackageKind.ROBOT, PackageKind.CONFIGURATION)
    if submission or package.kind is PackageKind.BASE_MODEL:
        yield from _missing(package, {"model.config": "which names the model"}, Severity.ERROR)
        yield from _missing_part(
            package, package.model_path, "model.sdf", ", which holds the model", Severity.ERROR
        )
    if submission:
        yield from _missing(package, REQUIRED, Severity.ERROR)
        yield from _sheet(package)
        yield from _missing(package, EXPECTED, Severity.WARNING)
        yield from _missing(package, PICTURES, Severity.INFO)
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


def _sheet(package: Package) -> Iterator[Finding | Unchecked]:
    """Report a missing sheet; one that a sibling holds for this configuration is there to read."""
    spelt = own_sheet(package)
    if spelt not in (None, SHEET):
        yield finding(
            package.folder_place(),
            f"{SHEET} is missing: {spelt} is read instead; rename it",
            severity=Severity.WARNING,
            key=SHEET,
            related=[(package.place(spelt), "specifications.md by another name")],
        )
        return
    holder = next(filter(partial(_describes, package), package.workspace.packages.values()), None)
    where = f" here: that of {holder.name} describes this configuration" if holder else ""
    severity = Severity.WARNING if holder else Severity.ERROR
    purpose = where or ", which each review requires"
    yield from _missing_part(package, package.part(SHEET), SHEET, purpose, severity)


def _describes(package: Package, sibling: Package) -> bool:
    """Return whether the sheet of another configuration of the same robot names this one."""
    number = configuration_number(package)
    if sibling is package or number is None or not is_same_robot(sibling.name, package.name):
        return False
    sheet = sibling.read(own_sheet(sibling) or SHEET)
    named = _CONFIGURATION.findall(sheet.text) if isinstance(sheet, SourceText) else []
    return number in map(int, named)


def _missing(
    package: Package, paths: dict[str, str], severity: Severity
) -> Iterator[Finding | Unchecked]:
    for path, purpose in paths.items():
        yield from _missing_part(package, package.part(path), path, f", {purpose}", severity)


def _missing_part(
    package: Package, part: Found | Missing, path: str, purpose: str, severity: Severity
) -> Iterator[Finding | Unchecked]:
    if isinstance(part, Found):
        return
    if part.package_not_at_hand:
        yield unchecked(part.reason)
    else:
        yield finding(
            package.folder_place(), f"{path} is missing{purpose}", severity=severity, key=path
        )


def _topics(package: Package) -> Iterator[Finding | Unchecked]:
    """Return no vehicle_topics.launch if the spawner starts bridges from other files."""
    started = [
        reference for reference in package.references if reference.kind is ReferenceKind.ROSLAUNCH
    ]
    if not any(_may_bridge(package, node) for node in started):
        yield from _missing(package, {TOPICS: "which bridges topics to ROS"}, Severity.ERROR)


def _may_bridge(package: Package, started: Reference) -> bool:
    """Return whether a started launch file may start bridges; an unknown one counts."""
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
    {
        "specifications.md": None,
        "../acme_rover_sensor_config_2/package.xml": "<package/>",
        "../acme_rover_sensor_config_2/specifications.md": "# Rover\nConfiguration 1 is small.\n",
        "@reported": [".:1"],
    },
    {"specifications.md": None, "Specification.md": "# Rover\n", "@reported": [".:1"]},
    {"launch/spawner.rb": None, "@reported": [".:1"]},
    {"thumbnails/1.png": None, "@reported": [".:1"]},
]
