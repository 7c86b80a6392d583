"""The baseline: findings that were there when it was written, in a file of their fingerprints."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from checker.fingerprint import fingerprint
from checker.package.reading import NotReadable, read_bytes

DEFAULT_FILE = "subt-check-baseline.json"
VERSION = 1
SIZE_LIMIT = 50_000_000


@dataclass(frozen=True)
class BaselineEntry:
    """One finding as it was.

    Attributes:
        rule: Id of the rule.
        key: What its places have in common, where the rule says so.
        reason: Why it need not be mended, if the user wrote so into the file.
    """

    fingerprint: str
    rule: str
    message: str
    key: str = ""
    reason: str = ""


@dataclass(frozen=True)
class Baseline:
    """The content of a baseline's file.

    Attributes:
        path: Of the file; None without a baseline.
        fault: Why it cannot be used, as the end of a sentence that starts with the path.
        digest: Stands for all entries: what is remembered of a check depends on them.
        packages: Entries by the name of the package.
    """

    path: Path | None = None
    fault: str = ""
    digest: str = ""
    packages: Mapping[str, tuple[BaselineEntry, ...]] = field(default_factory=dict, repr=False)


def read_baseline(path: Path) -> Baseline:
    """Return the content of a file, or why it cannot be used; nothing is raised."""
    if not path.exists():
        return Baseline(path, f"does not exist; --write-baseline --baseline {path.name} makes it")
    data = read_bytes(path.resolve(), path.name, SIZE_LIMIT)
    if isinstance(data, NotReadable):
        return Baseline(path, data.reason)
    try:
        text = data.decode("utf-8")
        packages = _packages(json.loads(text))
    except (ValueError, RecursionError) as error:
        return Baseline(path, f"is no baseline: {str(error)[:200]}")
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
        raise ValueError("packages is no table of lists")
    return {name: tuple(map(_entry, entries)) for name, entries in packages.items()}


def _entry(said: Any) -> BaselineEntry:
    known = [each.name for each in fields(BaselineEntry)]
    if not isinstance(said, dict) or not all(isinstance(v, str) for v in said.values()):
        raise ValueError(f"an entry is no table of texts: {said!r}")
    missing = [name for name in known[:3] if name not in said]
    if missing:
        raise ValueError(f"an entry has no {missing[0]}: {said!r}")
    return BaselineEntry(**{name: said[name] for name in known if name in said})


def baseline_text(packages: Mapping[str, Iterable[BaselineEntry]]) -> str:
    """Return the text of a file in plain ASCII, one member a line so that changes read well."""
    entries = {
        name: [
            {key: said for key, said in asdict(entry).items() if said} for entry in packages[name]
        ]
        for name in sorted(packages)
    }
    return json.dumps({"version": VERSION, "packages": entries}, indent=2) + "\n"
