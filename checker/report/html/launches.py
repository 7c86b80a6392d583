"""The graph of each launch as two drawings: publishers and readers of topics, and frames."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Final

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.report.launched import Launched, LaunchedNode, LaunchedTransform
from checker.report.report import ReportedFinding

WIDTH: Final = 900
_COLUMNS = ((0, 280), (340, 220), (620, 280))
"""Left edge and width of publishers, topics and readers."""
_ROW, _BOX, _INDENT = 34, 26, 22
_CHARACTER = 7.4
"""Width of a character of the drawing's font, with some room."""
_MOST_FRAMES = 120
_RULES = "WIR"

IsFaulty = Callable[[str], bool]


class Box(Record):
    """A node, topic or frame: left edge, top, width; `label` fits, `title` is whole."""

    x: float
    y: float
    width: float
    label: str
    title: str
    faulty: bool


class Line(Record):
    """A path between two boxes."""

    path: str
    faulty: bool


class Drawing(Record):
    """Boxes and lines of one height; `title` states what is seen."""

    title: str
    height: int
    boxes: tuple[Box, ...]
    lines: tuple[Line, ...]
    width: int = WIDTH
    box: int = _BOX


class ShownLaunch(Record):
    """A launch file.

    Attributes:
        nodes: The number of known nodes that it starts.
        others: Topics that are only read or only published, as far as known.
        hidden: Frames that are not drawn.
    """

    file: str
    nodes: int
    unknown: str
    topics: Drawing | None
    frames: Drawing | None
    others: tuple[str, ...]
    hidden: int


def shown_launches(
    launched: Sequence[Launched], findings: Sequence[ReportedFinding]
) -> list[ShownLaunch]:
    """Return what the page shows of each launch file; red is what a finding of WIR names."""
    of_wiring = [it for it in findings if it.rule.startswith(_RULES)]
    return [_shown_launch(each, of_wiring) for each in launched]


def _shown_launch(launched: Launched, findings: Sequence[ReportedFinding]) -> ShownLaunch:
    own = (it for it in findings if {place.file for place in it.places} & {*launched.files})
    said = "\n".join(text for it in own for text in (it.message, *(p.note for p in it.places)))

    def is_faulty(name: str) -> bool:
        return re.search(rf"(?<![\w/]){re.escape(name)}(?![\w/])", said) is not None

    published = {topic for node in launched.nodes for topic in node.publishes}
    read = {topic for node in launched.nodes for topic in node.reads}
    names = [topic.name for topic in launched.topics]
    drawn = [it for it in names if (it in published and it in read) or is_faulty(it)]
    frames = [*_rows(launched.transforms)]
    return ShownLaunch(
        plain(launched.file),
        sum(it.name.startswith("node ") for it in launched.nodes),
        plain(launched.unknown),
        _topics(launched.nodes, drawn, is_faulty),
        _frames(frames[:_MOST_FRAMES], is_faulty),
        tuple(plain(it) for it in names if it not in drawn),
        max(0, len(frames) - _MOST_FRAMES),
    )


def _topics(
    nodes: Sequence[LaunchedNode], topics: Sequence[str], is_faulty: IsFaulty
) -> Drawing | None:
    """Draw publishers to the left of topics, and readers to the right."""
    left = [it for it in nodes if set(it.publishes) & set(topics) or not it.reads]
    order = [topic for node in left for topic in node.publishes if topic in topics]
    middle = [*dict.fromkeys((*order, *topics))]
    places = {topic: place for place, topic in enumerate(middle)}
    right = [it for it in nodes if set(it.reads) & set(topics)]
    right += [it for it in nodes if it.reads and it not in left and it not in right]
    right.sort(
        key=lambda it: min((places[t] for t in it.reads if t in places), default=len(places))
    )
    if not left and not right:
        return None
    height = max(len(left), len(middle), len(right)) * _ROW
    columns = ([it.name for it in left], middle, [it.name for it in right])
    boxes = [[*_column(at, names, height, is_faulty)] for at, names in enumerate(columns)]
    lines = [
        *(
            _arrow(boxes[0][row], boxes[1][places[topic]])
            for row, node in enumerate(left)
            for topic in node.publishes
            if topic in places
        ),
        *(
            _arrow(boxes[1][places[topic]], boxes[2][row])
            for row, node in enumerate(right)
            for topic in node.reads
            if topic in places
        ),
    ]
    title = f"{len(left)} publishers, {len(middle)} topics, {len(right)} readers"
    return Drawing(title, height, tuple(box for column in boxes for box in column), tuple(lines))


def _column(at: int, names: Sequence[str], height: int, is_faulty: IsFaulty) -> Iterator[Box]:
    x, width = _COLUMNS[at]
    step = height / max(1, len(names))
    for row, name in enumerate(names):
        y = step * row + (step - _BOX) / 2
        yield _box(x, y, width, name, is_faulty(name))


def _box(x: float, y: float, width: float, name: str, faulty: bool) -> Box:
    whole = plain(name)
    label = shortened(_short(whole), int((width - 16) / _CHARACTER))
    return Box(x, round(y, 1), width, label, whole, faulty)


def _short(name: str) -> str:
    """Return a name without the word and the quotes that a sentence needs."""
    return name.removeprefix("node ").strip("'") if name.startswith("node ") else name


def _arrow(start: Box, end: Box) -> Line:
    """Draw from the right edge of one box to the left edge of another."""
    x, y = start.x + start.width, start.y + _BOX / 2
    to_x, to_y = end.x, end.y + _BOX / 2
    bend = (x + to_x) / 2
    path = f"M{x:g} {y:g}C{bend:g} {y:g} {bend:g} {to_y:g} {to_x:g} {to_y:g}"
    return Line(path, start.faulty and end.faulty)


_Row = tuple[int, str, LaunchedTransform | None]


def _rows(transforms: Iterable[LaunchedTransform]) -> Iterator[_Row]:
    """Yield the frames as a tree: depth, name, and the transform that places it."""
    below: dict[str, list[LaunchedTransform]] = {}
    for transform in transforms:
        below.setdefault(transform.parent, []).append(transform)
    children = {it.child for each in below.values() for it in each}
    roots = [name for name in below if name not in children] or [*below][:1]
    waiting: list[_Row] = [(0, name, None) for name in reversed(roots)]
    seen: set[str] = set()
    while waiting:
        depth, name, placed = waiting.pop()
        yield depth, name, placed
        if name not in seen:
            seen.add(name)
            inner = reversed(below.get(name, []))
            waiting += [(depth + 1, it.child, it) for it in inner]


def _frames(rows: Sequence[_Row], is_faulty: IsFaulty) -> Drawing | None:
    """Draw a row for each frame, indented below its parent."""
    boxes: list[Box] = []
    lines: list[Line] = []
    above: dict[int, Box] = {}
    for number, (depth, name, placed) in enumerate(rows):
        said = f"{placed.parent} → {placed.child}" if placed is not None else ""
        faulty = bool(said) and (is_faulty(said) or is_faulty(f"frame {name!r}"))
        text = f"{name}  ({_short(placed.by)})" if placed is not None else name
        x = min(depth, 20) * _INDENT
        box = _box(x, number * _ROW + 4, WIDTH - x, text, faulty)
        boxes.append(box)
        above[depth] = box
        if placed is not None:
            parent = above[depth - 1]
            bend = parent.x + _INDENT / 2
            path = f"M{bend:g} {parent.y + _BOX:g}V{box.y + _BOX / 2:g}H{box.x:g}"
            lines.append(Line(path, faulty))
    title = f"the tree of {len(rows)} frames"
    return Drawing(title, len(rows) * _ROW, tuple(boxes), tuple(lines)) if boxes else None
