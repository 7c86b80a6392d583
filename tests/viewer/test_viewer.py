"""What the viewer shows: the trial, views, layers and themes."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.viewer.rover import DURATION, HEIGHT, pose_at, rover
from tests.viewer.showing import (
    away,
    bundle,
    colours,
    picture,
    shown,
    state,
    until,
    yaw_of,
)

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page


def test_the_bundle_is_small_and_may_stand_in_a_page() -> None:
    text = bundle()
    assert len(text) < 800_000
    assert "</script" not in text.lower()
    assert "<!--" not in text


def test_the_bundle_carries_the_licence_of_what_it_contains() -> None:
    notice = bundle()[:2000]
    assert "The MIT License" in notice
    assert "three.js authors" in notice
    assert "above copyright notice and this permission notice" in notice


def test_it_knows_the_trial_and_shows_its_start(view: Page) -> None:
    assert view.evaluate("viewer.duration") == pytest.approx(DURATION, abs=1e-6)
    assert view.evaluate("viewer.playing") is False
    pose = state(view)["partPoses"]["body"]
    assert pose["position"] == pytest.approx([0, 0, HEIGHT], abs=1e-6)
    assert yaw_of(pose) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("time", [0.0, 0.05, 1.0, 1.975, 3.0, DURATION])
def test_seek_is_exact(view: Page, time: float) -> None:
    view.evaluate("time => viewer.seek(time)", time)
    facts = state(view)
    x, yaw = pose_at(time)
    assert facts["time"] == pytest.approx(time, abs=1e-6)
    assert facts["partPoses"]["body"]["position"] == pytest.approx([x, 0, HEIGHT], abs=1e-5)
    assert yaw_of(facts["partPoses"]["body"]) == pytest.approx(yaw, abs=1e-5)
    mast = [x - 0.3 * math.cos(yaw), -0.3 * math.sin(yaw), HEIGHT + 0.3]
    assert facts["partPoses"]["mast"]["position"] == pytest.approx(mast, abs=1e-5)


def test_what_lies_outside_the_trial_becomes_its_start_or_end(view: Page) -> None:
    view.evaluate("viewer.seek(99)")
    assert state(view)["time"] == view.evaluate("viewer.duration")
    view.evaluate("viewer.seek(-1)")
    assert state(view)["time"] == 0
    view.evaluate("viewer.seek(NaN)")
    assert state(view)["time"] == 0


def test_playing_moves_the_robot_to_the_end_and_stops_there(view: Page) -> None:
    view.evaluate("viewer.speed = 4; viewer.play()")
    assert view.evaluate("viewer.playing") is True
    until(view, "!viewer.playing")
    times = view.evaluate("heard.times")
    assert times == sorted(set(times))
    assert times[-1] == pytest.approx(DURATION, abs=1e-6)
    assert state(view)["partPoses"]["body"]["position"][0] == pytest.approx(2, abs=1e-5)
    view.evaluate("viewer.play()")
    assert state(view)["time"] < DURATION, "play begins anew at the end"


def test_pause_stops_time(view: Page) -> None:
    view.evaluate("viewer.play()")
    until(view, "viewer.state().time > 0")
    view.evaluate("viewer.pause()")
    stopped = state(view)["time"]
    view.wait_for_timeout(300)
    assert state(view)["time"] == stopped


def test_at_rest_nothing_is_drawn(view: Page) -> None:
    picture(view)
    view.evaluate(
        """() => {
          const ask = window.requestAnimationFrame;
          window.asked = 0;
          window.requestAnimationFrame = (then) => { asked += 1; return ask(then); };
        }"""
    )
    view.wait_for_timeout(300)
    assert view.evaluate("asked") == 0
    view.evaluate("viewer.seek(1)")
    assert view.evaluate("asked") == 1


def test_the_camera_goes_along_if_it_shall(view: Page) -> None:
    start = state(view)["camera"]
    view.evaluate("viewer.seek(1)")
    along = state(view)["camera"]
    assert along["target"][0] == pytest.approx(start["target"][0] + 1, abs=1e-5)
    assert along["position"][0] == pytest.approx(start["position"][0] + 1, abs=1e-5)
    view.evaluate("viewer.follow = false; viewer.seek(2)")
    for place in ("position", "target"):
        assert state(view)["camera"][place] == pytest.approx(along[place], abs=1e-9)


@pytest.mark.parametrize(
    ("name", "time", "direction"),
    [
        ("front", 0.0, (1, 0, 0.06)),
        ("side", 0.0, (0, -1, 0.06)),
        ("top", 0.0, (0, 0, 1)),
        ("front", DURATION, (0, 1, 0.06)),
    ],
)
def test_views_look_at_the_robot_as_it_has_turned(
    view: Page, name: str, time: float, direction: tuple[float, float, float]
) -> None:
    view.evaluate("([time, name]) => { viewer.seek(time); viewer.view(name); }", [time, name])
    facts = state(view)
    eye, target = facts["camera"]["position"], facts["camera"]["target"]
    seen = [
        (a - b) / away(facts) * math.hypot(*direction) for a, b in zip(eye, target, strict=True)
    ]
    assert seen == pytest.approx(direction, abs=2e-3)


def test_without_wish_for_less_motion_the_camera_flies(chromium: Browser, tmp_path: Path) -> None:
    with shown(chromium, tmp_path, rover(), still=False) as page:
        start = state(page)["camera"]["position"]
        # In one call: nothing is drawn before it ends, so that the flight has not begun.
        after = page.evaluate("() => { viewer.view('top'); return viewer.state(); }")
        assert after["camera"]["position"] == start
        until(
            page,
            "(() => { const { position, target } = viewer.state().camera;"
            "return Math.hypot(position[0] - target[0], position[1] - target[1]) < 0.02; })()",
        )


def test_it_fits_a_host_that_changes_its_size(view: Page) -> None:
    before = away(state(view))
    view.evaluate("document.querySelector('#host').style.width = '200px'")
    until(view, "document.querySelector('canvas').width === 200")
    assert away(state(view)) > 1.5 * before, "all of the robot stays in sight"


def test_it_names_the_layers_of_the_file_in_a_fixed_order(view: Page) -> None:
    assert view.evaluate("viewer.layers") == ["visual", "collision", "joint"]
    layers = {"visual": "opaque", "collision": False, "joint": False}
    assert state(view)["layers"] == layers


def test_layers_change_what_is_seen(view: Page) -> None:
    pictures = [picture(view)]
    for name, mode in [("visual", "transparent"), ("visual", "off"), ("collision", True)]:
        view.evaluate("([name, mode]) => viewer.setLayer(name, mode)", [name, mode])
        assert state(view)["layers"][name] == mode
        pictures.append(picture(view))
    assert len({shot.tobytes() for shot in pictures}) == len(pictures)
    view.evaluate("viewer.setLayer('collision', false); viewer.setLayer('visual', 'opaque')")
    assert picture(view).tobytes() == pictures[0].tobytes()


def test_a_layer_that_is_not_there_changes_nothing(view: Page) -> None:
    before = state(view)["layers"]
    view.evaluate("viewer.setLayer('constructor', true)")
    assert state(view)["layers"] == before


@pytest.mark.parametrize("rich", [False, True])
def test_themes_change_the_colours(chromium: Browser, tmp_path: Path, rich: bool) -> None:
    with shown(chromium, tmp_path, rover(), rich=rich) as page:
        light = colours(picture(page))[0]
        page.evaluate("viewer.setTheme('dark')")
        dark = colours(picture(page))[0]
        assert min(light) > 200
        assert max(dark) < 90


def test_what_is_disposed_of_leaves_nothing(view: Page) -> None:
    view.evaluate("viewer.dispose()")
    assert view.locator("#host > *").count() == 0
    view.keyboard.press("ArrowLeft")
    view.set_viewport_size({"width": 500, "height": 500})
    view.wait_for_timeout(200)
