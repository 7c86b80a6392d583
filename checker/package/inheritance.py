"""Parts that a package takes from a sibling: the model, launch files, Ruby code, specification.

A second configuration of a robot often has a spawner only: the launcher passes it the model of
the sibling that its roslaunch commands name, and everything else comes from there too.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from enum import StrEnum
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.finding import Place
from checker.package.model_file import own_model
from checker.package.references import Reference, ReferenceKind, descriptions_named
from checker.source.xml import XmlDocument

if TYPE_CHECKING:
    from checker.package.package import Package

SPAWNER = "launch/spawner.rb"
SUBMISSION_NAME = re.compile(r"_sensor_config_\d+\Z")
NEVER_INHERITED = frozenset({"package.xml", "CMakeLists.txt", SPAWNER})
SHEET = "specifications.md"
_SHEET_SPELT = re.compile(r"(?:(?:model|robot)[_ -])?spec(?:s|ifications?)?\.(?:md|markdown)", re.I)
_DESCRIPTION = "description.launch"
ROBOT_LAUNCH_FILES = frozenset({_DESCRIPTION, "vehicle_topics.launch"})
URDF_FOLDER = "urdf"


class Part(StrEnum):
    """A part that may be inherited from a sibling, by its name in reports."""

    MODEL = "model"
    SPAWNER = "spawner"
    TOPICS = "launch/vehicle_topics.launch"
    DESCRIPTION = "launch/description.launch"
    SPECIFICATION = SHEET


class Found(Record):
    """Location of a part.

    Attributes:
        package: The package that contains it.
        path: The path relative to the package that uses it: `model.sdf`, or
            `../<sibling>/model.sdf`.
    """

    package: Package
    path: str

    @property
    def is_inherited(self) -> bool:
        """True if it is in a sibling."""
        return self.path.startswith("../")


class Missing(Record):
    """A part that is not there.

    Attributes:
        part: Its path, or `model`.
        reason: A clause that states why.
        package_not_at_hand: The sibling it comes from, when that is not available: then nothing is
            known about the part. None if the package itself lacks it.
    """

    part: str
    reason: str
    package_not_at_hand: str | None = None


class Inherited(Record):
    """A part that comes from a sibling.

    Attributes:
        part: The part.
        package_name: The sibling that contains it, at the end of a chain of siblings.
        how: The text that states it, in the package that inherits.
        at_hand: Whether the sibling could be read.
    """

    part: Part
    package_name: str
    how: Place
    at_hand: bool


def base_of(package: Package) -> Reference | None:
    """Return the mention of the sibling whose model a package without its own is given.

    The first roslaunch command that names another robot states it, else a sibling's Ruby file
    that is loaded, else a dependency on another submission.
    """
    if own_model(package) is not None or not package.exists(SPAWNER):
        return None
    kinds = (ReferenceKind.ROSLAUNCH, ReferenceKind.REQUIRE, ReferenceKind.DEPENDENCY)
    others = [other for other in package.references if other.package_name != package.name]
    # What the package says itself counts before what the Ruby files of siblings say.
    for other in sorted(others, key=lambda other: (other.by_sibling, kinds.index(other.kind))):
        if _may_lend_model(package, other):
            return other
    return None


def _may_lend_model(package: Package, other: Reference) -> bool:
    if SUBMISSION_NAME.search(other.package_name):
        return True
    if other.kind is ReferenceKind.DEPENDENCY:
        return False
    if other.file in ROBOT_LAUNCH_FILES and other.package_name != "subt_ros":
        return True
    sibling = package.workspace.package(other.package_name)
    return sibling is not None and own_model(sibling) is not None


def inherited_from(package: Package, part: str) -> Reference | None:
    """Return the mention of the sibling that a part comes from when the package lacks it."""
    if part in NEVER_INHERITED:
        return None
    if part == URDF_FOLDER:
        return next(_describing(package), None) or package.base
    folder, _, file = part.rpartition("/")
    if folder == "launch":
        for other in package.references:
            loaded = other.kind is ReferenceKind.REQUIRE and file.endswith(".rb")
            started = other.kind is ReferenceKind.ROSLAUNCH and other.file == file
            if (loaded or started) and other.package_name != package.name:
                return other
    return package.base


def _describing(package: Package) -> Iterator[Reference]:
    """Yield the mentions of siblings whose URDF file the package's launch files load."""
    own = [(file.path, package.xml(file.path)) for file in package.index.with_suffix(".launch")]
    for path, document in own:
        if path.startswith("launch/") and isinstance(document, XmlDocument):
            yield from descriptions_named(document)
    for other in package.references:
        if other.kind is ReferenceKind.ROSLAUNCH and other.file == _DESCRIPTION:
            yield other


Holding = Callable[["Package"], str | None]
"""Returns the path of a part in the package itself."""


def find_part(package: Package, part: str, holding: Holding) -> Found | Missing:
    """Look for a part in a package, then in the siblings that it inherits from, one by one."""
    holder = package
    seen = [package.name]
    while (path := holding(holder)) is None:
        reference = inherited_from(holder, part)
        if reference is None or reference.package_name == holder.name:
            return Missing(
                part, f"{' and '.join(seen)} {'has' if len(seen) == 1 else 'have'} no {part}"
            )
        name = reference.package_name
        sibling = holder.workspace.package(name)
        if sibling is None:
            return Missing(part, f"{part} is inherited from {name}, which is not available", name)
        if sibling.name in seen:
            chain = " → ".join([*seen, sibling.name])
            return Missing(part, f"{part} is inherited in a circle: {chain}")
        holder = sibling
        seen.append(sibling.name)
    return Found(holder, path if holder is package else f"../{holder.name}/{path}")


def own_sheet(package: Package) -> str | None:
    """Return the specification sheet at the top of a package, also under a name of other spelling.

    `specification.md` or `Specs.md` should be `specifications.md`; only the right name
    counts when both are there.
    """
    if package.exists(SHEET):
        return SHEET
    names = (file.path for file in package.index.files)
    return min((name for name in names if _SHEET_SPELT.fullmatch(name)), default=None)


def inherited_parts(package: Package) -> Iterator[Inherited]:
    """Yield what a package takes from siblings, available or not."""
    for part in Part:
        if part is Part.SPAWNER:
            yield from _loaded_ruby(package)
            continue
        file = package.model_path if part is Part.MODEL else package.part(part)
        reference = inherited_from(package, part)
        if reference is None:
            continue
        if isinstance(file, Found) and file.is_inherited:
            yield Inherited(part, file.package.name, reference.place, at_hand=True)
        elif isinstance(file, Missing) and file.package_not_at_hand:
            yield Inherited(part, file.package_not_at_hand, reference.place, at_hand=False)


def _loaded_ruby(package: Package) -> Iterator[Inherited]:
    for name, other in {
        other.package_name: other
        for other in reversed(package.references)
        if other.kind is ReferenceKind.REQUIRE and other.package_name != package.name
    }.items():
        at_hand = package.workspace.package(name) is not None
        yield Inherited(Part.SPAWNER, name, other.place, at_hand)
