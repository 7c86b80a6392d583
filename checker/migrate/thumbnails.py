"""Pictures of the robot from five sides, by MuJoCo in a child process, where OpenGL is there."""

from __future__ import annotations

import base64
import json
import posixpath
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from msgspec import field

from checker.base.child_process import NONSENSE, Limits, ask, from_json
from checker.base.errors import WorkerFailed
from checker.base.record import Record
from checker.base.sandbox.files import from_disk
from checker.model.components import Visual
from checker.model.robot import Robot
from checker.physics.mesh.process import SIZE_LIMIT
from checker.physics.trial.mjcf.names import quaternion

NAMES = ("1", "2", "3", "4", "5")
"""Slantwise, from above, from the left, from the front, from the rear."""
SHAPES = ("box", "sphere", "cylinder", "capsule", "mesh")
_GREY = (0.6, 0.6, 0.6, 1.0)
_SECONDS, _MEMORY = 60.0, 16_000_000_000
"""Of processor time, and bytes of address space: software renderers map far more than they use."""


class Thumbnails(Record):
    """Pictures, or why there are none.

    Attributes:
        files: PNG files by their name without suffix.
        trouble: What the author has to do instead; empty when they were drawn.
    """

    files: Mapping[str, bytes] = field(default_factory=dict)
    trouble: str = ""


def thumbnails_of(robot: Robot, folder: Path) -> Thumbnails:
    """Draw a robot.

    Args:
        robot: To draw.
        folder: Of its package, to which the URIs of its meshes are relative.
    """
    shapes = list(_shapes(robot, folder))
    if not shapes:
        return Thumbnails(trouble=_trouble("the model has no visuals"))
    request = json.dumps({"shapes": shapes}).encode()
    files = dict.fromkeys((str(each["file"]) for each in shapes if each["file"]), SIZE_LIMIT)
    limits = Limits(_SECONDS, _MEMORY, draws=True)
    said = ask("checker.migrate.drawing", request, limits, from_disk(files.items()))
    if isinstance(said, WorkerFailed):
        return Thumbnails(trouble=_trouble(f"the process that draws {said.reason}"))
    try:
        answer = from_json(said)
        if "pictures" not in answer:
            return Thumbnails(trouble=_trouble(str(answer.get("unable", "there is no picture"))))
        pictures = (base64.b64decode(each) for each in answer["pictures"])
        return Thumbnails(dict(zip(NAMES, pictures, strict=True)))
    except NONSENSE:
        return Thumbnails(trouble=_trouble("the process that draws sent an invalid answer"))


def _trouble(reason: str) -> str:
    return f"thumbnails/1.png to 5.png (at an angle, top, left, front, rear), not drawn: {reason}"


def _shapes(robot: Robot, folder: Path) -> Iterator[dict[str, Any]]:
    for link in robot.links:
        for visual in link.visuals:
            pose = robot.pose_of_part(link, visual.pose)
            shape = visual.geometry.shape
            if pose is None or shape not in SHAPES:
                continue
            file = _file(visual, folder) if shape == "mesh" else ""
            if shape == "mesh" and not file:
                continue
            yield {
                "shape": shape,
                "sizes": {
                    name: [each.value for each in values]
                    for name, values in visual.geometry.sizes.items()
                },
                "file": file,
                "position": pose.translation,
                "quaternion": quaternion(pose.rotation),
                "colour": _colour(visual),
            }


def _file(visual: Visual, folder: Path) -> str:
    """Return where a mesh lies on disk; empty for one that the package does not hold."""
    uri = visual.geometry.uri
    path = posixpath.normpath(uri.value) if uri is not None else ""
    if not path or path.startswith(("/", "../")) or "://" in path:
        return ""
    real = folder / path
    return str(real.resolve()) if real.is_file() else ""


def _colour(visual: Visual) -> list[float]:
    said = visual.material.colours.get("diffuse", ()) if visual.material is not None else ()
    values = [min(max(each.value, 0.0), 1.0) for each in said[:4]]
    return [*values, *_GREY[len(values) :]]
