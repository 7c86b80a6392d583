"""Health, metrics and logs."""

from __future__ import annotations

import json
import logging
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from prometheus_client.parser import text_string_to_metric_families

from checker.base.sandbox.layers import Layer
from checker.service.jobs.durable.receipts import SHOWN_DIGITS, key_of_check
from checker.service.jobs.port import Alive, JobsUnreachable, State
from checker.service.logs import FIELDS, JsonLines
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.limits.admission import GUESSES_PER_MINUTE
from checker.service.web.metrics import BOUNDS, Metrics
from tests.web.board import DONE, ID, BoardJobs
from tests.web.server import left_behind


@dataclass
class Engine(BoardJobs):
    """An engine that says of itself what a test wants."""

    told: Alive | None = field(default_factory=lambda: Alive({"one": 3.0, "two": 600.0}, {}, 0))

    def alive(self) -> Alive:
        if self.told is None:
            raise JobsUnreachable
        return self.told


def client_for(tmp_path: Path, jobs: BoardJobs, **more: object) -> TestClient:
    (tmp_path / "data").mkdir(exist_ok=True)
    config = Config(**{"upload_limit": 1_000, **more})  # type: ignore[arg-type]
    app = create_app(jobs, Store(tmp_path / "data"), config)
    return TestClient(app, base_url="http://localhost", client=("127.0.0.1", 5_000))


def test_the_web_process_lives_whatever_the_engine_does(tmp_path: Path) -> None:
    assert client_for(tmp_path, Engine(told=None)).get("/healthz").json() == {"status": "ok"}


@pytest.mark.parametrize(
    ("told", "said"),
    [
        (None, "database does not answer"),
        (Alive({}, {}, 0), "No worker"),
        (Alive({"one": 61.0}, {}, 0), "No worker"),
    ],
)
def test_it_is_ready_only_if_a_check_would_be_done(
    tmp_path: Path, told: Alive | None, said: str
) -> None:
    answer = client_for(tmp_path, Engine(told=told)).get("/readyz")
    assert answer.status_code == 503
    assert said in answer.json()["error"]
    assert client_for(tmp_path, Engine()).get("/readyz").status_code == 200


def test_it_is_not_ready_without_room_for_uploads(tmp_path: Path) -> None:
    answer = client_for(tmp_path, Engine(), upload_limit=10**18).get("/readyz")
    assert answer.status_code == 503
    assert "MB free" in answer.json()["error"]


def test_it_is_not_ready_if_it_cannot_write_its_data(tmp_path: Path) -> None:
    client = client_for(tmp_path, Engine())
    (tmp_path / "data/incoming").write_text("a file where uploads come in")
    answer = client.get("/readyz")
    assert answer.status_code == 503
    assert answer.json()["error"].startswith("The data folder cannot be written: ")
    (tmp_path / "data/incoming").unlink()
    assert client.get("/readyz").status_code == 200
    assert not left_behind(Store(tmp_path / "data"))


def test_it_is_not_ready_if_it_may_not_write_its_data() -> None:
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place, "data")
        client = client_for(Path(place), Engine())
        folder.chmod(0o555)
        with as_nobody(Path(place)):
            answer = client.get("/readyz")
        assert answer.status_code == 503
        assert answer.json()["error"] == "The data folder cannot be written: Permission denied."


@contextmanager
def as_nobody(place: Path) -> Iterator[None]:
    """Have no rights of root for a moment: root may write whatever the bits say."""
    if os.geteuid() != 0:
        yield
        return
    place.chmod(0o755)
    if not all(each.stat().st_mode & 0o001 for each in place.parents):
        pytest.skip(f"{place} is closed to users without rights")
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)


WALL, FILTER = Layer("landlock", True, "version 7", hides=True), Layer("seccomp", True, "")
NETWORK, NO_ACCOUNT = Layer("namespaces", True, "no network"), Layer("account", False, "no root")
WALLED, BARE = (WALL, NO_ACCOUNT, FILTER), (NETWORK, NO_ACCOUNT, FILTER)
MIXED = Alive({"one": 3.0, "two": 3.0}, {}, 0, {"one": WALLED, "two": BARE})


@pytest.mark.parametrize(
    ("told", "allowed", "status"),
    [
        (MIXED, {"public": True}, 503),
        (MIXED, {"tokens": ("s3cret",)}, 503),
        (MIXED, {"public": True, "without_sandbox": True}, 200),
        (MIXED, {}, 200),
        (Alive({"one": 3.0, "two": 61.0}, {}, 0, MIXED.layers), {"public": True}, 200),
        (Alive({"old": 3.0}, {}, 0), {"public": True}, 503),
    ],
)
def test_it_is_not_ready_for_others_with_a_worker_without_sandbox(
    tmp_path: Path, told: Alive, allowed: dict[str, object], status: int
) -> None:
    answer = client_for(tmp_path, Engine(told=told), **allowed).get("/readyz")
    assert answer.status_code == status
    assert ("no sandbox layer that hides files" in answer.text) == (status == 503)


def test_sandbox_are_named_to_this_machine_and_to_tokens(tmp_path: Path) -> None:
    config = Config(tokens=("s3cret",), without_sandbox=True, upload_limit=1_000)
    app = create_app(Engine(told=MIXED), Store(tmp_path), config)
    here = TestClient(app, base_url="http://localhost", client=("127.0.0.1", 5_000))
    there = TestClient(app, base_url="http://localhost", client=("192.0.2.1", 5_000))
    sandbox = {"one": ["landlock", "seccomp"], "two": ["namespaces", "seccomp"]}
    told = {"status": "ok", "sandbox": sandbox}
    assert here.get("/readyz").json() == told
    assert here.get("/readyz", headers={"X-Forwarded-For": "::1"}).json() == {"status": "ok"}
    assert there.get("/readyz").json() == {"status": "ok"}
    token = {"Authorization": "Bearer s3cret"}
    assert there.get("/readyz", headers=token).json() == told


def test_metrics_count_requests_by_route(tmp_path: Path) -> None:
    waiting = Alive({'"\\\n': 1.0}, {"static": 2, "trial": 3}, 1)
    client = client_for(tmp_path, Engine({ID: DONE}, taken={"static": 0.5}, told=waiting))
    for path in (f"/api/checks/{ID}", "/api/checks/x", "/", f"/checks/{ID}", "/nothing"):
        client.get(path)
    client.post("/api/checks", files={"file": ("a.sdf", b"<sdf/>")})
    client.post("/api/checks", files={"file": ("a.exe", b"<sdf/>")})
    text = client.get("/metrics").text
    for line in (
        'subt_check_requests_total{method="GET",route="/api/checks/{id}",status="200"} 1.0',
        'subt_check_requests_total{method="GET",route="/api/checks/{id}",status="404"} 1.0',
        'subt_check_requests_total{method="GET",route="/",status="200"} 1.0',
        'subt_check_requests_total{method="GET",route="/checks/{id}",status="200"} 1.0',
        'subt_check_requests_total{method="GET",route="none",status="404"} 1.0',
        'subt_check_request_seconds_count{route="/api/checks/{id}"} 2.0',
        "subt_check_uploads_total 1.0",
        'subt_check_refused_total{cause="kind"} 1.0',
        'subt_check_waiting{queue="trial"} 3.0',
        "subt_check_running 1.0",
        "subt_check_engine_up 1.0",
        'subt_check_stage_seconds{stage="static"} 0.5',
    ):
        assert line in text.splitlines()
    assert 'stage="trial"' not in text, "no trial was finished lately"
    assert ID not in text


def figures(text: str) -> dict[tuple[str, ...], float]:
    """Return what a metrics page says, by name and labels, as Prometheus reads it."""
    samples = [each for family in text_string_to_metric_families(text) for each in family.samples]
    return {(each.name, *each.labels.values()): each.value for each in samples}


def test_metrics_are_in_the_format_of_prometheus() -> None:
    metrics = Metrics()
    metrics.count("GET", "/{id}", 200, 0.01)
    read = figures(metrics.text(Alive({'a"\\\nb': 1.0}, {"static": 1}, 0), {}).decode())
    assert read["subt_check_requests_total", "GET", "/{id}", "200"] == 1
    assert read["subt_check_worker_silent_seconds", 'a"\\\nb'] == 1
    assert all(name.startswith("subt_check_") for name, *_ in read)


@given(st.lists(st.floats(0, 100), min_size=1, max_size=50))
def test_the_histogram_adds_up(seconds: list[float]) -> None:
    metrics = Metrics()
    for each in seconds:
        metrics.count("GET", "/", 200, each)
    read = figures(metrics.text(None, {}).decode())
    for bound in (*BOUNDS, float("inf")):
        le = "+Inf" if bound == float("inf") else str(bound)
        expected = sum(each <= bound for each in seconds)
        assert read["subt_check_request_seconds_bucket", le, "/"] == expected


@pytest.mark.parametrize(
    ("address", "headers", "status"),
    [
        ("127.0.0.1", {}, 200),
        ("127.0.0.1", {"X-Forwarded-For": "192.0.2.1"}, 404),
        ("192.0.2.1", {}, 404),
        ("192.0.2.1", {"Authorization": "Bearer wrong"}, 404),
        ("192.0.2.1", {"Authorization": "Bearer s3cret"}, 200),
    ],
)
def test_metrics_are_for_this_machine_and_for_tokens(
    tmp_path: Path, address: str, headers: dict[str, str], status: int
) -> None:
    app = create_app(Engine(), Store(tmp_path), Config(tokens=("s3cret",)))
    client = TestClient(app, base_url="http://localhost", client=(address, 5_000))
    assert client.get("/metrics", headers=headers).status_code == status


@pytest.mark.parametrize("path", ["/metrics", "/readyz"])
def test_guesses_of_tokens_are_limited(tmp_path: Path, path: str) -> None:
    config = Config(tokens=("s3cret",), without_sandbox=True, upload_limit=1_000)
    app = create_app(Engine(told=MIXED), Store(tmp_path), config)

    def asked(token: str, address: str = "192.0.2.1") -> int:
        client = TestClient(app, base_url="http://localhost", client=(address, 5_000))
        return client.get(path, headers={"Authorization": f"Bearer {token}"}).status_code

    assert {asked("s3cret") for _ in range(GUESSES_PER_MINUTE + 5)} == {200}, "it is no guess"
    wrong = [asked(f"guess {n}") for n in range(GUESSES_PER_MINUTE + 5)]
    assert wrong == [404 if path == "/metrics" else 200] * GUESSES_PER_MINUTE + [429] * 5
    assert asked("s3cret") == 429, "or who guesses would know"
    assert asked("s3cret", "192.0.2.2") == 200


class Broken(BoardJobs):
    """An engine with a bug."""

    def status(self, id: str) -> State | None:
        raise ZeroDivisionError(id)


@pytest.mark.parametrize("path", [f"/api/checks/{ID}", f"/checks/{ID}"])
def test_a_fault_of_ours_is_logged_and_not_shown(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, path: str
) -> None:
    with caplog.at_level(logging.INFO, "subt-check"):
        answer = client_for(tmp_path, Broken()).get(path)
    assert answer.status_code == 500
    assert answer.json()["error"] == "The service has an internal error."
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert "ZeroDivisionError" in caplog.text


def test_logs_hold_no_token_no_id_and_no_name(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    client = client_for(tmp_path, Engine({ID: DONE}), tokens=("s3cret",))
    headers = {"Authorization": "Bearer s3cret"}
    with caplog.at_level(logging.INFO, "subt-check"):
        client.get(f"/api/checks/{ID}?name=%1b%5b31m", headers=headers)
        client.post("/api/checks", files={"file": ("evil\x1b.sdf", b"<sdf/>")}, headers=headers)
    lines = [JsonLines().format(record) for record in caplog.records if record.name[:4] == "subt"]
    assert len(lines) == 2
    for line in lines:
        for hidden in (ID, "s3cret", "evil", "name="):
            assert hidden not in line
    first = json.loads(lines[0])
    assert (first["route"], first["status"]) == ("/api/checks/{id}", 200)
    assert first["check"] == key_of_check(ID)[:SHOWN_DIGITS]


@given(st.text(), st.text())
def test_no_text_begins_a_line_of_the_log_of_its_own(message: str, field: str) -> None:
    record = logging.LogRecord("subt-check.web", logging.INFO, "", 0, message, None, None)
    setattr(record, FIELDS, {"field": field})
    line = JsonLines().format(record)
    assert line.isascii()
    assert line.isprintable()
    assert json.loads(line)["message"] == message
