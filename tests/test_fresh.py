"""The ledger of first contacts, and the figures that are published from it."""

from pathlib import Path

import pytest

from bench.fresh.__main__ import contacts, figures

HEAD = (
    "kind name commit date version robots judged errors_true errors_severity errors_false "
    "errors_unclear warnings_true warnings_severity warnings_false warnings_unclear found faults "
    "verdict seconds"
)


def ledger(folder: Path, *rows: str) -> Path:
    path = folder / "ledger.tsv"
    path.write_text("\n".join("\t".join(row.split()) for row in (HEAD, *rows)) + "\n")
    return path


def test_every_row_of_the_ledger_is_complete() -> None:
    assert contacts()
    for row in contacts():
        assert row.counts["judged"] <= row.counts["robots"], row.name
        assert row.counts["found"] <= row.counts["faults"], row.name


def test_each_contact_is_the_first() -> None:
    names = [row.name.lower() for row in contacts()]
    assert sorted({*names}) == sorted(names)


def test_reports_count_as_faults_only(tmp_path: Path) -> None:
    rows = contacts(
        ledger(
            tmp_path,
            "repository a/b c 2026-11-28 v 2 1 3 0 1 0 4 0 0 0 1 2 right 10",
            "report a/b#1 - 2026-11-28 v 1 1 9 9 9 9 9 9 9 9 1 1 wrong 5",
        )
    )
    assert dict(figures(rows)) == {
        "contacts": "1 repositories, 1 reports",
        "errors that are true": "75% (3 of 4)",
        "warnings that are true": "100% (4 of 4)",
        "findings that are false": "12% (1 of 8)",
        "verdict right": "100% (1 of 1)",
        "mended faults found": "67% (2 of 3)",
        "robots judged": "50% (1 of 2)",
        "seconds, median": "10",
    }


def test_a_row_of_another_kind_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="unknown kind"):
        contacts(ledger(tmp_path, "hearsay a/b c d v 1 1 0 0 0 0 0 0 0 0 0 0 right 1"))
