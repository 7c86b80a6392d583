"""The web process as it is started: from the environment, with the real engine behind it."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx

FACTORY = "checker.service.web.app:app_from_environment"
ANSWERING = re.compile(r"running on (http://127\.0\.0\.1:\d+)")


@dataclass
class Process:
    """A web process, and what it has logged."""

    url: str = ""
    lines: list[dict[str, Any]] = field(default_factory=list)


@contextmanager
def started(data: Path, **variables: str) -> Iterator[Process]:
    environment = {**os.environ, "SUBT_CHECK_DATA": str(data), **variables}
    command = [sys.executable, "-m", "uvicorn", "--factory", FACTORY, "--port", "0"]
    known = Process()
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stderr is not None
        try:
            for line in process.stderr:
                said = ANSWERING.search(line)
                if said:
                    known.url = said[1]
                    break
            assert known.url
            yield known
        finally:
            process.terminate()
            known.lines += [json.loads(line) for line in process.stderr]


def test_a_process_takes_an_upload_and_is_not_ready_without_a_worker(tmp_path: Path) -> None:
    with (
        started(tmp_path, SUBT_CHECK_TOKENS="s3cret") as process,
        httpx.Client(base_url=process.url, timeout=60) as client,
    ):
        assert client.get("/healthz").status_code == 200
        assert client.get("/readyz").status_code == 503
        model = {"file": ("a.sdf", b"<sdf/>")}
        assert client.post("/api/checks", files=model).status_code == 401
        headers = {"Authorization": "Bearer s3cret"}
        answer = client.post("/api/checks", files=model, headers=headers)
        assert answer.status_code == 201
        id, secret = answer.json()["id"], answer.json()["secret"]
        state = client.get(f"/api/checks/{id}").json()
        assert (state["stage"], state["name"]) == ("queued", "a.sdf")
        headers = {"Subt-Check-Secret": secret}
        answer = client.post(f"/api/checks/{id}/cancel", headers=headers)
        assert answer.json()["stage"] == "cancelled"
    requests = [line for line in process.lines if line["message"] == "request"]
    assert [line["status"] for line in requests] == [200, 503, 401, 201, 200, 200]
    for hidden in (id, secret, "s3cret", "a.sdf"):
        assert hidden not in json.dumps(process.lines)


def test_a_setting_that_makes_no_sense_ends_the_process(tmp_path: Path) -> None:
    environment = {
        **os.environ,
        "SUBT_CHECK_DATA": str(tmp_path),
        "SUBT_CHECK_UPLOAD_LIMIT": "much",
    }
    command = [sys.executable, "-m", "uvicorn", "--factory", FACTORY, "--port", "0"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert done.returncode != 0
    assert "SUBT_CHECK_UPLOAD_LIMIT is 'much'" in done.stderr
