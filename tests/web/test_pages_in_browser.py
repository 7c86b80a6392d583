"""The pages in a real browser, with checks that stand where the test puts them."""

from __future__ import annotations

import shutil
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from msgspec.structs import replace

from checker.package.archives.index import ArchiveLimits
from checker.pipeline import check_package
from checker.report.html.page import to_html, to_index
from checker.report.json_report import to_json
from checker.report.render_settings import RenderSettings, palette_for
from checker.report.report import Report
from checker.service.jobs.port import Event, JobsUnreachable, Stage, State
from checker.service.store.store import Store
from checker.service.web.app import create_app
from checker.service.web.config import Config
from checker.settings import Settings
from support.browser import watched_page
from tests.conftest import SAMPLES
from tests.web.board import DONE, ID, KEY, QUEUED, ROVER, SECRET, BoardJobs, keep_result
from tests.web.server import served

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

BUGGY = SAMPLES / "subtcheck_buggy_sensor_config_1"
TOKEN = "s3cret"  # noqa: S105
NAMED = {**ROVER, "name": "</script><b>\u202erover\N{ROBOT FACE}"}


@dataclass
class TellingJobs(BoardJobs):
    """A board whose changes are told."""

    told: list[Event] = field(default_factory=list)

    def happened(self) -> Sequence[Event]:
        return self.told

    def tell(self, stage: Stage) -> None:
        self.told.append(Event(len(self.told) + 1, stage, "", 0.0))


@dataclass
class Board:
    """A site and what stands behind it."""

    address: str
    jobs: TellingJobs
    store: Store


def served_board(folder: Path, config: Config) -> Iterator[Board]:
    jobs, store = TellingJobs(), Store(folder / "data")
    with served(create_app(jobs, store, config)) as port:
        yield Board(f"http://localhost:{port}", jobs, store)


@pytest.fixture
def board(tmp_path: Path) -> Iterator[Board]:
    yield from served_board(tmp_path, Config(upload_limit=2_000_000))


@pytest.fixture
def guarded_board(tmp_path: Path) -> Iterator[Board]:
    yield from served_board(tmp_path, Config(tokens=(TOKEN,)))


def stand(board: Board, stage: Stage) -> None:
    """Put the check into a stage, with findings as soon as there are some."""
    if stage in (Stage.TRIAL, Stage.DONE):
        if not board.store.has(KEY):
            report = Report((), {})
            keep_result(board.store, to_json(report), "report.html", "report.sarif", "robot.glb")
        known = replace(DONE, stage=stage, packages=(NAMED,))
        board.jobs.states[ID] = known if stage is Stage.DONE else replace(known, words="")
    else:
        board.jobs.states[ID] = replace(QUEUED, stage=stage, ahead=2, words="the reason")
    board.jobs.tell(stage)


def is_senders(page: Page) -> None:
    """Have the browser of a page keep the secret of the check, as if it had sent the package."""
    given = {"name": "subt-check-secret", "value": SECRET, "sameSite": "Strict", "httpOnly": True}
    page.context.add_cookies([{**given, "domain": "localhost", "path": f"/checks/{ID}"}])


def axe_violations(page: Page) -> list[object]:
    from axe_playwright_python.sync_playwright import Axe

    response = Axe().run(page).response
    assert len(response["passes"]) > 10
    return [
        (each["id"], [node["html"][:200] for node in each["nodes"][:3]])
        for each in response["violations"]
    ]


def upload_of(board: Board) -> Path:
    """Return what was uploaded last."""
    found = board.store.upload(board.jobs.states[ID].order.upload)
    assert found is not None
    return found


MARK = """() => {
  const kinds = "a[href], button, input, select, summary, [tabindex='0']";
  window.due = [...document.querySelectorAll(kinds)]
    .filter((each) => each.checkVisibility() && !each.disabled)
    .slice(0, 30);
  return window.due.length;
}"""
HERE = """() => {
  const here = document.activeElement;
  const style = getComputedStyle(here);
  const seen = style.outlineStyle !== "none" || style.boxShadow !== "none";
  return here === window.due.shift() && seen ? "" : here.outerHTML;
}"""


def lost_to_the_keyboard(page: Page) -> list[str]:
    """Go through a page by Tab; return where that skips something, or does not show where it is."""
    lost = []
    for _ in range(page.evaluate(MARK)):
        page.keyboard.press("Tab")
        lost.append(page.evaluate(HERE))
    return list(filter(None, lost))


ADDRESSES = [
    *("/", "/api", "/rules/SEN005", "/rules"),
    *(f"/checks/{ID}?{stage}" for stage in Stage),
    f"/checks/{ID}/delete?{Stage.DONE}",
]


@pytest.mark.parametrize("address", ADDRESSES)
@pytest.mark.parametrize(("width", "dark"), [(1280, False), (390, True)])
def test_every_page_is_for_everybody(
    chromium: Browser, board: Board, address: str, width: int, dark: bool
) -> None:
    if "?" in address:
        stand(board, Stage(address.partition("?")[2]))
    with watched_page(chromium, width=width, dark=dark) as page:
        is_senders(page)
        page.goto(board.address + address)
        page.wait_for_load_state()
        assert lost_to_the_keyboard(page) == []
        assert axe_violations(page) == []
        overflow = page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth")
        assert overflow <= 0, "the page is wider than the window"
        assert "</script><b>" not in page.content()


@pytest.mark.parametrize("rule", ["PKG012", "SEN026", "TRI002"])
def test_long_options_stay_on_a_narrow_page(chromium: Browser, board: Board, rule: str) -> None:
    with watched_page(chromium, width=390) as page:
        page.goto(f"{board.address}/rules/{rule}")
        told = page.locator(".told")
        assert told.locator("table tr").count() > 1
        assert told.evaluate("told => told.scrollWidth - told.clientWidth") <= 0


def unreachable(_: str) -> State | None:
    raise JobsUnreachable


@pytest.mark.parametrize(("width", "dark"), [(1280, False), (390, True)])
def test_a_page_of_an_error_is_for_everybody(
    chromium: Browser, board: Board, monkeypatch: pytest.MonkeyPatch, width: int, dark: bool
) -> None:
    context = chromium.new_context(
        viewport={"width": width, "height": 800},
        color_scheme="dark" if dark else "light",
    )
    page = context.new_page()
    page.set_default_timeout(10_000)

    def assert_shown(sentence: str) -> None:
        page.get_by_role("heading", name=sentence).wait_for()
        assert axe_violations(page) == []
        assert lost_to_the_keyboard(page) == []

    try:
        page.goto(f"{board.address}/checks/guessed")
        assert_shown("Nothing is at this address.")
        page.get_by_role("link", name="Check a package").click()
        page.get_by_label("Archive or model file").set_input_files(Path(__file__))
        page.evaluate("document.getElementById('upload').submit()")  # as without the script
        assert_shown("The file is not a package, archive or model file")
        monkeypatch.setattr(board.jobs, "status", unreachable)
        page.goto(f"{board.address}/checks/{ID}")
        assert_shown("The service cannot reach its database.")
    finally:
        context.close()


def test_the_page_follows_the_check_by_itself(chromium: Browser, board: Board) -> None:
    stand(board, Stage.QUEUED)
    with watched_page(chromium) as page:
        is_senders(page)
        page.goto(f"{board.address}/checks/{ID}")
        sentence, now = page.locator(".sentence"), page.locator("[aria-current=step]")
        assert sentence.inner_text() == "Waiting: 2 checks ahead"
        page.evaluate("window.same = true")
        for stage, step, said in (
            (Stage.STATIC, "Rules", "Checking: the reason"),
            (Stage.TRIAL, "Trial", "Checking: 5 errors and 1 warning so far"),
        ):
            stand(board, stage)
            page.get_by_text(said).first.wait_for()
            assert step in now.inner_text()
            assert page.locator("[role=status]").inner_text() == said
        page.get_by_role("button", name="Cancel").focus()
        stand(board, Stage.DONE)
        page.get_by_role("link", name="Open the report").wait_for()
        assert page.evaluate("window.same"), "the page was loaded anew"
        focused = page.evaluate("document.activeElement.textContent")
        assert focused == "Open the report", "who stood on a button that went is lost"
        assert "rover\N{ROBOT FACE}: Not ready" in page.title()
        assert page.locator("[aria-current=step]").count() == 0


def test_a_service_that_is_away_for_a_moment_is_asked_again(
    chromium: Browser, board: Board
) -> None:
    stand(board, Stage.STATIC)
    page = chromium.new_page()
    try:
        page.goto(f"{board.address}/checks/{ID}")
        page.context.set_offline(True)
        page.get_by_text("trying again").wait_for(state="attached", timeout=20_000)
        page.context.set_offline(False)
        stand(board, Stage.DONE)
        page.get_by_role("link", name="Open the report").wait_for(timeout=20_000)
    finally:
        page.close()


@pytest.mark.parametrize("javascript", [True, False])
def test_cancelling(chromium: Browser, board: Board, javascript: bool) -> None:
    stand(board, Stage.STATIC)
    with watched_page(chromium, javascript=javascript) as page:
        is_senders(page)
        page.goto(f"{board.address}/checks/{ID}")
        page.get_by_role("button", name="Cancel").click()
        page.wait_for_load_state()
        assert board.jobs.cancelled == [ID]
        assert page.url == f"{board.address}/checks/{ID}"


@pytest.mark.parametrize("javascript", [True, False])
def test_deleting(chromium: Browser, board: Board, javascript: bool) -> None:
    stand(board, Stage.DONE)
    with watched_page(chromium, javascript=javascript) as page:
        is_senders(page)
        page.goto(f"{board.address}/checks/{ID}")
        page.get_by_role("link", name="Delete").click()
        page.get_by_role("link", name="Keep it").click()
        page.get_by_role("link", name="Delete").click()
        page.get_by_role("button", name="Delete").click()
        page.get_by_text("Its link").or_(page.get_by_text("The link of this check")).wait_for()
        assert page.locator(".sentence").inner_text() == "Deleted"
        assert board.jobs.states == {}
        assert page.context.cookies() == []


@pytest.mark.parametrize("name", ["report.html", "packages/index.html"])
def test_a_report_leads_back_to_its_check(chromium: Browser, board: Board, name: str) -> None:
    """In an origin of its own, it brings no cookie along: the check's page asks for them itself."""
    report = check_package(BUGGY, Settings(trial=False))
    pages = {
        "report.html": to_html(
            report.packages[0], report, RenderSettings(palette_for("never", None))
        )
    }
    pages["index.html"] = to_index(report, [""])
    with board.store.workplace() as place:
        (place / "made").mkdir()
        (place / "made" / "report.json").write_text(to_json(report), "utf-8")
        for file, text in pages.items():
            (place / "made" / file).write_text(text, "utf-8")
        board.store.keep(KEY, place / "made")
    board.jobs.states[ID] = DONE
    page = chromium.new_page()
    try:
        is_senders(page)
        page.goto(f"{board.address}/api/checks/{ID}/{name}")
        back = page.get_by_role("link", name="Back to the check")
        assert page.locator("header a").first.inner_text() == "Back to the check"
        assert back.bounding_box() is not None
        back.click()
        page.wait_for_url(f"{board.address}/checks/{ID}")
        page.get_by_role("link", name="Delete").wait_for()
    finally:
        page.close()


def test_without_javascript_the_page_comes_anew(chromium: Browser, board: Board) -> None:
    stand(board, Stage.QUEUED)
    with watched_page(chromium, javascript=False) as page:
        page.goto(f"{board.address}/checks/{ID}")
        stand(board, Stage.DONE)
        page.get_by_role("link", name="Open the report").wait_for()
        assert not page.locator("#copy").is_visible()
        assert page.get_by_label("Link to this check").input_value() == page.url


def test_the_link_is_copied(chromium: Browser, board: Board) -> None:
    stand(board, Stage.DONE)
    with watched_page(chromium) as page:
        page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        page.goto(f"{board.address}/checks/{ID}")
        page.get_by_role("button", name="Copy").click()
        page.get_by_role("button", name="Copied").wait_for()
        assert page.evaluate("navigator.clipboard.readText()") == page.url


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package with what a repository would have beside it, and names in other scripts."""
    folder = shutil.copytree(BUGGY, tmp_path / "Wägelchen 包")
    (folder / "leer.txt").touch()
    for hidden in (".git/config", "scripts/__pycache__/x.pyc"):
        (folder / hidden).parent.mkdir(parents=True, exist_ok=True)
        (folder / hidden).write_text("not sent", "utf-8")
    return folder


def files_of(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file())
    sent = [each for each in files if not {".git", "__pycache__"} & {*each.parts}]
    return {each.relative_to(folder.parent).as_posix(): each.read_bytes() for each in sent}


def assert_packed(archive: Path, folder: Path) -> None:
    with zipfile.ZipFile(archive) as made:
        assert made.testzip() is None
        assert {name: made.read(name) for name in made.namelist()} == files_of(folder)


def test_a_folder_is_packed_by_the_page(chromium: Browser, board: Board, package: Path) -> None:
    with watched_page(chromium) as page:
        page.goto(board.address)
        page.get_by_label("or package folder").set_input_files(package)
        number = len(files_of(package))
        page.get_by_text(f"{number} files").wait_for()
        page.get_by_role("button", name="Check").click()
        page.wait_for_url(f"**/checks/{ID}")
        assert_packed(upload_of(board), package)
        first = board.jobs.states[ID].order
        page.goto(board.address)
        page.get_by_label("or package folder").set_input_files(package)
        page.get_by_text(f"{number} files").wait_for()
        page.get_by_label("Profile").select_option("sdf")
        page.get_by_role("button", name="Check").click()
        page.wait_for_url(f"**/checks/{ID}")
        assert board.jobs.states[ID].order == replace(first, profile="sdf")


def drop(page: Page, *paths: Path) -> None:
    """Drag files or folders from the desktop onto the drop zone."""
    box = page.locator("#drop").bounding_box()
    assert box is not None
    session = page.context.new_cdp_session(page)
    dragged = {"items": [], "files": [str(each) for each in paths], "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        where = {"x": box["x"] + 20, "y": box["y"] + 20}
        session.send("Input.dispatchDragEvent", {"type": kind, **where, "data": dragged})


def test_a_folder_is_dropped(chromium: Browser, board: Board, package: Path) -> None:
    with watched_page(chromium) as page:
        page.goto(board.address)
        drop(page, package)
        page.get_by_text("Wägelchen 包.zip").wait_for()
        page.get_by_role("button", name="Check").click()
        page.wait_for_url(f"**/checks/{ID}")
        assert_packed(upload_of(board), package)


ARM = """<robot name="arm"><link name="base"><visual><geometry>
<mesh filename="package://my_arm/meshes/visual/base.stl"/></geometry></visual>
<collision><geometry><mesh filename='../meshes/hull.STL'/></geometry></collision></link></robot>
"""


def sent(page: Page, board: Board) -> dict[str, bytes]:
    """Send what was chosen, and return the files of the archive that came."""
    page.get_by_role("button", name="Check").click()
    page.wait_for_url(f"**/checks/{ID}")
    with zipfile.ZipFile(upload_of(board)) as made:
        return {name: made.read(name) for name in made.namelist()}


def test_a_model_asks_for_its_meshes_and_takes_them(
    chromium: Browser, board: Board, tmp_path: Path
) -> None:
    files = {"arm.urdf": ARM.encode(), "base.stl": b"solid base", "hull.STL": b"solid hull"}
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    with watched_page(chromium) as page:
        page.goto(board.address)
        drop(page, tmp_path / "arm.urdf")
        page.locator("#missing").get_by_text("The model needs base.stl, hull.STL").wait_for()
        drop(page, tmp_path / "base.stl")
        page.locator("#missing").get_by_text("The model needs hull.STL").wait_for()
        drop(page, tmp_path / "hull.STL")
        page.locator("#chosen").get_by_text("my_arm.zip: 3 files").wait_for()
        assert page.locator("#missing").inner_text() == ""
        assert sent(page, board) == {
            "my_arm/urdf/arm.urdf": files["arm.urdf"],
            "my_arm/meshes/visual/base.stl": files["base.stl"],
            "my_arm/meshes/hull.STL": files["hull.STL"],
        }


TRUCK = """<robot name="truck" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:include filename="$(find truck)/urdf/parts/wheel.xacro"/>
<link name="a"><visual><geometry>
<mesh filename="file://$(find truck)/meshes/${side}.dae"/></geometry></visual></link></robot>
"""


def test_what_comes_before_its_model_is_kept(
    chromium: Browser, board: Board, tmp_path: Path
) -> None:
    contents = {"left.dae": "<COLLADA/>", "truck.xacro": TRUCK, "wheel.xacro": "<robot/>"}
    for name, content in contents.items():
        (tmp_path / name).write_text(content, "utf-8")
    with watched_page(chromium) as page:
        page.goto(board.address)
        drop(page, tmp_path / "left.dae")
        page.get_by_role("alert").get_by_text("left.dae is not a model. Add the .urdf").wait_for()
        drop(page, tmp_path / "truck.xacro")
        page.locator("#missing").get_by_text("The model needs wheel.xacro: drop").wait_for()
        drop(page, tmp_path / "wheel.xacro")
        page.locator("#chosen").get_by_text("truck.zip: 3 files").wait_for()
        assert sorted(sent(page, board)) == [
            "truck/meshes/left.dae",
            "truck/urdf/parts/wheel.xacro",
            "truck/urdf/truck.xacro",
        ]


def test_one_model_is_sent_as_it_is(chromium: Browser, board: Board, package: Path) -> None:
    with watched_page(chromium) as page:
        page.goto(board.address)
        drop(page, package / "model.sdf")
        page.locator("#chosen").get_by_text("model.sdf").wait_for()
        assert page.get_by_role("alert").inner_text() == ""
        page.get_by_role("button", name="Check").click()
        page.wait_for_url(f"**/checks/{ID}")
        assert board.jobs.states[ID].order.name == "model.sdf"


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (("arm.stl", "hand.stl"), "None of these files is a model"),
        (("arm.zip", "arm.urdf"), "arm.zip is an archive: send it alone"),
        (("arm.stl",), "arm.stl is not a model. Add the .urdf"),
        (("arm.step",), "does not end in"),
    ],
)
def test_files_that_are_no_robot(
    chromium: Browser, board: Board, tmp_path: Path, names: tuple[str, ...], said: str
) -> None:
    for name in names:
        (tmp_path / name).write_text("x")
    with watched_page(chromium) as page:
        page.goto(board.address)
        drop(page, *(tmp_path / name for name in names))
        page.get_by_role("alert").get_by_text(said).wait_for()


def test_what_is_beyond_the_limits_is_not_sent(
    chromium: Browser, board: Board, tmp_path: Path
) -> None:
    large, many, empty = (tmp_path / name for name in ("large", "many", "empty"))
    for folder in (large, many, empty / ".git"):
        folder.mkdir(parents=True)
    (large / "mesh.dae").write_bytes(bytes(2_000_001))
    for number in range(ArchiveLimits().entries + 1):
        (many / str(number)).touch()
    (empty / ".git" / "config").touch()
    wrong = tmp_path / "notes.txt"
    wrong.write_text("hello", "utf-8")
    with watched_page(chromium) as page:
        page.goto(board.address)
        said = page.get_by_role("alert")
        page.get_by_role("button", name="Check").press("Enter")
        said.get_by_text("No file is chosen").wait_for()
        page.get_by_label("or package folder").set_input_files(large)
        said.get_by_text("at most 2 MB can be sent").wait_for()
        page.get_by_label("or package folder").set_input_files(many)
        said.get_by_text("more than 5000 files").wait_for()
        page.get_by_label("or package folder").set_input_files(empty)
        said.get_by_text("contains no files").wait_for()
        page.get_by_label("Archive or model file").set_input_files(wrong)
        said.get_by_text("“notes.txt” does not end in .zip").wait_for()
        page.get_by_role("button", name="Check").press("Enter")
        assert said.inner_text().startswith("“notes.txt” does not end in .zip")
        assert axe_violations(page) == []
    assert board.jobs.states == {}


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("notes.zip", b"hello" * 9, "notes.zip has the name of a zip archive, but"),
        ("empty.zip", b"", "empty.zip is empty."),
    ],
)
def test_a_refusal_of_the_service_is_shown_in_place(
    chromium: Browser, board: Board, tmp_path: Path, name: str, content: bytes, said: str
) -> None:
    (tmp_path / name).write_bytes(content)
    page = chromium.new_page()  # the browser itself notes the refusal on its console
    try:
        page.goto(board.address)
        page.get_by_label("Archive or model file").set_input_files(tmp_path / name)
        page.get_by_role("button", name="Check").click()
        page.get_by_text(said).wait_for()
        assert page.get_by_role("alert").inner_text().startswith(said)
        assert page.get_by_role("button", name="Check").is_enabled()
        assert not page.locator("progress").is_visible()
    finally:
        page.close()


@pytest.mark.parametrize("javascript", [True, False])
def test_a_token_opens_the_service(
    chromium: Browser, guarded_board: Board, javascript: bool
) -> None:
    context = chromium.new_context(java_script_enabled=javascript)
    page = context.new_page()
    try:
        for token in ("guess", TOKEN):
            page.goto(guarded_board.address)
            page.get_by_label("Token").fill(token)
            page.get_by_label("Archive or model file").set_input_files(BUGGY / "model.sdf")
            page.get_by_role("button", name="Check").click()
            if token != TOKEN:
                page.get_by_text("This token is not known.").wait_for()
                assert guarded_board.jobs.states == {}
        page.wait_for_url(f"**/checks/{ID}")
    finally:
        context.close()
