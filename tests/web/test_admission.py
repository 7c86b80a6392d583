"""Who may do what: tokens, rates, places, hosts, other sites; and the headers of every answer."""

from __future__ import annotations

import hmac
import secrets
from pathlib import Path

import pytest
from fastapi.testclient import TestClient
from hypothesis import given
from hypothesis import strategies as st
from starlette.requests import HTTPConnection

from checker.base.errors import InvalidSettings
from checker.report.html.page import text_of
from checker.service.store.store import Store
from checker.service.web.answers.headers import NOTHING, PAGE, POLICY, file_response
from checker.service.web.app import create_app
from checker.service.web.config import Config, config_from
from checker.service.web.limits.admission import Admission
from checker.service.web.limits.rates import CLIENTS, Rate, Slots, client_of
from tests.web.board import DONE, ID, SENDER, BoardJobs, keep_result

MODEL = {"file": ("a.sdf", b"<sdf/>")}
TOKEN = "s3cret"  # noqa: S105 - of the tests


def client_for(tmp_path: Path, config: Config, address: str = "192.0.2.1") -> TestClient:
    jobs, store = BoardJobs({ID: DONE}), Store(tmp_path / "data")
    app = create_app(jobs, store, config)
    return TestClient(
        app, base_url="http://localhost", client=(address, 5_000), follow_redirects=False
    )


@pytest.mark.parametrize("path", ["/api/checks", "/checks"])
@pytest.mark.parametrize(
    ("header", "field", "welcome"),
    [
        ("", "", False),
        ("", "wrong", False),
        ("Bearer wrong", "", False),
        ("Bearer wrong", TOKEN, False),
        ("Basic s3cret", "", False),
        (f"bearer {TOKEN}", "", True),
        ("Bearer other", "", True),
        ("", TOKEN, True),
    ],
)
def test_uploads_want_one_of_the_tokens(
    tmp_path: Path, path: str, header: str, field: str, welcome: bool
) -> None:
    client = client_for(tmp_path, Config(tokens=(TOKEN, "other")))
    headers = {"Authorization": header} if header else {}
    data = {"token": field} if field else {}
    answer = client.post(path, data=data, files=MODEL, headers=headers)
    assert answer.status_code == ((201 if path == "/api/checks" else 303) if welcome else 401)
    assert ("www-authenticate" in answer.headers) is not welcome
    assert TOKEN not in answer.text


@pytest.mark.parametrize("guess", [TOKEN, "other", "guess", TOKEN[:-1], ""])
def test_tokens_are_compared_in_constant_time(guess: str, monkeypatch: pytest.MonkeyPatch) -> None:
    compared: list[tuple[bytes, bytes]] = []

    def compare(one: bytes, other: bytes) -> bool:
        compared.append((one, other))
        return hmac.compare_digest(one, other)

    monkeypatch.setattr(secrets, "compare_digest", compare)
    known = Admission(Config(tokens=(TOKEN, "other"))).knows(guess)
    assert known is (guess in (TOKEN, "other"))
    # Each is compared, also behind the one that fits, and by nothing else than this.
    assert compared == [(guess.encode(), TOKEN.encode()), (guess.encode(), b"other")]


def test_reports_are_read_by_their_link_alone_and_nothing_lists_them(tmp_path: Path) -> None:
    client = client_for(tmp_path, Config(tokens=(TOKEN,)))
    assert client.get(f"/api/checks/{ID}").status_code == 200
    for path in ("/api/checks", "/api/checks/", "/checks", "/checks/", "/", "/api/openapi.json"):
        assert ID not in client.get(path, headers={"Authorization": f"Bearer {TOKEN}"}).text


def test_uploads_of_one_address_are_limited(tmp_path: Path) -> None:
    client = client_for(tmp_path, Config(public=True, uploads_per_minute=3))
    answers = [client.post("/api/checks", files=MODEL) for _ in range(4)]
    assert [each.status_code for each in answers] == [201, 201, 201, 429]
    assert 1 <= int(answers[3].headers["retry-after"]) <= 20
    assert client.get(f"/api/checks/{ID}").status_code == 200


def test_uploads_that_other_web_processes_took_count_as_well(tmp_path: Path) -> None:
    for config, status in ((Config(public=True), 429), (Config(uploads_per_minute=0), 201)):
        jobs = BoardJobs({ID: DONE}, waits={("testclient", 30): 9.1})
        app = create_app(jobs, Store(tmp_path / "data"), config)
        client = TestClient(app, base_url="http://localhost")
        answer = client.post("/api/checks", files=MODEL)
        assert answer.status_code == status
        assert answer.headers.get("retry-after") == ("10" if status == 429 else None)


def test_guesses_of_tokens_are_limited(tmp_path: Path) -> None:
    client = client_for(tmp_path, Config(tokens=(TOKEN,), uploads_per_minute=3))
    headers = {"Authorization": "Bearer guess"}
    answers = [client.post("/api/checks", headers=headers, files=MODEL) for _ in range(5)]
    assert [each.status_code for each in answers] == [401, 401, 401, 429, 429]


@given(st.lists(st.floats(0, 120), min_size=1, max_size=200), st.integers(1, 60))
def test_a_rate_is_never_exceeded(pauses: list[float], per_minute: int) -> None:
    now = 0.0
    rate = Rate(per_minute, lambda: now)
    taken = []
    for pause in pauses:
        now += pause
        wait = rate.wait("one")
        if wait == 0:
            taken.append(now)
        else:
            assert 0 < wait <= 60 / per_minute + 1e-6
    for first in taken:
        assert sum(first <= each < first + 60 for each in taken) <= 2 * per_minute


def test_who_waits_as_told_is_let_in() -> None:
    now = 0.0
    rate = Rate(2, lambda: now)
    assert [rate.wait("one"), rate.wait("one")] == [0, 0]
    now += rate.wait("one") + 1e-9
    assert rate.wait("one") == 0
    assert rate.wait("two") == 0


def test_a_rate_remembers_so_many_clients_and_no_more() -> None:
    rate = Rate(1, lambda: 0.0)
    for number in range(CLIENTS + 100):
        rate.wait(str(number))
    assert len(rate._buckets) == CLIENTS
    assert rate.wait(str(CLIENTS + 99)) > 0


def test_places_are_given_back() -> None:
    slots = Slots(3, 2)
    with slots.one("a") as first, slots.one("a") as second, slots.one("a") as third:
        assert (first, second, third) == (True, True, False)
        with slots.one("b") as fourth, slots.one("c") as fifth:
            assert (fourth, fifth) == (True, False)
    assert slots == Slots(3, 2)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("192.0.2.1", "192.0.2.2", False),
        ("2001:db8::1", "2001:db8::ffff:1:2:3", True),
        ("2001:db8::1", "2001:db8:0:1::1", False),
        ("::ffff:192.0.2.1", "192.0.2.1", True),
        ("fe80::1%eth0", "fe80::2", True),
    ],
)
def test_a_client_is_known_by_its_network(one: str, other: str, same: bool) -> None:
    def known(address: str) -> str:
        return client_of(HTTPConnection({"type": "http", "client": (address, 1)}))

    assert (known(one) == known(other)) is same


@pytest.mark.parametrize(
    ("headers", "welcome"),
    [
        ({}, True),
        ({"Origin": "http://localhost", "Sec-Fetch-Site": "same-origin"}, True),
        ({"Origin": "http://evil.example"}, False),
        ({"Origin": "null"}, False),
        ({"Sec-Fetch-Site": "cross-site"}, False),
        ({"Sec-Fetch-Site": "same-site", "Origin": "http://localhost"}, False),
    ],
)
def test_other_sites_cannot_make_a_browser_change_anything(
    tmp_path: Path, headers: dict[str, str], welcome: bool
) -> None:
    client = client_for(tmp_path, Config())
    for method, path in (
        ("POST", "/api/checks"),
        ("POST", "/checks"),
        ("POST", f"/checks/{ID}/cancel"),
        ("POST", f"/api/checks/{ID}/cancel"),
        ("DELETE", f"/api/checks/{ID}"),
    ):
        files = MODEL if path.endswith("checks") else None
        assert client.get(f"/api/checks/{ID}", headers=headers).status_code == 200
        answer = client.request(method, path, files=files, headers=headers | SENDER)
        assert (answer.status_code != 403) is welcome


@pytest.mark.parametrize(
    ("config", "host", "welcome"),
    [
        (Config(), "localhost:8000", True),
        (Config(), "127.0.0.1:8000", True),
        (Config(), "[::1]:8000", True),
        (Config(), "rebound.evil.example", False),
        (Config(base_url="https://check.example"), "check.example", True),
        (Config(public=True), "check.example", True),
        (Config(tokens=(TOKEN,)), "check.example", True),
        (Config(public=True), "a b<script>", False),
        (Config(public=True), "", False),
    ],
)
def test_a_service_for_this_machine_answers_under_its_names_alone(
    tmp_path: Path, config: Config, host: str, welcome: bool
) -> None:
    answer = client_for(tmp_path, config).get(f"/api/checks/{ID}", headers={"Host": host})
    assert answer.status_code == (200 if welcome else 421)


def test_every_answer_forbids_what_it_does_not_need(tmp_path: Path) -> None:
    client = client_for(tmp_path, Config())
    for path in ("/", "/nothing", "/api/nothing", "/healthz", f"/api/checks/{ID}", "/rules"):
        headers = client.get(path).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert headers["cache-control"] == "private, no-store"
        assert "noindex" in headers["x-robots-tag"]
        is_page = headers["content-type"].startswith("text/html")
        assert headers[POLICY] == (PAGE if is_page else NOTHING)
        assert "strict-transport-security" not in headers


def test_https_is_remembered_by_browsers(tmp_path: Path) -> None:
    client = client_for(tmp_path, Config(public=True))
    client.base_url = client.base_url.copy_with(scheme="https")
    assert "max-age" in client.get("/").headers["strict-transport-security"]


HASH = "sha256-" + "A" * 43 + "="


def test_a_report_runs_its_own_script_and_reaches_nothing(tmp_path: Path) -> None:
    head = text_of("report.html.j2").replace("sha256-{{ script_hash }}", HASH)
    client = client_for(tmp_path, Config())
    keep_result(Store(tmp_path / "data"), head, "report.html")
    headers = client.get(f"/api/checks/{ID}/report.html").headers
    policy = dict(each.strip().partition(" ")[::2] for each in headers[POLICY].split(";"))
    assert policy["script-src"] == f"'{HASH}'"
    for what in ("default-src", "connect-src", "form-action", "base-uri", "frame-ancestors"):
        assert policy[what] == "'none'"
    assert "allow-same-origin" not in policy["sandbox"]


def test_a_page_without_a_policy_runs_nothing(tmp_path: Path) -> None:
    page = tmp_path / "report.html"
    page.write_text("<script>alert(1)</script>" + " " * 5_000 + f"script-src '{HASH}'")
    assert file_response(page).headers[POLICY].endswith("script-src 'none'")


def test_the_environment_says_what_is_allowed() -> None:
    config = config_from(
        {
            "SUBT_CHECK_TOKENS": " one, two ,",
            "SUBT_CHECK_UPLOAD_LIMIT": "5000",
            "SUBT_CHECK_RETENTION_DAYS": "",
            "SUBT_CHECK_PUBLIC": "yes",
            "SUBT_CHECK_WITHOUT_SANDBOX": "1",
            "SUBT_CHECK_UPLOADS_PER_MINUTE": "0",
            "SUBT_CHECK_STREAMS_PER_CLIENT": "7",
            "SUBT_CHECK_BASE_URL": "https://check.example/",
        }
    )
    assert config.tokens == ("one", "two")
    assert (config.upload_limit, config.retention_days) == (5_000, 30)
    assert config.public
    assert config.without_sandbox
    assert config.uploads_per_minute == 0
    assert config.streams_per_client == 7
    assert config.base_url == "https://check.example"
    assert config_from({}) == Config()
    assert Config().only_here


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("SUBT_CHECK_UPLOAD_LIMIT", "100 MB"),
        ("SUBT_CHECK_UPLOAD_LIMIT", "0"),
        ("SUBT_CHECK_STREAMS_PER_CLIENT", "0"),
        ("SUBT_CHECK_RETENTION_DAYS", "-1"),
        ("SUBT_CHECK_RETENTION_DAYS", "36501"),
        ("SUBT_CHECK_BASE_URL", "check.example"),
        ("SUBT_CHECK_BASE_URL", "https://check.example/below"),
        ("SUBT_CHECK_BASE_URL", "javascript:alert(1)"),
        ("SUBT_CHECK_TOKENS", "g e h e i m"),
    ],
)
def test_a_setting_that_makes_no_sense_is_named(name: str, value: str) -> None:
    with pytest.raises(InvalidSettings, match=name):
        config_from({name: value})
