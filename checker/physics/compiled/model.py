"""A model as MuJoCo compiles it: its parts with their places, and its first second."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from msgspec import convert

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.base.extras import PHYSICS
from checker.base.files import read_bytes
from checker.base.output import Stages
from checker.base.parts import NotAvailable, WorkerFailed, part
from checker.base.record import Record
from checker.formats.mjcf.model import MjcfModel
from checker.physics.compiled.text import SIZE_LIMIT, MujocoText, mujoco_text
from checker.source.text import Span
from checker.source.xml import Element

LIMITS = Limits(seconds=60.0, memory=3_000_000_000)
_MODULE = f"{__package__}.worker"


class Compiled(Record):
    """What MuJoCo makes of a text; see the worker.

    Attributes:
        refusals: What it refuses; the parts are those of the text without that.
        sizes: Numbers of coordinates, velocities, commands and states: `nq`, `nv`, `nu`, `na`.
        timestep: Seconds.
        bodies: The bodies; the first one is the world.
        idle: Numbers of the actuators that have no moment about any joint.
        held: Numbers of the joints that an equality holds, or couples with others.
        in_tendons: Numbers of the joints of fixed tendons.
        at_key: Whether there is a keyframe, so that the start is the first one.
        contacts: Pairs of shapes that touch at the start.
        trouble: What became too large or NaN within the first second: `position`, `velocity` or
            `acceleration`; else empty.
        time: Seconds that were simulated.
        fastest: Greatest velocity of a joint, rad/s or m/s.
    """

    refusals: tuple[Refusal, ...] = ()
    sizes: Mapping[str, int] = {}
    timestep: float = 0.0
    integrator: int = 0
    bodies: tuple[Body, ...] = ()
    joints: tuple[Joint, ...] = ()
    geoms: tuple[Geom, ...] = ()
    actuators: tuple[Actuator, ...] = ()
    idle: tuple[int, ...] = ()
    held: tuple[int, ...] = ()
    in_tendons: tuple[int, ...] = ()
    at_key: bool = False
    contacts: tuple[Contact, ...] = ()
    trouble: str = ""
    time: float = 0.0
    fastest: float = 0.0


class Refusal(Record):
    """A message of MuJoCo, and the line that it names; 0 for none."""

    text: str
    line: int


class Body(Record):
    """A body; `welded` is the number of the body that moves it, 0 for the world.

    Attributes:
        line: The line of its element; 0 if it is not known.
        mass: Kilograms.
        inertia: Principal moments, kg·m².
        position: Its frame in the world, metres, in the reference pose.
        centre: Its centre of mass in the world, metres, in the reference pose.
        reach: Metres from its centre of mass to the farthest point of its shapes, at most; 0 for a
            body without shapes.
        stated: Whether its mass and inertia are stated, not computed from its shapes.
        visual_mass: Kilograms of it that come from meshes that collide with nothing.
    """

    line: int
    name: str
    parent: int
    welded: int
    mass: float
    inertia: tuple[float, float, float]
    position: tuple[float, float, float]
    centre: tuple[float, float, float]
    reach: float
    stated: bool
    visual_mass: float


class Joint(Record):
    """A joint; angles in radians.

    Attributes:
        type: `free`, `ball`, `slide` or `hinge`.
        body: The number of the body that it moves.
        limited: Whether the range counts.
        axis: Its axis in the world, in the reference pose.
    """

    line: int
    name: str
    type: str
    body: int
    limited: bool
    range: tuple[float, float]
    axis: tuple[float, float, float]
    stiffness: float
    damping: float
    armature: float
    friction: float


class Geom(Record):
    """A shape; `collides` is False for one that is only seen."""

    line: int
    name: str
    body: int
    collides: bool


class Actuator(Record):
    """An actuator.

    Attributes:
        joint: The number of the joint that it moves; -1 if it moves something else.
        gain: Force for a command of 1.
        stiffness: Force for each unit by which the joint is off; 0 for a motor.
        damping: Force for each unit of the joint's velocity.
        plain: Whether it has no state, curve or plugin of its own.
    """

    line: int
    name: str
    joint: int
    gain: float
    stiffness: float
    damping: float
    gear: float
    plain: bool
    ctrl_limited: bool
    ctrl_range: tuple[float, float]
    force_limited: bool
    force_range: tuple[float, float]


class Contact(Record):
    """Two shapes that touch; a negative distance (metres) is how deep they overlap."""

    geoms: tuple[int, int]
    distance: float


class CompiledModel(Record, eq=False, dict=True):
    """A model and what MuJoCo makes of it.

    Attributes:
        model: The model as it is written.
        text: The text that MuJoCo got.
        compiled: What it made of it.
    """

    model: MjcfModel
    text: MujocoText
    compiled: Compiled

    def element(self, line: int) -> Element | None:
        """Return the element of a part by its line; None if it is not known."""
        return self.text.element(line)

    def root(self, body: int) -> int:
        """Return the number of the body of a tree that the world holds."""
        while parent := self.compiled.bodies[body].parent:
            body = parent
        return body

    def span(self, line: int) -> Span:
        """Return the place of a part by its line; the model's root if it is not known."""
        return (self.text.element(line) or self.model.document.root).span

    @cached_property
    def lacks_files(self) -> bool:
        """True if files are missing, so that masses and contacts of meshes mean nothing."""
        return bool(self.text.absent)


class CompiledModels(Record, eq=False):
    """The models of a package that were compiled, and why others were not."""

    models: tuple[CompiledModel, ...]
    missing: tuple[str, ...]


@part
def compiled_models(models: tuple[MjcfModel, ...], cache: Cache, stages: Stages) -> CompiledModels:
    """Return the models as MuJoCo compiles them."""
    PHYSICS.require_for("a model of MuJoCo")
    made: list[CompiledModel] = []
    missing: list[str] = []
    with stages.stage("mujoco", "compiling models in MuJoCo"):
        for model in models:
            if not model.is_whole:
                continue  # what is missing is a finding
            compiled = _compiled(model, cache)
            if isinstance(compiled, str):
                missing.append(f"{model.file}: {compiled}")
            else:
                made.append(compiled)
    return CompiledModels(tuple(made), tuple(missing))


@part
def each_compiled(models: CompiledModels) -> tuple[CompiledModel, ...] | NotAvailable:
    """Return each model that MuJoCo accepts, or accepts without what it refuses."""
    accepted = tuple(each for each in models.models if each.compiled.bodies)
    if accepted:
        return accepted
    refused = next((f"MuJoCo refuses {it.model.file}" for it in models.models), "")
    absent = "a file that the model includes cannot be read"
    return NotAvailable(next(filter(None, (refused, *models.missing)), absent))


def _compiled(model: MjcfModel, cache: Cache) -> CompiledModel | str:
    text = mujoco_text(model)
    if text.obstacle:
        return text.obstacle
    item = {"text": text.text, "attached": dict(text.attached), "files": dict(text.files)}
    contents = [read_bytes_of(place) for place in text.files.values()]
    texts = (text.text, *text.attached.values(), *text.files)
    key = work_key((*texts, *contents), ["physics/compiled"], ("mujoco",))
    work = Work("compiled", _MODULE, LIMITS, {key: item}, _decode, files=_files)
    result = Background(work, cache).result()
    if isinstance(result, WorkerFailed):
        return f"MuJoCo {result.reason}"
    return CompiledModel(model, text, result)


def read_bytes_of(place: str) -> bytes:
    """Return the content of a file on disk; empty if it cannot be read."""
    from pathlib import Path

    content = read_bytes(Path(place), place, SIZE_LIMIT)
    return content if isinstance(content, bytes) else b""


def _files(item: Any) -> list[tuple[str, int]]:
    return [(place, SIZE_LIMIT) for place in item["files"].values()]


def _decode(answer: Any) -> Compiled:
    return convert(answer, Compiled)
