"""compose.yaml holds what docs/service.md promises: services that can do little, and no secrets."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml

from checker import cli
from checker.base.resources import tool_version
from tests.deployment.dockerfile import stages

ROOT = Path(__file__).parent.parent.parent
COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "compose.yaml").read_text("utf-8"))
SERVICES: dict[str, dict[str, Any]] = COMPOSE["services"]
OURS = {name: told for name, told in SERVICES.items() if "build" in told}
_SUBSTITUTED = re.compile(r"\$\{(\w+)(:[?-])?([^}]*)\}")


def test_it_is_what_the_specification_of_compose_asks_for() -> None:
    words = ["-m", "check_jsonschema", "--builtin-schema", "vendor.compose-spec"]
    done = subprocess.run(
        [sys.executable, *words, ROOT / "compose.yaml"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_there_are_a_web_process_two_workers_and_a_database() -> None:
    assert SERVICES.keys() == {"web", "worker", "database"}
    assert OURS.keys() == {"web", "worker"}
    assert SERVICES["worker"]["deploy"]["replicas"] == 2


@pytest.mark.parametrize("name", SERVICES)
def test_a_service_can_do_little(name: str) -> None:
    told = SERVICES[name]
    assert told["read_only"] is True
    assert told["cap_drop"] == ["ALL"]
    assert "cap_add" not in told
    assert "privileged" not in told
    assert "no-new-privileges:true" in told["security_opt"]
    assert min(map(int, told["user"].split(":"))) > 0
    assert told["init"] is True, "children that their parent left behind are taken care of"
    assert told["mem_limit"]
    assert told["pids_limit"] > 0


@pytest.mark.parametrize("name", SERVICES)
def test_a_service_is_named_by_version_and_has_time_to_stop(name: str) -> None:
    told = SERVICES[name]
    assert re.fullmatch(r"[a-z-]+:\d+(\.\d+)*(-[a-z]+)?", told["image"])
    assert int(told["stop_grace_period"].removesuffix("s")) >= 30
    assert any(mount.startswith("/tmp") for mount in told["tmpfs"])  # noqa: S108


def test_the_image_is_called_by_the_version_of_the_project() -> None:
    assert {told["image"] for told in OURS.values()} == {f"subt-check:{tool_version()}"}


@pytest.mark.parametrize("name", OURS)
def test_a_command_is_understood(name: str) -> None:
    arguments = cli.build_parser().parse_args(OURS[name]["command"])
    if name == "web":
        assert arguments.workers == 0
        (network,) = COMPOSE["networks"]["outside"]["ipam"]["config"]
        assert arguments.behind_proxy == network["gateway"]


def test_ours_run_as_the_user_of_the_image_on_its_data() -> None:
    last = stages((ROOT / "Dockerfile").read_text("utf-8"))[-1]
    for told in OURS.values():
        assert told["user"] == last.only("USER")
        assert told["volumes"] == [f"data:{last.only('VOLUME')}"]


def test_ours_wait_for_the_database() -> None:
    for told in OURS.values():
        assert told["depends_on"] == {"database": {"condition": "service_healthy"}}
    assert SERVICES["database"]["healthcheck"]["test"][1] == "pg_isready"


def test_only_the_web_process_is_reached_and_only_from_this_machine() -> None:
    assert {name for name, told in SERVICES.items() if "ports" in told} == {"web"}
    assert all(port.startswith("127.0.0.1:") for port in SERVICES["web"]["ports"])


def test_only_the_web_process_reaches_out() -> None:
    outward = {
        name
        for name, told in SERVICES.items()
        if any(not (COMPOSE["networks"][net] or {}).get("internal") for net in told["networks"])
    }
    assert outward == {"web"}


def test_secrets_have_no_defaults() -> None:
    secret = re.compile(r"PASSWORD|TOKEN|URL")
    for told in SERVICES.values():
        for name, value in told.get("environment", {}).items():
            if secret.search(name):
                used = _SUBSTITUTED.findall(value)
                assert used, f"{name} is written down"
                assert all(kind == ":?" and says for _, kind, says in used), name


def test_a_worker_knows_no_tokens() -> None:
    assert "SUBT_CHECK_TOKENS" not in SERVICES["worker"]["environment"]


def test_volumes_are_kept_by_name() -> None:
    used = {mount.partition(":")[0] for told in SERVICES.values() for mount in told["volumes"]}
    assert used == COMPOSE["volumes"].keys()
