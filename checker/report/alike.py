"""Models of one folder with the same findings: copies, which the text report shows once."""

from __future__ import annotations

import posixpath
from collections.abc import MutableMapping

from checker.finding import Place
from checker.report.report import PackageReport

Likeness = tuple[object, ...]
"""What copies have in common: equal for two models whose reports differ in names alone."""


def first_alike(package: PackageReport, seen: MutableMapping[Likeness, str]) -> str:
    """Return the name of a model before with the same findings at the same lines; else empty.

    Args:
        package: The report of the package.
        seen: The name of the first model of each kind; is added to.
    """
    if package.kind != "base_model" or not package.findings:
        return ""
    found = sorted((it.rule, it.severity, *_spots(it.places)) for it in package.findings)
    likeness = (posixpath.dirname(package.path), package.profile, package.verdict, *found)
    first = seen.setdefault(likeness, package.name)
    return "" if first == package.name else first


def _spots(places: tuple[Place, ...]) -> tuple[tuple[str, int], ...]:
    return tuple((it.file, it.line) for it in places)
