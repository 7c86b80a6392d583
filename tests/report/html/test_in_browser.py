"""The page in a real browser: what one sees, presses and reads."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from checker.pipeline import check_package
from checker.report.html.page import to_html
from checker.report.render_settings import Palette, RenderSettings
from checker.settings import Settings
from tests.browser import watched_page, without_webgl
from tests.conftest import SAMPLES

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

WHEELED = "husky_migration_sensor_config_1"
TRACKED = "subtcheck_crawler_sensor_config_1"
COPTER = "subtcheck_quadro_sensor_config_1"
BROKEN = "broken_rover_sensor_config_1"
SEVERAL = "broken_ouster_description"
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


def open_page(page: Page, address: str) -> None:
    page.goto(address)
    page.wait_for_function("() => window.subtCheckStage !== undefined")


def state(page: Page) -> dict[str, Any]:
    found: dict[str, Any] = page.evaluate("() => window.subtCheckStage.state()")
    return found


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
            turned = zip(first["quaternion"], later["quaternion"], strict=True)
            assert abs(sum(a * b for a, b in turned)) < 0.999


def test_slider_and_plots_show_one_moment(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(WHEELED))
        put_at(page, 9.0)
        assert state(page)["time"] == pytest.approx(9.0)
        assert page.locator(".moment").inner_text() == "9.00 s"
        assert page.locator(".stage .leg").inner_text() == "turn"
        marks = page.locator(".plot .now").evaluate_all("all => all.map((each) => each.style.left)")
        assert len(set(marks)) == 1
        assert float(marks[0].rstrip("%")) == pytest.approx(60.0, abs=0.5)
        box = page.locator(".plot .field").first.bounding_box()
        assert box is not None
        page.locator(".plot .field").first.click(position={"x": box["width"] / 3, "y": 20})
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


def test_severities_can_be_hidden(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(BROKEN))
        warnings = page.locator("article.warning")
        assert warnings.first.is_visible()
        page.locator("input[data-severity=warning]").uncheck()
        assert not any(each.is_visible() for each in warnings.all())
        assert page.locator("article.error").first.is_visible()


def test_without_javascript_everything_but_the_3d_is_there(
    chromium: Browser, report: Callable[[str], str]
) -> None:
    address = report(BROKEN)
    with watched_page(chromium, javascript=False) as page:
        page.goto(address)
        assert page.locator("article.rule").count() > 50
        assert page.locator(".pictures img").first.is_visible()
        assert page.locator(".plot polyline").count() > 4
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
        assert not second.locator("table").is_visible()
        robots.nth(1).get_by_role("link").click()
        second.locator("table").wait_for(state="visible")
        put_at(page, 3.0)
        marks = page.locator("#trial-1 .now").evaluate_all(
            "all => all.map((each) => each.style.left)"
        )
        assert len(set(marks)) == 1
        assert not second.locator(".now").first.is_visible()


@pytest.mark.parametrize("name", [WHEELED, BROKEN, SEVERAL])
@pytest.mark.parametrize("dark", [False, True])
def test_axe_finds_nothing_serious(
    chromium: Browser, report: Callable[[str], str], name: str, dark: bool
) -> None:
    from axe_playwright_python.sync_playwright import Axe

    with watched_page(chromium, dark=dark) as page:
        open_page(page, report(name))
        response = Axe().run(page).response
        assert len(response["passes"]) > 10
        found = response["violations"]
        grave = [
            (each["id"], [node["html"][:200] for node in each["nodes"][:3]])
            for each in found
            if each["impact"] in ("serious", "critical")
        ]
        assert grave == []


def test_it_prints_on_a4(chromium: Browser, report: Callable[[str], str]) -> None:
    with watched_page(chromium) as page:
        open_page(page, report(WHEELED))
        page.emulate_media(media="print")
        assert page.locator(".pictures img").first.is_visible()
        assert not page.locator(".controls").is_visible()
        assert not page.locator("nav").is_visible()
        printed = page.pdf(prefer_css_page_size=True)
        assert printed.startswith(b"%PDF")
        assert b"/MediaBox [0 0 594" in printed or b"/MediaBox [0 0 595" in printed
