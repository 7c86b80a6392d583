"""What the checker makes of an SDF file: whether it refuses it, and the robots in it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from checker.base.cache import NO_CACHE
from checker.engine.review import findings_of
from checker.finding import Severity
from checker.formats.sdf.includes import ModelIncludes
from checker.formats.sdf.reader import read_sdf
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.settings import Settings
from checker.source.xml import XmlDocument

REFUSING = (
    *("SDF001", "SDF002", "SDF005", "SDF006", "SDF009", "SDF012", "SDF017", "SDF018"),
    *("KIN001", "KIN002", "KIN004", "KIN008", "KIN010", "KIN011", "INE002", "SEN001", "SEN027"),
)
"""Rules whose errors say that a parser does not load the file."""
_SETTINGS = Settings(profile="sdf", profile_chosen=True, select=REFUSING, trial=False, cache=False)


@dataclass(frozen=True)
class Checked:
    """A file as the checker reads it.

    Attributes:
        errors: Why it says that the file is refused; each begins with the rule.
        robots: The models at the top of the file and in its worlds, by name.
        merges: Whether a model gives its parts to another one.
        more: Whether worlds include models, which are no robots of the file.
    """

    errors: tuple[str, ...]
    robots: dict[str, Robot]
    merges: bool
    more: bool


def checked(file: Path) -> Checked:
    """Check an SDF file, and read it."""
    with open_input(file) as opened:
        (package,) = opened.packages
        findings = findings_of(package, _SETTINGS, NO_CACHE)
        errors = [each for each in findings if each.severity is Severity.ERROR]
        document = package.xml(file.name)
        is_sdf = isinstance(document, XmlDocument) and document.root.tag == "sdf"
        robots = read_sdf(document, ModelIncludes(package)) if is_sdf else ()
        return Checked(
            tuple(f"{error.rule} {error.message}" for error in errors),
            {robot.name.value: robot for robot in robots},
            any("_merged__" in model.scoped_name for each in robots for model in each.models),
            is_sdf and any(world.child("include") for world in document.root.all("world")),
        )
