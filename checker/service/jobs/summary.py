"""What the state of a check says of its packages: made by the child, read by the worker."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from checker.base.words import listed, plain, shortened
from checker.finding import Severity
from checker.report.files import package_folders
from checker.report.report import Report, VerdictKind
from checker.report.verdict import sentence
from checker.service.jobs.outcome import Checked

_PACKAGES_LIMIT = 5_000
_TEXT_LIMIT = 1_000
_TEXTS, _NUMBERS = ("name", "folder"), ("errors", "warnings", "infos")


def summary(report: Report) -> dict[str, Any]:
    """Return what a report says in short.

    "packages", as in `State.packages`; "words": what came out, one sentence; "crashed": whether a
    rule could not run because of the checker itself.
    """
    packages = [
        {
            "name": shortened(plain(package.name), _TEXT_LIMIT),
            "verdict": package.verdict.value,
            "errors": package.count(Severity.ERROR),
            "warnings": package.count(Severity.WARNING),
            "infos": package.count(Severity.INFO),
            "folder": folder,
        }
        for package, folder in zip(report.packages, package_folders(report), strict=True)
    ]
    words = shortened(_words(report), _TEXT_LIMIT)
    crashed = any(package.crashed for package in report.packages)
    return {"packages": packages, "words": words, "crashed": crashed}


def _words(report: Report) -> str:
    if len(report.packages) == 1:
        return str(sentence(report.packages[0]))
    kinds = Counter(package.verdict for package in report.packages)
    said = [f"{kinds[kind]} {kind.replace('_', ' ')}" for kind in VerdictKind if kinds[kind]]
    return f"{len(report.packages)} packages: {listed(said)}"


def read_summary(key: str, said: Any) -> Checked | None:
    """Return what a summary says; None for what is none."""
    match said:
        case {"packages": list(packages), "words": str(words)} if len(
            packages
        ) <= _PACKAGES_LIMIT and all(map(_is_package, packages)):
            names = (*_TEXTS, "verdict", *_NUMBERS)
            kept = tuple({name: each[name] for name in names} for each in packages)
            return Checked(key, kept, shortened(plain(words), _TEXT_LIMIT))
    return None


def _is_package(said: Any) -> bool:
    return (
        isinstance(said, Mapping)
        and all(_is_text(said.get(name)) for name in _TEXTS)
        and said.get("verdict") in list(VerdictKind)
        and all(type(said.get(name)) is int and said[name] >= 0 for name in _NUMBERS)
    )


def _is_text(said: Any) -> bool:
    return isinstance(said, str) and len(said) <= _TEXT_LIMIT
