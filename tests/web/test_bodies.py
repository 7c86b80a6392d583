"""What is sent of a body: less to who takes it compressed, nothing to who wants the head."""

from __future__ import annotations

import secrets
from pathlib import Path

import httpx
import pytest
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from starlette.datastructures import Headers

from checker.service.store.store import Store
from checker.service.web.answers.bodies import takes_gzip
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.pages.site import FOLDER, release
from tests.web.board import DONE, ID, KEY, QUEUED, BoardJobs, keep_result
from tests.web.server import eventually, served


def static(name: str) -> str:
    return f"{FOLDER}/{release()}/{name}"


PAGE = "<meta content=\"script-src 'sha256-" + "A" * 43 + "='\">" + "a report " * 9_000
BROWSER = {"Accept": "text/html,*/*;q=0.8", "Accept-Encoding": "br, gzip"}
RESULT = ("report.html", "report.sarif", "robot.glb")
COMPRESSED = (
    *("/", "/rules", "/api/openapi.json", static("site.css"), static("watch.js")),
    *(f"/api/checks/{ID}/{name}" for name in ("report.json", *RESULT)),
)
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


@pytest.mark.parametrize("address", COMPRESSED)
def test_a_client_that_takes_gzip_gets_less(client: TestClient, address: str) -> None:
    plain = client.get(address, headers={"Accept-Encoding": "identity"})
    packed = client.get(address, headers=BROWSER)
    assert packed.headers["content-encoding"] == "gzip"
    assert int(packed.headers["content-length"]) < len(plain.content) / 2
    assert packed.content == plain.content  # the client unpacks it
    changed = ("content-length", "content-encoding")
    assert [each for each in packed.headers.items() if each[0] not in changed] == [
        each for each in plain.headers.items() if each[0] not in changed
    ]
    assert "Accept-Encoding" in plain.headers["vary"]
    assert client.head(address, headers=BROWSER).headers == packed.headers


@pytest.mark.parametrize("address", ["/healthz", f"/api/checks/{ID}", "/metrics"])
def test_what_is_short_or_of_another_kind_is_sent_as_it_is(
    client: TestClient, address: str
) -> None:
    assert "content-encoding" not in client.get(address).headers


@pytest.mark.parametrize("where", ["/api/checks", "/checks"])
def test_the_answer_to_an_upload_is_sent_as_it_is(client: TestClient, where: str) -> None:
    """It is the one that tells of something new what nobody else may know."""
    files, takes = {"file": ("a.sdf", b"<sdf/>")}, {"Accept-Encoding": "gzip"}
    answer = client.post(where, files=files, headers=takes, follow_redirects=False)
    assert answer.status_code in (201, 303)
    assert "content-encoding" not in answer.headers


@pytest.mark.parametrize(
    ("said", "takes"),
    [
        ("gzip", True),
        ("deflate, GZIP;q=0.5, br", True),
        ("gzip;q=1.0", True),
        ("gzip;q=0.001", True),
        ("gzip;q=0", False),
        ("gzip; q=0.000", False),
        ("", False),
        ("identity", False),
        ("x-gzip-not, xgzip", False),
        (",;,;;q=,gzip;;", True),
    ],
)
def test_what_a_client_takes_is_what_it_says(said: str, takes: bool) -> None:
    assert takes_gzip(Headers({"Accept-Encoding": said})) is takes


@given(st.text())
def test_nothing_that_a_client_says_fails(said: str) -> None:
    takes_gzip(Headers({"Accept-Encoding": said.encode("latin-1", "replace").decode("latin-1")}))


def test_what_is_compressed_already_is_sent_as_it_is(tmp_path: Path) -> None:
    store, noise = Store(tmp_path / "data"), secrets.token_bytes(50_000)
    (tmp_path / "made").mkdir()
    (tmp_path / "made/robot.glb").write_bytes(noise)
    store.keep(KEY, tmp_path / "made")
    client = TestClient(create_app(BoardJobs({ID: DONE}), store, Config()), "http://localhost")
    answer = client.get(f"/api/checks/{ID}/robot.glb", headers={"Accept-Encoding": "gzip"})
    assert "content-encoding" not in answer.headers
    assert answer.content == noise


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
def test_a_stream_begins_before_anything_happens(tmp_path: Path) -> None:
    app = create_app(BoardJobs({ID: QUEUED}), Store(tmp_path), Config())
    with (
        served(app) as port,
        httpx.stream(
            "GET", f"http://localhost:{port}/api/checks/{ID}/events?after=2", timeout=10.0
        ) as answer,
    ):
        assert answer.status_code == 200
        assert "content-encoding" not in answer.headers


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
