"""Paths of a report as the one sees them who sent the package."""

from __future__ import annotations

from pathlib import Path

from msgspec.structs import replace

from checker.package.inputs import SINGLE_FILE_SUFFIXES
from checker.report.report import Report


def seen_from_here(report: Report, given: Path) -> Report:
    """Return a report whose paths start at what was given, not at what the service calls it."""
    return replace(
        report,
        packages=tuple(
            replace(each, path=_package(each.path, each.name, given)) for each in report.packages
        ),
        not_opened=tuple(
            replace(each, path=str(given / _below(each.path))) for each in report.not_opened
        ),
    )


def _package(path: str, name: str, given: Path) -> str:
    if given.name.lower().endswith(SINGLE_FILE_SUFFIXES):
        return str(given.parent)
    is_itself = given.is_dir() and name == given.resolve().name
    return str(given if is_itself else given / _below(path))


def _below(path: str) -> str:
    """Return a path without its first part, the name of the upload."""
    return path.partition("/")[2]
