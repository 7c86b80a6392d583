"""docs/service-api.md tells all that the description of the API does, and its examples work."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi.testclient import TestClient

from checker.service.jobs.port import Event, Stage
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.web.board import DONE, ID, SECRET, BoardJobs, keep_result

ADDRESS = "https://check.example"
PAGE = (Path(__file__).parents[2] / "docs/service-api.md").read_text("utf-8")
EXAMPLES = re.findall("^```sh\n(.*)\n```$", PAGE, re.M)
FILES = ("report.html", "report.sarif", "robot.glb", "index.html", "a/report.html", "a/robot.glb")


class Ended(BoardJobs):
    """A check that is over."""

    def happened(self) -> Sequence[Event]:
        return [Event(1, Stage.DONE, "", 0.0)]


@pytest.fixture
def client(tmp_path: Path) -> TestClient:
    store = Store(tmp_path / "data")
    keep_result(store, "{}", *FILES)
    app = create_app(Ended({ID: DONE}), store, Config(base_url=ADDRESS))
    return TestClient(app, base_url=ADDRESS, follow_redirects=False)


def section(title: str) -> str:
    """Return what stands below a heading; nothing without it."""
    return "".join(re.findall(rf"^### {re.escape(title)}\n(.*?)(?=^#|\Z)", PAGE, re.M | re.S))


def operations(description: Any) -> Iterator[tuple[str, Any]]:
    for path, methods in description["paths"].items():
        for method, told in methods.items():
            yield f"{method.upper()} {path}", told


def test_the_page_tells_all_of_the_description(client: TestClient) -> None:
    description = client.get("/api/openapi.json").json()
    told_of = dict(operations(description))
    assert re.findall("^### ([A-Z]+ /.*)$", PAGE, re.M) != []
    assert {*re.findall("^### ([A-Z]+ /.*)$", PAGE, re.M)} == {*told_of}
    for title, told in told_of.items():
        names = [each["name"] for each in told.get("parameters", ()) if each["in"] != "path"]
        form = told.get("requestBody", {}).get("content", {}).get("multipart/form-data", {})
        for name in (*names, *form.get("schema", {}).get("properties", ())):
            assert f"`{name}`" in section(title)
        for status in told["responses"]:
            assert re.search(rf"\b{status}\b", PAGE) or status == "200"
    for name, schema in description["components"]["schemas"].items():
        for member in schema.get("properties", {}):
            assert f"`{member}`" in section(name)
        for word in schema.get("enum", ()):
            assert f"`{word}`" in section("CheckView")


def request_of(example: str) -> dict[str, Any]:
    """Return the request that a command of curl sends."""
    values = {"$ID": ID, "$FOLDER": "a", "$SECRET": SECRET}
    for name, value in values.items():
        example = example.replace(name, value)
    program, *words = shlex.split(example)
    assert program == "curl"
    request: dict[str, Any] = {"method": "GET", "headers": {}, "url": words.pop()}
    while words:
        match words.pop(0):
            case "--request":
                request["method"] = words.pop(0)
            case "--header":
                name, _, value = words.pop(0).partition(": ")
                request["headers"][name] = value
            case "--form":
                field, _, file = words.pop(0).partition("=@")
                request |= {"method": "POST", "files": {field: (file, b"<sdf/>")}}
            case "--output":
                assert words.pop(0) == request["url"].rpartition("/")[2]
            case "--no-buffer":
                assert request["url"].endswith("/events")
            case word:
                raise AssertionError(word)
    return request


def title_of(request: dict[str, Any]) -> str:
    """Return the operation that a request asks for."""
    path = request["url"].removeprefix(ADDRESS).replace(ID, "{id}").replace("/a/", "/{folder}/")
    return f"{request['method']} {path}"


def test_every_operation_has_an_example_that_goes_well(client: TestClient) -> None:
    requests = {title_of(request): request for request in map(request_of, EXAMPLES)}
    description = client.get("/api/openapi.json").json()
    assert requests.keys() == dict(operations(description)).keys()
    upload, delete = requests.pop("POST /api/checks"), requests.pop("DELETE /api/checks/{id}")
    for request in (*requests.values(), delete):
        answer: httpx.Response = client.request(**request)
        assert answer.status_code in (200, 204), (request, answer.text)
    upload["files"]["file"] = ("rover.sdf", upload["files"]["file"][1])
    assert client.request(**upload).status_code == 201


@pytest.mark.parametrize("tokens", [(), ("s3cret",)])
def test_a_token_is_told_of_where_one_is_needed(tmp_path: Path, tokens: tuple[str, ...]) -> None:
    app = create_app(BoardJobs(), Store(tmp_path), Config(tokens=tokens, base_url=ADDRESS))
    page = TestClient(app, base_url=ADDRESS).get("/api").text
    assert 'href="/api/openapi.json"' in page
    assert ("Authorization: Bearer" in page) is bool(tokens)
    assert "s3cret" not in page
