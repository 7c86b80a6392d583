"""Places of findings as SARIF's locations, and fixes as its replacements."""

from __future__ import annotations

import posixpath
from typing import Any
from urllib.parse import quote

from checker.base.words import plain
from checker.finding import Edit, Fix, Place
from checker.report.finding_text import path_of
from checker.report.report import PackageReport

BASE = "%SRCROOT%"
"""Base of paths; code hosts replace it with the root of the repository."""

EDITS_LIMIT = 500
"""Edits of one fix; those with more are for the command `--fix`."""

Json = dict[str, Any]


def artifact(path: str, folder: str) -> Json:
    """Return where a file is: relative to a folder if it is in it, else with its whole path.

    Args:
        path: The path from the folder in which the command was run.
        folder: The folder, absolute; represents `BASE`.
    """
    whole = posixpath.normpath(posixpath.join(folder, path))
    above = folder.rstrip("/") + "/"
    if whole == folder:
        return {"uri": "./", "uriBaseId": BASE}
    if whole.startswith(above):
        return {"uri": _quoted(whole[len(above) :]), "uriBaseId": BASE}
    return {"uri": "file://" + _quoted(whole)}


def _quoted(path: str) -> str:
    """Percent-encode a path; bytes of names that are no text become what they were."""
    try:
        return quote(path.encode("utf-8", "surrogateescape"))
    except UnicodeEncodeError:
        return quote(path.encode("utf-8", "replace"))


def location(place: Place, package: PackageReport, folder: str) -> Json:
    """Return a place as a location.

    Code hosts insist on a line, so a folder has line 1 too.
    """
    where = artifact(path_of(place, package), folder)
    if not place.file and not where["uri"].endswith("/"):
        where["uri"] += "/"
    physical: Json = {"artifactLocation": where, "region": region(place)}
    if context := _context(place):
        physical["contextRegion"] = context
    result: Json = {"physicalLocation": physical}
    if place.element:
        name = plain(place.element)
        result["logicalLocations"] = [{"fullyQualifiedName": name, "kind": "element"}]
    return result


def region(place: Place) -> Json:
    """Return the stretch of a place, with its text where the report has it.

    A place of no width, as that of something missing, represents its line.
    """
    if (place.line, place.column) >= (place.end_line, place.end_column):
        return {"startLine": place.line}
    stretch = _stretch(place)
    if _is_whole(place):
        stretch["snippet"] = {"text": plain(place.snippet[place.column - 1 : place.end_column - 1])}
    return stretch


def _context(place: Place) -> Json:
    """Return the line around a stretch; it must be more than the stretch itself."""
    whole = place.column == 1 and place.end_column > len(place.snippet)
    if whole or not _is_whole(place):
        return {}
    return {
        "startLine": place.line,
        "startColumn": 1,
        "endLine": place.line,
        "endColumn": len(place.snippet) + 1,
        "snippet": {"text": plain(place.snippet)},
    }


def _is_whole(place: Place) -> bool:
    """Return whether the snippet, which may be cut, contains the whole stretch."""
    inside = place.column < place.end_column <= len(place.snippet) + 1
    return place.line == place.end_line and inside


def _stretch(place: Place) -> Json:
    return {
        "startLine": place.line,
        "startColumn": place.column,
        "endLine": place.end_line,
        "endColumn": place.end_column,
    }


def fixes(fix: Fix | None, how: str, package: PackageReport, folder: str) -> list[Json]:
    """Return a fix as a list of one; of none if there is none, or none that SARIF can contain."""
    if fix is None or len(fix.edits) > EDITS_LIMIT or not all(map(_is_text, fix.edits)):
        return []
    by_file: dict[str, list[Json]] = {}
    for edit in fix.edits:
        change = {
            "deletedRegion": _stretch(edit.place),
            "insertedContent": {"text": edit.replacement},
        }
        by_file.setdefault(path_of(edit.place, package), []).append(change)
    changes = [
        {"artifactLocation": artifact(path, folder), "replacements": replacements}
        for path, replacements in by_file.items()
    ]
    safety = {"safety": str(fix.safety)}
    description = {"description": {"text": plain(how)}} if how else {}
    return [{**description, "artifactChanges": changes, "properties": safety}]


def _is_text(edit: Edit) -> bool:
    return not any("\ud800" <= character <= "\udfff" for character in edit.replacement)
