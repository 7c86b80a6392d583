"""The baseline: findings that were there when it was written, in a file, with their places."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from msgspec import field, to_builtins

from checker.base.files import NotReadable, read_bytes
from checker.base.record import Record
from checker.base.words import shortened
from checker.finding import Severity, fingerprint
from checker.rulebook.suppression.entries import REASON_LIMIT

DEFAULT_FILE = "subt-check-baseline.json"
VERSION = 2
SIZE_LIMIT = 5_000_000
ENTRIES_LIMIT = 20_000


class BaselineEntry(Record):
    """One finding as it was.

    Attributes:
        rule: Id of the rule.
        places: The number of faults at each place, by names that `spots.py` gives them.
        key: What its places have in common, where the rule states it.
        reason: The reason why it need not be mended, if the user wrote so into the file.
    """

    rule: str
    severity: Severity
    message: str
    places: Mapping[str, int]
    key: str = ""
    reason: str = ""


class Baseline(Record):
    """The content of a baseline's file.

    Attributes:
        path: The path of the file; None without a baseline.
        fault: The reason why it cannot be used, as the end of a sentence that starts with the path.
        digest: The digest of all entries; the key of a cached check contains it.
        packages: Entries by the name of the package.
        missing: Whether nothing is in the way of a new file there.
    """

    path: Path | None = None
    fault: str = ""
    digest: str = ""
    packages: Mapping[str, tuple[BaselineEntry, ...]] = field(default_factory=dict)
    missing: bool = False


def read_baseline(path: Path) -> Baseline:
    """Return the content of a file, or why it cannot be used; nothing is raised."""
    try:
        data = read_bytes(path.resolve(strict=True), path.name, SIZE_LIMIT)
    except FileNotFoundError:
        if path.is_symlink():
            return Baseline(path, "is a broken link")
        advice = f"create it with --write-baseline --baseline {path}"
        return Baseline(path, f"does not exist; {advice}", missing=True)
    except (OSError, RuntimeError, ValueError) as error:
        # A path that is too long or a link that leads to itself.
        return Baseline(path, f"cannot be read: {getattr(error, 'strerror', None) or error}")
    if isinstance(data, NotReadable):
        return Baseline(path, data.reason)
    try:
        text = data.decode("utf-8")
        packages = _packages(json.loads(text))
    except (ValueError, RecursionError) as error:
        return Baseline(path, f"is not a baseline: {str(error)[:200]}")
    return Baseline(path, digest=fingerprint(text), packages=packages)


def _packages(content: object) -> dict[str, tuple[BaselineEntry, ...]]:
    """Return the entries by package.

    Raises:
        ValueError: The content has another form.
    """
    if not isinstance(content, dict) or "version" not in content:
        raise ValueError("it has no version")
    if content["version"] != VERSION:
        raise ValueError(f"it has version {content['version']!r}, expected {VERSION}")
    packages = content.get("packages")
    if not isinstance(packages, dict) or not all(isinstance(v, list) for v in packages.values()):
        raise ValueError("packages is not a table of lists")
    if (number := sum(map(len, packages.values()))) > ENTRIES_LIMIT:
        raise ValueError(f"it has {number} entries, more than the limit of {ENTRIES_LIMIT}")
    return {name: tuple(map(_entry, entries)) for name, entries in packages.items()}


def _entry(data: Any) -> BaselineEntry:
    if not isinstance(data, dict):
        raise ValueError(f"an entry is not a table: {data!r}")
    texts = {name: data.get(name, "") for name in ("rule", "message", "key", "reason")}
    if not all(isinstance(text, str) for text in texts.values()):
        raise ValueError(f"an entry contains a value that is not a string: {data!r}")
    for name in ("rule", "message"):
        if not texts[name]:
            raise ValueError(f"an entry has no {name}: {data!r}")
    if data.get("severity") not in list(Severity):
        raise ValueError(f"an entry has severity {data.get('severity')!r}: {data!r}")
    texts["reason"] = shortened(texts["reason"], REASON_LIMIT)
    return BaselineEntry(**texts, severity=Severity(data["severity"]), places=_places(data))


def _places(data: Mapping[str, Any]) -> dict[str, int]:
    places = data.get("places")
    if not isinstance(places, dict) or not all(type(n) is int and n > 0 for n in places.values()):
        raise ValueError(f"an entry has no places with their counts: {data!r}")
    return places


def baseline_text(packages: Mapping[str, Iterable[BaselineEntry]]) -> str:
    """Return the text of a file in plain ASCII, one member a line so that changes read well.

    Raises:
        ValueError: It would not be read again; the text is the end of a sentence.
    """
    entries = {
        name: [
            {key: member for key, member in to_builtins(entry).items() if member}
            for entry in packages[name]
        ]
        for name in sorted(packages)
    }
    if (number := sum(map(len, entries.values()))) > ENTRIES_LIMIT:
        raise ValueError(f"would have {number} entries, more than the limit of {ENTRIES_LIMIT}")
    text = json.dumps({"version": VERSION, "packages": entries}, indent=2) + "\n"
    if len(text) > SIZE_LIMIT:
        size = f"{len(text) / 1e6:.1f} MB, more than the limit of {SIZE_LIMIT / 1e6:g} MB"
        raise ValueError(f"would have {size}")
    return text
