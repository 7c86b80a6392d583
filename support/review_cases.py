"""Faults that maintainers had corrected, and what our rules state about them before and after.

SUBT_CHECK_REVIEWS names their folder: `<id>/before/<package>`, `<id>/after/<package>` and
`cases.json`, which names the file and the rules of which any may report the fault.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache

from checker.pipeline import check_package
from checker.rulebook.discovery import all_rules
from checker.settings import Settings
from support.real_packages import REVIEWS, judged_folders, named_folder

FOLDER = named_folder(REVIEWS)

OUT_OF_REACH = {
    "R104": "nothing in the package names the device before the correction",
    "R254": "the camera looks into a mesh, and the packages are kept without meshes",
    "R269": "the sheet says 'HD Camera', which is no device that a datasheet tells of",
}
"""Faults that the available files do not show, and why."""

Said = tuple[str, str, str]
"""Rule, message and element of a finding."""


@cache
def known_rules() -> frozenset[str]:
    """Return the ids of all rules."""
    return frozenset(rule.id for rule in all_rules())


@dataclass(frozen=True)
class ReviewCase:
    """One corrected fault.

    Attributes:
        id: The id of the review finding.
        package: Folder of the package.
        file: The file of the fault.
        rules: Ids of which any may report it, those that do not exist yet among them.
        what: The fault in a few words.
    """

    id: str
    package: str
    file: str
    rules: tuple[str, ...]
    what: str

    @property
    def existing(self) -> tuple[str, ...]:
        """The rules that there are."""
        return tuple(rule for rule in self.rules if rule in known_rules())

    def said(self, side: str) -> set[Said]:
        """Return what the rules report in the file, `before` or `after` the correction."""
        if not self.existing:
            return set()
        settings = Settings(select=self.existing)
        (package,) = check_package(FOLDER / self.id / side / self.package, settings).packages
        return {
            (finding.rule, finding.message, place.element)
            for finding in package.findings
            for place in finding.places
            if place.file == self.file
        }

    def corrected(self) -> set[Said]:
        """Return what is reported before the correction, and no longer after it."""
        return self.said("before") - self.said("after")


def review_cases() -> list[ReviewCase]:
    """Return all cases; none if there is no folder of them."""
    if FOLDER is None:
        return []
    judged = {folder.name for folder in judged_folders(REVIEWS)}
    entries = json.loads((FOLDER / "cases.json").read_text("utf-8"))
    return [
        ReviewCase(each["id"], each["package"], each["file"], tuple(each["rules"]), each["what"])
        for each in entries
        if each["id"] in judged
    ]
