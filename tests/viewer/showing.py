"""Pages with a viewer in them, and what one sees there."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import pytest
from PIL import Image

from support.browser import watched_page
from tests.conftest import SAMPLES

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

    Colours = tuple[tuple[int, int, int], ...]

BUNDLE = SAMPLES.parent / "templates/report/viewer.js"
TEMPLATE = Path(__file__).parent / "page.html"


def bundle() -> str:
    """Return the viewer as built, or skip the test."""
    if not BUNDLE.exists():
        pytest.skip("the viewer is not built; `make viewer` does")
    return BUNDLE.read_text(encoding="utf-8")


@contextlib.contextmanager
def shown(
    chromium: Browser,
    folder: Path,
    glb: bytes,
    *,
    theme: str = "light",
    still: bool = True,
    rich: bool = False,
    **settings: Any,
) -> Iterator[Page]:
    """A page with a viewer in it, which was asked to show a GLB."""
    options = json.dumps({"theme": theme, "reducedMotion": still, "rich": rich})
    text = TEMPLATE.read_text().replace("{{ viewer }}", bundle())
    text = text.replace("{{ glb }}", base64.b64encode(glb).decode())
    (folder / "page.html").write_text(text.replace("{{ options }}", options))
    with watched_page(chromium, **settings) as page:
        page.goto((folder / "page.html").as_uri())
        page.evaluate("opened")
        yield page


def state(page: Page) -> dict[str, Any]:
    facts: dict[str, Any] = page.evaluate("viewer.state()")
    return facts


def until(page: Page, expression: str) -> None:
    """Wait for a condition. playwright's own way evaluates text, which the page forbids."""
    for _ in range(200):
        if page.evaluate(expression):
            return
        page.wait_for_timeout(50)
    pytest.fail(f"never: {expression}")


def yaw_of(pose: dict[str, list[float]]) -> float:
    x, y, z, w = pose["quaternion"]
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def picture(page: Page) -> Image.Image:
    """What the canvas shows once it has come to rest."""
    page.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return Image.open(io.BytesIO(page.locator("canvas").screenshot())).convert("RGB")


def colours(picture: Image.Image) -> Colours:
    """The pixels, row by row."""
    return cast("Colours", picture.get_flattened_data())


def highlighted(picture: Image.Image) -> int:
    """Number of pixels in the colour of what is selected, however much light is on them."""
    return sum(
        red > 70 and green < red / 3 and red / 3 < blue < 0.9 * red
        for red, green, blue in colours(picture)
    )


def away(state: dict[str, Any]) -> float:
    return math.dist(state["camera"]["position"], state["camera"]["target"])
