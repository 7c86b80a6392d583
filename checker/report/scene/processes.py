"""Processes that are started before their task is known.

They load their libraries while their parent loads its own, which takes each of them half a second.
"""

from __future__ import annotations

from checker.base.child_process import Child, Limits
from checker.base.child_server import Server
from checker.base.record import Record

DRAWING_LIMITS = Limits(20.0, 4_000_000_000, draws=True)
"""OpenGL takes 0.9 GB of address space for an empty scene, drivers of graphics cards more."""
PLATFORMS = ("egl", "osmesa")
"""Platforms that draw without a window; the second if the first is missing."""


class StartedProcesses(Record):
    """Processes that wait.

    Attributes:
        meshes: The process that reads mesh files.
        drawing: The process that draws a scene.
        xacro: The process that expands xacro files.
    """

    meshes: Server | None = None
    drawing: Child | None = None
    xacro: Server | None = None

    def stop(self) -> None:
        """End them."""
        for process in (self.meshes, self.drawing, self.xacro):
            if process is not None:
                process.stop()


NO_PROCESSES = StartedProcesses()


def drawing_module(platform: str) -> str:
    """Return the name of the module that draws by one of `PLATFORMS`."""
    return f"{__package__}.drawing.by_{platform}"


def drawing_process() -> Child:
    """Start a process that waits for a scene."""
    return Child(drawing_module(PLATFORMS[0]), None, DRAWING_LIMITS)
