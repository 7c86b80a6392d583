"""What the viewer answers: selection, clicks, keys, wheel and fingers."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.viewer.rover import AXLE, BODY, HEIGHT, rover
from tests.viewer.showing import (
    away,
    highlighted,
    picture,
    shown,
    state,
    until,
)

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page


@pytest.mark.parametrize(
    ("path", "found"),
    [
        (BODY, BODY),
        (f"{BODY}/visual[hull]/geometry/box/size", f"{BODY}/visual[hull]"),
        (f"{BODY}/inertial/mass", BODY),
        (f"{AXLE}/axis/limit", AXLE),
        (f"{BODY}x", ""),
        ("sdf/model[rover]/plugin[drive]", ""),
        ("", ""),
    ],
)
def test_select_finds_the_part_that_an_element_belongs_to(
    view: Page, path: str, found: str
) -> None:
    assert view.evaluate("path => viewer.select(path)", path) == found
    assert state(view)["selected"] == found
    assert (highlighted(picture(view)) > 200) == bool(found)


def test_select_comes_nearer_and_names_the_part(view: Page) -> None:
    before = state(view)
    view.evaluate("path => viewer.select(path)", AXLE)
    after = state(view)
    assert away(after) < away(before)
    assert after["camera"]["target"] == pytest.approx([0.4, 0, HEIGHT], abs=1e-3)
    assert highlighted(picture(view)) > 200, "though its layer is off and the hull hides it"
    assert view.get_by_text("axle", exact=True).is_visible()
    view.evaluate("viewer.select('')")
    assert highlighted(picture(view)) == 0
    assert not view.get_by_text("axle", exact=True).is_visible()
    assert state(view)["layers"]["joint"] is False


def test_a_click_selects_and_tells(view: Page) -> None:
    view.locator("canvas").click()
    hull = f"{BODY}/visual[hull]"
    assert view.evaluate("heard.selected") == [[hull, "hull"]]
    assert state(view)["selected"] == hull
    assert highlighted(picture(view)) > 1000
    view.locator("canvas").click(position={"x": 5, "y": 5})
    assert view.evaluate("heard.selected")[-1] == ["", ""]
    assert highlighted(picture(view)) == 0


def test_a_layer_that_was_switched_on_is_clicked_before_the_visuals(view: Page) -> None:
    view.evaluate("viewer.setLayer('collision', true)")
    view.locator("canvas").click()
    assert state(view)["selected"] == f"{BODY}/collision[hull]"


def test_a_drag_turns_and_selects_nothing(view: Page) -> None:
    before = state(view)["camera"]["position"]
    view.mouse.move(640, 240)
    view.mouse.down()
    view.mouse.move(740, 240, steps=4)
    view.mouse.up()
    assert view.evaluate("heard.selected") == []
    assert math.dist(state(view)["camera"]["position"], before) > 0.5


def test_keys_turn_zoom_and_reset(view: Page) -> None:
    canvas = view.locator("canvas")
    assert "arrow keys" in (canvas.get_attribute("aria-label") or "")
    view.keyboard.press("Tab")
    assert view.evaluate("document.activeElement.tagName") == "CANVAS"
    home = state(view)
    view.keyboard.press("ArrowLeft")
    turned = state(view)
    assert math.dist(turned["camera"]["position"], home["camera"]["position"]) > 0.1
    assert away(turned) == pytest.approx(away(home), rel=1e-6)
    view.keyboard.press("+")
    assert away(state(view)) < away(home)
    view.keyboard.press("-")
    assert away(state(view)) == pytest.approx(away(home), rel=1e-6)
    view.keyboard.press("Home")
    reset = state(view)["camera"]["position"]
    assert reset == pytest.approx(home["camera"]["position"], abs=1e-6)


def test_the_wheel_scrolls_the_page_until_the_view_is_clicked(view: Page) -> None:
    before = away(state(view))
    view.mouse.move(640, 100)
    view.mouse.wheel(0, 60)
    until(view, "scrollY > 0")
    assert away(state(view)) == before
    assert view.get_by_text("Click the view to zoom").is_visible()
    view.evaluate("scrollTo(0, 0)")
    view.mouse.click(640, 100)
    view.mouse.wheel(0, 60)
    until(view, f"viewer.state().camera.position[0] > 1.01 * {before} * 0.7")
    assert view.evaluate("scrollY") == 0


def test_one_finger_may_scroll_the_page(chromium: Browser, tmp_path: Path) -> None:
    with shown(chromium, tmp_path, rover(), width=390, touch=True) as page:
        assert page.evaluate("getComputedStyle(document.querySelector('canvas')).touchAction") == (
            "pan-y"
        )
        page.locator("canvas").tap()
        assert state(page)["selected"] == f"{BODY}/visual[hull]"
        assert page.evaluate("document.documentElement.scrollWidth") == 390
