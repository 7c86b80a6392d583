"""The page in a real browser: what one sees, presses and reads."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from msgspec.structs import replace

from checker.pipeline import check_package, check_paths
from checker.report.files import artefacts
from checker.report.html.page import to_html
from checker.report.render_settings import Palette, RenderSettings
from checker.settings import Settings
from support.browser import watched_page, without_webgl
from tests.conftest import SAMPLES

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page

WHEELED = "husky_migration_sensor_config_1"
TRACKED = "subtcheck_crawler_sensor_config_1"
COPTER = "subtcheck_quadro_sensor_config_1"
BROKEN = "broken_rover_sensor_config_1"
SEVERAL = "broken_ouster_description"
LONG = "ctu_cras_norlab_absolem_with_a_long_name_sensor_config_1"
SHOWN = (WHEELED, TRACKED, COPTER, BROKEN, SEVERAL)


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], str]:
    """Make the page of a sample, once, and return its address."""
    folder = tmp_path_factory.mktemp("reports")

    def made(name: str) -> str:
        file: Path = folder / f"{name}.html"
        if not file.exists():
            found = check_package(SAMPLES / name, Settings(display=True))
            manner = RenderSettings(Palette(enabled=False), str(SAMPLES))
            file.write_text(to_html(found.packages[0], found, manner), "utf-8")
        return file.as_uri()

    return made


@pytest.fixture(scope="module")
def index(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Make the pages of several samples, and return the address of their list."""
    folder = tmp_path_factory.mktemp("several")
    found = check_paths([SAMPLES / name for name in (COPTER, WHEELED, BROKEN)], {"display": True})
    packages = (
        replace(each, name=LONG) if each.name == WHEELED else each for each in found.packages
    )
    found = replace(found, packages=tuple(packages))
    for name, content in artefacts(found, RenderSettings(Palette(enabled=False), str(SAMPLES))):
        file = folder / name
        file.parent.mkdir(exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
    return (folder / "index.html").as_uri()


def open_page(page: Page, address: str) -> None:
    page.goto(address)
    page.wait_for_function("() => window.subtCheckStage !== undefined")


def state(page: Page) -> dict[str, Any]:
    found: dict[str, Any] = page.evaluate("() => window.subtCheckStage.state()")
    return found


def moments(page: Page, within: str = ".in-view") -> list[str]:
    """Return the moments that plots show."""
    return page.locator(f"{within} .u-legend .u-series:first-child .u-value").all_inner_texts()


def shown(page: Page) -> list[Locator]:
    return [each for each in page.locator("article.finding").all() if each.is_visible()]


def put_at(page: Page, seconds: float) -> None:
    page.locator(".time").evaluate(
        "(slider, to) => { slider.value = to; slider.dispatchEvent(new Event('input')); }", seconds
    )


@pytest.mark.parametrize("name", SHOWN)
@pytest.mark.parametrize(("width", "dark"), [(1280, False), (390, True)])
def test_it_opens_without_complaint(
    chromium: Browser, report: Callable[[str], str], name: str, width: int, dark: bool
) -> None:
    with watched_page(chromium, width=width, dark=dark) as page:
        open_page(page, report(name))
        assert page.locator(".stage canvas").is_visible()
        assert not page.locator(".pictures").is_visible()
        overflow = page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth")
        assert overflow <= 0, "the page is wider than the window"
        tables = page.locator("#trial .scroll").evaluate_all(
            "(all) => all.map((each) => each.scrollWidth - each.clientWidth)"
        )
        assert max(tables) <= 0, "a table is wider than its frame"


@pytest.mark.parametrize(
    ("name", "part"),
    [(WHEELED, "front_left_wheel_link"), (TRACKED, "base_link"), (COPTER, "base_link")],
)
def test_the_replay_moves_the_robot(
    chromium: Browser, report: Callable[[str], str], name: str, part: str
) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(name))
        first = state(page)["partPoses"][part]
        page.locator(".speed").select_option("4")
        page.get_by_role("button", name="Play").click()
        page.wait_for_function("() => window.subtCheckStage.state().time > 4")
        page.get_by_role("button", name="Pause").click()
        later = state(page)["partPoses"][part]
        assert math.dist(first["position"], later["position"]) > 0.2
        if name == WHEELED:
            # Where it was paused, a wheel may have turned a whole number of times.
            put_at(page, 3.0)
            there = state(page)["partPoses"][part]
            turned = zip(first["quaternion"], there["quaternion"], strict=True)
            assert abs(sum(a * b for a, b in turned)) < 0.999


def test_slider_and_plots_show_one_moment(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(WHEELED))
        put_at(page, 9.0)
        assert state(page)["time"] == pytest.approx(9.0)
        assert page.locator(".moment").inner_text() == "9.00 s"
        assert page.locator(".stage .leg").inner_text() == "turn"
        assert set(moments(page)) == {"9.00 s"}
        box = page.locator(".plot .u-over").first.bounding_box()
        assert box is not None
        page.locator(".plot .u-over").first.click(position={"x": box["width"] / 3, "y": 20})
        assert state(page)["time"] == pytest.approx(5.0, abs=0.1)
        page.locator(".time").focus()
        page.keyboard.press("ArrowRight")
        assert state(page)["time"] > 5.0


def test_each_switch_shows_its_layer(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(WHEELED))
        boxes = page.locator(".layers input")
        assert boxes.count() == 7
        view = page.locator(".stage .view")
        before = view.screenshot()
        for number in range(1, boxes.count()):
            boxes.nth(number).check()
            page.wait_for_timeout(150)
            after = view.screenshot()
            assert after != before, boxes.nth(number).get_attribute("data-layer")
            assert state(page)["layers"][boxes.nth(number).get_attribute("data-layer")]
            before = after
        assert state(page)["layers"]["visual"] == "transparent"
        boxes.first.uncheck()
        assert state(page)["layers"]["visual"] == "off"


def test_a_finding_shows_its_part_and_a_part_its_findings(
    chromium: Browser, report: Callable[[str], str]
) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(BROKEN))
        finding = page.locator(".finding", has=page.locator(".show:visible")).first
        finding.locator(".show").click()
        chosen = state(page)["selected"]
        elements = (finding.get_attribute("data-elements") or "").split("\n")
        assert any(each == chosen or each.startswith(f"{chosen}/") for each in elements)
        assert "selected" in (finding.get_attribute("class") or "")
        page.get_by_role("button", name="Whole").click()
        page.wait_for_timeout(200)
        box = page.locator(".stage canvas").bounding_box()
        assert box is not None
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        said = page.locator(".chosen").inner_text()
        assert ":" in said
        assert state(page)["selected"]


def test_pointing_at_a_plot_tells_the_values_there(
    chromium: Browser, report: Callable[[str], str]
) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(WHEELED))
        speed = page.locator(".plot").first
        speed.scroll_into_view_if_needed()
        box = speed.locator(".u-over").bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + box["width"] / 3, box["y"] + 40)
        value = speed.locator(".u-series", has_text="measured").locator(".u-value")
        assert float(value.inner_text().removesuffix(" m/s")) == pytest.approx(0.5, abs=0.02)
        commanded = speed.locator(".u-series", has_text="commanded").locator(".u-value")
        assert commanded.inner_text() == "0.5 m/s"
        others = {round(float(each.removesuffix(" s"))) for each in moments(page)}
        assert others == {5}, "all plots tell of one moment"
        page.mouse.move(5, 5)
        page.wait_for_timeout(100)
        assert set(moments(page)) == {"0.00 s"}, "the moment of the replay again"


def test_findings_are_sought_and_filtered(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(BROKEN))
        everything = page.locator("article.finding").count()
        page.locator("input[name=severity][value=warning]").uncheck()
        assert not any("warning" in (each.get_attribute("class") or "") for each in shown(page))
        page.locator("input[name=severity][value=warning]").check()
        page.locator("input[name=concern][value=robot]").uncheck()
        left = shown(page)
        assert left
        assert "robot" not in {each.get_attribute("data-concern") for each in left}
        page.locator("input[name=concern][value=robot]").check()
        search = page.get_by_role("searchbox", name="Search the findings")
        search.fill("SEN005 lidar")
        assert {each.get_attribute("data-rule") for each in shown(page)} == {"SEN005"}
        assert f" of {everything} shown" in page.locator(".filters .shown").inner_text()
        search.fill("")
        page.get_by_label("Rule", exact=True).select_option("KIN001")
        assert {each.get_attribute("data-rule") for each in shown(page)} == {"KIN001"}


def test_a_link_to_a_finding_is_copied_and_leads_there(
    chromium: Browser, report: Callable[[str], str]
) -> None:
    with watched_page(chromium) as page:
        page.context.grant_permissions(["clipboard-read", "clipboard-write"])
        open_page(page, report(BROKEN))
        note = page.locator("article.finding.info").first
        assert not note.is_visible(), "notes are folded"
        anchor = note.get_attribute("id")
        page.locator("article.finding a.copy").first.click()
        page.get_by_text("Link copied").wait_for()
        first = page.locator("article.finding").first.get_attribute("id")
        copied = page.evaluate("() => navigator.clipboard.readText()")
        assert copied == f"{report(BROKEN)}#{first}"
        page.locator("input[name=severity][value=info]").uncheck()
        page.evaluate("(anchor) => { location.hash = anchor; }", anchor)
        note.wait_for(state="visible")
        note.get_by_role("link").first.click()
        rule = page.locator(f"#rule-{note.get_attribute('data-rule')}")
        rule.get_by_text("Options and examples").wait_for(state="visible")


def test_the_index_is_sorted_and_sought(chromium: Browser, index: str) -> None:
    with watched_page(chromium) as page:
        page.goto(index)
        rows = page.locator("table.packages tbody tr")
        names = rows.locator("th").all_inner_texts
        given = names()
        assert len(given) == 3
        assert page.locator("table.packages img").count() == 3
        page.get_by_role("button", name="errors").click()
        assert names()[-1] == BROKEN
        page.get_by_role("button", name="errors").click()
        assert names()[0] == BROKEN
        head = page.get_by_role("columnheader", name="errors")
        assert head.get_attribute("aria-sort") == "descending"
        page.get_by_role("button", name="Package").click()
        assert names() == sorted(given)
        page.get_by_role("searchbox").fill("multicopter")
        assert [each for each in rows.all() if each.is_visible()]
        assert [each.inner_text() for each in rows.locator("th").all() if each.is_visible()] == [
            COPTER
        ]
        leads = page.get_by_role("link", name=COPTER).get_attribute("href")
        assert leads == f"{COPTER}/report.html"


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [1280, 390])
def test_the_index_is_accessible_at_any_width(
    chromium: Browser, index: str, dark: bool, width: int
) -> None:
    from axe_playwright_python.sync_playwright import Axe

    with watched_page(chromium, dark=dark, width=width) as page:
        page.goto(index)
        assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0
        table = page.locator(".scroll").first
        assert table.evaluate("(each) => each.scrollWidth - each.clientWidth") <= 0
        assert Axe().run(page).response["violations"] == []


def test_without_javascript_everything_but_the_3d_is_there(
    chromium: Browser, report: Callable[[str], str]
) -> None:
    address = report(BROKEN)
    with watched_page(chromium, javascript=False) as page:
        page.goto(address)
        assert page.locator("article.finding").count() > 50
        assert page.locator(".pictures img").first.is_visible()
        assert page.get_by_text("The plots need JavaScript; the table has the figures").is_visible()
        assert page.get_by_role("columnheader", name="Limits").is_visible()
        assert not page.locator(".controls").is_visible()
        assert not page.locator(".filters").is_visible()
        assert page.locator("#glb").get_attribute("download") == "robot.glb"


def test_without_webgl_the_pictures_stay(chromium: Browser, report: Callable[[str], str]) -> None:
    address = report(WHEELED)
    with without_webgl(chromium) as blind:
        page = blind.new_page()
        page.goto(address)
        page.wait_for_function("() => document.querySelector('.stage').dataset.trouble")
        assert page.locator(".pictures img").first.is_visible()
        assert not page.locator(".controls").is_visible()


def test_of_several_robots_each_leads_to_its_trial(
    chromium: Browser, report: Callable[[str], str]
) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(SEVERAL))
        robots = page.locator("#robots tbody tr")
        assert robots.count() == 3
        assert "ouster_example" in page.locator(".stage .which").inner_text()
        second = page.locator("#trial-2")
        figures = second.get_by_role("columnheader", name="Limits")
        assert not figures.is_visible()
        robots.nth(1).get_by_role("link").click()
        figures.wait_for(state="visible")
        put_at(page, 3.0)
        assert set(moments(page, "#trial-1")) == {"3.00 s"}
        assert set(moments(page, "#trial-2")) == {"0.00 s"}


@pytest.mark.parametrize("name", [WHEELED, BROKEN, SEVERAL])
@pytest.mark.parametrize("dark", [False, True])
def test_axe_finds_nothing(
    chromium: Browser, report: Callable[[str], str], name: str, dark: bool
) -> None:
    from axe_playwright_python.sync_playwright import Axe

    with watched_page(chromium, dark=dark) as page:
        open_page(page, report(name))
        response = Axe().run(page).response
        assert len(response["passes"]) > 10
        assert response["violations"] == []


def test_it_prints_on_a4(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(BROKEN))
        page.emulate_media(media="print")
        assert page.locator(".pictures img").first.is_visible()
        assert not page.locator(".controls").is_visible()
        assert not page.locator("nav").is_visible()
        page.evaluate("() => dispatchEvent(new Event('beforeprint'))")
        assert page.locator("article.finding.info").first.is_visible(), "notes are unfolded"
        assert page.get_by_text("Options and examples").first.is_visible()
        printed = page.pdf(prefer_css_page_size=True)
        assert printed.startswith(b"%PDF")
        assert b"/MediaBox [0 0 594" in printed or b"/MediaBox [0 0 595" in printed
