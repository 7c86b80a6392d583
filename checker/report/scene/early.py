"""Children that are started before it is known what they are to do.

They load their libraries while the parent loads its own, which takes each of them half a second.
"""

from __future__ import annotations

from checker.base.child_process import Child, Limits
from checker.base.record import Record
from checker.physics.mesh.limits import MEMORY

_DRAWS = Limits(20.0, 4_000_000_000, draws=True)
"""OpenGL takes 0.9 GB of address space for an empty scene, drivers of graphics cards more."""
SECONDS_FOR_ALL = 60
"""By the clock, for the looks of the mesh files of one robot."""
_READS = Limits(SECONDS_FOR_ALL, MEMORY)
PLATFORMS = ("egl", "osmesa")
"""What draws without a window; the second where the first is missing."""


class EarlyChildren(Record):
    """Children that wait.

    Attributes:
        meshes: For mesh files to measure.
        artist: For a scene to draw.
        looks: For mesh files to look at.
    """

    meshes: Child | None = None
    artist: Child | None = None
    looks: Child | None = None

    def stop(self) -> None:
        """End those that nobody has given anything."""
        for child in (self.meshes, self.artist, self.looks):
            if child is not None:
                child.stop()


NO_CHILDREN = EarlyChildren()


def early_children(meshes: Child | None, *, display: bool) -> EarlyChildren:
    """Start the children behind a display.

    Args:
        meshes: One that is there already.
        display: Whether there is to be a display.
    """
    if not display:
        return EarlyChildren(meshes)
    return EarlyChildren(meshes, artist(PLATFORMS[0], None), looks())


def artist(platform: str, request: bytes | None) -> Child:
    """Start a child that draws; see `Child`."""
    return Child(f"checker.report.scene.drawing.by_{platform}", request, _DRAWS)


def looks() -> Child:
    """Start a child that waits for mesh files, to read what they look like."""
    return Child("checker.report.scene.files.worker", None, _READS)
