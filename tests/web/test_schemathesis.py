"""The API keeps what its description says, whatever schemathesis thinks of."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import schemathesis
from fastapi import FastAPI
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, settings
from schemathesis import checks

from checker.service.jobs.check import result_key
from checker.service.jobs.durable.client import DurableJobs, durable_jobs
from checker.service.jobs.durable.workers import Workers
from checker.service.jobs.port import Order, Stage
from checker.service.store.store import SUMMARY, Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.conftest import SAMPLES
from tests.effort import examples
from tests.web.board import BoardJobs

HOST = {"Host": "localhost"}
FEW = settings(
    max_examples=examples(40),
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)
DESCRIPTION = schemathesis.openapi.from_asgi(
    "/api/openapi.json", create_app(BoardJobs(), Store(Path("nowhere")), Config()), headers=HOST
)
# A form may be right by its schema, which knows no archives, and be refused all the same.
WITHOUT = [checks.positive_data_acceptance]
MODEL = b"<sdf version='1.6'/>"
PACKAGE = {
    "name": "rover",
    "kind": "robot",
    "verdict": "ready",
    "errors": 0,
    "warnings": 0,
    "infos": 0,
}
REPORTS = ("report.json", "report.sarif", "report.html", "robot.glb")


@dataclass(frozen=True)
class Site:
    """The application with its engine and its store, and checks that are over."""

    app: FastAPI
    of_one: str
    of_several: str
    cancelled: str


def done(jobs: DurableJobs, folders: tuple[str, ...]) -> str:
    """Return the id of a check whose result was in the store already."""
    order = Order(str(len(folders)) * 64, "rover.zip")
    report = (SAMPLES / "ouster_description.report.json").read_text("utf-8")
    packages = [{**PACKAGE, "folder": folder} for folder in folders]
    names = [f"{folder}/{name}".lstrip("/") for folder in folders for name in REPORTS[2:]]
    with jobs.store.workplace() as place:
        made = place / "made"
        for name in (*REPORTS[:2], *names, *(["index.html"] if folders[0] else [])):
            (made / name).parent.mkdir(parents=True, exist_ok=True)
            (made / name).write_text(report)
        (made / SUMMARY).write_text(json.dumps({"packages": packages, "words": "Ready"}))
        jobs.store.keep(result_key(order, Stage.TRIAL), made)
    return jobs.submit(order).id


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Site]:
    folder = tmp_path_factory.mktemp("api")
    store = Store(folder / "data")
    jobs = durable_jobs(f"sqlite:///{folder}/jobs.sqlite", store)
    Workers(jobs.checks.engine).record_heartbeat("worker")
    app = create_app(jobs, store, Config())
    cancelled = jobs.submit(Order("a" * 64, "a.zip"))
    assert jobs.cancel(cancelled.id, cancelled.secret)
    yield Site(app, done(jobs, ("",)), done(jobs, ("a", "b")), cancelled.id)
    jobs.checks.engine.dispose()


@pytest.mark.slow
@DESCRIPTION.parametrize()
@FEW
def test_any_request_is_answered_as_described(case: schemathesis.Case, site: Site) -> None:
    case.call_and_validate(app=site.app, headers=HOST, excluded_checks=WITHOUT)


@pytest.mark.slow
@DESCRIPTION.include(path_regex="{id}").parametrize()
@FEW
def test_any_request_about_a_check_is_answered_as_described(
    case: schemathesis.Case, site: Site
) -> None:
    for id in (site.of_one, site.of_several, site.cancelled):
        case.path_parameters["id"] = id
        case.call_and_validate(app=site.app, headers=HOST, excluded_checks=WITHOUT)


def test_what_goes_well_is_answered_as_described(site: Site) -> None:
    client = TestClient(site.app, base_url="http://localhost", follow_redirects=False)

    def ask(method: str, path: str, **given: Any) -> Any:
        address = path.format(id=id, folder="b")
        answer = client.request(method, address, **given)
        DESCRIPTION[path][method].validate_response(answer)
        return answer

    id = ""
    taken = ask("POST", "/api/checks", files={"file": ("a.sdf", MODEL)})
    assert taken.status_code == 201
    id = taken.json()["id"]
    assert ask("GET", "/api/checks/{id}").json()["stage"] == "queued"
    secret = {"Subt-Check-Secret": taken.json()["secret"]}
    cancelled = ask("POST", "/api/checks/{id}/cancel", headers=secret)
    assert cancelled.json()["stage"] == "cancelled"
    assert ask("GET", "/api/checks/{id}/events").status_code == 200
    assert ask("DELETE", "/api/checks/{id}", headers=secret).status_code == 204
    assert ask("GET", "/api/checks/{id}").status_code == 404
    id = site.of_one
    for name in REPORTS:
        assert ask("GET", f"/api/checks/{{id}}/{name}").status_code == 200
    id = site.of_several
    assert ask("GET", "/api/checks/{id}/packages/index.html").status_code == 200
    for name in REPORTS[2:]:
        assert ask("GET", f"/api/checks/{{id}}/packages/{{folder}}/{name}").status_code == 200
