"""The graph of frames: the frame that each is relative to, and the resulting positions."""

from __future__ import annotations

from dataclasses import dataclass, field

from checker.base.record import Record
from checker.model.faults import Fault, FaultKind
from checker.model.geometry.transform import Transform
from checker.source.text import Span

MODEL_FRAME = "__model__"


class FrameNode(Record, eq=False):
    """A frame: its pose in another one.

    Attributes:
        relative_to: Scoped name of that other frame; None for the root.
        transform: Pose in it.
        span: The pose that states it.
        label: What a message calls it: `link 'wheel'`.
    """

    relative_to: str | None
    transform: Transform
    span: Span
    label: str


@dataclass
class FrameGraph:
    """Frames by scoped name. The root is the robot's own frame, named `__model__`.

    Each pose is computed once, without recursion: a chain may be of any length.
    """

    nodes: dict[str, FrameNode] = field(default_factory=dict)
    faults: list[Fault] = field(default_factory=list)
    _poses: dict[str, Transform | None] = field(default_factory=dict)

    def add(self, name: str, node: FrameNode) -> None:
        """Add a frame; the first of two with one name counts."""
        self.nodes.setdefault(name, node)

    def pose(self, name: str) -> Transform | None:
        """Return the pose of a frame in the root; None if it has no parent, or is its own."""
        chain: list[str] = []
        on_chain: set[str] = set()
        at: str | None = name
        while at is not None and at not in self._poses and at in self.nodes:
            if at in on_chain:
                self._report_cycle(chain[chain.index(at) :])
                break
            chain.append(at)
            on_chain.add(at)
            at = self.nodes[at].relative_to
        above = self._start(chain, at)
        for link in reversed(chain):
            if link not in self._poses:
                node = self.nodes[link]
                self._poses[link] = above @ node.transform if above is not None else None
            above = self._poses[link]
        return self._poses.get(name)

    def _start(self, chain: list[str], at: str | None) -> Transform | None:
        """Return the pose that the top of a chain builds on."""
        if at is None:
            return Transform()
        if at in self._poses:
            return self._poses[at]
        if chain and at not in self.nodes:
            node = self.nodes[chain[-1]]
            self.faults.append(
                Fault(
                    FaultKind.FRAME,
                    node.span,
                    f"{node.label} is posed relative to {at!r}, which does not exist"
                    if at
                    else f"{node.label} is posed relative to nothing",
                )
            )
        return None

    def _report_cycle(self, names: list[str]) -> None:
        first = self.nodes[names[0]]
        circle = " → ".join([*names[:6], "…"] if len(names) > 6 else [*names, names[0]])
        self.faults.append(
            Fault(
                FaultKind.FRAME, first.span, f"{first.label} is posed relative to itself: {circle}"
            )
        )
        for name in names:
            self._poses[name] = None

    def pose_below(self, name: str, ancestor: str) -> Transform | None:
        """Return the pose of a frame in one that it is connected to; None if it does not.

        Nothing is remembered, so that the ancestor itself may be placed later.
        """
        pose = Transform()
        seen: set[str] = set()
        at: str | None = name
        while at != ancestor:
            if at is None or at in seen or at not in self.nodes:
                return None
            seen.add(at)
            pose = self.nodes[at].transform @ pose
            at = self.nodes[at].relative_to
        return pose
