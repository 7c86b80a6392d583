"""Work in the background: cached, begun early, by one process for many requests, and in vain."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest

from checker.base.background import Background, Work
from checker.base.cache import NO_CACHE, Cache
from checker.base.child_process import Limits
from checker.base.child_server import Server
from checker.base.parts import WorkerFailed
from checker.base.sandbox.launcher import OwnLauncher

LIMITS = Limits(seconds=5, memory=1_000_000_000)
BODY = """
import json, os

count = 0

def answer(request, files):
    global count
    count += 1
    asked = json.loads(request)
    if "killed" in asked["items"]:
        os.kill(os.getpid(), 9)
    if "told" in asked["items"]:
        told = {"failed": {"reason": "was killed", "momentary": True}}
        return json.dumps([told] * len(asked["items"])).encode()
    if "dies" in asked["items"]:
        os._exit(1)
    if "silent" in asked["items"]:
        return b"nonsense"
    said = [asked.get("prefix", "") + each for each in asked["items"]]
    return json.dumps([*said, count][: len(said) + ("more" in asked["items"])]).encode()
"""


@pytest.fixture(autouse=True)
def worker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Have processes started that find the module `doubles`."""
    (tmp_path / "work").mkdir()
    (tmp_path / "work" / "doubles.py").write_text(BODY)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "work"))
    with closing(OwnLauncher()) as launcher:
        monkeypatch.setattr("checker.base.child_process.launcher", lambda: launcher)
        yield


def word(said: Any) -> str:
    if not isinstance(said, str):
        raise ValueError("no word")
    return said


def work(*items: str, **more: Any) -> Work[str]:
    return Work("words", "doubles", LIMITS, {f"{each:0>64}": each for each in items}, word, **more)


def results(done: Background[str]) -> list[str | WorkerFailed]:
    return [*done.results().values()]


def test_what_is_known_is_not_asked_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cache = Cache(tmp_path / "cache")
    first = Background(work("a", "b", common={"prefix": "1"}), cache)
    assert not first.known
    assert results(first) == ["1a", "1b"]
    more = Background(work("b", "c", common={"prefix": "2"}), cache)
    assert results(more) == ["1b", "2c"]
    monkeypatch.setattr("checker.base.background.Child", None)
    assert Background(work("a", "c"), cache).known
    assert Background(work("a"), cache).result() == "1a"


def test_what_does_not_last_is_not_kept(tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    kept = work("a", "b", lasts=lambda said: said == "a")
    assert results(Background(kept, cache)) == ["a", "b"]
    again = Background(work("a", "b", common={"prefix": "new "}), cache)
    assert results(again) == ["a", "new b"]


@pytest.mark.parametrize("item", ["silent", "more", "dies"])
def test_no_proper_answer_is_a_reason(item: str, tmp_path: Path) -> None:
    cache = Cache(tmp_path / "cache")
    failed = results(Background(work("a", item), cache))
    assert all(isinstance(each, WorkerFailed) and each.reason for each in failed)
    assert not list((tmp_path / "cache").rglob("*.json"))


@pytest.mark.parametrize("item", ["killed", "told"])
def test_what_may_be_there_the_next_time_is_told_apart(item: str, tmp_path: Path) -> None:
    lasting, passing = Cache(tmp_path / "one"), Cache(tmp_path / "two")
    Background(work("dies"), lasting).results()
    assert (lasting.is_whole, lasting.disturbed) == (False, "")
    (failed,) = results(Background(work(item), passing))
    assert isinstance(failed, WorkerFailed)
    assert failed.momentary
    assert passing.disturbed == f"words: {failed.reason}"


def test_a_full_disk_is_a_reason(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cache = Cache(tmp_path / "cache")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "none"))
    (failed,) = results(Background(work("a"), cache))
    assert failed == WorkerFailed("could not be started: No such file or directory", True)
    assert cache.disturbed.startswith("words: could not be started")


def test_small_work_needs_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.base.background.Child", None)
    assert results(Background(work("a", "b", here=str.upper), NO_CACHE)) == ["A", "B"]
    (failed,) = results(Background(work("a", here=lambda _: 1), NO_CACHE))
    assert isinstance(failed, WorkerFailed)


@contextmanager
def started() -> Iterator[Server]:
    server = Server("doubles", LIMITS).start()
    try:
        yield server
    finally:
        server.stop()


def test_one_process_answers_one_request_after_the_other() -> None:
    with started() as server:
        first, second = (Background(work(each), NO_CACHE, server) for each in ("a", "b"))
        first.begin()
        second.begin()
        assert (second.result(), first.result()) == ("b", "a")
        # It counts how often it was asked: a third time.
        assert server.give(json.dumps({"items": ["more"]}).encode()).answer() == b'["more", 3]'
        given_up = Background(work("d"), NO_CACHE, server)
        given_up.begin()
        given_up.stop()
        assert isinstance(given_up.result(), WorkerFailed)
        assert Background(work("c"), NO_CACHE, server).result() == "c"
    assert not server.alive


def test_a_server_that_died_is_started_anew() -> None:
    with started() as server:
        lost, queued = (Background(work(each), NO_CACHE, server) for each in ("dies", "a"))
        lost.begin()
        queued.begin()
        assert lost.result() == queued.result() == WorkerFailed("failed with an error")
        assert Background(work("b"), NO_CACHE, server).result() == "b"


def test_a_server_that_takes_too_long_is_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Limits, "clock_seconds", 0.0)
    with started() as server:
        late = Background(work("a"), NO_CACHE, server).result()
        assert isinstance(late, WorkerFailed)
        assert "took longer" in late.reason
        assert not server.alive
