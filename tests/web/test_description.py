"""The page of the API tells all that its description does, and its examples work."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from html import unescape
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi.testclient import TestClient

from checker.service.jobs.port import Event, Stage
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.pages.description import Operation, groups_of, shapes_of
from tests.web.board import DONE, ID, SECRET, BoardJobs, keep_result

ADDRESS = "http://localhost"
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


@pytest.fixture
def description(client: TestClient) -> Any:
    return client.get("/api/openapi.json").json()


def operations(description: Any) -> list[Operation]:
    groups = groups_of(description, ADDRESS)
    return [operation for group in groups for operation in group.operations]


def words_of(html: str) -> str:
    text = re.sub("</?code>", "", html)
    return " ".join(unescape(re.sub("<[^>]*>", " ", text)).split())


def test_the_page_tells_all_of_the_description(client: TestClient, description: Any) -> None:
    answer = client.get("/api")
    assert answer.status_code == 200
    words = words_of(answer.text)
    for path, methods in description["paths"].items():
        for method, told in methods.items():
            assert f"{method.upper()} {path}" in words
            assert told["description"].replace("`", "") in words
            for each in told.get("parameters", ()):
                assert each["name"] in words
            for answered in told["responses"].values():
                assert answered["description"] in [*words_in(answer.text), "Successful Response"]
    for name, schema in description["components"]["schemas"].items():
        assert f'id="shape-{name}"' in answer.text
        for member in schema.get("properties", {}):
            assert f"<code>{member}</code>" in answer.text


def words_in(html: str) -> list[str]:
    """Return what is in the entries of lists of definitions."""
    return [
        unescape(re.sub("<(a|span).*", "", entry)).strip()
        for entry in re.findall("<dd>(.*?)</dd>", html)
    ]


def test_every_operation_has_its_place_and_its_example(
    client: TestClient, description: Any
) -> None:
    found = operations(description)
    assert len(found) == sum(map(len, description["paths"].values()))
    assert len({each.anchor for each in found}) == len(found)
    page = client.get("/api").text
    for each in found:
        assert f'id="{each.anchor}"' in page
        assert each.example in unescape(page)
        assert {outcome.status for outcome in each.outcomes} == set(
            description["paths"][each.path][each.method.lower()]["responses"]
        )


def test_kinds_are_said_in_words(description: Any) -> None:
    kinds = {
        f"{shape.name}.{member.name}": member.kind
        for shape in shapes_of(description)
        for member in shape.members
    }
    assert kinds["CheckView.packages"] == "list of PackageView"
    assert kinds["CheckView.files"] == "list of text"
    assert kinds["CheckView.final"] == "true or false"
    assert kinds["CheckView.created"] == "number"
    assert kinds["CheckView.ahead"] == "whole number"
    (stage,) = (shape for shape in shapes_of(description) if shape.name == "Stage")
    assert stage.words[0] == "queued"


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


def test_every_example_is_a_request_that_goes_well(client: TestClient, description: Any) -> None:
    found = operations(description)
    ends = [each for each in found if each.method == "DELETE"]
    for each in [*(each for each in found if each not in ends), *ends]:
        if each.path == "/api/checks":
            continue  # last, or it would put its own check in the place of the other
        answer: httpx.Response = client.request(**request_of(each.example))
        assert answer.status_code in (200, 204), (each.example, answer.text)
    (upload,) = (each for each in found if each.path == "/api/checks")
    request = request_of(upload.example)
    request["files"]["file"] = ("rover.sdf", request["files"]["file"][1])
    assert client.request(**request).status_code == 201


@pytest.mark.parametrize("tokens", [(), ("s3cret",)])
def test_a_token_is_told_of_where_one_is_needed(tmp_path: Path, tokens: tuple[str, ...]) -> None:
    app = create_app(BoardJobs(), Store(tmp_path), Config(tokens=tokens))
    page = TestClient(app, base_url=ADDRESS).get("/api").text
    assert ("Authorization: Bearer $TOKEN" in unescape(page)) is bool(tokens)
    assert "s3cret" not in page
