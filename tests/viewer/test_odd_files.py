"""What the viewer makes of files without a trial, a robot, or sense; and of names."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from support.browser import without_webgl
from tests.viewer.glb_file import GlbFile, container
from tests.viewer.rover import HEIGHT, rover
from tests.viewer.showing import (
    picture,
    shown,
)

if TYPE_CHECKING:
    from playwright.sync_api import Browser


def test_a_robot_without_a_trial_stands_still(chromium: Browser, tmp_path: Path) -> None:
    with shown(chromium, tmp_path, rover(moving=False)) as page:
        assert page.evaluate("[heard.failure, viewer.duration]") == ["", 0]
        before = picture(page)
        page.evaluate("viewer.seek(3); viewer.play()")
        assert page.evaluate("viewer.playing") is False
        assert picture(page).tobytes() == before.tobytes()
        assert page.evaluate("heard.times") == []


@pytest.mark.parametrize("extras", [{}, {"robot": None, "size": "x", "centre": []}])
def test_a_file_without_a_robot_shows_the_ground(
    chromium: Browser, tmp_path: Path, extras: dict[str, Any]
) -> None:
    file = GlbFile()
    file.node(name="world")
    with shown(chromium, tmp_path, file.written(**extras)) as page:
        assert page.evaluate("[heard.failure, viewer.layers]") == ["", []]
        assert page.evaluate("viewer.select('sdf/model[x]')") == ""
        assert len(picture(page).getcolors(100_000) or []) > 1


def test_a_file_without_anything_shows_the_ground(chromium: Browser, tmp_path: Path) -> None:
    with shown(chromium, tmp_path, container(b'{"asset":{"version":"2.0"}}', b"")) as page:
        assert page.evaluate("[heard.failure, viewer.layers]") == ["", []]


@pytest.mark.parametrize("glb", [b"", b"glTF", b"no such thing", rover()[:400]])
def test_what_is_no_glb_is_refused_in_words(chromium: Browser, tmp_path: Path, glb: bytes) -> None:
    with shown(chromium, tmp_path, glb) as page:
        assert page.evaluate("heard.failure").startswith("the 3D file cannot be read: ")
        assert page.locator("#host > *").count() == 0


def test_nothing_is_fetched_whatever_the_file_says(chromium: Browser, tmp_path: Path) -> None:
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "https://subt.example/robot.bin"}],
    }
    text = json.dumps(document).encode()
    glb = container(text + b" " * (-len(text) % 4), b"")
    with shown(chromium, tmp_path, glb) as page:
        failure = "the 3D file cannot be read: it refers to other files"
        assert page.evaluate("heard.failure") == failure


HOSTILE = [
    (
        "</script><script>heard.failure='pwned'</script>",
        "<img src=x onerror=heard.failure='pwned'>",
    ),
    ("__proto__", "constructor"),
    ("a.b[0]/c", "a_b0c"),
    ("\u202eevil\u0007\u200d", "🤖" * 3000),
    ("", " "),
]


@pytest.mark.parametrize("names", HOSTILE)
def test_links_may_have_any_name(chromium: Browser, tmp_path: Path, names: tuple[str, str]) -> None:
    with shown(chromium, tmp_path, rover(names=names)) as page:
        page.evaluate("viewer.seek(1)")
        found = page.evaluate(
            "([one, other]) => { const poses = new Map(Object.entries(viewer.state().partPoses));"
            "return [poses.get(one).position, poses.get(other).position]; }",
            list(names),
        )
        assert found == [
            pytest.approx([1, 0, HEIGHT], abs=1e-5),
            pytest.approx([1.7, 0, 0.2], abs=1e-5),
        ]
        path = f"sdf/model[rover]/link[{names[1]}]"
        assert page.evaluate("path => viewer.select(path)", path) == path
        picture(page)
        assert page.evaluate("heard.failure") == ""
        assert page.locator("#host img, #host script").count() == 0
        label = page.locator("#host > div").first.bounding_box()
        assert label is None or label["x"] >= 0
        assert label is None or label["x"] + label["width"] <= 1280


def test_without_webgl_it_says_so(chromium: Browser, tmp_path: Path) -> None:
    with without_webgl(chromium) as blind, shown(blind, tmp_path, rover()) as page:
        assert page.evaluate("heard.failure") == (
            "this browser cannot draw in 3D: it offers no WebGL 2"
        )
        assert page.locator("#host > *").count() == 0
