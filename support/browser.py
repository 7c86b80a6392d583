"""A real browser for tests: Chromium without a window, driven by playwright.

def test_it(chromium: Browser, tmp_path: Path) -> None:
    with watched_page(chromium, width=390) as page:
        page.goto(file.as_uri())
"""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterator
from typing import TYPE_CHECKING
from urllib.parse import urldefrag, urlsplit

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

_PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
_WEBGL = ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"]
"""Drawn by software, which is there on every machine."""
_NO_WEBGL = ["--no-sandbox", "--disable-gpu", "--disable-3d-apis"]


def _program() -> str:
    """Return where the browser is, or skip the test."""
    for name in _PROGRAMS:
        if found := shutil.which(name):
            return found
    pytest.skip("Chromium is not installed; `make test-more` installs it")


@contextlib.contextmanager
def started() -> Iterator[Browser]:
    """Start a browser."""
    program = _program()
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=_WEBGL)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    """One browser for all tests of a module; the others find no event loop that runs."""
    with started() as browser:
        yield browser


@contextlib.contextmanager
def without_webgl(chromium: Browser) -> Iterator[Browser]:
    """The same browser on a machine that cannot draw in 3D."""
    blind = chromium.browser_type.launch(executable_path=_program(), args=_NO_WEBGL)
    try:
        yield blind
    finally:
        blind.close()


def _itself(url: str) -> str:
    """Return the prefix of addresses that a page may request: a file its own, a site its site's."""
    parts = urlsplit(url)
    return f"{parts.scheme}://{parts.netloc}/" if parts.netloc else urldefrag(url).url


@contextlib.contextmanager
def watched_page(
    chromium: Browser,
    *,
    width: int = 1280,
    height: int = 800,
    dark: bool = False,
    reduced_motion: bool = True,
    touch: bool = False,
    javascript: bool = True,
) -> Iterator[Page]:
    """A page that must not request anything but itself or its site, nor complain on its console."""
    context = chromium.new_context(
        viewport={"width": width, "height": height},
        color_scheme="dark" if dark else "light",
        reduced_motion="reduce" if reduced_motion else "no-preference",
        has_touch=touch,
        java_script_enabled=javascript,
    )
    page = context.new_page()
    page.set_default_timeout(20_000)
    requests: list[str] = []
    complaints: list[str] = []
    page.on("request", lambda request: requests.append(request.url[:200]))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on(
        "console",
        lambda said: complaints.append(said.text) if said.type in {"error", "warning"} else None,
    )
    try:
        yield page
        itself = _itself(page.url)
        beyond = [url for url in requests if not url.startswith(("data:", "blob:", itself))]
        assert not beyond, f"the page asks for {beyond}"
        assert not complaints, complaints
    finally:
        context.close()
