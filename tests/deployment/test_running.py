"""The commands of compose.yaml together are a service: the web process, two workers, PostgreSQL."""

from __future__ import annotations

import contextlib
import json
import os
import secrets
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

from support.postgres import fresh_database
from support.started import address, process
from tests.conftest import SAMPLES
from tests.deployment.image import ROOT

COMMANDS: dict[str, list[str]] = {
    name: told["command"]
    for name, told in yaml.safe_load((ROOT / "compose.yaml").read_text("utf-8"))["services"].items()
    if "command" in told
}
TOKEN = secrets.token_hex(16)
WHERE = {"0.0.0.0": "127.0.0.1", "8000": "0"}  # noqa: S104 - what containers have to themselves


@pytest.fixture
def surroundings(postgres_url: str, tmp_path: Path) -> dict[str, str]:
    own = {name: value for name, value in os.environ.items() if "SUBT_CHECK" not in name}
    return own | {
        "SUBT_CHECK_DATABASE_URL": fresh_database(postgres_url),
        "SUBT_CHECK_DATA": str(tmp_path / "data"),
    }


@pytest.fixture
def service(surroundings: dict[str, str], tmp_path: Path) -> Iterator[str]:
    """The address of a service that runs as compose.yaml says."""
    ours = [sys.executable, "-m", "checker.cli"]
    web = [*ours, *(WHERE.get(word, word) for word in COMMANDS["web"])]
    with contextlib.ExitStack() as stack:
        told = surroundings | {"SUBT_CHECK_TOKENS": TOKEN}
        started = stack.enter_context(process(web, ROOT, told, tmp_path / "web.log"))
        for name in ("one", "two"):
            worker = [*ours, *COMMANDS["worker"]]
            log = tmp_path / f"{name}.log"
            stack.enter_context(process(worker, ROOT, surroundings, log))
        yield address(started)


def logs(tmp_path: Path) -> str:
    return "".join(log.read_text("utf-8") for log in tmp_path.glob("*.log"))


def submit(server: str, package: Path, token: str) -> subprocess.CompletedProcess[str]:
    words = ["submit", str(package), "--server", server, "--format", "json"]
    return subprocess.run(
        [sys.executable, "-m", "checker.cli", *words],
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
        env=os.environ | {"SUBT_CHECK_TOKEN": token},
    )


def test_a_robot_is_checked_for_those_with_a_token(
    service: str, surroundings: dict[str, str], tmp_path: Path
) -> None:
    sample = SAMPLES / "subtcheck_buggy_sensor_config_1"
    done = submit(service, sample, TOKEN)
    assert done.returncode == 0, done.stderr
    (package,) = json.loads(done.stdout)["packages"]
    assert package["verdict"] == "ready"
    assert package["trial"]["measurements"], "the worker has driven it"
    refused = submit(service, sample, TOKEN[:-1])
    assert (refused.returncode, refused.stdout) == (2, "")
    said = logs(tmp_path)
    password = surroundings["SUBT_CHECK_DATABASE_URL"].partition("@")[0].rpartition(":")[2]
    id = done.stderr.partition("/checks/")[2].split()[0]
    assert len(id) == 22
    assert said.count("is waiting for checks") == 2
    assert not [secret for secret in (TOKEN, password, id) if secret in said]
