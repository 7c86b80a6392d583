"""docs/service.md and docs/security.md say what is so."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

from checker.package.archives.index import ArchiveLimits
from checker.service.jobs.check import LIMITS
from checker.service.jobs.port import Stage
from checker.service.web.config import Config
from checker.service.web.services import AT_ONCE, OF_ONE
from checker.service.web.uploads.archive_indexes import PROCESSOR_SECONDS, SECONDS
from tests.deployment.image import ROOT
from tests.each import of_each

SERVICE = (ROOT / "docs/service.md").read_text("utf-8")
SECURITY = (ROOT / "docs/security.md").read_text("utf-8")
EVALUATED = SECURITY.partition("## Evaluation of untrusted text")[2].partition("\n## ")[0]
SANDBOX = SECURITY.partition("## The sandbox")[2].partition("\n## ")[0]
NAMED_TESTS = re.findall(r"`(tests/[\w/.]+)::(\w+)`", SECURITY)


@cache
def functions_of(file: Path) -> set[str]:
    nodes = ast.walk(ast.parse(file.read_text("utf-8")))
    functions = (ast.FunctionDef, ast.AsyncFunctionDef)
    return {node.name for node in nodes if isinstance(node, functions)}


def rows(document: str) -> list[list[str]]:
    """Return the cells of all tables, without heads."""
    lines = [line for line in document.splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
    heads = {"threat", "variable", "what", "address", "metric", "place"}
    return [row for row in cells if row[0] not in heads]


@of_each("file", sorted({file for file, _ in NAMED_TESTS}))
def test_every_test_that_is_named_exists(file: str) -> None:
    named = {test for at, test in NAMED_TESTS if at == file}
    assert named <= functions_of(ROOT / file)


def test_every_threat_has_what_holds_it_and_a_test() -> None:
    threats = rows(SECURITY.replace(EVALUATED, "").replace(SANDBOX, ""))
    assert len(threats) > 20
    assert all(len(row) == 3 and row[1] and "::test_" in row[2] for row in threats)


def test_every_attempt_is_held_by_some_layer() -> None:
    attempts = [row for row in rows(SANDBOX) if len(row) == 5 and row[0] != "attempt"]
    assert len(attempts) > 20
    held_otherwise = attempts.pop()
    assert "the launcher has none" in held_otherwise[1]
    assert all(any(cell not in ("", "–", "– ¹") for cell in row[1:]) for row in attempts)


def test_every_place_of_evaluation_has_what_bounds_it_and_a_test() -> None:
    places = rows(EVALUATED)
    assert len(places) > 15
    assert all(len(row) == 4 and all(row) and "::test_" in row[3] for row in places)


def test_every_variable_is_explained() -> None:
    used = {
        name
        for file in (ROOT / "checker").rglob("*.py")
        for name in re.findall(r"SUBT_CHECK_[A-Z_]*[A-Z]", file.read_text("utf-8"))
    }
    listed = [row[0].strip("`") for row in rows(SERVICE) if row[0].startswith("`SUBT_CHECK")]
    assert set(listed) == used
    assert len(listed) == len(used)


def test_what_compose_asks_for_stands_in_the_example() -> None:
    asked = set(re.findall(r"\$\{(\w+):\?", (ROOT / "compose.yaml").read_text("utf-8")))
    assert asked == set(re.findall(r"^(\w+)=", SERVICE, re.MULTILINE))


def test_limits_are_those_of_the_code() -> None:
    config, index = Config(), ArchiveLimits()
    static, trial = LIMITS[Stage.STATIC], LIMITS[Stage.TRIAL]
    told = dict(row for row in rows(SERVICE) if len(row) == 2)
    assert told["upload"] == (
        f"{config.upload_limit / 1e6:g} MB; {config.upload_seconds:g} s and "
        f"{1e6 / config.steady:g} s for each MB; "
        f"{config.slowest / 1e3:g} kB/s on average, {config.idle_seconds:g} s without a byte"
    )
    assert told["uploads"] == (
        f"{config.uploads_per_minute} a minute from one address; "
        f"{config.uploads_at_once} at once, half of them from one address; "
        f"{config.bytes_per_client / 1e6:g} MB at once from one address (five of the largest), "
        "and half of the disk's room for uploads, unless it is a single one"
    )
    assert told["archive"] == (
        f"{index.entries} entries, {index.paths} with the folders on the way to them, "
        f"{index.unpacked_bytes / 1e6:g} MB unpacked, {index.ratio} times its packed size; "
        f"{PROCESSOR_SECONDS} s of a processor and {SECONDS:g} s to read its index"
    )
    assert told["archive indexes"].startswith(
        f"{AT_ONCE} at once, {OF_ONE} of them from one token or address"
    )
    assert told["static check"] == (
        f"{static.seconds:g} s of processor time and {static.memory / 1e9:g} GB of address space "
        f"in each process, {static.open_files} open files"
    )
    assert told["check with trial"].startswith(f"{trial.seconds:g} s")
    assert told["streams of events"].startswith(
        f"{config.streams} at once, {config.streams_per_client} from one address"
    )


def test_defaults_are_those_of_the_code() -> None:
    told = {row[0].strip("`"): row[2] for row in rows(SERVICE) if len(row) == 3}
    plain = Config()
    assert told["SUBT_CHECK_RETENTION_DAYS"] == str(plain.retention_days)
    assert told["SUBT_CHECK_UPLOAD_LIMIT"] == str(plain.upload_limit)
    assert told["SUBT_CHECK_UPLOADS_PER_MINUTE"] == str(plain.uploads_per_minute)
    assert told["SUBT_CHECK_STREAMS_PER_CLIENT"] == str(plain.streams_per_client)


def test_the_figures_that_are_named_are_counted() -> None:
    metrics = (ROOT / "checker/service/web/metrics.py").read_text("utf-8")
    named = re.findall(r"`subt_check_(\w+)`", SERVICE)
    assert named
    assert not [name for name in named if f'"{name}"' not in metrics]
