"""A model as MuJoCo compiles it: its parts with their places, and its first second."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from checker.base.record import Record
from checker.formats.mjcf.model import MjcfModel
from checker.physics.compiled.text import MujocoText
from checker.source.text import Span
from checker.source.xml import Element


class Compiled(Record):
    """What MuJoCo makes of a text; see the worker.

    Attributes:
        refusals: What it refuses; the parts are those of the text without that.
        sizes: Numbers of coordinates, velocities, commands and states: `nq`, `nv`, `nu`, `na`.
        lacks_meshes: Whether a shape of an absent mesh collides, or gives its body mass.
        timestep: Seconds.
        bodies: The bodies; the first one is the world.
        idle: Numbers of the actuators that have no moment about any joint.
        held: Numbers of the joints that an equality holds, or couples with others.
        in_tendons: Numbers of the joints of fixed tendons.
        at_key: Whether there is a keyframe, so that the start is the first one.
        contacts: Bodies whose shapes touch at the start.
        trouble: What became too large or NaN within the first second: `position`, `velocity` or
            `acceleration`; else empty.
        time: Seconds that were simulated.
        fastest: Greatest velocity of a joint, rad/s or m/s.
        own_hits: Rangefinders whose beam always meets the robot itself.
    """

    refusals: tuple[Refusal, ...] = ()
    sizes: Mapping[str, int] = {}
    lacks_meshes: bool = False
    timestep: float = 0.0
    bodies: tuple[Body, ...] = ()
    joints: tuple[Joint, ...] = ()
    actuators: tuple[Actuator, ...] = ()
    idle: tuple[int, ...] = ()
    held: tuple[int, ...] = ()
    in_tendons: tuple[int, ...] = ()
    at_key: bool = False
    contacts: tuple[Contact, ...] = ()
    trouble: str = ""
    time: float = 0.0
    fastest: float = 0.0
    own_hits: tuple[OwnHit, ...] = ()


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
        reach: Metres from its centre of mass to the farthest point of its shapes, at most; 0 for a
            body without shapes.
        stated: Whether its mass and inertia are stated, not computed from its shapes.
        visual_mass: Kilograms of it that come from meshes that collide with nothing.
        colliding_visuals: Lines of meshes in a visual group or class that collide, beside shapes
            that are made for it.
    """

    line: int
    name: str
    parent: int
    welded: int
    mass: float
    inertia: tuple[float, float, float]
    position: tuple[float, float, float]
    reach: float
    stated: bool
    visual_mass: float
    colliding_visuals: tuple[int, ...] = ()


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
    """Two shapes of bodies that touch; a negative distance (metres) is how deep they overlap."""

    bodies: tuple[int, int]
    distance: float


class OwnHit(Record):
    """A rangefinder whose beam meets a body that moves with its own.

    Attributes:
        line: The line of the sensor; 0 if it is not known.
        body: The number of the body with its site.
        hit: The number of the body that the beam meets.
        distance: Metres.
    """

    line: int
    name: str
    body: int
    hit: int
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
    def overlaps(self) -> Mapping[tuple[int, int], float]:
        """Depth by which bodies overlap at the start, metres; empty if shapes are missing.

        The keys are the numbers of two bodies, the smaller one first.
        """
        deepest: dict[tuple[int, int], float] = {}
        for contact in () if self.compiled.lacks_meshes else self.compiled.contacts:
            first, second = sorted(contact.bodies)
            before = deepest.get((first, second), 0.0)
            deepest[first, second] = max(-contact.distance, before)
        return deepest


class CompiledModels(Record, eq=False):
    """The models of a package that were compiled, and why others were not."""

    models: tuple[CompiledModel, ...]
    missing: tuple[str, ...]
