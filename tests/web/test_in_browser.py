"""The whole service in a real browser: send a package, watch it being checked, read its report."""

from __future__ import annotations

import os
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from support.browser import watched_page
from support.service import service, zip_of
from tests.conftest import SAMPLES

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

GOOD = SAMPLES / "subtcheck_buggy_sensor_config_1"
BROKEN = SAMPLES / "broken_rover_sensor_config_1"
CRAWLER = SAMPLES / "subtcheck_crawler_sensor_config_1"
CHECKED_MS = 240_000
"""A whole check, on a machine that does much else."""
HEAVY_BYTES = 60_000_000
CHECK_ADDRESS = re.compile(r"/checks/[\w-]{22}$")


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a service with one worker."""
    with service(tmp_path_factory.mktemp("service") / "data") as found:
        yield found


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return zip_of([GOOD], tmp_path_factory.mktemp("archives") / "buggy.zip")


def send(page: Page, address: str, file: Path) -> None:
    page.goto(address)
    page.get_by_label("Archive or model file").set_input_files(file)
    page.get_by_role("button", name="Check").click()


def sent(page: Page, address: str, file: Path) -> None:
    send(page, address, file)
    page.wait_for_url(CHECK_ADDRESS, timeout=60_000)


def test_a_good_package_from_the_form_to_the_robot_in_3d(
    chromium: Browser, address: str, good: Path
) -> None:
    with watched_page(chromium) as page:
        sent(page, address, good)
        link = page.url
        report = page.get_by_role("link", name="Open the report")
        report.wait_for(timeout=CHECKED_MS)
        assert page.locator(".sentence").inner_text().startswith("Ready")
        names = page.locator(".files a").all_inner_texts()
        assert names == ["JSON", "SARIF", "robot.glb"]
        report.click()
        page.wait_for_function("() => window.subtCheckStage !== undefined")
        assert page.locator(".stage canvas").is_visible()
        assert page.locator("h1").inner_text() == GOOD.name
    with watched_page(chromium, width=390, dark=True) as another:
        another.goto(link)
        assert another.locator(".sentence").inner_text().startswith("Ready")
        with another.expect_download() as download:
            another.get_by_role("link", name="robot.glb").click()
        assert download.value.path().read_bytes().startswith(b"glTF")
    stranger = chromium.new_context()
    for guess in (link[:-1] + ("A" if link[-1] != "A" else "B"), f"{address}/checks/1"):
        assert stranger.request.get(guess).status == 404
        assert stranger.request.get(f"{guess}/report.html").status == 404
    stranger.close()


def test_the_same_package_again_has_its_own_link_and_is_done_at_once(
    chromium: Browser, address: str, good: Path
) -> None:
    with watched_page(chromium) as page:
        sent(page, address, good)
        page.get_by_role("link", name="Open the report").wait_for(timeout=CHECKED_MS)
        first = page.url
        with page.expect_response(CHECK_ADDRESS) as answer:
            sent(page, address, good)
        assert page.url != first
        assert "Open the report" in answer.value.text()


def test_first_findings_come_before_the_trial_ends(chromium: Browser, address: str) -> None:
    with watched_page(chromium) as page:
        page.goto(address)
        page.get_by_label("or package folder").set_input_files(BROKEN)
        page.get_by_role("button", name="Check").click()
        page.wait_for_url(CHECK_ADDRESS)
        page.get_by_role("heading", name="First findings").wait_for(timeout=CHECKED_MS)
        assert page.locator("#findings li").count() == 20
        assert "so far" in page.locator(".sentence").inner_text()
        report = page.get_by_role("link", name="Open the report")
        report.wait_for(timeout=CHECKED_MS)
        assert page.locator(".sentence").inner_text().startswith("Not ready")
        page.locator("#findings a").first.click()
        page.wait_for_url("**/rules/*")
        assert page.locator(".told").is_visible()
        page.go_back()
        report.click()
        page.wait_for_function("() => window.subtCheckStage !== undefined")
        assert page.locator("article.finding").count() > 50


def test_two_packages_in_one_archive_without_javascript(
    chromium: Browser, address: str, tmp_path: Path
) -> None:
    archive = zip_of([GOOD, CRAWLER], tmp_path / "both.zip")
    with watched_page(chromium, javascript=False) as page:
        sent(page, address, archive)
        page.get_by_role("heading", name="Packages").wait_for(timeout=CHECKED_MS)
        assert page.locator(".sentence").inner_text() == "2 of 2 packages ready"
        for folder in (GOOD.name, CRAWLER.name):
            page.get_by_role("link", name=folder, exact=True).click()
            page.wait_for_url(f"**/packages/{folder}/report.html")
            assert page.locator("h1").inner_text() == folder
            page.go_back()


WATCH_THE_BAR = """() => {
  const bar = document.getElementById("bar");
  const seen = [];
  new MutationObserver(() => {
    seen.push(bar.value);
    sessionStorage.seen = JSON.stringify(seen);
  }).observe(bar, { attributes: true });
}"""


def test_a_large_archive_shows_how_far_it_is(
    chromium: Browser, address: str, tmp_path: Path
) -> None:
    heavy = {f"{GOOD.name}/materials/textures/noise.png": os.urandom(HEAVY_BYTES)}
    archive = zip_of([GOOD], tmp_path / "heavy.zip", heavy)
    with watched_page(chromium) as page:
        page.goto(address)
        page.evaluate(WATCH_THE_BAR)
        page.get_by_label("Archive or model file").set_input_files(archive)
        page.get_by_text("heavy.zip: 60 MB").wait_for()
        page.get_by_role("button", name="Check").click()
        page.wait_for_url(CHECK_ADDRESS, timeout=120_000)
        seen = page.evaluate("JSON.parse(sessionStorage.seen)")
        assert seen[-1] == 100
        assert any(0 < each < 100 for each in seen), "it jumped from nothing to all"
        assert seen == sorted(seen)
        page.get_by_role("button", name="Cancel").click()
        page.get_by_text("Cancelled").first.wait_for()


def bomb(path: Path) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr("rover/model.sdf", bytes(50_000_000))
    return path


def text(path: Path) -> Path:
    path.write_text("a robot, but only in words\n" * 10, "utf-8")
    return path


@pytest.mark.parametrize("javascript", [True, False])
@pytest.mark.parametrize(
    ("make", "said"), [(bomb, "200 times the size"), (text, "but not its content")]
)
def test_what_is_no_package_is_refused_with_the_reason(
    chromium: Browser, address: str, tmp_path: Path, make: object, said: str, javascript: bool
) -> None:
    assert callable(make)
    context = chromium.new_context(java_script_enabled=javascript)
    page = context.new_page()
    try:
        send(page, address, make(tmp_path / "rover.zip"))
        page.get_by_text(said).wait_for()
        assert not CHECK_ADDRESS.search(page.url)
    finally:
        context.close()


def test_a_damaged_model_is_a_finding_and_no_failure(
    chromium: Browser, address: str, tmp_path: Path
) -> None:
    (tmp_path / "rover.sdf").write_text("<sdf version='1.6'><model name='</script>'>", "utf-8")
    with watched_page(chromium) as page:
        sent(page, address, tmp_path / "rover.sdf")
        page.get_by_role("link", name="Open the report").wait_for(timeout=CHECKED_MS)
        assert page.locator(".sentence").inner_text().startswith("Not ready")
