"""No accepted check is lost and none is told twice, whichever processes of the service die."""

from __future__ import annotations

import json
import threading
from contextlib import suppress
from itertools import groupby
from pathlib import Path

import httpx

from checker.service.jobs.durable.receipts import key_of_check
from support.service import zip_of
from tests.conftest import SAMPLES
from tests.serving.conftest import SECONDS, Serve, wait_for
from tests.survival.conftest import (
    Home,
    connected,
    half_sent,
    kill,
    kill_web,
    robot,
    upload,
    wait_for_end,
)
from tests.web.server import form, request_head

WHOLE = ["queued", "static", "trial", "done"]
MODEL = "broken_gurdy_description"


def events_of(url: str, id: str, after: int = 0) -> list[dict[str, object]]:
    """Return the events of a check that is over, as a stream tells them."""
    address = f"{url}/api/checks/{id}/events"
    text = httpx.get(address, headers={"Last-Event-ID": str(after)}, timeout=SECONDS).text
    return [json.loads(line[6:]) for line in text.splitlines() if line.startswith("data: ")]


def assert_told_once(url: str, id: str) -> None:
    """Assert that a check has ended well, by events in order, of which none came twice."""
    told = events_of(url, id)
    numbers = [event["number"] for event in told]
    assert numbers == sorted(set(numbers))
    assert [stage for stage, _ in groupby(event["stage"] for event in told)] == WHOLE


def test_a_web_server_is_killed_in_the_middle_of_an_upload(home: Home) -> None:
    serving = home.serve()
    accepted = upload(serving.url)
    kept = home.stored("uploads")
    with half_sent(serving.url, 2_000_000) as connection:
        wait_for(lambda: any(each.stat().st_size for each in home.stored("incoming")))
        kill_web(serving)
        with suppress(ConnectionError):
            assert connection.recv(1) == b""
    assert home.stored("incoming") == []
    assert home.stored("uploads") == kept
    assert home.keys() == {key_of_check(accepted)}
    home.worker()
    assert wait_for_end(serving.url, accepted)["stage"] == "done"
    assert_told_once(serving.url, accepted)


def test_a_web_server_is_killed_as_soon_as_it_has_taken_an_upload(home: Home) -> None:
    serving = home.serve()
    body = form("robot.sdf", robot())
    with connected(serving.url) as connection:
        connection.sendall(request_head(len(body)) + body)
        answer = b""
        while b"}" not in answer:
            answer += connection.recv(65_536)
        kill_web(serving)
    id = json.loads(answer.partition(b"\r\n\r\n")[2])["id"]
    told = httpx.get(f"{serving.url}/api/checks/{id}", timeout=SECONDS).json()
    assert (told["name"], told["stage"]) == ("robot.sdf", "queued")
    home.worker()
    assert wait_for_end(serving.url, id)["stage"] == "done"
    assert_told_once(serving.url, id)


class Watcher:
    """Somebody who watches a check until the stream ends or breaks.

    Attributes:
        numbers: Of the events so far.
    """

    def __init__(self, url: str, id: str) -> None:
        self.numbers: list[int] = []
        self._address = f"{url}/api/checks/{id}/events"
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _watch(self) -> None:
        with (
            suppress(httpx.TransportError),
            httpx.stream("GET", self._address, timeout=SECONDS) as answer,
        ):
            for line in answer.iter_lines():
                if line.startswith("id: "):
                    self.numbers.append(int(line[4:]))

    def seen(self) -> list[int]:
        self._thread.join(SECONDS)
        return self.numbers


def test_all_is_killed_in_the_middle_of_several_checks(home: Home) -> None:
    serving = home.serve()
    for _ in range(2):
        home.worker()
    names = [f"robot-{number}.sdf" for number in range(5)]
    ids = {name: upload(serving.url, name) for name in names}
    watcher = Watcher(serving.url, ids[names[0]])
    wait_for(lambda: watcher.numbers and any("trial" in each for each in home.begun()))
    kill(serving)
    home.kill_workers()
    before = watcher.seen()

    serving = home.serve()
    for _ in range(2):
        home.worker()
    for name, id in ids.items():
        told = wait_for_end(serving.url, id)
        assert (told["name"], told["stage"]) == (name, "done")
        assert told["files"] == [f"/api/checks/{id}/report.json"]
        assert_told_once(serving.url, id)
    assert home.keys() == set(map(key_of_check, ids.values()))
    assert len([each for each in home.stored("results") if each.name == "report.json"]) == 10
    assert set(home.begun().values()) <= {1, 2}
    after = [event["number"] for event in events_of(serving.url, ids[names[0]], before[-1])]
    everything = [*before, *after]
    assert everything == sorted(set(everything))


def test_a_service_that_is_stopped_goes_on_where_it_was(serve: Serve, tmp_path: Path) -> None:
    environment = {"SUBT_CHECK_DATA": str(tmp_path / "data")}
    serving = serve("--workers", 1, **environment)
    package = zip_of([SAMPLES / MODEL], tmp_path / f"{MODEL}.zip")
    id = upload(serving.url, package.name, package.read_bytes())

    def has_begun() -> bool:
        told = httpx.get(f"{serving.url}/api/checks/{id}", timeout=SECONDS).json()
        return bool(told["stage"] != "queued")

    wait_for(has_begun)
    assert serving.stop() == 0

    serving = serve("--workers", 1, **environment)
    told = wait_for_end(serving.url, id)
    assert told["stage"] == "done"
    assert str(told["words"]).startswith("Not ready")
    assert_told_once(serving.url, id)
    assert serving.stop() == 0
    assert list((tmp_path / "data" / "incoming").iterdir()) == []
