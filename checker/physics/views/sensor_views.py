"""The views of a package's robots: begun early, collected when a rule first asks for them."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from checker.base.cache import Cache, code_hash, key_of
from checker.base.child_process import Child, Died, Limits, from_json
from checker.base.progress import Stages
from checker.base.resources import version_of
from checker.base.sandbox.files import from_disk
from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.model.sensing.view import SensorViews, View
from checker.physics.mesh.limits import MEMORY, SIZE_LIMIT
from checker.physics.mesh.package_meshes import TimedMeshes
from checker.physics.views.request import Asked, Content, asked_of
from checker.physics.views.worker import SECONDS_FOR_ALL
from checker.source.text import Located

_KIND = "view"
_LIBRARIES = ("lxml", "numpy", "pycollada", "trimesh")
_SMALL = 1500
"""Pairs of sensor and visual up to which solids are looked at without a child: some 50 ms."""
_ROBOTS = 8
"""Of one file; a world with more of them is no submission."""


@dataclass(eq=False)
class _Pending:
    """What is asked about one robot.

    Attributes:
        known: The worker's answer, if it was known.
        child: Works at it otherwise; None where it needs no child.
    """

    robot: Robot
    asked: Asked
    key: str
    known: Any = None
    child: Child | None = None


@dataclass(eq=False)
class Viewing:
    """The views of some robots."""

    robots: tuple[Robot, ...]
    cache: Cache
    stages: Stages
    _pending: dict[int, _Pending] = field(default_factory=dict)
    _views: tuple[SensorViews, ...] | None = None

    def begin(self) -> None:
        """Begin with the first robot, while the caller does something else."""
        # What goes wrong is met again by who asks for the views.
        with suppress(Exception):
            self._begun(0)

    def stop(self) -> None:
        """End what nobody has waited for."""
        for pending in self._pending.values():
            if pending.child is not None:
                pending.child.stop()

    @property
    def views(self) -> tuple[SensorViews, ...]:
        """The robots with the views of their sensors."""
        if self._views is None:
            said = (f"only the sensors of the first {_ROBOTS} robots are looked through",)
            self._views = tuple(
                self._collected(self._begun(number))
                if number < _ROBOTS
                else SensorViews(robot, (), said)
                for number, robot in enumerate(self.robots)
            )
        return self._views

    def _begun(self, number: int) -> _Pending:
        if number not in self._pending:
            with self.stages.stage("views"):
                self._pending[number] = self._started(self.robots[number])
        return self._pending[number]

    def _started(self, robot: Robot) -> _Pending:
        asked = asked_of(robot, _content_of(robot))
        text = json.dumps(asked.request)
        # The files count by what is in them, not by where they are.
        hashed = json.dumps({**asked.request, "meshes": _without_places(asked)})
        own = code_hash("physics/views", "physics/mesh"), *map(version_of, _LIBRARIES)
        pending = _Pending(robot, asked, key_of(hashed, *own))
        if not asked.sensors or not (asked.request["meshes"] or asked.request["solids"]):
            return pending
        pending.known = _checked(self.cache.get(_KIND, pending.key), asked)
        if pending.known is None and (asked.request["meshes"] or asked.work > _SMALL):
            limits = Limits(SECONDS_FOR_ALL, MEMORY)
            files = from_disk((mesh["file"], SIZE_LIMIT) for mesh in asked.request["meshes"])
            pending.child = Child("checker.physics.views.worker", text.encode(), limits, files)
        return pending

    def _collected(self, pending: _Pending) -> SensorViews:
        """Wait for what was asked about a robot, and keep it."""
        asked = pending.asked
        if not asked.sensors or not (asked.request["meshes"] or asked.request["solids"]):
            nothing = tuple(View(each, (), 0.0, None) for each in asked.sensors)
            return SensorViews(pending.robot, nothing, asked.unseen if asked.sensors else ())
        if pending.known is None:
            with self.stages.stage("views", "looking through the sensors"):
                told = _answered(pending)
            if isinstance(told, str):
                return SensorViews(pending.robot, (), (told,))
            if not told["unread"]:
                self.cache.put(_KIND, pending.key, told)
            pending.known = told
        return _views_of(pending.robot, asked, pending.known)


def _answered(pending: _Pending) -> dict[str, Any] | str:
    """Return the worker's answer, or why there is none."""
    if pending.child is None:
        from checker.physics.views.worker import look

        return look(pending.asked.request)
    told = pending.child.answer()
    if isinstance(told, Died):
        return f"what the sensors see was not worked out: it {told.reason}"
    try:
        known = _checked(from_json(told), pending.asked)
    except ValueError:
        known = None
    return known or "what the sensors see was not worked out: the answer was nonsense"


def _checked(told: Any, asked: Asked) -> dict[str, Any] | None:
    """Return an answer that fits the question; None for anything else."""
    with suppress(KeyError, TypeError, ValueError, AttributeError):
        views, unread = list(told["views"]), list(told["unread"])
        if (
            len(views) == len(asked.sensors)
            and all(-1 <= int(view["by"]) < len(asked.visuals) for view in views)
            and all(len(view["shares"]) == len(view["reach"]) for view in views)
            and all(view["cut"] >= 0.0 and sum(view["shares"], 0.0) >= 0.0 for view in views)
            and all(0 <= number < len(asked.contents) and str(why) for number, why in unread)
        ):
            return {"views": views, "unread": unread}
    return None


def _views_of(robot: Robot, asked: Asked, told: dict[str, Any]) -> SensorViews:
    views = tuple(
        View(
            mounted,
            tuple(zip(view["shares"], view["reach"], strict=True)),
            view["cut"],
            asked.visuals[view["by"]] if view["by"] >= 0 else None,
        )
        for mounted, view in zip(asked.sensors, told["views"], strict=True)
    )
    meshes = asked.request["meshes"]
    unread = (f"{meshes[number]['uri']} {reason}" for number, reason in told["unread"])
    return SensorViews(robot, views, (*asked.unseen, *unread))


def _without_places(asked: Asked) -> list[Any]:
    meshes = asked.request["meshes"]
    return [
        (key, mesh["part"], mesh["uses"]) for key, mesh in zip(asked.contents, meshes, strict=True)
    ]


def _content_of(robot: Robot) -> Content:
    """Return what finds the files of a robot's meshes."""
    meshes = robot.meshes
    return meshes.meshes.content if isinstance(meshes, TimedMeshes) else _not_looked_for


def _not_looked_for(uri: Located[str]) -> MeshFault:  # noqa: ARG001 - as a `Content` has it
    return MeshFault(MeshTrouble.NOT_LOOKED_AT, "was not looked for")
