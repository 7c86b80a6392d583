"""The views of a package's robots: started early, collected when a rule first requests them."""

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
from checker.model.sensing.view import CoveredLight, Hit, SensorViews, View
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.mesh.process import SIZE_LIMIT, mesh_work
from checker.physics.mesh.uris import MeshFile
from checker.physics.views.request import Content, ViewRequest, view_request
from checker.source.text import Located

_LIBRARIES = ("lxml", "numpy", "pycollada", "trimesh")
_SMALL = 1500
"""Pairs of sensor and visual up to which solids need no child process: some 50 ms."""
_ROBOTS = 8
"""Greatest number for one file; a world with more of them is no submission."""

_RAYS = ("shares", "reach", "across", "visual")
"""Members of the worker's answer for each ray of a view."""
_Answer = dict[str, Any]
"""Answer of the worker: `views` and `unread`."""


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
    _begun: dict[int, tuple[ViewRequest, Background[_Answer] | None]] = field(default_factory=dict)
    _views: tuple[SensorViews, ...] | None = None

    def begin(self) -> None:
        """Begin with the first robot, while the caller does something else."""
        # Errors occur again when a rule requests the views.
        with suppress(Exception):
            self._begin(0)

    def stop(self) -> None:
        """Stop the processes that still run."""
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

    def _begin(self, number: int) -> tuple[ViewRequest, Background[_Answer] | None]:
        if number not in self._begun:
            with self.stages.stage("views"):
                request = view_request(self.robots[number], _content_of(self.robots[number]))
                begun = self._work(request) if request.has_work else None
                if begun is not None:
                    begun.begin()
                self._begun[number] = request, begun
        return self._begun[number]

    def _work(self, request: ViewRequest) -> Background[_Answer]:
        # The files count by what is in them, not by where they are.
        hashed = json.dumps({**request.item, "meshes": _without_places(request)})
        key = work_key([hashed], ["physics/views", "physics/mesh"], _LIBRARIES)
        work = mesh_work(
            "views",
            {key: request.item},
            lambda answer: _checked(answer, request),
            lambda answer: all(lasts for _, _, lasts in answer["unread"]),
            lambda item: [(mesh["file"], SIZE_LIMIT) for mesh in item["meshes"]],
            None if request.item["meshes"] or request.work > _SMALL else _seen_here,
        )
        return Background(work, self.cache, self.server)

    def _collected(self, number: int, robot: Robot) -> SensorViews:
        """Wait for the answer about a robot."""
        request, begun = self._begin(number)
        if begun is None:
            nothing = tuple(View(sensor, (), 0.0, None) for sensor in request.sensors)
            return SensorViews(robot, nothing, request.unseen if request.sensors else ())
        with self.stages.stage("views", "" if begun.known else "checking sensor fields of view"):
            answer = begun.result()
        if isinstance(answer, WorkerFailed):
            reason = f"the views of the sensors were not computed: the process {answer.reason}"
            return SensorViews(robot, (), (reason,))
        return _views_of(robot, request, answer)


def _seen_here(item: _Answer) -> _Answer:
    from checker.physics.views.visibility import sensors_of, views_of

    return views_of(item, sensors_of(item))


def _checked(answer: Any, request: ViewRequest) -> _Answer:
    """Return an answer that fits the question.

    Raises:
        AttributeError, KeyError, TypeError, ValueError: It does not.
    """
    views, unread, covered = (list(answer[name]) for name in ("views", "unread", "covered"))
    if (
        len(views) == len(request.sensors)
        and all(-1 <= int(view["by"]) < len(request.shapes) for view in views)
        and all(len({len(view[name]) for name in _RAYS}) == 1 for view in views)
        and all(0 <= number < len(request.shapes) for view in views for number in view["visual"])
        and all(view["cut"] >= 0.0 and sum(view["shares"], 0.0) >= 0.0 for view in views)
        and all(0 <= number < len(request.contents) and str(why) for number, why, _ in unread)
        and all(0 <= number < len(request.lights) for number, *_ in covered)
        and all(0.0 <= around + ahead <= 2.1 for _, around, ahead in covered)
    ):
        return {"views": views, "unread": unread, "covered": covered}
    raise ValueError("no views of these sensors")


def _views_of(robot: Robot, request: ViewRequest, answer: dict[str, Any]) -> SensorViews:
    views = tuple(
        View(
            mounted,
            tuple(
                Hit(share, metres, azimuth, request.shapes[visual])
                for share, metres, azimuth, visual in zip(
                    view["shares"], view["reach"], view["across"], view["visual"], strict=True
                )
            ),
            view["cut"],
            request.shapes[view["by"]] if view["by"] >= 0 else None,
        )
        for mounted, view in zip(request.sensors, answer["views"], strict=True)
    )
    meshes = request.item["meshes"]
    unread = (f"{meshes[number]['uri']} {reason}" for number, reason, _ in answer["unread"])
    covered = []
    for number, around, ahead in answer["covered"]:
        light, visual = request.lights[int(number)]
        covered.append(CoveredLight(light, visual, around, ahead))
    unseen = (*request.unseen, *unread) if views else ()
    return SensorViews(robot, views, unseen, tuple(covered))


def _without_places(request: ViewRequest) -> list[Any]:
    meshes = request.item["meshes"]
    return [
        (key, mesh["part"], mesh["centred"], mesh["uses"])
        for key, mesh in zip(request.contents, meshes, strict=True)
    ]


def _content_of(robot: Robot) -> Content:
    """Return what finds the files of a robot's meshes."""
    meshes = robot.meshes
    if not isinstance(meshes, PackageMeshes):
        return _not_looked_for

    def content(uri: Located[str]) -> tuple[MeshFile, str] | MeshFault:
        known = robot.scaled_meshes.load(uri)
        if isinstance(known, MeshFault) and known.trouble is MeshTrouble.MISSCALED:
            return known
        return meshes.content(uri)

    return content


def _not_looked_for(uri: Located[str]) -> MeshFault:  # noqa: ARG001 - as a `Content` has it
    return MeshFault(MeshTrouble.NOT_LOOKED_AT, "was not searched")
