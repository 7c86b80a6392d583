"""Guesses what the packages of a folder are made for."""

from __future__ import annotations

import re
from collections import Counter
from itertools import islice
from pathlib import Path

from checker.errors import UnreadableInput
from checker.package.kind import PackageKind
from checker.package.model_file import own_model
from checker.package.opening import open_input
from checker.package.package import Package
from checker.record import record
from checker.source.text import SourceText

_LOOKED_AT = 100
"""Packages; more of them tell nothing new."""
_SUBMISSIONS = (PackageKind.ROBOT, PackageKind.CONFIGURATION)
_HARMONIC = re.compile(r"\b(?:lib)?gz-sim-|\bgz::sim::")
"""Plugins by the names that they have since Gazebo Garden."""


@record()
class Guess:
    """A profile, and what speaks for it.

    Attributes:
        profile: Empty where nothing, or more than one thing, is to be guessed.
        reason: A part of a sentence; holds no text of a user.
    """

    profile: str
    reason: str


def guessed_profile(folder: Path) -> Guess:
    """Return the profile that suits all packages of a folder."""
    try:
        with open_input(folder) as opened:
            found = Counter(filter(None, map(_profile_of, islice(opened.packages, _LOOKED_AT))))
    except UnreadableInput:
        found = Counter()
    counted = ", ".join(
        f"{number} {'package' if number == 1 else 'packages'} for {profile}"
        for profile, number in sorted(found.items())
    )
    if len(found) == 1:
        return Guess(next(iter(found)), counted)
    if found:
        return Guess("", f"{counted}; each is checked with the profile subt, or urdf if it is URDF")
    return Guess("", "nothing: there is no robot yet")


def _profile_of(package: Package) -> str:
    """Return the profile that suits a package; empty for one that holds no robot."""
    if package.is_urdf:
        return "urdf"
    if package.kind in _SUBMISSIONS:
        return "subt"
    model = own_model(package)
    text = package.read(model) if model else None
    if not isinstance(text, SourceText):
        return ""
    return "gazebo-harmonic" if _HARMONIC.search(text.text) else "sdf"
