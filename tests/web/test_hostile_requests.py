"""Requests that no browser sends: each is answered in words, and none does any harm."""

from __future__ import annotations

import logging
import socket
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from msgspec.structs import replace

from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.port import Order
from checker.service.logs import JsonLines
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.web.board import DONE, ID, QUEUED, BoardJobs, keep_result
from tests.web.server import eventually, left_behind, served
from tests.web.test_transfer import GOOD

CLOSE = "Host: localhost\r\nConnection: close\r\n"
EVIL = "evil.example"
CHECK = f"/api/checks/{ID}"
FORM = "Content-Type: multipart/form-data; boundary=B\r\n"


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Store:
    store = Store(tmp_path_factory.mktemp("hostile"))
    keep_result(store, "{}", "report.html", "a/report.html", "index.html")
    return store


@pytest.fixture(scope="module")
def port(store: Store) -> Iterator[int]:
    with served(create_app(BoardJobs({ID: DONE}), store, Config(upload_limit=1_000_000))) as port:
        yield port


def answer_to(port: int, request: bytes) -> bytes:
    """Return all that a server answers before it closes the connection."""
    received = b""
    with socket.create_connection(("127.0.0.1", port), timeout=30) as connection:
        try:
            connection.sendall(request)
            while piece := connection.recv(65_536):
                received += piece
        except ConnectionError:  # it does not listen to the end of what it refuses
            pass
    return received


def request(path: str, more: str = "", method: str = "GET", common: str = CLOSE) -> bytes:
    return f"{method} {path} HTTP/1.1\r\n{common}{more}\r\n".encode("latin-1")


def post(more: str, body: bytes = b"") -> bytes:
    return request("/api/checks", more, "POST") + body


HEADS = {
    "noise": (b"\x00\xff noise\r\n\r\n", 400),
    "TLS": (bytes.fromhex("16030100c8010000c40303") + b"x" * 200, 400),
    "HTTP/0.9": (b"GET /\r\n\r\n", 400),
    "HTTP/1.0 without a host": (b"GET /healthz HTTP/1.0\r\n\r\n", 421),
    "two hosts": (request("/healthz", f"Host: {EVIL}\r\n"), 400),
    "no host": (request("/healthz", common="Connection: close\r\n"), 400),
    "a host of many": (
        request("/healthz", common="Host: a, localhost\r\nConnection: close\r\n"),
        421,
    ),
    "another host": (request("/", common=f"Host: {EVIL}\r\nConnection: close\r\n"), 421),
    "a proxy's request": (request(f"http://{EVIL}/healthz"), 404),
    "a tunnel": (request(f"{EVIL}:443", method="CONNECT"), 404),
    "options of all": (request("*", method="OPTIONS"), 404),
    "options": (request(CHECK, method="OPTIONS"), 405),
    "trace": (request("/", f"Cookie: {EVIL}\r\n", method="TRACE"), 405),
    "a method of its own": (request("/api/checks", method="EVIL"), 405),
    "another method behind the first": (
        request(CHECK, "X-HTTP-Method-Override: DELETE\r\n"),
        200,
    ),
    "the word of a proxy": (
        request(CHECK, f"X-Forwarded-Host: {EVIL}\r\nForwarded: host={EVIL}\r\n"),
        200,
    ),
    "a flood of headers": (request("/", "".join(f"X-{n}: y\r\n" for n in range(20_000))), 400),
    "a long header": (request("/", f"X: {'y' * 1_000_000}\r\n"), 400),
    "a long query": (request(f"{CHECK}/events?after=9" + "&a=b" * 3_000), 204),
    "a long number": (request(f"{CHECK}/events?after={'9' * 5_000}"), 422),
    "a token that is none": (request("/metrics", "Authorization: Bearer \xff\xfe\r\n"), 200),
    "another protocol": (request("/healthz", "Upgrade: websocket\r\n"), 200),
    "no range": (request(f"{CHECK}/report.json", "Range: bytes=-0,--5,x\r\n"), 200),
    "a thousand ranges": (
        request(f"{CHECK}/report.json", "Range: bytes=" + "0-1," * 1_000 + "0-1\r\n"),
        200,
    ),
    "an event far ahead": (request(f"{CHECK}/events", f"Last-Event-ID: {'9' * 10}\r\n"), 204),
}
BODIES = {
    "two lengths": (post("Content-Length: 5\r\nContent-Length: 6\r\n", b"hello"), 400),
    "a length below zero": (post("Content-Length: -5\r\n", b"hello"), 400),
    "a length with a sign": (post("Content-Length: +5\r\n", b"hello"), 400),
    "a length of thirty digits": (post(f"Content-Length: {'9' * 30}\r\n"), 400),
    "a length of 20 digits": (post(f"{FORM}Content-Length: {'9' * 20}\r\n"), 413),
    "an unknown coding": (post("Transfer-Encoding: gzip, chunked\r\n", b"0\r\n\r\n"), 400),
    "chunks of no size": (post(f"{FORM}Transfer-Encoding: chunked\r\n", b"zz\r\n--B\r\n"), 400),
    "a chunk that lies": (
        post(f"{FORM}Transfer-Encoding: chunked\r\n", b"3\r\n--B--\r\n\r\n0\r\n\r\n"),
        400,
    ),
    "a request behind the body": (post("Content-Length: 2\r\n", b"{}" + request(CHECK)), 415),
    "a body that is packed": (
        post(f"{FORM}Content-Encoding: gzip\r\nContent-Length: 4\r\n", b"\x1f\x8b\x08\0"),
        400,
    ),
    "a body of another site": (post(f"Origin: http://localhost.{EVIL}\r\n"), 403),
}
LONG = "%F0%90%90%80"
"""A letter of four bytes, in an address."""
PATHS = {
    "up": (request("/../../etc/passwd"), 404),
    "up, hidden": (request("/%2e%2e/%2e%2e/etc/passwd"), 404),
    "up from a package": (request(f"{CHECK}/packages/..%2f/report.html"), 404),
    "up from the fixed files": (request("/static/x/%2e%2e%2fapp.py"), 404),
    "a zero": (request("/checks/%00"), 404),
    "no text": (request("/checks/%ff%fe"), 404),
    "half a letter": (request("/rules/%ed%a0%80"), 404),
    "a line of its own": (request(f"/rules/%0d%0aX:%20{EVIL}"), 404),
    "a long name": (request(f"{CHECK}/packages/{'a' * 110}/report.html"), 404),
    "a longer name": (request(f"{CHECK}/packages/{LONG * 110}/report.html"), 404),
    "the longest name": (request(f"{CHECK}/packages/{LONG * 1_000}/report.html"), 404),
    "a long id": (request("/checks/" + "a" * 10_000), 404),
}
ALL = HEADS | BODIES | PATHS


@pytest.mark.parametrize("name", ALL)
def test_it_is_answered_in_words(
    port: int, store: Store, caplog: pytest.LogCaptureFixture, name: str
) -> None:
    sent, status = ALL[name]
    with caplog.at_level(logging.WARNING):
        answer = answer_to(port, sent)
    assert int(answer.split()[1]) == status
    assert answer.count(b"HTTP/1.1 ") == 1
    assert EVIL.encode() not in answer
    assert not [record for record in caplog.records if record.exc_info]
    assert eventually(lambda: all("results" in each.parts for each in left_behind(store)))
    assert httpx.get(f"http://localhost:{port}/healthz").status_code == 200


TAKEN = {
    "another name behind a star": (
        "filename=\"a.zip\"; filename*=UTF-8''..%2fb.zip",
        "a.zip",
    ),
    "two names": ('filename="a.exe"; filename="b.zip"', "b.zip"),
    "a path": (r'filename="C:\\temp\\..\\a.zip"', "a.zip"),
    "lines": ('filename="a%0d%0aX: y.zip"', "a_0d_0aX_y.zip"),
    "markup": ('filename="a%22><script>alert(1)</script>.zip"', "script.zip"),
    "a zero": ('filename="a\0.zip"', "a.zip"),
    "text that runs backwards": ('filename="a\u202epiz.zip"', "a_piz.zip"),
    "4000 letters": (f'filename="{"a" * 3_900}.zip"', "a" * 96 + ".zip"),
    "another charset": ('filename="a.zip"\r\nContent-Type: text/plain; charset=none', "a.zip"),
}
REFUSED = {
    "only a name behind a star": ("filename*=UTF-8''a.zip", 422),
    "40 000 letters": (f'filename="{"a" * 39_000}.zip"', 400),
    "a length of its own": ('filename="a.zip"\r\nContent-Length: 3', 400),
    "ten thousand lines": ('filename="a.zip"' + "\r\nX-A: b" * 10_000, 400),
    "quotes without end": ("filename=" + '"\\' * 2_000, 422),
}


def sent_as(said: str, jobs: BoardJobs, store: Store) -> bytes:
    """Return the answer to an archive of which the form says this."""
    head = f'--B\r\nContent-Disposition: form-data; name="file"; {said}\r\n\r\n'
    body = head.encode() + GOOD + b"\r\n--B--\r\n"
    with served(create_app(jobs, store, Config())) as port:
        return answer_to(port, post(f"{FORM}Content-Length: {len(body)}\r\n", body))


@pytest.mark.parametrize("name", TAKEN)
def test_a_name_in_a_form_is_made_safe(tmp_path: Path, name: str) -> None:
    said, safe = TAKEN[name]
    jobs = BoardJobs()
    assert int(sent_as(said, jobs, Store(tmp_path)).split()[1]) == 201
    assert [state.order.name for state in jobs.states.values()] == [safe]


@pytest.mark.parametrize("name", REFUSED)
def test_a_name_in_a_form_is_refused(tmp_path: Path, name: str) -> None:
    said, status = REFUSED[name]
    jobs, store = BoardJobs(), Store(tmp_path)
    assert int(sent_as(said, jobs, store).split()[1]) == status
    assert not jobs.states
    assert not left_behind(store)


def test_bytes_of_a_client_are_not_repeated(port: int) -> None:
    head = b'--B\r\nContent-Disposition: form-data; name="file"; filename="\xff<b>.zip"\r\n\r\n'
    answer = answer_to(port, post(f"{FORM}Content-Length: {len(head)}\r\n", head))
    assert b"The upload form cannot be read: segment header failed to decode." in answer
    assert b"<b>" not in answer


@pytest.mark.parametrize(
    ("config", "base"),
    [
        (Config(public=True), f"http://{EVIL}"),
        (Config(public=True, base_url="https://check.example"), "https://check.example"),
    ],
)
def test_links_follow_the_host_only_for_who_named_it(
    tmp_path: Path, config: Config, base: str
) -> None:
    app = create_app(BoardJobs({ID: QUEUED}), Store(tmp_path), config)
    with served(app) as port:
        answer = httpx.get(f"http://localhost:{port}{CHECK}", headers={"Host": EVIL})
    assert answer.json()["url"] == f"{base}/checks/{ID}"
    # Nobody between may give this answer to somebody else.
    assert answer.headers["cache-control"] == "private, no-store"


def test_streams_that_nobody_reads_leave_room_for_others(tmp_path: Path) -> None:
    config = Config(public=True, streams=200, streams_per_client=100)
    app = create_app(BoardJobs({ID: QUEUED}), Store(tmp_path), config)
    with served(app) as port:
        deaf = [socket.create_connection(("127.0.0.1", port)) for _ in range(150)]
        for each in deaf:
            each.sendall(request(f"{CHECK}/events", common="Host: localhost\r\n"))
        with httpx.Client(base_url=f"http://localhost:{port}", timeout=30) as client:
            files = {"file": ("a.zip", GOOD)}
            assert client.get(f"{CHECK}/events").status_code == 503
            assert client.post("/api/checks", files=files).status_code == 201
            assert client.get("/").status_code == 200
        for each in deaf:
            each.close()


def test_uploads_end_before_the_disk_is_full(tmp_path: Path) -> None:
    jobs, store = BoardJobs(), Store(tmp_path)
    with served(create_app(jobs, store, Config(upload_limit=10**18))) as port:
        address = f"http://localhost:{port}/api/checks"
        answer = httpx.post(address, files={"file": ("a.zip", GOOD)})
    assert answer.status_code == 503
    assert answer.json()["error"] == "The service cannot keep the upload: No space left on device."
    assert int(answer.headers["retry-after"]) > 0
    assert not left_behind(store)


def test_tokens_in_addresses_count_for_nothing_and_are_not_logged(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    app = create_app(BoardJobs(), Store(tmp_path), Config(tokens=("s3cret",)))
    with caplog.at_level(logging.INFO), served(app) as port:
        address = f"http://localhost:{port}/api/checks?token=s3cret"
        answer = httpx.post(address, files={"file": ("a.zip", GOOD)})
    assert answer.status_code == 401
    lines = [JsonLines().format(each) for each in caplog.records if each.name[:4] == "subt"]
    assert any('"/api/checks"' in line for line in lines)
    assert "s3cret" not in "".join(lines)


def test_a_database_that_fails_takes_no_id_into_the_log(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    store = Store(tmp_path / "data")
    jobs = durable_jobs(f"sqlite:///{tmp_path}/jobs.sqlite", store)
    id = jobs.submit(Order("a" * 64, "a.zip")).id
    with jobs.checks.engine.begin() as connection:
        connection.exec_driver_sql("ALTER TABLE workflow_status RENAME TO elsewhere")
    with caplog.at_level(logging.INFO), served(create_app(jobs, store, Config())) as port:
        status = httpx.get(f"http://localhost:{port}/api/checks/{id}").status_code
    jobs.checks.engine.dispose()
    assert status == 503
    lines = [JsonLines().format(each) for each in caplog.records if each.name[:4] == "subt"]
    assert any("no such table" in line for line in lines)
    assert id not in "".join(lines)


def test_a_check_of_an_upload_that_is_too_old_is_as_good_as_none(tmp_path: Path) -> None:
    """A result that was deleted under a check is not there, and no fault."""
    app = create_app(BoardJobs({ID: replace(DONE, result="b" * 64)}), Store(tmp_path), Config())
    with served(app) as port:
        for name in ("report.json", "report.html", "packages/a/report.html"):
            answer = httpx.get(f"http://localhost:{port}{CHECK}/{name}")
            assert answer.status_code == 404
