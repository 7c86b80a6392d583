"""Why a robot cannot be flattened by text edits that surely mean the same."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from checker.model.components import Frame, Joint, Link, Model
from checker.model.faults import FaultKind
from checker.model.frames import MODEL_FRAME
from checker.model.robot import Robot
from checker.model.sdf.document import sdf_version

LIMIT = 20_000_000
"""Characters of all nested models together: files that include each other often grow fast."""

_NO_NAMES = ("", MODEL_FRAME, "world")

_MEANINGS = ((1, 5), (1, 7))
"""SDF versions that changed which frame an axis or a pose is written in."""


def obstacle(robot: Robot) -> str:
    """Return the reason, as the end of a sentence; empty when it can be flattened."""
    return next(_obstacles(robot), "")


def _obstacles(robot: Robot) -> Iterator[str]:
    if robot.missing_parts:
        yield robot.missing_parts
    posed: tuple[Link | Frame | Model | Joint, ...] = (*robot.links, *robot.frames, *robot.models)
    for parts in (posed, robot.joints):
        if any(part.name.value in _NO_NAMES for part in parts):
            yield "a part has no name of its own"
        names = Counter(part.scoped_name for part in parts)
        for name in (name for name, number in names.items() if number > 1):
            yield f"two parts are called {name}"
    for fault in robot.faults:
        if fault.kind in (FaultKind.FRAME, FaultKind.INCLUDE):
            yield fault.message
    yield from _other_versions(robot)
    for name in robot.frame_graph.nodes:
        if robot.pose_of(name) is None:
            yield f"nobody can tell where {name} is"
    if sum(len(model.definition.whole_span.text) for model in robot.models) > LIMIT:
        yield f"its nested models hold more than {LIMIT} characters"


def _other_versions(robot: Robot) -> Iterator[str]:
    own = sdf_version(robot.document)
    for model in robot.models:
        version = sdf_version(model.definition.document)
        newer = version > own >= _MEANINGS[-1]
        if newer or any((version < change) is not (own < change) for change in _MEANINGS):
            said = ".".join(map(str, version)), ".".join(map(str, own))
            yield f"{model.definition.source.file} is written in SDF {said[0]}, not in {said[1]}"
