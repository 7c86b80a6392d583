"""Print how the checker answered at its last first contacts.

Run with `python -m bench.fresh` from the top folder. `ledger.tsv` has a row for each contact; see
README.md.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from checker.base.record import Record

LEDGER = Path(__file__).parent / "ledger.tsv"
LAST = 20
"""Contacts that the figures are about."""
VERDICTS = ("true", "severity", "false", "unclear")


class Contact(Record):
    """A row of the ledger."""

    kind: str
    """`repository` or `report`."""
    name: str
    counts: dict[str, int]
    """The columns that are whole numbers."""
    right: bool
    """Whether the verdict of the report was right."""
    seconds: float

    def total(self, *columns: str) -> int:
        """Return the sum of these columns."""
        return sum(self.counts[column] for column in columns)


def contacts(ledger: Path = LEDGER) -> list[Contact]:
    """Return the rows of the ledger, oldest first."""
    with ledger.open(encoding="utf-8", newline="") as rows:
        return [contact(row) for row in csv.DictReader(rows, delimiter="\t")]


def contact(row: dict[str, str]) -> Contact:
    """Return a row as a record; raise ValueError if it is not complete."""
    if row["kind"] not in {"repository", "report"} or row["verdict"] not in {"right", "wrong"}:
        raise ValueError(f"{row['name']}: unknown kind {row['kind']} or verdict {row['verdict']}")
    columns: tuple[str, ...] = ("robots", "judged", "found", "faults")
    columns += tuple(f"{what}_{verdict}" for what in ("errors", "warnings") for verdict in VERDICTS)
    counts = {column: int(row[column]) for column in columns}
    right = row["verdict"] == "right"
    return Contact(row["kind"], row["name"], counts, right, float(row["seconds"]))


def share(part: int, whole: int) -> str:
    """Return a share as a percentage with its numbers."""
    return f"{part / whole:.0%} ({part} of {whole})" if whole else "-"


def figures(rows: Sequence[Contact]) -> Iterator[tuple[str, str]]:
    """Yield each figure of these contacts with its name."""
    repositories = [row for row in rows if row.kind == "repository"]

    def total(*columns: str) -> int:
        return sum(row.total(*columns) for row in repositories)

    def all_of(what: str) -> tuple[str, ...]:
        return tuple(f"{what}_{verdict}" for verdict in VERDICTS)

    yield "contacts", f"{len(repositories)} repositories, {len(rows) - len(repositories)} reports"
    for what in ("errors", "warnings"):
        yield f"{what} that are true", share(total(f"{what}_true"), total(*all_of(what)))
    false = total("errors_false", "warnings_false")
    yield "findings that are false", share(false, total(*all_of("errors"), *all_of("warnings")))
    yield "verdict right", share(sum(row.right for row in repositories), len(repositories))
    found = sum(row.total("found") for row in rows)
    yield "mended faults found", share(found, sum(row.total("faults") for row in rows))
    yield "robots judged", share(total("judged"), total("robots"))
    if repositories:
        middle = sorted(row.seconds for row in repositories)[len(repositories) // 2]
        yield "seconds, median", f"{middle:.0f}"


def main() -> int:
    """Print the figures of the last contacts."""
    for name, value in figures(contacts()[-LAST:]):
        print(f"{name:<24} {value}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
