"""The API: what it tells of a check, its files and events, and how it says no."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import httpx
import pytest
from fastapi.testclient import TestClient
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.service.jobs.port import Alive, Event, JobsUnreachable, Stage, State
from checker.service.store.store import SUMMARY, Store
from checker.service.web.answers.headers import file_response
from checker.service.web.app import create_app
from checker.service.web.config import Config
from tests.each import of_each
from tests.effort import examples
from tests.web.board import DONE, ID, QUEUED, ROVER, SECRET, BoardJobs, keep_result
from tests.web.server import eventually, served

PAGE = "<meta content=\"script-src 'sha256-" + "A" * 43 + "='\">"


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


@pytest.fixture
def jobs() -> BoardJobs:
    return BoardJobs({ID: QUEUED})


@pytest.fixture
def client(jobs: BoardJobs, store: Store) -> TestClient:
    app = create_app(jobs, store, Config())
    return TestClient(app, base_url="http://localhost", follow_redirects=False)


def test_a_check_tells_where_it_stands(client: TestClient, jobs: BoardJobs, store: Store) -> None:
    jobs.states[ID] = DONE
    keep_result(store, PAGE, "report.html", "report.sarif", SUMMARY)
    said = client.get(f"/api/checks/{ID}").json()
    assert said["id"] == ID
    assert said["url"] == f"http://localhost/checks/{ID}"
    assert (said["stage"], said["final"]) == ("done", True)
    assert said["packages"] == [ROVER]
    assert said["expires"] == DONE.expires
    for address in said["files"]:
        assert client.get(address).status_code == 200
    names = {address.rpartition("/")[2] for address in said["files"]}
    assert names == {"report.json", "report.html", "report.sarif"}


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("report.json", "application/json"),
        ("report.sarif", "application/sarif+json"),
        ("report.html", "text/html; charset=utf-8"),
        ("robot.glb", "model/gltf-binary"),
    ],
)
def test_a_file_comes_as_what_it_is(
    client: TestClient, jobs: BoardJobs, store: Store, name: str, kind: str
) -> None:
    jobs.states[ID] = DONE
    keep_result(store, PAGE, *({name} - {"report.json"}))
    answer = client.get(f"/api/checks/{ID}/{name}")
    assert answer.status_code == 200
    assert answer.headers["content-type"] == kind
    assert answer.text == PAGE


def test_a_file_that_is_deleted_before_it_is_sent_is_not_there(
    jobs: BoardJobs, tmp_path: Path
) -> None:
    class Deleting(Store):
        def file(self, key: str, name: str) -> Path | None:
            path = super().file(key, name)
            shutil.rmtree(self.folder)
            return path

    store = Deleting(tmp_path / "data")
    client = TestClient(create_app(jobs, store, Config()), base_url="http://localhost")
    jobs.states[ID] = DONE
    for name in ("report.html", "report.json"):
        keep_result(store, PAGE, "report.html")
        answer = client.get(f"/api/checks/{ID}/{name}")
        assert answer.status_code == 404
        assert answer.json()["error"] == "The check has no such file, or not yet."


def test_a_file_that_is_deleted_while_it_is_sent_comes_whole(tmp_path: Path) -> None:
    path = tmp_path / "report.json"
    path.write_bytes(content := b"[]" * 900_000)
    answer = file_response(path)
    path.unlink()
    sent = TestClient(answer).get("/")
    assert sent.content == content
    assert sent.headers["content-length"] == str(len(content))


REPORT = (
    '<title>&lt;header&gt;</title></head><header class="not_ready">\n<h1>rover</h1></header>'
    + "a finding " * 500
)
BROWSER = {"Accept": "text/html,*/*;q=0.8", "Accept-Encoding": "gzip, br"}


def test_a_report_leads_back_to_its_check_in_browsers_alone(
    client: TestClient, jobs: BoardJobs, store: Store
) -> None:
    jobs.states[ID] = DONE
    keep_result(store, REPORT, "report.html", "index.html", "a/report.html", "a/robot.glb")
    for name in ("report.html", "packages/index.html", "packages/a/report.html"):
        address = f"/api/checks/{ID}/{name}"
        answer = client.get(address, headers=BROWSER)
        (link,) = re.findall('\n<p class="back"><a href=.*</p>', answer.text)
        led = client.get(str(answer.url.join(link.split('"')[3])))
        assert (led.status_code, led.headers["location"]) == (307, f"/checks/{ID}")
        assert answer.text.replace(link, "") == REPORT
        assert ID not in answer.text  # it is the same for all checks that share it
        assert answer.headers["content-encoding"] == "gzip"
        assert client.get(address).text == REPORT  # as `submit --report` keeps it
    for name in ("report.json", "packages/a/robot.glb"):
        assert client.get(f"/api/checks/{ID}/{name}", headers=BROWSER).text == REPORT


@pytest.mark.parametrize("text", [PAGE, "", "x" * 70_000 + REPORT, "<header id='x'>"])
def test_a_page_that_is_none_of_ours_stays_as_it_is(
    client: TestClient, jobs: BoardJobs, store: Store, text: str
) -> None:
    jobs.states[ID] = DONE
    keep_result(store, text, "report.html")
    answer = client.get(f"/api/checks/{ID}/report.html", headers=BROWSER)
    assert answer.text == text


def test_files_of_several_packages_lie_beside_the_list_of_them(
    client: TestClient, jobs: BoardJobs, store: Store
) -> None:
    jobs.states[ID] = DONE
    keep_result(store, PAGE, "index.html", "röver/report.html", "röver/robot.glb")
    answer = client.get(f"/api/checks/{ID}/index.html")
    assert answer.status_code == 307
    index = httpx.URL(f"http://localhost/api/checks/{ID}/index.html").join(
        answer.headers["location"]
    )
    assert client.get(str(index)).status_code == 200
    for link in ("r%C3%B6ver/report.html", "r%C3%B6ver/robot.glb"):
        assert client.get(str(index.join(link))).text == PAGE


def test_a_file_that_is_not_there_yet_is_said(client: TestClient) -> None:
    answer = client.get(f"/api/checks/{ID}/report.html")
    assert answer.status_code == 404
    assert "not yet" in answer.json()["error"]


NOT_FILES = (SUMMARY, "packages/%2e%2e/report.json", "packages/../../report.json", "x/report.html")


@pytest.mark.parametrize("name", NOT_FILES)
def test_nothing_else_of_the_store_is_served(
    client: TestClient, jobs: BoardJobs, store: Store, name: str
) -> None:
    jobs.states[ID] = DONE
    keep_result(store, PAGE, SUMMARY)
    assert client.get(f"/api/checks/{ID}/{name}").status_code == 404


ADDRESSES = (
    *("", "/"),
    *("/events", "/report.json", "/report.sarif", "/report.html", "/robot.glb", "/index.html"),
    *("/packages/index.html", "/packages/a/report.html", "/packages/a/robot.glb"),
)


@pytest.mark.parametrize("id", [ID[:-1] + "m", "x", "%00", "%F0%9F%A4%96", "a" * 5_000])
@of_each("address", ADDRESSES)
def test_every_unknown_check_is_answered_alike(client: TestClient, address: str, id: str) -> None:
    answer = client.get(f"/api/checks/{id}{address}")
    assert answer.status_code == 404
    assert answer.json() == client.get("/api/nothing").json()
    assert client.delete(f"/api/checks/{id}").json() == answer.json()


def test_a_check_can_be_ended(client: TestClient, jobs: BoardJobs) -> None:
    answer = client.post(f"/api/checks/{ID}/cancel", headers={"Subt-Check-Secret": SECRET})
    assert (answer.status_code, answer.json()["id"]) == (200, ID)
    assert jobs.cancelled == [ID]


def test_a_check_can_be_deleted(client: TestClient, jobs: BoardJobs) -> None:
    answer = client.delete(f"/api/checks/{ID}", headers={"Subt-Check-Secret": SECRET})
    assert (answer.status_code, answer.content) == (204, b"")
    assert client.get(f"/api/checks/{ID}").status_code == 404
    assert jobs.states == {}


@pytest.mark.parametrize("secret", ["", "x", ID, SECRET[:-1], "x" * 9_000])
@pytest.mark.parametrize(
    ("method", "address", "what"),
    [
        ("POST", f"/api/checks/{ID}/cancel", "cancel its check"),
        ("DELETE", f"/api/checks/{ID}", "delete its check"),
    ],
)
def test_only_the_sender_can_end_a_check(
    client: TestClient, jobs: BoardJobs, method: str, address: str, what: str, secret: str
) -> None:
    headers = {"Subt-Check-Secret": secret} if secret else {}
    # A browser's cookie is for pages: what a program sends is asked for by name.
    cookie = {"Cookie": f"subt-check-secret={SECRET}"}
    answer = client.request(method, address, headers=headers | cookie)
    assert answer.status_code == 403
    assert answer.json()["error"] == f"Only the person who uploaded this package can {what}."
    assert (jobs.states, jobs.cancelled) == ({ID: QUEUED}, [])


def sent(client: TestClient, **headers: str) -> httpx.Response:
    given = {name.replace("_", "-"): value for name, value in headers.items()}
    files = {"file": ("a.sdf", b"<sdf version='1.6'/>")}
    return client.post("/api/checks", files=files, headers=given)


def test_who_uploads_is_given_the_secret(client: TestClient) -> None:
    answer = sent(client)
    assert answer.json() == {
        "id": ID,
        "secret": SECRET,
        "url": f"http://localhost/checks/{ID}",
    }
    cookie = answer.headers["set-cookie"]
    assert set(cookie.split("; ")) == {
        f"subt-check-secret={SECRET}",
        "HttpOnly",
        "Max-Age=2592000",
        f"Path=/checks/{ID}",
        "SameSite=strict",
    }
    assert client.get(f"/api/checks/{ID}").text.count(SECRET) == 0


def test_behind_https_the_secret_is_for_https(jobs: BoardJobs, store: Store) -> None:
    config = Config(base_url="https://check.example", public=True)
    client = TestClient(create_app(jobs, store, config), base_url="http://check.example")
    assert "; Secure" in sent(client).headers["set-cookie"]


def test_a_key_of_the_client_goes_along(client: TestClient, jobs: BoardJobs) -> None:
    key = "4f3ab1de-7c1b-4e0c-9a3e-1f0d6c8f2b11"
    assert sent(client).status_code == sent(client, Idempotency_Key=key).status_code == 201
    assert jobs.keys == ["", key]


@pytest.mark.parametrize("key", ["", "1", "x" * 21, "x" * 201, "\xe9" * 30, "x" * 30 + "\x7f"])
def test_a_key_that_can_be_guessed_is_refused(
    client: TestClient, jobs: BoardJobs, key: str
) -> None:
    files = {"file": ("a.sdf", b"<sdf version='1.6'/>")}
    headers = [(b"idempotency-key", key.encode("latin-1"))]
    answer = client.post("/api/checks", files=files, headers=headers)
    assert answer.status_code == 422
    expected = "expected 22 to 200 printable characters of ASCII."
    assert answer.json()["error"] == f"The header Idempotency-Key is wrong, {expected}"
    assert jobs.keys == []


TOLD = BoardJobs()
LISTENER = TestClient(create_app(TOLD, Store(Path("nowhere")), Config()), "http://localhost")


@settings(max_examples=examples(30))
@given(st.text(max_size=300), st.text(max_size=300))
def test_words_of_any_kind_are_told(name: str, words: str) -> None:
    TOLD.states[ID] = replace(QUEUED, words=words, packages=({**ROVER, "name": name},))
    answer = LISTENER.get(f"/api/checks/{ID}")
    assert answer.status_code == 200
    told = answer.json()
    assert len(told["words"]) == len(words)
    for text in (told["words"], told["packages"][0]["name"]):
        assert not set(text) & set("\x00\x1b\u202e\ud800")


@pytest.mark.parametrize(
    ("method", "path", "status"),
    [
        ("GET", "/api/nothing", 404),
        ("PUT", f"/api/checks/{ID}", 405),
        ("GET", "/api/checks", 405),
        ("GET", f"/api/checks/{ID}/events?after=-1", 422),
        ("GET", f"/api/checks/{ID}/events?after={10**30}", 422),
        ("GET", f"/api/checks/{ID}/events?after=x", 422),
        ("POST", "/api/checks", 415),
    ],
)
def test_no_is_said_in_one_shape(client: TestClient, method: str, path: str, status: int) -> None:
    answer = client.request(method, path)
    assert answer.status_code == status
    said = answer.json()
    assert sorted(said) == ["advice", "error"]
    assert all(text.endswith(".") for text in said.values())


def test_a_browser_gets_a_page_that_says_why(client: TestClient) -> None:
    opened = client.get("/api/checks/nobody/report.html", headers={"accept": "text/html,*/*"})
    assert opened.status_code == 404
    assert opened.headers["content-type"].startswith("text/html")
    assert "accept" in opened.headers["vary"].lower()
    asked = client.get("/api/checks/nobody/report.html", headers={"accept": "*/*"})
    assert asked.headers["content-type"] == "application/json"
    sent = client.post("/api/checks", headers={"accept": "text/html"})
    assert sent.headers["content-type"] == "application/json"


def test_the_description_names_every_route_and_its_refusals(client: TestClient) -> None:
    paths = client.get("/api/openapi.json").json()["paths"]
    assert {f"/api/checks/{{id}}{each}" for each in ("", "/events", "/report.json")} <= set(paths)
    for path, operations in paths.items():
        for operation in operations.values():
            for status, answer in operation["responses"].items():
                if path.startswith("/api/") and int(status) >= 400:
                    schema = answer["content"]["application/json"]["schema"]
                    assert schema == {"$ref": "#/components/schemas/Problem"}


@dataclass
class Unreachable(BoardJobs):
    """An engine whose database is away."""

    def status(self, id: str) -> State | None:
        raise JobsUnreachable(id)

    def alive(self) -> Alive:
        raise JobsUnreachable


@pytest.mark.parametrize("path", [f"/api/checks/{ID}", f"/api/checks/{ID}/events", f"/checks/{ID}"])
def test_an_engine_that_is_away_is_said(store: Store, path: str) -> None:
    client = TestClient(create_app(Unreachable(), store, Config()), base_url="http://localhost")
    answer = client.get(path)
    assert answer.status_code == 503
    assert int(answer.headers["retry-after"]) > 0


@dataclass
class Playing(BoardJobs):
    """A check to which one more thing happens each time somebody asks."""

    script: Sequence[Stage] = (Stage.QUEUED, Stage.STATIC, Stage.TRIAL, Stage.DONE)
    asked: int = 0

    def happened(self) -> Sequence[Event]:
        self.asked += 1
        shown = self.script[: self.asked]
        if shown[-1].is_final:
            self.states[ID] = replace(QUEUED, stage=shown[-1])
        return [Event(n, stage, "ünïcode\n\nid: 9", 1.0) for n, stage in enumerate(shown, 1)]


def numbers(text: str) -> list[int]:
    return [int(line[4:]) for line in text.splitlines() if line.startswith("id: ")]


def test_events_come_as_they_happen_until_the_check_ends(store: Store) -> None:
    jobs = Playing({ID: QUEUED})
    app = create_app(jobs, store, Config())
    answer = TestClient(app, base_url="http://localhost").get(f"/api/checks/{ID}/events")
    assert answer.headers["content-type"].startswith("text/event-stream")
    assert numbers(answer.text) == [1, 2, 3, 4]
    told = [json.loads(line[6:]) for line in answer.text.splitlines() if line.startswith("data: ")]
    assert [each["stage"] for each in told] == list(jobs.script)


@pytest.mark.parametrize(
    ("query", "header", "expected"),
    [("?after=2", "", [3, 4]), ("", "3", [4]), ("?after=1", "3", [4]), ("", "x", [1, 2, 3, 4])],
)
def test_who_comes_back_gets_what_was_missed(
    store: Store, query: str, header: str, expected: list[int]
) -> None:
    jobs = Playing({ID: replace(QUEUED, stage=Stage.DONE)}, asked=4)
    client = TestClient(create_app(jobs, store, Config()), base_url="http://localhost")
    headers = {"Last-Event-ID": header} if header else {}
    answer = client.get(f"/api/checks/{ID}/events{query}", headers=headers)
    assert numbers(answer.text) == expected


def test_who_comes_back_after_the_end_is_told_to_stop(store: Store) -> None:
    jobs = Playing({ID: replace(QUEUED, stage=Stage.DONE)}, asked=4)
    client = TestClient(create_app(jobs, store, Config()), base_url="http://localhost")
    assert client.get(f"/api/checks/{ID}/events?after=4").status_code == 204


@pytest.mark.service
def test_streams_are_bounded_and_end_with_their_readers(store: Store) -> None:
    jobs = BoardJobs({ID: QUEUED})
    app = create_app(jobs, store, Config(streams=4, public=True, streams_per_client=2))
    with served(app) as port, httpx.Client(base_url=f"http://localhost:{port}") as client:
        address = f"/api/checks/{ID}/events"
        with client.stream("GET", address) as one, client.stream("GET", address) as two:
            assert (one.status_code, two.status_code) == (200, 200)
            refused = client.get(address)
            assert refused.status_code == 503
            assert refused.json()["error"] == "Too many pages follow checks."

        def is_free() -> bool:
            with client.stream("GET", address) as again:
                return again.status_code == 200

        assert eventually(is_free)
