"""Uploads: those that are taken lie in the store, all others leave nothing behind."""

from __future__ import annotations

import io
import json
import os
import shutil
import socket
import sys
import tarfile
import zipfile
from collections.abc import Callable
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from threading import Event, Thread
from time import monotonic, sleep

import httpx
import pytest
from fastapi.testclient import TestClient

from checker.service.jobs.port import JobsUnreachable, Order, Receipt
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.limits import space
from checker.service.web.uploads.transfer import AT_ONCE
from support.disk import small_disk
from tests.web.board import ID, BoardJobs
from tests.web.server import BOUNDARY, eventually, form, left_behind, request_head, served
from tests.web.test_archive_indexes import read_by

LIMIT = 600_000
CUT = 'refused_total{cause="cut"} 1.0'


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


@pytest.fixture
def jobs() -> BoardJobs:
    return BoardJobs()


@pytest.fixture
def client(jobs: BoardJobs, store: Store) -> TestClient:
    app = create_app(jobs, store, Config(upload_limit=LIMIT))
    return TestClient(app, base_url="http://localhost")


def zipped(*entries: tuple[str, bytes]) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            archive.writestr(zipfile.ZipInfo(name), content, zipfile.ZIP_DEFLATED)
    return file.getvalue()


def linked() -> bytes:
    file = io.BytesIO()
    with tarfile.open(fileobj=file, mode="w:gz") as archive:
        info = tarfile.TarInfo("rover/model.sdf")
        info.type, info.linkname = tarfile.SYMTYPE, "/etc/passwd"
        archive.addfile(info)
    return file.getvalue()


GOOD = zipped(("rover/model.sdf", b"<sdf/>"))


def test_an_upload_is_kept_and_its_check_ordered(
    client: TestClient, jobs: BoardJobs, store: Store
) -> None:
    answer = client.post("/api/checks", files={"file": ("my rover.zip", GOOD)})
    assert answer.status_code == 201
    given = answer.json()
    assert (given["id"], given["url"]) == (ID, f"http://localhost/checks/{ID}")
    assert answer.headers["location"] == f"/api/checks/{ID}"
    order = jobs.states[ID].order
    assert order.name == "my_rover.zip"
    kept = store.upload(order.upload)
    assert kept is not None
    assert kept.read_bytes() == GOOD
    assert left_behind(store) == [kept]


MANY = [(f"rover/{number}", b"") for number in range(5_001)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("bomb.zip", zipped(("rover/mesh.dae", bytes(60_000_000))), "200 times the size"),
        ("escape.zip", zipped(("../../etc/cron.d/x", b"x")), "leads out of the archive"),
        ("absolute.zip", zipped(("/etc/x", b"x")), "is an absolute path"),
        ("control.zip", zipped(("rover/a\nb", b"x")), "control characters"),
        ("case.zip", zipped(("rover/a", b"x"), ("rover/A", b"x")), "upper and lower case"),
        ("many.zip", zipped(*MANY), "5000 entries"),
        ("link.tar.gz", linked(), "is a symbolic link"),
        ("empty.zip", zipped(), "contains no files"),
        ("cut.zip", GOOD[:40], "not a zip archive, or is cut off"),
    ],
)
def test_an_archive_that_may_do_harm_is_refused_with_its_reason(
    client: TestClient, jobs: BoardJobs, store: Store, name: str, content: bytes, said: str
) -> None:
    answer = client.post("/api/checks", files={"file": (name, content)})
    assert answer.status_code == 422
    assert name in answer.json()["error"]
    assert said in answer.json()["error"]
    assert answer.json()["advice"]
    assert not jobs.states
    assert not left_behind(store)


def test_a_file_at_the_limit_is_taken_and_one_byte_more_is_not(
    client: TestClient, store: Store
) -> None:
    model = b"<sdf>".ljust(LIMIT)
    assert client.post("/api/checks", files={"file": ("a.sdf", model)}).status_code == 201
    (kept,) = left_behind(store)
    answer = client.post("/api/checks", files={"file": ("a.sdf", model + b" ")})
    assert answer.status_code == 413
    assert "0.6 MB" in answer.json()["error"]
    assert left_behind(store) == [kept]


def test_a_profile_that_is_none_is_refused(client: TestClient, store: Store) -> None:
    answer = client.post("/api/checks", data={"profile": "moon"}, files={"file": ("a.zip", GOOD)})
    assert answer.status_code == 422
    assert "gazebo-harmonic" in answer.json()["advice"]
    assert not left_behind(store)


def test_an_order_that_the_engine_cannot_take_is_said(store: Store) -> None:
    class Away(BoardJobs):
        def submit(self, order: Order, key: str = "") -> Receipt:
            raise JobsUnreachable(order.name + key)

    client = TestClient(create_app(Away(), store, Config()), base_url="http://localhost")
    answer = client.post("/api/checks", files={"file": ("a.zip", GOOD)})
    assert answer.status_code == 503
    assert int(answer.headers["retry-after"]) > 0


def test_a_full_disk_is_said(client: TestClient, store: Store) -> None:
    store.folder.write_bytes(b"")  # where a folder is expected
    answer = client.post("/api/checks", files={"file": ("a.zip", GOOD)})
    assert answer.status_code == 503
    assert "cannot keep the upload" in answer.json()["error"]


def test_a_disk_that_gets_full_meanwhile_is_said(
    store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    def free(_: Path) -> int:
        return 0 if any(store.folder.glob("incoming/*")) else 10**12

    monkeypatch.setattr(space, "_free_bytes", free)
    with TestClient(create_app(BoardJobs(), store, Config(public=True))) as client:
        answer = client.post("/api/checks", files={"file": ("a.zip", noise())})
        assert answer.status_code == 503
        assert answer.json()["error"].endswith("No space left on device.")
        assert not left_behind(store)
        # It is within what is reserved at first.
        assert client.post("/api/checks", files={"file": ("a.zip", GOOD)}).status_code == 201


Talk = Callable[[socket.socket], None]


def answer_to(store: Store, config: Config, talk: Talk) -> tuple[int, dict[str, str]]:
    """Return status and words of what a server answers to bytes that a test sends."""
    with served(create_app(BoardJobs(), store, config)) as port:
        with socket.create_connection(("127.0.0.1", port), timeout=30) as connection:
            talk(connection)
            received = b""
            while piece := connection.recv(65_536):
                received += piece
        head, _, body = received.partition(b"\r\n\r\n")
        assert eventually(lambda: not left_behind(store))
        return int(head.split()[1]), json.loads(body)


@pytest.mark.service
def test_a_slow_upload_is_refused(store: Store) -> None:
    def talk(connection: socket.socket) -> None:
        connection.sendall(request_head(100_000) + form("a.zip", GOOD)[:80])

    status, words = answer_to(store, Config(idle_seconds=0.3), talk)
    assert status == 408
    assert "too slow" in words["error"]


@pytest.mark.service
def test_an_upload_that_trickles_is_refused(store: Store) -> None:
    def talk(connection: socket.socket) -> None:
        connection.sendall(request_head(100_000))
        connection.settimeout(0.05)
        for byte in form("a.zip", GOOD) * 10:
            connection.sendall(bytes([byte]))
            try:
                if connection.recv(1, socket.MSG_PEEK):
                    break
            except TimeoutError:
                continue
        connection.settimeout(30)

    status, _ = answer_to(store, Config(idle_seconds=1, slowest=10_000), talk)
    assert status == 408


@pytest.mark.service
def test_an_upload_that_comes_steadily_ends_after_its_time_all_the_same(store: Store) -> None:
    def talk(connection: socket.socket) -> None:
        connection.sendall(request_head(500_000) + form("a.sdf", b"<sdf/>")[:-20])
        with suppress(OSError):
            for _ in range(60):
                connection.sendall(b" " * 1_000)
                sleep(0.02)

    status, words = answer_to(store, Config(upload_seconds=0.5, steady=1_000_000), talk)
    assert status == 408
    assert "at most 1 s" in words["error"]


def are_coming(store: Store, number: int) -> bool:
    """Whether so many uploads are under way."""
    return len([*store.folder.glob("incoming/*")]) == number


@pytest.mark.service
def test_one_address_holds_so_many_bytes_of_uploads_and_no_more(store: Store) -> None:
    config = Config(upload_limit=LIMIT)
    with served(create_app(BoardJobs(), store, config)) as port, ExitStack() as stack:
        for number in range(1, 6):
            connection = socket.create_connection(("127.0.0.1", port))
            stack.enter_context(connection).sendall(request_head(LIMIT))
            assert eventually(partial(are_coming, store, number))
        address = f"http://localhost:{port}/api/checks"
        answer = httpx.post(address, files={"file": ("a.zip", GOOD)})
        assert answer.status_code == 503
        assert "3 MB are in progress from this address" in answer.json()["error"]
        stack.close()
        assert eventually(lambda: not left_behind(store))
        assert httpx.post(address, files={"file": ("a.zip", GOOD)}).status_code == 201


@pytest.mark.service
def test_an_upload_that_is_announced_too_large_is_refused_before_it_comes(store: Store) -> None:
    def talk(connection: socket.socket) -> None:
        connection.sendall(request_head(200_000_000))

    status, words = answer_to(store, Config(), talk)
    assert status == 413
    assert "100 MB" in words["error"]


@pytest.mark.service
def test_a_client_that_sends_all_the_same_gets_to_know_why_not(store: Store) -> None:
    def talk(connection: socket.socket) -> None:
        connection.sendall(request_head(20_000_000))
        for _ in range(20):
            connection.sendall(bytes(1_000_000))

    status, _ = answer_to(store, Config(upload_limit=LIMIT), talk)
    assert status == 413


@pytest.mark.service
def test_an_upload_of_unknown_length_is_cut_at_the_limit(store: Store) -> None:
    config = Config(upload_limit=LIMIT)
    whole = form("a.sdf", b"<sdf>".ljust(LIMIT + 1))
    with served(create_app(BoardJobs(), store, config)) as port:
        answer = httpx.post(
            f"http://localhost:{port}/api/checks",
            content=(whole[at : at + 10_000] for at in range(0, len(whole), 10_000)),
            headers={"Content-Type": f"multipart/form-data; boundary={BOUNDARY}"},
        )
        assert answer.status_code == 413
        assert eventually(lambda: not left_behind(store))


@pytest.mark.service
@pytest.mark.parametrize("sent", [0, 60, 200, 40_000, 3 * AT_ONCE])
def test_an_upload_that_is_cut_off_leaves_nothing(store: Store, sent: int) -> None:
    whole = form("a.sdf", b"<sdf>".ljust(4 * AT_ONCE))
    jobs = BoardJobs()
    with served(create_app(jobs, store, Config())) as port:
        with socket.create_connection(("127.0.0.1", port)) as connection:
            connection.sendall(request_head(len(whole)) + whole[:sent])
            assert eventually(lambda: bool(left_behind(store)))
        assert eventually(lambda: CUT in httpx.get(f"http://localhost:{port}/metrics").text)
        assert not left_behind(store)
        answer = httpx.get(f"http://localhost:{port}/healthz")
        assert answer.status_code == 200
    assert not jobs.states


def trickle(port: int, stop: Event) -> None:
    """Send an upload that never stands still and never ends."""
    with socket.create_connection(("127.0.0.1", port)) as connection:
        connection.sendall(request_head(10_000_000) + form("slow.sdf", b"<sdf/>")[:200])
        while not stop.is_set():
            connection.sendall(b" " * 100)
            sleep(0.004)


@pytest.mark.service
def test_slow_senders_keep_nobody_waiting(store: Store) -> None:
    stop = Event()
    with served(create_app(BoardJobs(), store, Config())) as port, ExitStack() as stack:
        stack.callback(stop.set)
        for _ in range(10):
            Thread(target=trickle, args=(port, stop), daemon=True).start()
        assert eventually(lambda: len([*store.folder.glob("incoming/*")]) == 10)
        begun = monotonic()
        answer = httpx.post(
            f"http://localhost:{port}/api/checks",
            content=form("quick.sdf", b"<sdf/>"),
            headers={"Content-Type": f"multipart/form-data; boundary={BOUNDARY}"},
            timeout=30,
        )
        assert answer.status_code == 201
        # Theirs would have lasted for minutes; this is for a machine that does much else.
        assert monotonic() - begun < 15
        assert len([*store.folder.glob("incoming/*")]) >= 10


DISTURBED = """
def serve(wire):
    wire.recv(4096)
    wire.sendall(b'{"momentary": "Input/output error"}\\n')
"""


def test_a_fault_of_the_system_is_none_of_the_archive(
    client: TestClient,
    jobs: BoardJobs,
    store: Store,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    read_by(DISTURBED, tmp_path, monkeypatch)
    answer = client.post("/api/checks", files={"file": ("a.zip", GOOD)})
    assert answer.status_code == 503
    assert answer.json()["error"] == "The service cannot look at a.zip now: Input/output error."
    assert int(answer.headers["retry-after"]) > 0
    assert not jobs.states
    assert not left_behind(store)


SLOW = """
import json, os, socket, time
def serve(wire):
    message, _, _, _ = socket.recv_fds(wire, 4096, 1)
    if json.loads(message)["name"] == "slow.zip":
        time.sleep(60)
    wire.sendall(b"{}\\n")
"""


@pytest.mark.service
@pytest.mark.skipif(sys.platform != "linux", reason="the system has one address of its own")
def test_slow_archives_of_one_sender_keep_nobody_else_waiting(
    store: Store, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_by(SLOW, tmp_path, monkeypatch)

    def send(port: int, source: str, name: str) -> int:
        transport = httpx.HTTPTransport(local_address=source)
        with httpx.Client(transport=transport, timeout=30) as client:
            address = f"http://127.0.0.1:{port}/api/checks"
            return client.post(address, files={"file": (name, GOOD)}).status_code

    def send_slow(port: int) -> None:
        with suppress(httpx.HTTPError):
            send(port, "127.0.0.2", "slow.zip")

    with served(create_app(BoardJobs(), store, Config())) as port:
        for _ in range(40):
            Thread(target=send_slow, args=(port,), daemon=True).start()
        assert eventually(lambda: len([*store.folder.glob("incoming/*")]) == 40)
        begun = monotonic()
        for _ in range(5):
            assert send(port, "127.0.0.1", "quick.zip") == 201
        assert monotonic() - begun < 15  # a single slow one would last for a minute


ASLEEP = """
import socket, time
def serve(wire):
    _, (descriptor,), _, _ = socket.recv_fds(wire, 4096, 1)
    time.sleep(2)
    wire.sendall(b"{}\\n")
"""


@pytest.mark.root
@pytest.mark.service
@pytest.mark.skipif(sys.platform != "linux", reason="the system has one address of its own")
def test_the_copies_that_indexes_are_read_from_have_their_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    read_by(ASLEEP, tmp_path, monkeypatch)
    config = Config(public=True, upload_limit=1_000_000)
    answers: list[int] = []

    def send(port: int, source: str, content: bytes) -> None:
        transport = httpx.HTTPTransport(local_address=source)
        with httpx.Client(transport=transport, timeout=30) as client:
            address = f"http://127.0.0.1:{port}/api/checks"
            answer = client.post(address, files={"file": ("a.zip", content)})
            answers.append(answer.status_code)

    with small_disk(tmp_path / "disk", 5_050_000) as disk:
        store = Store(disk / "data")
        store.folder.mkdir()
        free = [shutil.disk_usage(disk).free]
        with served(create_app(BoardJobs(), store, config)) as port:
            senders = [
                Thread(target=send, args=(port, f"127.0.0.{number + 2}", noise()))
                for number in range(3)
            ]
            for each in senders:
                each.start()
            while any(each.is_alive() for each in senders):
                free.append(shutil.disk_usage(disk).free)
                sleep(0.01)
    assert 201 in answers
    assert min(free) >= config.room


def noise() -> bytes:
    return zipped(("rover/noise.png", os.urandom(900_000)))
