"""Whatever a server does, the client ends with an answer or a sentence."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest

from checker.base.errors import CheckerError
from checker.service.client.connection import Answer, Connection, Patience
from checker.service.client.server import parse_server
from checker.service.client.upload import Upload
from tests.submitting.conftest import QUICK, Asked, Service, StartService, answer, in_turn


def connection_to(service: Service, token: str = "", patience: Patience = QUICK) -> Connection:
    return Connection(parse_server(service.url), token, patience)


def ask(service: Service, **options: int) -> Answer:
    return connection_to(service).ask("GET", "/api/checks/x", **options)


def test_an_answer(start_service: StartService) -> None:
    service = start_service(in_turn(answer(200, {"a": 1}, X_Y="z")))
    said = connection_to(service, "secret").ask("GET", "/api/checks/x")
    assert (said.status, said.read_as(dict), said.headers["x-y"]) == (200, {"a": 1}, "z")
    (asked,) = service.asked
    assert asked.headers["authorization"] == "Bearer secret"
    assert asked.headers["host"] == f"127.0.0.1:{service.port}"


def test_no_token_no_header(start_service: StartService) -> None:
    service = start_service(in_turn(answer(200)))
    ask(service)
    assert "authorization" not in service.asked[0].headers


def test_the_path_of_the_address_stands_before_all_others(start_service: StartService) -> None:
    service = start_service(in_turn(answer(200)))
    Connection(parse_server(service.url + "/subt/"), "", QUICK).ask("GET", "/api/checks/x")
    assert service.lines == ["GET /subt/api/checks/x"]


@pytest.mark.parametrize("status", [408, 429, 502, 503, 504])
def test_a_busy_service_is_asked_again(start_service: StartService, status: int) -> None:
    busy = answer(status, "x", Retry_After="0")
    service = start_service(in_turn(busy, busy, answer(200, "1")))
    assert ask(service).read_as(int) == 1
    assert len(service.asked) == 3


def test_a_service_is_left_alone_as_long_as_it_wants(start_service: StartService) -> None:
    service = start_service(in_turn(answer(429, "x", Retry_After="1"), answer(200)))
    started = time.monotonic()
    ask(service)
    assert time.monotonic() - started >= 1.0


@pytest.mark.parametrize("wanted", ["3600", "999999999"])
def test_nobody_waits_for_an_hour(start_service: StartService, wanted: str) -> None:
    service = start_service(in_turn(answer(503, "x", Retry_After=wanted)))
    with pytest.raises(CheckerError, match="answers 503; try again later"):
        ask(service)
    assert len(service.asked) == 1


@pytest.mark.parametrize("wanted", ["", "-1", "soon", "Fri, 31 Dec 1999 23:59:59 GMT", "9" * 5000])
def test_a_wish_that_is_no_number_counts_as_none(start_service: StartService, wanted: str) -> None:
    service = start_service(in_turn(answer(503, "x", Retry_After=wanted), answer(200)))
    assert ask(service).status == 200


@pytest.mark.parametrize(
    "said",
    [
        b"",
        b"HTTP/1.1 200 OK\r\nContent-Length: 100\r\n\r\nshort",
        b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nab",
        b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nmany\r\nab",
        b"HTTP/1.1 200 OK\r\nContent-Le",
        b"\x00\xff garbage \x1b[31m\r\n\r\n",
        b"HTTP/1.1 2000000 OK\r\n\r\n",
        b"HTTP/1.1 200 OK\r\n" + b"X: y\r\n" * 200 + b"\r\n",
        b"HTTP/1.1 200 OK\r\nX: " + b"y" * 100_000 + b"\r\n\r\n",
    ],
    ids=range(9),
)
def test_what_is_cut_off_or_no_answer_is_asked_for_again(
    start_service: StartService, said: bytes
) -> None:
    service = start_service(in_turn(said, answer(200, "1")))
    assert ask(service).read_as(int) == 1
    assert len(service.asked) == 2


def test_trouble_ends_in_a_sentence(start_service: StartService) -> None:
    service = start_service(in_turn(b"\x1b[31mgarbage\r\n\r\n"))
    with pytest.raises(CheckerError, match=r"does not answer \(.*\); try again later") as raised:
        ask(service)
    assert str(raised.value).isprintable()
    assert len(service.asked) > 2


def test_an_endless_answer_is_not_read(start_service: StartService) -> None:
    def endless(_: Asked) -> None:
        assert service.connection is not None
        service.connection.sendall(b"HTTP/1.1 200 OK\r\n\r\n")
        while True:
            service.connection.sendall(b"x" * 65536)

    service = start_service(endless)
    with pytest.raises(CheckerError, match=r"answers with more than 0\.1 MB"):
        ask(service, limit=100_000)


@pytest.mark.parametrize("start", [b"", b"HTTP/1.1 200 OK\r\n\r\n", b"HTTP/1.1 100 Go on\r\n"])
def test_an_answer_that_drips_is_cut_off(start_service: StartService, start: bytes) -> None:
    def drip(_: Asked) -> None:
        assert service.connection is not None
        service.connection.sendall(start)
        while True:
            service.connection.sendall(b"x")
            time.sleep(0.05)

    service = start_service(drip)
    patience = Patience(silence=5.0, answer=0.5, trouble=0.6, pause=0.3)
    with pytest.raises(CheckerError, match=r"takes longer than 0\.5 s to answer; try again later"):
        connection_to(service, patience=patience).ask("GET", "/x")


def test_a_silent_server_is_not_waited_for(start_service: StartService) -> None:
    service = start_service(lambda _: time.sleep(2))  # type: ignore[func-returns-value]
    patience = Patience(silence=0.2, answer=60.0, trouble=0.3, pause=0.2)
    with pytest.raises(CheckerError, match=r"does not answer \(timed out\)"):
        connection_to(service, patience=patience).ask("GET", "/x")


@pytest.mark.parametrize("method", ["GET", "POST", "DELETE"])
@pytest.mark.parametrize("status", [301, 302, 303, 307, 308])
def test_a_token_is_not_carried_elsewhere(
    start_service: StartService, model: Path, method: str, status: int
) -> None:
    other = start_service(in_turn(answer(200, {"id": "x" * 22})))
    service = start_service(in_turn(answer(status, "x", Location=f"{other.url}/\x1bx")))
    upload = Upload(model) if method == "POST" else None
    with pytest.raises(CheckerError, match=r"redirects to http.*give this address") as raised:
        connection_to(service, "secret").ask(method, "/api/checks", upload)
    assert str(raised.value).isprintable()
    assert not other.asked
    assert len(service.asked) == 1


def test_a_large_upload_that_is_refused_at_once_tells_why(
    start_service: StartService, tmp_path: Path
) -> None:
    file = tmp_path / "large.zip"
    with file.open("wb") as sparse:
        sparse.truncate(50_000_000)
    service = start_service(in_turn(answer(500)))
    service.early = lambda _: answer(413, {"error": "The file is too large."})
    said = connection_to(service).ask("POST", "/api/checks", Upload(file))
    assert said.status == 413
    assert said.read_as(dict) == {"error": "The file is too large."}


def test_an_upload_is_sent_whole_again(start_service: StartService, model: Path) -> None:
    service = start_service(in_turn(answer(503, "x"), b"", answer(201, "1")))
    upload = Upload(model, "sdf")
    assert connection_to(service).ask("POST", "/api/checks", upload).status == 201
    assert len(service.asked) == 3
    for asked in service.asked:
        assert asked.body.count(model.read_bytes()) == 1
        assert len(asked.body) == int(asked.headers["content-length"])


@pytest.mark.service
def test_a_name_that_nobody_has_is_not_asked_again() -> None:
    started = time.monotonic()
    with pytest.raises(CheckerError, match=r"http://nobody\.invalid cannot be reached: "):
        Connection(parse_server("http://nobody.invalid")).ask("GET", "/x")
    assert time.monotonic() - started < 60


def test_a_service_that_is_gone(start_service: StartService) -> None:
    service = start_service(in_turn(answer(200)))
    service.close()
    with pytest.raises(CheckerError, match=r"does not answer \(Connection refused\); try again"):
        ask(service)


def test_an_answer_that_is_no_json() -> None:
    for body in (b"", b"<html>", b"\xff", b'"\xff"', b"[" * 100_000, b'{"a":' * 100_000):
        assert Answer(200, {}, body).read_as(dict) is None
    assert Answer(200, {}, json.dumps([1]).encode()).read_as(list) == [1]
