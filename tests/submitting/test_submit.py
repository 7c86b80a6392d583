"""`subt-check submit` in a process of its own, against a service that answers as a test wants."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from checker.finding import Severity
from checker.pipeline import check_paths
from checker.report.json_report import to_json
from checker.report.report import Report
from tests.command.conftest import BROKEN, GOOD, clean_environment
from tests.conftest import SAMPLES
from tests.report.any_report import many
from tests.submitting.conftest import (
    ID,
    SECRET,
    Asked,
    Service,
    StartService,
    Submit,
    answer,
    checking,
)

DONE: dict[str, object] = {"stage": "done", "words": "1 package"}
RUNNING: dict[str, object] = {"stage": "static", "words": "the rules look", "ahead": 0}


def report_of(name: str) -> str:
    """Return the report of a sample as a service writes it: paths start at the upload's name."""
    (package,) = check_paths([SAMPLES / name], {"trial": False}).packages
    said = json.loads(to_json(Report((package,), {"subt-check": "1.0"})))
    said["packages"][0]["path"] = f"{name}.zip/{name}"
    return json.dumps(said)


@pytest.mark.parametrize(("name", "code"), [(GOOD, 0), (BROKEN, 1)])
def test_findings_are_told_as_the_check_of_here_tells_them(
    start_service: StartService, submit: Submit, tmp_path: Path, name: str, code: int
) -> None:
    service = start_service(checking(RUNNING, DONE, report=report_of(name)))
    (tmp_path / name).symlink_to(SAMPLES / name)
    done = submit(name, "--server", service.url)
    alone = subprocess.run(
        [sys.executable, "-m", "checker.cli", name, "--no-trial"],
        capture_output=True,
        check=False,
        cwd=tmp_path,
        text=True,
    )
    assert (done.returncode, done.stdout) == (code, alone.stdout)
    assert done.stderr == f"subt-check: the check is at {service.url}/checks/{ID}\n"


def test_a_folder_is_sent_as_an_archive_of_its_name(
    start_service: StartService, submit: Submit, tmp_path: Path
) -> None:
    service = start_service(checking(DONE))
    (tmp_path / "rover").mkdir()
    (tmp_path / "rover/model.sdf").write_text("<sdf/>", "utf-8")
    (tmp_path / "rover/link").symlink_to("model.sdf")
    done = submit("rover", "--server", service.url, "--profile", "sdf")
    sent = service.asked[0]
    assert sent.headers["content-type"].startswith("multipart/form-data; boundary=")
    assert b'name="profile"\r\n\r\nsdf\r\n' in sent.body
    assert b'filename="rover.zip"' in sent.body
    assert b"PK\x03\x04" in sent.body
    assert "rover: 1 link left out, because archives cannot contain them: link\n" in done.stderr


def test_a_model_file_of_a_package_is_sent_with_a_warning(
    start_service: StartService, submit: Submit, tmp_path: Path, model: Path
) -> None:
    service = start_service(checking(DONE))
    assert "without its meshes" not in submit(model, "--server", service.url).stderr
    (tmp_path / "model.config").write_text("<model/>", "utf-8")
    assert "robot.sdf is sent without its meshes;" in submit(model, "--server", service.url).stderr
    assert b"<model name='robot'/>" in service.asked[0].body


def test_the_exit_code_follows_severities(
    start_service: StartService, submit: Submit, model: Path
) -> None:
    service = start_service(checking(DONE, report=to_json(many(1, severity=Severity.WARNING))))
    assert submit(model, "--server", service.url).returncode == 0
    assert submit(model, "--server", service.url, "--fail-on", "warning").returncode == 1


def test_files_are_written_where_they_are_wanted(
    start_service: StartService, submit: Submit, model: Path, tmp_path: Path
) -> None:
    names = ["report.json", "report.html", "packages/index.html", "packages/../../robot.glb"]
    addresses = [f"/api/checks/{ID}/{name}" for name in names]
    standing = DONE | {"files": [*addresses, "/etc/passwd", "packages/..%2f..%2frobot.glb"]}
    service = start_service(
        checking(standing, report_html=b"<p>page</p>", index_html=b"<p>all</p>")
    )
    options = ("--report", "there/all", "--output", "one.html", "--format", "html")
    done = submit(model, "--server", service.url, *options)
    assert (done.returncode, done.stdout) == (1, "")
    assert (tmp_path / "one.html").read_bytes() == b"<p>page</p>"
    written = {path.name: path.read_bytes() for path in (tmp_path / "there/all").iterdir()}
    assert written.pop("report.json") == to_json(many(1)).encode()
    assert written == {"report.html": b"<p>page</p>", "index.html": b"<p>all</p>"}
    assert {path.name for path in tmp_path.iterdir()} == {"robot.sdf", "there", "one.html"}


def test_the_report_in_json_is_the_one_of_the_service(
    start_service: StartService, submit: Submit, model: Path
) -> None:
    written = json.dumps({**json.loads(to_json(many(1))), "later": {"version": [2]}})
    service = start_service(checking(DONE, report=written))
    assert submit(model, "--server", service.url, "--format", "json").stdout == written


def refused(done: subprocess.CompletedProcess[str], reason: str) -> None:
    assert (done.returncode, done.stdout) == (2, ""), done
    assert reason in done.stderr
    assert done.stderr.replace("\n", "").isprintable()


@pytest.mark.parametrize(
    ("status", "said", "reason"),
    [
        (401, {"error": "A token is needed.", "advice": "Bring one."}, "needed. Bring one."),
        (
            413,
            {"error": "Too large.\x1b[31m", "advice": None},
            "Too large.\N{REPLACEMENT CHARACTER}",
        ),
        (415, {"error": "x" * 100_000, "advice": ""}, "xxx…"),
        (500, "<h1>Oops</h1>", "answers 500, but not like a subt-check service"),
        (200, "<h1>Welcome</h1>", "answers 200, but not like a subt-check service"),
        (201, {"id": "../../x"}, "answers 201, but not like"),
        (201, {"id": 3}, "answers 201, but not like"),
        (201, {"id": ID, "secret": "x\r\ny"}, "answers 201, but not like"),
        (201, {"id": ID}, "answers 201, but not like"),
        (201, [], "answers 201, but not like"),
    ],
)
def test_an_upload_that_is_not_taken(
    start_service: StartService, submit: Submit, model: Path, status: int, said: object, reason: str
) -> None:
    service = start_service(lambda _: answer(status, said))
    refused(submit(model, "--server", service.url), reason)
    assert len(service.asked) == 1


def test_a_package_that_the_check_refuses(
    start_service: StartService, submit: Submit, model: Path
) -> None:
    state: dict[str, object] = {"stage": "refused", "words": "the upload cannot be checked: it is"}
    service = start_service(checking(RUNNING, state))
    refused(submit(model, "--server", service.url), "the upload cannot be checked: it is")


@pytest.mark.parametrize(
    ("state", "reason"),
    [
        ({"stage": "failed", "words": "the checker could not finish: it died"}, "finish: it died"),
        ({"stage": "cancelled", "words": ""}, "the check was cancelled"),
        ({"mood": "good"}, "answers 200, but not like"),
        ({"stage": 7}, "answers 200, but not like"),
    ],
)
def test_a_check_that_does_not_finish(
    start_service: StartService, submit: Submit, model: Path, state: dict[str, object], reason: str
) -> None:
    service = start_service(checking(RUNNING, state))
    done = submit(model, "--server", service.url)
    assert (done.returncode, done.stdout) == (3, "")
    assert reason in done.stderr


@pytest.mark.parametrize(
    ("report", "reason"),
    [
        ("<html>", "the report is not JSON"),
        ('{"schema_version": "7"}', "schema_version is '7', expected '1'"),
        ("[" * 100_000, "the report is not JSON"),
    ],
)
def test_a_report_that_is_none(
    start_service: StartService, submit: Submit, model: Path, report: str, reason: str
) -> None:
    service = start_service(checking(DONE, report=report))
    done = submit(model, "--server", service.url)
    assert (done.returncode, done.stdout) == (3, "")
    assert reason in done.stderr


def test_a_check_that_the_service_forgot(
    start_service: StartService, submit: Submit, model: Path
) -> None:
    def respond(asked: Asked) -> bytes:
        posted = asked.method == "POST"
        return (
            answer(201, {"id": ID, "secret": SECRET})
            if posted
            else answer(404, {"error": "There is nothing."})
        )

    done = submit(model, "--server", start_service(respond).url)
    assert done.returncode == 3
    assert "There is nothing." in done.stderr


@pytest.mark.parametrize("name", ["nowhere.zip", "n" * 10_000, "notes.txt", "empty", "pipe.sdf"])
def test_what_cannot_be_sent(
    start_service: StartService, submit: Submit, tmp_path: Path, name: str
) -> None:
    service = start_service(checking(DONE))
    (tmp_path / "notes.txt").write_text("x", "utf-8")
    os.mkfifo(tmp_path / "pipe.sdf")
    done = submit(name, "--server", service.url)
    assert (done.returncode, done.stdout) == (2, "")
    assert not service.asked


def test_a_token_goes_along_and_is_told_to_nobody(
    start_service: StartService, submit: Submit, model: Path
) -> None:
    service = start_service(checking(DONE))
    environment = {"SUBT_CHECK_TOKEN": "s3cret"}
    done = submit(model, "--server", service.url, **environment)
    assert {each.headers["authorization"] for each in service.asked} == {"Bearer s3cret"}
    done_too = submit(model, "--server", service.url, "--token", "0ther", **environment)
    assert service.asked[-1].headers["authorization"] == "Bearer 0ther"
    for each in (done, done_too):
        assert "s3cret" not in each.stdout + each.stderr
        assert "0ther" not in each.stdout + each.stderr
        assert "without encryption" not in each.stderr


@pytest.mark.service
def test_a_token_in_clear_over_a_network_is_warned_of(submit: Submit, model: Path) -> None:
    done = submit(model, "--server", "http://nobody.invalid", "--token", "s3cret")
    warned = "the token is sent to http://nobody.invalid without encryption; use https://"
    assert warned in done.stderr
    assert done.returncode == 2


@pytest.mark.parametrize("token", ["two words", "lin\re", "prüfung"])
def test_a_token_that_is_none(submit: Submit, model: Path, token: str) -> None:
    done = submit(model, "--server", "http://nobody.invalid", "--token", token)
    refused(done, "the token contains characters that are not ASCII letters, digits or signs")


def at_a_terminal(model: Path, service: Service) -> tuple[subprocess.Popen[bytes], int]:
    """Start the command at a terminal of its own; return it and our end of the terminal."""
    ours, its = pty.openpty()
    command = [sys.executable, "-m", "checker.cli", "submit", str(model), "--server", service.url]
    process = subprocess.Popen(
        command, stdin=its, stdout=its, stderr=its, env=clean_environment(), start_new_session=True
    )
    os.close(its)
    return process, ours


def read_until(terminal: int, words: str) -> str:
    shown, ends = b"", time.monotonic() + 30
    while words.encode() not in shown:
        assert time.monotonic() < ends, shown
        shown += os.read(terminal, 1000)
    return shown.decode()


@pytest.mark.parametrize(
    ("typed", "said"),
    [(b"y\n", "the check is cancelled"), (b"\n", "the check continues at http://127.0.0.1:")],
)
def test_who_interrupts_is_asked_whether_the_check_shall_end(
    start_service: StartService, model: Path, typed: bytes, said: str
) -> None:
    service = start_service(checking(RUNNING))
    process, terminal = at_a_terminal(model, service)
    shown = read_until(terminal, "the rules look")
    assert "uploading robot.sdf" in shown
    process.send_signal(signal.SIGINT)
    read_until(terminal, "[y/N]")
    os.write(terminal, typed)
    read_until(terminal, said)
    assert process.wait(20) == 130
    cancelled = [each for each in service.asked if each.path.endswith("/cancel")]
    secrets = [each.headers["subt-check-secret"] for each in cancelled]
    assert secrets == [SECRET] * (typed == b"y\n")
    assert not [line for line in service.lines if line.startswith("DELETE")]
    os.close(terminal)


def test_an_upload_that_is_sent_again_is_known_by_its_key(
    start_service: StartService, submit: Submit, model: Path
) -> None:
    check = checking(DONE)
    lost = [b"", answer(503, "busy", Retry_After="0")]

    def respond(asked: Asked) -> bytes | None:
        return lost.pop() if asked.method == "POST" and lost else check(asked)

    service = start_service(respond)
    submit(model, "--server", service.url)
    keys = [each.headers["idempotency-key"] for each in service.asked if each.method == "POST"]
    assert len(keys) == 3
    assert len(set(keys)) == 1
    submit(model, "--server", service.url)
    others = [each.headers["idempotency-key"] for each in service.asked if each.method == "POST"]
    assert len(others[-1]) == len(keys[0]) == 43
    assert others[-1] != keys[0]


def test_without_a_terminal_the_check_goes_on(
    start_service: StartService, model: Path, tmp_path: Path
) -> None:
    service = start_service(checking(RUNNING))
    command = [sys.executable, "-m", "checker.cli", "submit", str(model), "--server", service.url]
    said = tmp_path / "said"
    with said.open("wb") as file:
        process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=file, stderr=file, env=clean_environment()
        )
    ends = time.monotonic() + 30
    while len(service.asked) < 3:
        assert time.monotonic() < ends
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    assert process.wait(20) == 130
    assert f"the check continues at {service.url}/checks/{ID}\n" in said.read_text("utf-8")
    assert not [line for line in service.lines if line.startswith("DELETE")]
