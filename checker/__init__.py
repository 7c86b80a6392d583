"""Check robot packages from Python: `check` reads, judges and drives them, and returns a `Report`.

These names are kept as long as the first number of the version; all other modules may change. Each
is loaded when it is first used, since the checker's readers take a moment to load.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from checker.base.errors import CheckerError
    from checker.finding import Edit, Fix, Place, Safety, Severity
    from checker.pipeline import check_package as check
    from checker.report.json_report import report_from_json, to_json
    from checker.report.report import (
        NotChecked,
        NotOpened,
        PackageReport,
        Report,
        ReportedFinding,
        VerdictKind,
    )
    from checker.settings import Settings

__all__ = [
    "CheckerError",
    "Edit",
    "Fix",
    "NotChecked",
    "NotOpened",
    "PackageReport",
    "Place",
    "Report",
    "ReportedFinding",
    "Safety",
    "Settings",
    "Severity",
    "VerdictKind",
    "check",
    "report_from_json",
    "to_json",
]

_MODULES = (
    ".base.errors",
    ".finding",
    ".pipeline",
    ".report.json_report",
    ".report.report",
    ".settings",
)


def __getattr__(name: str) -> Any:
    """Load a name of the API when it is first used."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    inside = "check_package" if name == "check" else name
    for module in _MODULES:
        value = vars(import_module(module, __name__)).get(inside)
        if value is not None:
            return value
    raise AttributeError(f"module {__name__!r} lacks {name!r}")


def __dir__() -> list[str]:
    """Name what the API has, though little of it is loaded yet."""
    return sorted(__all__)
