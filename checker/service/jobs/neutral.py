"""Reports that do not show where on this machine an upload lay while it was checked."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from checker.report.report import Report
from checker.service.jobs.layout import GIVEN, TEMPORARY


def without_folder(report: Report, place: Path) -> Report:
    """Return a report in which paths begin below the folder of work in progress.

    Messages hold paths here and there: of settings that cannot be used, of rules that crashed.

    Args:
        report: As it came out of the check.
        place: The folder, laid out by `checker.service.jobs.layout`.
    """
    folders = "|".join(re.escape(str(each)) for each in {place, place.resolve()})
    unpacked = rf"{TEMPORARY}/[^/\s]+|{re.escape(GIVEN)}"
    pattern = re.compile(rf"(?:{folders})(?:/(?:{unpacked}))?/?")
    said: Report = _changed(report, lambda text: pattern.sub("", text))
    return said


def _changed(value: Any, change: Callable[[str], str]) -> Any:
    """Return a value with all the texts in it changed."""
    match value:
        case str() if type(value) is str:
            return change(value)
        case tuple():
            return tuple(_changed(each, change) for each in value)
        case list():
            return [_changed(each, change) for each in value]
        case Mapping():
            return {_changed(key, change): _changed(each, change) for key, each in value.items()}
        case _ if is_dataclass(value) and not isinstance(value, type):
            changes = {
                field.name: _changed(getattr(value, field.name), change)
                for field in fields(value)
                if field.init
            }
            return replace(value, **changes)
    return value
