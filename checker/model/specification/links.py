"""Links of a sheet, and the sensors that no link describes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice
from urllib.parse import unquote

from checker.model.specification.sensors import ListedSensor
from checker.source.markdown import Markdown
from checker.source.text import Located, Span

MAX_LINKS = 2000
_TEXT_LIMIT = 2000
_LINK = re.compile(r"\]\([ \t]{0,5}<?([^()\s<>]{1,500})>?(?:[ \t][^()\n]{0,200})?\)")
_ELSEWHERE = re.compile(r"[a-z][a-z0-9+.-]{0,20}:|[#/\\]", re.IGNORECASE)
_LEADS_OUT = re.compile(r"https?://\w|\]\([^()\s]{1,500}\)", re.IGNORECASE)
# A device's name holds a digit (`VLP-16`) or begins with a capital (`Microstrain`).
_NAME = re.compile(
    r"\b(?:\w[\w-]{0,30}\d[\w-]{0,30}|\d{1,5}[A-Za-z]\w{0,30}|[A-Z][A-Za-z]{3,30})\b"
)
_SHORTEST_NAME = 3
_PLAIN = frozenset(
    {
        *("camera", "cameras", "color", "colour", "compass", "config", "depth", "detector", "gas"),
        *("image", "imus", "lidar", "lidars", "magnetometer", "altimeter", "monocular", "odometry"),
        *("onboard", "planar", "point", "real", "sensor", "sensors", "simulated", "thermal"),
        *("wheel", "forward", "front", "rear", "side", "wide", "angle", "this", "with"),
    }
)
"""Words with a capital that name no device."""
_MODELED = re.compile(r"\bmodell?ed\b", re.IGNORECASE)


def relative_links(markdown: Markdown) -> Iterator[Located[str]]:
    """Yield the paths that links lead to, as written; links to web pages and headings are none."""
    for match in islice(_LINK.finditer(markdown.text), MAX_LINKS):
        path = unquote(re.split(r"[?#]", match.group(1))[0])
        if path and not _ELSEWHERE.match(match.group(1)):
            yield Located(path, Span(markdown.source, *match.span(1)))


def without_datasheet(markdown: Markdown, listed: Sequence[ListedSensor]) -> list[ListedSensor]:
    """Return the items of sensors that have no link, and whose device no line with a link names.

    Items that name no device are left out.
    """
    lines = markdown.text.splitlines()
    linked = "\n".join(_plain(line) for line in lines if _LEADS_OUT.search(line[:_TEXT_LIMIT]))
    items: dict[int, ListedSensor] = {}
    for item in listed:
        names = _names(item.text)
        if not item.kind.is_sensor or not names or item.span.start in items:
            continue
        if not _LEADS_OUT.search(item.span.text) and not any(name in linked for name in names):
            items[item.span.start] = item
    return list(items.values())


def _names(text: str) -> list[str]:
    device = _MODELED.split(text[:_TEXT_LIMIT], maxsplit=1)[0]
    written = [match.group() for match in _NAME.finditer(device)]
    # `Velodyne-16` is linked as velodyne.com, and `D435i` as the D435 that it descends from.
    parts = [part for name in written for part in name.split("-") if part.isalpha()]
    older = [name.rstrip("abcdefghijklmnopqrstuvwxyz") for name in written]
    names = (_plain(name) for name in (*written, *parts, *older))
    return [name for name in names if len(name) >= _SHORTEST_NAME and name not in _PLAIN]


def _plain(text: str) -> str:
    """Return letters and digits alone: `vlp16` for `VLP-16`."""
    return re.sub(r"[^a-z0-9]", "", text[:_TEXT_LIMIT].lower())
