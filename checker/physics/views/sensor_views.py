"""The views of a package's robots: begun early, collected when a rule first asks for them."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from checker.base.background import Background, work_key
from checker.base.cache import Cache
from checker.base.child_server import Server
from checker.base.output import Stages
from checker.base.parts import WorkerFailed
from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.model.sensing.view import SensorViews, View
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.mesh.process import SIZE_LIMIT, mesh_work
from checker.physics.views.request import Asked, Content, asked_of
from checker.source.text import Located

_LIBRARIES = ("lxml", "numpy", "pycollada")
_SMALL = 1500
"""Pairs of sensor and visual up to which solids are looked at without a child: some 50 ms."""
_ROBOTS = 8
"""Of one file; a world with more of them is no submission."""

_Told = dict[str, Any]
"""What the worker says: `views` and `unread`."""


@dataclass(eq=False)
class RobotViews:
    """The views of some robots.

    Attributes:
        server: Reads mesh files; None starts a process for the views alone.
    """

    robots: tuple[Robot, ...]
    cache: Cache
    stages: Stages
    server: Server | None = None
    _begun: dict[int, tuple[Asked, Background[_Told] | None]] = field(default_factory=dict)
    _views: tuple[SensorViews, ...] | None = None

    def begin(self) -> None:
        """Begin with the first robot, while the caller does something else."""
        # What goes wrong is met again by who asks for the views.
        with suppress(Exception):
            self._begin(0)

    def stop(self) -> None:
        """End what nobody has waited for."""
        for _, begun in self._begun.values():
            if begun is not None:
                begun.stop()

    @property
    def views(self) -> tuple[SensorViews, ...]:
        """The robots with the views of their sensors."""
        if self._views is None:
            unseen = (f"only the views of the first {_ROBOTS} robots are checked",)
            self._views = tuple(
                self._collected(number, robot)
                if number < _ROBOTS
                else SensorViews(robot, (), unseen)
                for number, robot in enumerate(self.robots)
            )
        return self._views

    def _begin(self, number: int) -> tuple[Asked, Background[_Told] | None]:
        if number not in self._begun:
            with self.stages.stage("views"):
                asked = asked_of(self.robots[number], _content_of(self.robots[number]))
                begun = self._work(asked) if asked.sensors and asked.visible else None
                if begun is not None:
                    begun.begin()
                self._begun[number] = asked, begun
        return self._begun[number]

    def _work(self, asked: Asked) -> Background[_Told]:
        # The files count by what is in them, not by where they are.
        hashed = json.dumps({**asked.request, "meshes": _without_places(asked)})
        key = work_key([hashed], ["physics/views", "physics/mesh"], _LIBRARIES)
        work = mesh_work(
            "views",
            {key: asked.request},
            lambda told: _checked(told, asked),
            lambda told: not told["unread"],
            lambda item: [(mesh["file"], SIZE_LIMIT) for mesh in item["meshes"]],
            None if asked.request["meshes"] or asked.work > _SMALL else _seen_here,
        )
        return Background(work, self.cache, self.server)

    def _collected(self, number: int, robot: Robot) -> SensorViews:
        """Wait for what was asked about a robot."""
        asked, begun = self._begin(number)
        if begun is None:
            nothing = tuple(View(sensor, (), 0.0, None) for sensor in asked.sensors)
            return SensorViews(robot, nothing, asked.unseen if asked.sensors else ())
        with self.stages.stage(
            "views", "" if begun.known else "computing the views of the sensors"
        ):
            told = begun.result()
        if isinstance(told, WorkerFailed):
            reason = f"the views of the sensors were not computed: the process {told.reason}"
            return SensorViews(robot, (), (reason,))
        return _views_of(robot, asked, told)


def _seen_here(request: _Told) -> _Told:
    from checker.physics.views.visibility import sensors_of, views_of

    return views_of(request, sensors_of(request))


def _checked(told: Any, asked: Asked) -> _Told:
    """Return an answer that fits the question.

    Raises:
        AttributeError, KeyError, TypeError, ValueError: It does not.
    """
    views, unread = list(told["views"]), list(told["unread"])
    if (
        len(views) == len(asked.sensors)
        and all(-1 <= int(view["by"]) < len(asked.visuals) for view in views)
        and all(len(view["shares"]) == len(view["reach"]) for view in views)
        and all(view["cut"] >= 0.0 and sum(view["shares"], 0.0) >= 0.0 for view in views)
        and all(0 <= number < len(asked.contents) and str(why) for number, why in unread)
    ):
        return {"views": views, "unread": unread}
    raise ValueError("no views of these sensors")


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
    return meshes.content if isinstance(meshes, PackageMeshes) else _not_looked_for


def _not_looked_for(uri: Located[str]) -> MeshFault:  # noqa: ARG001 - as a `Content` has it
    return MeshFault(MeshTrouble.NOT_LOOKED_AT, "was not searched")
