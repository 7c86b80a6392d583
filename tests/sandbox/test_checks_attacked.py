"""What checks uploads is taken over: the worker reads, keeps and serves nothing that it should not.

The process that checks runs `hostile_checker` in place of our own module, in the sandbox that
the service puts up, or one of them alone.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from checker.base.sandbox import layers, namespaces
from checker.base.sandbox.launcher import OwnLauncher
from checker.service.jobs import children
from checker.service.jobs.check import check_upload
from checker.service.jobs.children import Children
from checker.service.jobs.outcome import Checked, Died, Outcome
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import SUMMARY, Store
from tests.sandbox.assets import SECRET, Outside
from tests.sandbox.test_layers import MATRIX, ONLY_FOR_ROOT, claimed

GOOD = b"<sdf version='1.6'><model name='good'/></sdf>"
OTHERS_KEY = "ab" * 32
NAMES = (
    *("../../x", "index.html/../..", "/etc/passwd", "..", ".", "", "a/b/report.html", "x\0"),
    *("report.html\n", "report.html/", "summary.json", "Summary.json", "a/../report.html"),
    *("cache/x/ab/" + "cd" * 32 + ".json", "cache/../ab/" + "ab" * 32 + ".json", "jobs.sqlite"),
    *("cache/x/ab/" + "ab" * 32 + ".json/x", "a" * 300 + "/report.html"),
    "漢" * 110 + "/robot.glb",
    *("robot.glb -> /etc/passwd", "report.html" + "\u202e", "\ud800/report.html"),
)


@pytest.fixture
def store(outside: Outside, monkeypatch: pytest.MonkeyPatch) -> Iterator[Store]:
    """A store among the files of `outside`; nothing but results and uploads is ever written."""
    monkeypatch.setattr(children, "MODULE", "hostile_checker")
    found = Store(outside.folder)
    yield found
    assert not list((outside.folder / "incoming").iterdir())
    top = {each.name for each in outside.folder.iterdir()}
    # What attempts leave there is told by `Outside.got`.
    laid_out = {
        "planted",
        "renamed-hostile",
        "doomed",
        "jobs.sqlite",
        "moded",
        "removed",
        "renamed",
        "socket",
    }
    assert top - laid_out <= {"incoming", "lock", "parts", "results", "uploads"}


def ordered(store: Store, content: bytes, name: str = "robot.sdf") -> Order:
    with store.incoming() as incoming:
        incoming.write(content)
        return Order(incoming.finish(), name, "sdf")


def told(**asked: Any) -> bytes:
    """Return an upload that says what to do."""
    return b"<sdf><!-- HOSTILE" + json.dumps(asked).encode() + b"HOSTILE --></sdf>"


def checked(store: Store, content: bytes, stage: Stage = Stage.STATIC) -> Outcome:
    order = ordered(store, content)
    waiting = Children(store, ahead=False)
    outcome = check_upload(store, waiting, order, stage, lambda: False)
    waiting.close()
    return outcome


def kept(store: Store, before: set[Path]) -> set[str]:
    """Return the files of results that have come since."""
    now = {each for each in (store.folder / "results").rglob("*") if each.is_file()}
    return {each.name for each in now - before}


def results(store: Store) -> set[Path]:
    return {each for each in (store.folder / "results").rglob("*") if each.is_file()}


def still_checks(store: Store) -> None:
    """Assert that the next good upload is checked."""
    outcome = checked(store, GOOD)
    assert isinstance(outcome, Checked), outcome
    assert store.names(outcome.key) == ("report.json",)


@pytest.mark.parametrize("names", [layers.ALL, *((name,) for name in layers.ALL)], ids="+".join)
def test_native_code_in_the_process_that_checks(
    names: tuple[str, ...], store: Store, outside: Outside, monkeypatch: pytest.MonkeyPatch
) -> None:
    held: list[str] = []
    sandbox = partial(OwnLauncher, names=names)

    def started(*arguments: Any, **options: Any) -> OwnLauncher:
        launcher = sandbox(*arguments, **options)
        held.extend(each.name for each in launcher.layers if each.held)
        lacking.extend(f"{each.name}: {each.words}" for each in launcher.layers if not each.held)
        return launcher

    lacking: list[str] = []
    monkeypatch.setattr(children, "OwnLauncher", started)
    without = ("many_processes",)
    outcome = checked(store, told(deed="attempts", assets=outside.given, without=without))
    if not held:
        pytest.skip(f"does not hold here: {', '.join(lacking)}")
    assert isinstance(outcome, Checked), outcome
    report = store.file(outcome.key, "report.json")
    assert report is not None
    said = json.loads(report.read_bytes())
    seen = outside.got()
    got = {name for name, word in said.items() if seen.get(name, word.startswith("got"))}
    wanted = claimed(held, "works")
    if {*held} == {*layers.ALL} and not namespaces.bubblewrap():
        wanted = {*MATRIX}
    assert got & (wanted - ONLY_FOR_ROOT) == set()
    if "namespaces" in held or "landlock" in held:
        assert SECRET not in report.read_bytes()
    assert store.names(outcome.key) == ("report.json",)
    still_checks(store)


@pytest.mark.parametrize("name", NAMES)
def test_names_that_are_none_of_a_result(name: str, store: Store) -> None:
    before = results(store)
    outcome = checked(store, told(deed="names", names=[name]))
    assert isinstance(outcome, Died), outcome
    assert kept(store, before) == set()


def test_the_worker_goes_on(store: Store) -> None:
    for asked in (
        {"deed": "names", "names": ["../../x"]},
        {"deed": "dies"},
        {"deed": "nothing of the kind"},
    ):
        assert isinstance(checked(store, told(**asked)), Died)
    still_checks(store)


@pytest.mark.parametrize(
    "asked",
    [
        {"deed": "many", "many": 60_000},
        {"deed": "large", "many": 3},
        {"deed": "table", "table": {"report.json": [0, 10**18]}},
        {"deed": "table", "table": {"report.json": [-1, 1]}},
        {"deed": "table", "table": {"report.json": [0.5, 1]}},
        {"deed": "table", "table": {"report.json": {"at": 0}}},
        {"deed": "table", "table": [["report.json", 0, 1]]},
        {"deed": "answer", "said": ["[", "[", 100_000, ""]},
        {"deed": "answer", "said": ["[" * 900, "", 0, "]" * 900]},
        {"deed": "answer", "said": ['{"crashed": false, "words": "', "x", 30_000_000, '"}']},
        {"deed": "answer", "said": ['{"crashed": false, "words": ', "9", 100_000, "}"]},
        {"deed": "lies", "more": {"packages": {}}},
        {"deed": "lies", "more": {"packages": [{"name": "x"}] * 3}},
        {"deed": "lies", "more": {"packages": [[]] * 6_000}},
        {"deed": "lies", "more": {"words": None}},
        {"deed": "lies", "more": {"crashed": "no"}},
    ],
    ids=lambda asked: json.dumps(asked)[:60],
)
def test_answers_that_are_none(asked: dict[str, Any], store: Store) -> None:
    before = results(store)
    outcome = checked(store, told(**asked))
    assert isinstance(outcome, Died), outcome
    assert kept(store, before) == set()
    assert not list((store.folder / "parts").rglob("*.json"))


def test_what_is_said_of_another_result_is_kept_as_words(store: Store) -> None:
    more = {"key": OTHERS_KEY, "result": "../../jobs.sqlite", "words": "\x1b[2J" + "x" * 9_000}
    outcome = checked(store, told(deed="lies", more=more))
    assert isinstance(outcome, Checked)
    assert outcome.key != OTHERS_KEY
    assert "\x1b" not in outcome.words
    assert len(outcome.words) <= 1_000
    assert store.names(outcome.key) == ()
    assert store.file(outcome.key, SUMMARY) is not None


def test_parts_of_one_upload_reach_no_other(store: Store) -> None:
    keys = [OTHERS_KEY, "cd" * 32]
    one, other = told(deed="seen", keys=keys), told(deed="seen", keys=[])
    assert isinstance(checked(store, one), Checked)
    again, another = checked(store, one, Stage.TRIAL), checked(store, other, Stage.TRIAL)
    assert isinstance(again, Checked)
    assert isinstance(another, Checked)
    assert json.loads(again.words) == ["upload", *(_part(key) for key in sorted(keys))]
    assert json.loads(another.words) == ["upload"]


def _part(key: str) -> str:
    return f"cache/trial/{key[:2]}/{key}.json"


def test_whatever_is_left_behind_is_removed(store: Store) -> None:
    # If it is looked at meanwhile, folders that cannot be listed are too much.
    assert isinstance(checked(store, told(deed="leftovers")), Checked | Died)
    assert not list((store.folder / "incoming").iterdir())


@pytest.mark.parametrize(
    ("asked", "most", "words"),
    [
        ({"deed": "holds", "bytes": 1_000_000_000}, {"memory": 500_000_000}, "0.5 GB of memory"),
        ({"deed": "fills", "bytes": 400_000_000}, {"disk": 100_000_000}, "0.1 GB of disk space"),
        ({"deed": "multiplies"}, {"processes": 20}, "20 processes"),
        ({"deed": "leftovers"}, {"files": 1_000}, "1000 files"),
    ],
    ids=lambda value: value.get("deed") if isinstance(value, dict) else None,
)
def test_what_all_of_its_processes_use_is_bounded(
    asked: dict[str, Any],
    most: dict[str, int],
    words: str,
    store: Store,
    outside: Outside,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Limits of the system hold each of them alone."""
    monkeypatch.setattr(children, "MOST", replace(children.MOST, **most))
    outcome = checked(store, told(**asked, seconds=30, mark=outside.given["mark"]))
    assert isinstance(outcome, Died), outcome
    assert words in outcome.reason
    assert not outside.survivors()
    still_checks(store)
