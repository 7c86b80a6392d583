"""`subt-check serve`: one command, a web server and workers that live and end together."""

from __future__ import annotations

import http.client
import json
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path
from threading import Timer
from urllib.parse import urlsplit

import httpx
import pytest

from checker.base.output import EXIT_CRASH, EXIT_USAGE
from checker.service.client.connection import Connection
from checker.service.client.server import parse_server
from checker.service.client.upload import Upload
from tests.conftest import SAMPLES
from tests.effort import slowness
from tests.serving.conftest import SECONDS, Serve, Serving, command_of, environment_of, wait_for

EVERYWHERE = "0.0.0.0"  # noqa: S104 - that is what is tested
MODEL = ("robot.sdf", b"<sdf version='1.6'/>")
FIRST_UPLOAD_SECONDS = 2.5
"""Of processor time: it takes one."""
BROKEN = "broken_rover_sensor_config_1"


def get(url: str, path: str, **headers: str) -> tuple[int, bytes]:
    parts = urlsplit(url)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=SECONDS)
    connection.request("GET", path, headers=headers)
    answer = connection.getresponse()
    try:
        return answer.status, answer.read()
    finally:
        connection.close()


def test_its_first_line_is_its_address(serve: Serve) -> None:
    serving = serve("--workers", 0)
    assert serving.url.startswith("http://127.0.0.1:")
    assert serving.said == f"the service runs at {serving.url}\n"
    assert get(serving.url, "/healthz") == (200, b'{"status":"ok"}')
    assert not serving.workers()
    assert all(line.startswith('{"time"') for line in serving.told.splitlines())
    assert (serving.folder / "data").is_dir()


def test_a_first_upload_waits_for_little_work(serve: Serve) -> None:
    serving = serve("--workers", 2)
    url = serving.url
    answer = httpx.post(f"{url}/api/checks", files={"file": MODEL}, timeout=SECONDS)
    assert answer.status_code == 201
    work = sum(map(processor_seconds, (serving.id, *serving.web())))
    assert work < FIRST_UPLOAD_SECONDS * slowness()
    # What workers load would come in between; they come all the same.
    wait_for(lambda: len(serving.workers()) == 2)


def processor_seconds(process: int) -> float:
    """Return what a process has used of processors."""
    fields = Path(f"/proc/{process}/stat").read_text("ascii").rpartition(") ")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def test_what_is_sent_is_checked_and_told(serve: Serve, tmp_path: Path) -> None:
    serving = serve("--workers", 1)
    done = subprocess.run(
        [
            *(sys.executable, "-m", "checker.cli", "submit", SAMPLES / BROKEN),
            *("--server", serving.url, "--report", tmp_path / "report"),
        ],
        capture_output=True,
        check=False,
        env=environment_of(tmp_path),
        text=True,
        timeout=4 * SECONDS,
    )
    assert done.returncode == 1, done.stderr
    assert f"\n{BROKEN}: " in done.stdout
    files = {path.name for path in (tmp_path / "report").iterdir()}
    assert files == {"report.html", "report.json", "report.sarif", "robot.glb"}
    assert serving.stop() == 0


def test_a_worker_that_dies_is_followed_by_another_of_its_name(serve: Serve) -> None:
    serving = serve("--workers", 2)
    assert serving.url
    wait_for(lambda: len(serving.workers()) == 2)
    names = {command_of(each).split()[-1] for each in serving.workers()}
    dead = serving.workers()[0]
    os.kill(dead, signal.SIGKILL)
    wait_for(lambda: len(set(serving.workers()) - {dead}) == 2)
    assert {command_of(each).split()[-1] for each in serving.workers()} == names
    assert "was ended by SIGKILL; it restarts in 1 s\n" in serving.told


def test_workers_that_are_drained_stay_away(serve: Serve) -> None:
    serving = serve("--workers", 2)
    wait_for(lambda: serving.told.count("is waiting for checks") == 2)
    drain = [sys.executable, "-m", "checker.cli", "admin", "drain"]
    drain += ["--data", str(serving.folder / "data")]
    said = subprocess.run(drain, capture_output=True, check=True, text=True).stdout
    assert said.count("drains worker-") == 2
    wait_for(lambda: serving.told.count("has ended as it was told, and is not restarted") == 2)
    assert serving.workers() == []
    assert get(serving.url, "/healthz")[0] == 200
    assert serving.stop() == 0


def test_a_web_server_that_dies_is_followed_by_another_at_its_address(serve: Serve) -> None:
    serving = serve("--workers", 0)
    url = serving.url
    assert get(url, "/healthz")[0] == 200
    (dead,) = serving.web()
    os.kill(dead, signal.SIGKILL)
    # Who asks meanwhile waits.
    assert get(url, "/healthz")[0] == 200
    assert serving.web() != [dead]
    assert "the web server was ended by SIGKILL; it restarts" in serving.told


def processes_of(serving: Serving) -> list[int]:
    return [serving.id, *serving.web(), *serving.workers()]


def is_gone(process: int) -> bool:
    return not command_of(process)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_all_in_good_order(serve: Serve, number: int) -> None:
    serving = serve("--workers", 1)
    url = serving.url
    wait_for(serving.workers)
    processes = processes_of(serving)
    assert len(processes) == 3
    serving.process.send_signal(number)
    assert serving.process.wait(SECONDS) == 0
    assert all(map(is_gone, processes))
    assert "Finished server process" in serving.told
    with pytest.raises(ConnectionRefusedError):
        get(url, "/healthz")


def test_keys_at_a_terminal_reach_only_the_one_who_passes_them_on(serve: Serve) -> None:
    serving = serve("--workers", 1)
    assert serving.url
    wait_for(serving.workers)
    groups = {os.getpgid(each) for each in processes_of(serving)}
    assert len(groups) == 3


def test_a_second_signal_ends_all_at_once(serve: Serve) -> None:
    serving = serve("--workers", 1)
    assert serving.url
    wait_for(serving.workers)
    processes = processes_of(serving)
    # A worker that does not hear.
    os.kill(serving.workers()[0], signal.SIGSTOP)
    serving.process.send_signal(signal.SIGTERM)
    wait_for(lambda: "a second signal ends it immediately" in serving.told)
    assert serving.process.poll() is None
    serving.process.send_signal(signal.SIGTERM)
    assert serving.process.wait(SECONDS) == 3
    assert all(map(is_gone, processes))


def test_all_end_with_the_one_who_started_them(serve: Serve) -> None:
    serving = serve("--workers", 1)
    assert serving.url
    wait_for(serving.workers)
    processes = processes_of(serving)
    os.kill(serving.id, signal.SIGKILL)
    wait_for(lambda: all(map(is_gone, processes[1:])))


def refused(serving: Serving, reason: str, code: int = EXIT_USAGE) -> None:
    assert serving.process.wait(SECONDS) == code
    assert serving.said == ""
    assert reason in serving.told
    assert "Traceback" not in serving.told


def test_others_are_let_in_only_on_purpose(serve: Serve) -> None:
    refused(
        serve("--host", EVERYWHERE), "can be reached from other machines; set SUBT_CHECK_TOKENS"
    )
    refused(serve("--host", "::"), "or allow everybody with --public")


def test_everybody_is_let_in_by_name(serve: Serve) -> None:
    serving = serve("--host", EVERYWHERE, "--public", "--workers", 0)
    port = urlsplit(serving.url).port
    assert serving.url == f"http://0.0.0.0:{port}"
    assert "everybody who can reach the service may upload (--public)\n" in serving.told
    assert get(f"http://127.0.0.1:{port}", "/", Host="check.example")[0] == 200


def test_with_tokens_any_address_is_fine(serve: Serve) -> None:
    environment = {"SUBT_CHECK_TOKENS": "s3cret,0ther"}
    serving = serve("--host", EVERYWHERE, "--workers", 0, **environment)
    assert get(f"http://127.0.0.1:{urlsplit(serving.url).port}", "/healthz")[0] == 200
    assert "everybody" not in serving.told
    assert "s3cret" not in "".join(map(command_of, processes_of(serving)))


@pytest.mark.parametrize(
    ("options", "environment", "reason"),
    [
        (("--host", "nobody.invalid"), {}, "nobody.invalid port 0 cannot be used"),
        (("--host", "192.0.2.1"), {}, "choose another --host or --port"),
        ((), {"SUBT_CHECK_UPLOAD_LIMIT": "much"}, "SUBT_CHECK_UPLOAD_LIMIT is 'much'"),
        (("--base-url", "here"), {}, "SUBT_CHECK_BASE_URL is 'here'"),
        (
            (),
            {"SUBT_CHECK_DATABASE_URL": "sqlite://"},
            "SUBT_CHECK_DATABASE_URL is not the address",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(
    serve: Serve, options: tuple[str, ...], environment: dict[str, str], reason: str
) -> None:
    refused(serve(*options, **environment), reason)


def test_a_database_that_is_damaged_is_said_once(serve: Serve, tmp_path: Path) -> None:
    (tmp_path / "jobs.sqlite").write_bytes(b"no page of a database" * 999)
    serving = serve("--data", tmp_path)
    said = f"file is not a database (sqlite:///{tmp_path}/jobs.sqlite)\n"
    refused(serving, said, EXIT_CRASH)
    assert serving.told.count("\n") == 1


def test_a_port_that_is_taken_is_refused(serve: Serve) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        refused(serve("--port", port), f"127.0.0.1 port {port} cannot be used (Address already")


def test_a_port_is_waited_for_until_its_last_holder_has_ended(serve: Serve) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        Timer(1.0, taken.close).start()  # the command takes less until it asks for the port
        serving = serve("--workers", 0, "--port", port)
        assert get(serving.url, "/healthz")[0] == 200


def test_a_place_for_data_that_is_none_is_refused(serve: Serve, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    for place in ("file", "file/data", "/proc/data"):
        serving = serve("--workers", 0, "--data", tmp_path / place)
        refused(serving, f"{tmp_path / place} cannot be used for the service's data")


@pytest.mark.parametrize(("options", "believed"), [((), False), (("--behind-proxy",), True)])
def test_a_proxy_is_believed_only_where_there_is_one(
    serve: Serve, options: tuple[str, ...], believed: bool
) -> None:
    serving = serve("--workers", 0, "--public", *options)
    status, body = get(serving.url, "/healthz", **{"X-Forwarded-Proto": "https"})
    assert status == 200
    headers = headers_of(serving.url, {"X-Forwarded-Proto": "https"})
    assert ("strict-transport-security" in headers) == believed
    assert body


def headers_of(url: str, headers: dict[str, str]) -> dict[str, str]:
    parts = urlsplit(url)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=SECONDS)
    connection.request("GET", "/", headers=headers)
    answer = connection.getresponse()
    connection.close()
    return {name.lower(): value for name, value in answer.getheaders()}


def test_the_public_address_is_the_one_of_links(serve: Serve, tmp_path: Path) -> None:
    serving = serve("--workers", 0, "--base-url", "https://check.example")
    model = tmp_path / "robot.sdf"
    model.write_text("<sdf version='1.6'/>", "utf-8")
    connection = Connection(parse_server(serving.url))
    said = json.loads(connection.ask("POST", "/api/checks", Upload(model)).body)
    assert said["url"] == f"https://check.example/checks/{said['id']}"


def test_a_worker_joins_and_leaves(serve: Serve, tmp_path: Path) -> None:
    serving = serve("--workers", 0)
    url = serving.url
    assert get(url, "/readyz")[0] == 503
    with (tmp_path / "said").open("wb") as said:
        worker = subprocess.Popen(
            [
                *(sys.executable, "-m", "checker.cli", "worker", "--jobs", "1"),
                *("--name", "extra", "--data", serving.folder / "data"),
            ],
            stdout=said,
            stderr=said,
            env=environment_of(tmp_path),
        )
    try:
        wait_for(lambda: get(url, "/readyz")[0] == 200)
        worker.send_signal(signal.SIGTERM)
        assert worker.wait(SECONDS) == 0
        wait_for(lambda: get(url, "/readyz")[0] == 503)
    finally:
        worker.kill()
        worker.wait()
    assert not (tmp_path / "data").exists()
