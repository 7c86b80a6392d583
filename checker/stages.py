"""What takes long in a check: said while it happens, and timed for the report."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter

from checker.mesh.package_meshes import PackageMeshes
from checker.model.mesh import Mesh, MeshFault
from checker.record import record
from checker.saying import Say, say_nothing
from checker.source.text import Located


@record(eq=False)
class Stages:
    """The stages of one check.

    Attributes:
        say: Told what begins, in a few words.
        seconds: That each stage took, without the stages inside it.
    """

    say: Say = say_nothing
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, words: str = "") -> Iterator[None]:
        """Time what is done inside; a stage that is entered again goes on.

        Args:
            name: In the report.
            words: For the person who waits; empty for what is not worth a line.
        """
        if words:
            self.say(words)
        inside = sum(self.seconds.values())
        started = perf_counter()
        try:
            yield
        finally:
            took = perf_counter() - started
            others = sum(self.seconds.values()) - inside
            self.seconds[name] = self.seconds.get(name, 0.0) + max(took - others, 0.0)


@dataclass(eq=False)
class TimedMeshes:
    """The meshes of a robot, whose first reading is a stage: a `Meshes`.

    Attributes:
        meshes: Where they are had from.
        number: How many there are.
        read: Whether they have been asked for, so that asking again costs nothing.
    """

    meshes: PackageMeshes
    number: int
    stages: Stages
    read: bool = False

    def begin(self) -> None:
        """Begin to read them, while the caller does something else."""
        with self.stages.stage("meshes"):
            self.meshes.begin()

    def stop(self) -> None:
        """End the reading, if nobody has waited for it."""
        self.meshes.stop()

    def of(self, uri: Located[str]) -> Mesh | MeshFault:
        """Return what the file behind a URI holds."""
        if self.read:
            return self.meshes.of(uri)
        self.read = True
        noun = "mesh" if self.number == 1 else "meshes"
        with self.stages.stage("meshes", f"reading {self.number} {noun}"):
            return self.meshes.of(uri)
