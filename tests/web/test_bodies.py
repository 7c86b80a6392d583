"""What is sent of an answer's body: nothing to who asks for the head."""

from __future__ import annotations

from pathlib import Path

import httpx
import pytest
from fastapi.testclient import TestClient

from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.web.board import DONE, ID, QUEUED, BoardJobs, keep_result
from tests.web.server import eventually, served

PAGE = "<meta content=\"script-src 'sha256-" + "A" * 43 + "='\">" + "a report " * 9_000
RESULT = ("report.html", "report.sarif", "robot.glb")
ADDRESSES = (
    *("/", "/rules", "/nothing", f"/checks/{ID}", "/healthz", "/readyz", "/metrics"),
    *(f"/api/checks/{ID}", "/api/openapi.json", "/api/nothing", "/api/checks/nothing"),
    *(f"/api/checks/{ID}/{name}" for name in ("report.json", *RESULT)),
)


@pytest.fixture
def client(tmp_path: Path) -> TestClient:
    store = Store(tmp_path / "data")
    keep_result(store, PAGE, *RESULT)
    app = create_app(BoardJobs({ID: DONE}), store, Config(upload_limit=1_000))
    return TestClient(app, base_url="http://localhost", client=("127.0.0.1", 5_000))


@pytest.mark.parametrize("address", ADDRESSES)
def test_the_head_is_that_of_the_whole_answer(client: TestClient, address: str) -> None:
    whole, head = client.get(address), client.head(address)
    assert head.status_code == whole.status_code != 405
    assert not head.content
    if address != "/metrics":  # it counts the first of the two
        assert head.headers == whole.headers


@pytest.mark.parametrize("address", ["/checks", "/api/checks", f"/checks/{ID}/cancel"])
def test_what_has_no_body_to_get_has_no_head(client: TestClient, address: str) -> None:
    answer = client.head(address)
    assert answer.status_code == 405
    assert "HEAD" not in answer.headers["allow"]


@pytest.mark.parametrize(
    ("address", "allowed"),
    [(f"/api/checks/{ID}", "DELETE, GET, HEAD"), ("/healthz", "GET, HEAD"), ("/", "GET, HEAD")],
)
def test_who_may_get_is_told_of_the_head(client: TestClient, address: str, allowed: str) -> None:
    answer = client.put(address)
    assert answer.status_code == 405
    assert sorted(answer.headers["allow"].split(", ")) == allowed.split(", ")


def test_the_head_is_logged_as_such(client: TestClient) -> None:
    client.head(f"/api/checks/{ID}")
    figures = client.get("/metrics").text
    assert 'requests_total{method="HEAD",route="/api/checks/{id}",status="200"} 1.0' in figures


@pytest.mark.service
def test_the_head_of_a_stream_ends_and_keeps_no_place(tmp_path: Path) -> None:
    config = Config(public=True, streams=1)
    app = create_app(BoardJobs({ID: QUEUED}), Store(tmp_path), config)
    address = f"/api/checks/{ID}/events"
    with served(app) as port, httpx.Client(base_url=f"http://localhost:{port}") as client:
        answer = client.head(address)
        assert answer.status_code == 200
        assert answer.headers["content-type"].startswith("text/event-stream")
        assert eventually(lambda: client.head(address).status_code == 200)
        assert client.head("/healthz").status_code == 200, "the connection goes on"
