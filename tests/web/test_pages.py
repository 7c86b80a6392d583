"""The pages for people: what they say at each stage, and that nothing of a user acts in them."""

from __future__ import annotations

import hashlib
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.pipeline import check_package
from checker.report.files import package_folders
from checker.report.json_report import to_json
from checker.report.report import PackageReport, Report
from checker.rulebook.discovery import all_rules
from checker.service.jobs.port import Event, Stage, State
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.service.web.pages.progress import SHOWN, glance, headline, package_lines, steps_of
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.effort import examples
from tests.report.any_report import HOSTILE, PACKAGES
from tests.web.board import (
    DONE,
    ID,
    KEY,
    QUEUED,
    ROVER,
    SECRET,
    SENDER,
    BoardJobs,
    Client,
    keep_result,
)


class Elements(HTMLParser):
    """What a browser would make of a page: its elements with attributes, and its words."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.words = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.words += data

    def all(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.found if name == tag]


@pytest.fixture
def jobs() -> BoardJobs:
    return BoardJobs()


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "data")


def client_of(jobs: BoardJobs, store: Store, config: Config | None = None) -> Client:
    return Client(create_app(jobs, store, config or Config()))


@pytest.fixture
def client(jobs: BoardJobs, store: Store) -> Client:
    return client_of(jobs, store)


def test_the_start_page_shows_the_limits_before_anything_is_sent(
    jobs: BoardJobs, store: Store
) -> None:
    config = Config(upload_limit=7_500_000, retention_days=4)
    page = Elements(client_of(jobs, store, config).get("/").text)
    for said in ("7.5 MB", "5000 files", "500 MB unpacked", ".tar.gz", ".urdf", "4 days"):
        assert said in page.words
    (form,) = page.all("form")
    assert (form["method"], form["action"]) == ("post", "/checks")
    assert form["enctype"] == "multipart/form-data"


@pytest.mark.parametrize("tokens", [(), ("s3cret",)])
def test_a_token_is_asked_for_before_the_file_and_only_where_one_is_needed(
    jobs: BoardJobs, store: Store, tokens: tuple[str, ...]
) -> None:
    page = Elements(client_of(jobs, store, Config(tokens=tokens)).get("/").text)
    names = [each["name"] for each in page.all("input") if "name" in each]
    assert names == (["token", "file"] if tokens else ["file"])
    assert "s3cret" not in page.words


def test_the_form_without_a_script_leads_to_the_check(client: Client, jobs: BoardJobs) -> None:
    sdf = b'<?xml version="1.0"?><sdf version="1.6"/>'
    answer = client.post("/checks", data={"profile": "sdf"}, files={"file": ("rover.sdf", sdf)})
    assert answer.status_code == 303
    assert answer.headers["location"] == f"/checks/{ID}"
    assert jobs.states[ID].order.name == "rover.sdf"
    assert jobs.states[ID].order.profile == "sdf"


def test_a_refused_form_is_answered_by_a_page(client: Client) -> None:
    answer = client.post("/checks", files={"file": ("rover.txt", b"hello")})
    page = Elements(answer.text)
    assert answer.status_code == 415
    assert ".tar.gz" in page.words
    assert {"href": "/"} in page.all("a")


@pytest.mark.parametrize(
    ("state", "said"),
    [
        (replace(QUEUED, ahead=3), "Waiting: 3 checks ahead Link"),
        (QUEUED, "Waiting: it starts in a moment"),
        (replace(QUEUED, stage=Stage.STATIC, words="the rules look"), "Checking: the rules look"),
        (
            replace(QUEUED, stage=Stage.TRIAL, result=KEY, packages=(ROVER,)),
            "Checking: 5 errors and 1 warning so far",
        ),
        (
            replace(QUEUED, stage=Stage.TRIAL, packages=(ROVER,), words="starts again: it ended"),
            "Checking: 5 errors and 1 warning so far Starts again: it ended.",
        ),
        (DONE, "Not ready: 5 errors to fix"),
        (
            replace(QUEUED, stage=Stage.REFUSED, words="rover.zip is damaged; pack it again"),
            "Not checked: rover.zip is damaged Pack it again. Send a package",
        ),
        (replace(QUEUED, stage=Stage.CANCELLED), "Cancelled"),
    ],
)
def test_each_stage_is_said_in_a_sentence(
    client: Client, jobs: BoardJobs, state: State, said: str
) -> None:
    jobs.states[ID] = state
    answer = client.get(f"/checks/{ID}")
    page = Elements(answer.text)
    assert answer.status_code == 200
    assert said in " ".join(page.words.split())
    refreshed = {"http-equiv": "refresh", "content": "2"} in page.all("meta")
    assert refreshed is not state.stage.is_final
    assert "18 May 2033, 03:33 UTC" in page.words


@pytest.mark.parametrize("stage", Stage)
def test_only_the_sender_sees_how_to_end_a_check(
    client: Client, jobs: BoardJobs, stage: Stage
) -> None:
    jobs.states[ID] = replace(QUEUED, stage=stage)
    others = client.get(f"/checks/{ID}").text
    own = client.request("GET", f"/checks/{ID}", headers=SENDER).text
    assert f"/checks/{ID}/cancel" not in others
    assert f"/checks/{ID}/delete" not in others
    assert (f"/checks/{ID}/cancel" in own) is not stage.is_final
    assert f"/checks/{ID}/delete" in own
    assert SECRET not in own


@pytest.mark.parametrize(
    ("stage", "advice"),
    [(Stage.REFUSED, "Correct this"), (Stage.FAILED, "tell the operator")],
)
def test_a_check_without_a_report_says_what_to_do(stage: Stage, advice: str) -> None:
    assert advice in headline(replace(QUEUED, stage=stage, words="so it is"), ()).advice


@pytest.mark.parametrize("stage", Stage)
def test_the_steps_mark_where_a_check_is(stage: Stage) -> None:
    events = [Event(1, Stage.QUEUED, "", 0.0), Event(2, Stage.STATIC, "", 0.0)]
    stands = [step.stands for step in steps_of(replace(QUEUED, stage=stage), events)]
    expected = {
        Stage.QUEUED: ["now", "next", "next", "next"],
        Stage.STATIC: ["done", "now", "next", "next"],
        Stage.TRIAL: ["done", "done", "now", "next"],
        Stage.DONE: ["done"] * 4,
        Stage.REFUSED: ["done", "stopped", "skipped", "skipped"],
        Stage.FAILED: ["done", "stopped", "skipped", "skipped"],
        Stage.CANCELLED: ["done", "stopped", "skipped", "skipped"],
    }
    assert stands == expected[stage]


def test_first_findings_are_shown_while_the_robot_drives(
    client: Client, jobs: BoardJobs, store: Store
) -> None:
    rover = SAMPLES / "broken_rover_sensor_config_1"
    keep_result(store, to_json(check_package(rover, Settings(trial=False))))
    jobs.states[ID] = replace(QUEUED, stage=Stage.TRIAL, result=KEY, packages=(ROVER,))
    page = Elements(client.get(f"/checks/{ID}").text)
    found = glance(store, KEY)
    assert found is not None
    assert len(found.findings) == SHOWN
    assert all(each.severity == "error" for each in found.findings)
    for each in found.findings:
        assert each.message in page.words
        assert each.where in page.words
        assert {"href": f"/rules/{each.rule}"} in page.all("a")
    assert f"and {found.more} more findings" in page.words
    assert "report.html" not in str(page.all("a"))


def test_a_finished_check_leads_to_its_files(client: Client, jobs: BoardJobs, store: Store) -> None:
    keep_result(store, "{}", "report.sarif", "report.html", "robot.glb")
    jobs.states[ID] = DONE
    links = [each["href"] for each in Elements(client.get(f"/checks/{ID}").text).all("a")]
    for name in ("report.html", "report.json", "report.sarif", "robot.glb"):
        assert f"/api/checks/{ID}/{name}" in links


def test_each_of_several_packages_has_its_report(
    client: Client, jobs: BoardJobs, store: Store
) -> None:
    good = {**ROVER, "name": "good", "verdict": "ready", "errors": 0, "folder": "good"}
    bad = {**ROVER, "folder": "rover~2"}
    names = ("good/report.html", "good/robot.glb", "rover~2/report.html", "index.html")
    keep_result(store, "{}", *names)
    jobs.states[ID] = replace(DONE, packages=(good, bad), words="")
    answer = client.get(f"/checks/{ID}")
    page = Elements(answer.text)
    links = [each["href"] for each in page.all("a")]
    assert "1 of 2 packages ready" in page.words
    assert f"/api/checks/{ID}/packages/good/report.html" in links
    assert f"/api/checks/{ID}/packages/good/robot.glb" in links
    assert f"/api/checks/{ID}/packages/rover~2/report.html" in links
    assert f"/api/checks/{ID}/packages/rover~2/robot.glb" not in links


def test_a_world_is_no_package(client: Client, jobs: BoardJobs, store: Store) -> None:
    world = {**ROVER, "name": "yard.sdf", "kind": "world", "verdict": "ready", "folder": "yard_sdf"}
    world |= {"errors": 0, "warnings": 2}
    robot = {**ROVER, "folder": "rover", "kind": "ros2_package"}
    keep_result(store, "{}", "rover/report.html", "yard_sdf/report.html", "index.html")
    jobs.states[ID] = replace(DONE, packages=(world, robot), words="")
    page = Elements(client.get(f"/checks/{ID}").text)
    words = " ".join(page.words.split())
    assert "0 of 1 package and 1 of 1 world ready: 5 errors and 3 warnings" in words
    assert words.index("rover Not ready") < words.index("yard.sdf world Ready")
    report = {"class": "primary", "href": f"/api/checks/{ID}/packages/rover/report.html"}
    assert report in page.all("a")


def test_what_to_fix_stands_above_the_downloads(
    client: Client, jobs: BoardJobs, store: Store
) -> None:
    report = check_package(SAMPLES / "broken_acme_scout", Settings(trial=False))
    keep_result(store, to_json(report), "report.html", "report.sarif")
    jobs.states[ID] = DONE
    words = Elements(client.get(f"/checks/{ID}").text).words
    assert words.index("What to fix") < words.index("Downloads")
    several = [each for package in report.packages for each in package.findings if each.places[1:]]
    assert several
    assert " more place" in words


def test_the_link_is_the_one_that_others_reach(jobs: BoardJobs, store: Store) -> None:
    jobs.states[ID] = DONE
    for config, expected in (
        (Config(), f"http://localhost/checks/{ID}"),
        (Config(base_url="https://check.example"), f"https://check.example/checks/{ID}"),
    ):
        page = Elements(client_of(jobs, store, config).get(f"/checks/{ID}").text)
        assert [each["value"] for each in page.all("input")] == [expected]


def test_cancelling_ends_the_check_and_returns_to_it(client: Client, jobs: BoardJobs) -> None:
    jobs.states[ID] = QUEUED
    answer = client.post(f"/checks/{ID}/cancel", headers=SENDER)
    assert (answer.status_code, answer.headers["location"]) == (303, f"/checks/{ID}")
    assert jobs.cancelled == [ID]


def test_deleting_asks_first_and_leaves_nothing(client: Client, jobs: BoardJobs) -> None:
    jobs.states[ID] = DONE
    asked = client.request("GET", f"/checks/{ID}/delete", headers=SENDER)
    (form,) = Elements(asked.text).all("form")
    assert (form["method"], form["action"]) == ("post", f"/checks/{ID}/delete")
    assert "Delete this check?" in asked.text
    assert jobs.states == {ID: DONE}
    done = client.post(f"/checks/{ID}/delete", headers=SENDER)
    assert (done.status_code, jobs.states) == (200, {})
    assert "Upload and report are deleted within two hours" in done.text
    assert 'subt-check-secret=""' in done.headers["set-cookie"]
    assert f"Path=/checks/{ID}" in done.headers["set-cookie"]
    assert client.get(f"/checks/{ID}").status_code == 404


@pytest.mark.parametrize(
    ("method", "what"), [("GET", "delete"), ("POST", "delete"), ("POST", "cancel")]
)
@pytest.mark.parametrize("cookie", ["", "subt-check-secret=x", f"other={SECRET}"])
def test_others_are_told_who_may(
    client: Client, jobs: BoardJobs, method: str, what: str, cookie: str
) -> None:
    if method == "GET" and cookie.startswith("subt-check"):
        return  # to ask shows nothing that the check's own page does not
    jobs.states[ID] = QUEUED
    headers = {"Cookie": cookie, "Subt-Check-Secret": SECRET}
    answer = client.request(method, f"/checks/{ID}/{what}", headers=headers)
    assert answer.status_code == 403
    said = f"Only the person who uploaded this package can {what} its check."
    assert said in Elements(answer.text).words
    assert (jobs.states, jobs.cancelled) == ({ID: QUEUED}, [])


def test_the_form_has_the_browser_keep_the_secret(client: Client) -> None:
    answer = client.post("/checks", files={"file": ("rover.sdf", b"<sdf/>")})
    assert answer.headers["set-cookie"].startswith(f"subt-check-secret={SECRET}; HttpOnly; ")


def title(text: str) -> str:
    return text.partition("<title>")[2].partition("</title>")[0]


def test_a_check_is_called_as_its_package_as_soon_as_that_is_known(
    client: Client, jobs: BoardJobs
) -> None:
    named = ({**ROVER, "name": "acme_rover"},)
    for state, name, lead in (
        (QUEUED, "rover.zip", "Waiting"),
        (replace(QUEUED, stage=Stage.TRIAL, packages=named), "acme_rover", "Checking"),
        (replace(DONE, packages=named), "acme_rover", "Not ready"),
        (replace(DONE, packages=named * 2), "rover.zip", "0 of 2 packages ready"),
    ):
        jobs.states[ID] = state
        text = client.get(f"/checks/{ID}").text
        assert title(text) == f"{name}: {lead} – subt-check"
        assert f"<h1><bdi>{name}</bdi></h1>" in text
        assert ("uploaded as <bdi>rover.zip</bdi>" in text) is (name == "acme_rover")


NOWHERE = (
    *("/nothing", "/checks/ABCDEFGHIJKLMNOPQRSTUV", "/checks/%00", "/checks/x' or 1=1"),
    *("/checks/..%2f..%2fetc", "/rules/ZZZ999", "/static/0000000000000000/site.css"),
)


@pytest.mark.parametrize("address", NOWHERE)
def test_what_is_not_there_is_answered_alike(client: Client, address: str) -> None:
    answer = client.get(address)
    assert answer.status_code == 404
    assert answer.text == client.get("/checks/another").text


def test_fixed_files_are_kept_for_ever_under_names_that_change(client: Client) -> None:
    page = Elements(client.get("/").text)
    sources = [each["src"] for each in page.all("script")]
    sources += [each["href"] for each in page.all("link")]
    assert len(sources) == 4
    for source in sources:
        assert source is not None
        assert re.fullmatch(r"/static/[0-9a-f]{16}/[a-z]+\.(css|js|svg)", source)
        answer = client.get(source)
        assert answer.status_code == 200
        assert "immutable" in answer.headers["cache-control"]
        other = source.replace(source.split("/")[2], "0" * 16)
        assert client.get(other).status_code == 404


PAGES = (
    *("/", f"/checks/{ID}", f"/checks/{ID}/delete"),
    *("/api", "/rules", "/rules/SEN005", "/nothing"),
)


@pytest.mark.parametrize("address", PAGES)
def test_no_page_holds_a_script_or_a_style(client: Client, jobs: BoardJobs, address: str) -> None:
    jobs.states[ID] = DONE
    answer = client.request("GET", address, headers=SENDER)
    policy = answer.headers["content-security-policy"]
    assert "unsafe" not in policy
    page = Elements(answer.text)
    assert not page.all("style")
    for tag, attributes in page.found:
        assert tag != "script" or attributes.get("src")
        assert not [name for name in attributes if name == "style" or name.startswith("on")]


def test_every_rule_has_a_page_and_stands_in_the_list(client: Client) -> None:
    links = [each.get("href") for each in Elements(client.get("/rules").text).all("a")]
    for rule in all_rules():
        assert f"/rules/{rule.id}" in links
        answer = client.get(f"/rules/{rule.id.lower()}")
        assert answer.status_code == 200
        assert rule.name in answer.text


def test_a_report_that_is_none_is_not_shown(client: Client, jobs: BoardJobs, store: Store) -> None:
    keep_result(store, '{"schema_version": "1", "packages": [{}]}')
    jobs.states[ID] = replace(QUEUED, stage=Stage.TRIAL, result=KEY)
    assert client.get(f"/checks/{ID}").status_code == 200
    assert glance(store, KEY) is None


@pytest.fixture(scope="module")
def hostile_board(tmp_path_factory: pytest.TempPathFactory) -> tuple[BoardJobs, Store, Client]:
    jobs, store = BoardJobs(), Store(tmp_path_factory.mktemp("data"))
    return jobs, store, client_of(jobs, store)


@settings(max_examples=examples(30))
@given(st.lists(PACKAGES, min_size=1, max_size=3), st.sampled_from(HOSTILE))
def test_what_users_name_things_never_becomes_part_of_the_page(
    hostile_board: tuple[BoardJobs, Store, Client], packages: list[PackageReport], hostile: str
) -> None:
    jobs, store, client = hostile_board
    report = Report(tuple(packages), {})
    named = [
        {**ROVER, "name": f"{hostile}<b>{package.name}", "folder": folder}
        for package, folder in zip(report.packages, package_folders(report), strict=True)
    ]
    text = to_json(report)
    key = hashlib.sha256(text.encode()).hexdigest()
    keep_result(store, text, key=key)
    words = f"Not ready: {hostile}<i>"
    jobs.states[ID] = replace(DONE, result=key, packages=tuple(named), words=words)
    answer = client.get(f"/checks/{ID}")
    page = Elements(answer.text)
    assert answer.status_code == 200
    assert not page.all("b") + page.all("i")
    assert len(page.all("script")) == 1
    assert not page.all("img")
    assert not re.search("[\u202a-\u202e\u2066-\u2069\x1b]", answer.text)


def test_package_lines_are_escaped_addresses() -> None:
    odd = {**ROVER, "folder": 'a"b/../c'}
    (line,) = package_lines(replace(DONE, packages=(odd,)), ('a"b/../c/report.html',))
    assert line.page == f"/api/checks/{ID}/packages/a%22b%2F..%2Fc/report.html"


def test_many_packages_stay_readable(client: Client, jobs: BoardJobs) -> None:
    many = tuple({**ROVER, "name": f"p{n}", "folder": f"p{n}"} for n in range(2_000))
    jobs.states[ID] = replace(DONE, packages=many, words="")
    answer = client.get(f"/checks/{ID}")
    assert len(Elements(answer.text).all("tr")) == 501
    assert "and 1500 more packages" in answer.text
