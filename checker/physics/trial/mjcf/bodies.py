"""The links of a robot as nested bodies of MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator

from checker.model.geometry.transform import Transform
from checker.physics.trial.mjcf.layout import Layout
from checker.physics.trial.mjcf.names import Names, numbers, placed, well_placed

_BELT = 'surfacevel="1e-9 0 0 0 0 0"'
"""MuJoCo has room for a surface velocity only where the text states one that is not zero."""
_TOUCHES_GROUND_ALONE = 'contype="0" conaffinity="1" condim="3" priority="1"'


class BodyWriter:
    """Writes bodies with the joints, inertias and geoms in them, and names them.

    Attributes:
        names: Complete once the text is written.
    """

    def __init__(self, layout: Layout, belts: frozenset[str]) -> None:
        self.layout = layout
        self.belts = belts
        self.names = Names()

    def text(self, height: float) -> str:
        """Return all bodies, without recursion: robots may be thousands of links deep.

        Args:
            height: z of the robot's frame, metres.
        """
        forest, poses = self.layout.forest, self.layout.poses
        lift = Transform(translation=(0.0, 0.0, height))
        lines: list[str] = []
        waiting: list[str | None] = list(reversed(forest.tops))
        while waiting:
            name = waiting.pop()
            if name is None:
                lines.append("</body>")
                continue
            base = forest.base(name)
            start = lift if base is None else poses[base].inverse
            lines.extend(self._opened(name, start @ poses[name]))
            waiting.append(None)
            waiting.extend(reversed(forest.below.get(name, [])))
        return "\n".join(lines)

    def _opened(self, name: str, pose: Transform) -> Iterator[str]:
        """Yield a body and what is in it, all but the bodies below and the end."""
        link = self.layout.robot.tree.links[name]
        weightless = "" if link.gravity.value else ' gravcomp="1"'
        yield f'<body name="{self.names.body(name)}" {placed(pose)}{weightless}>'
        yield from self._joints(name)
        yield self.layout.inertias[name].mjcf
        yield from self._geoms(name)

    def _joints(self, name: str) -> Iterator[str]:
        tie = self.layout.forest.tie(name)
        if tie is None:
            yield f'<freejoint name="{self.names.free_joint(name)}"/>'
            return
        degrees = self.layout.degrees[name]
        if not degrees:
            return
        joint = tie.joint.scoped_name
        own = self.names.joint(joint, ball=degrees[0].kind == "ball")
        inverse = self.layout.poses[name].inverse
        at = self.layout.robot.pose_of_joint(tie.joint)
        known = at is not None and well_placed(at)
        anchor = inverse.apply(at.translation) if at is not None and known else (0.0, 0.0, 0.0)
        for degree, mj in zip(degrees, (own, f"{own}_2"), strict=False):
            axis = Transform(inverse.rotation).rotate(degree.axis)
            yield f'<joint name="{mj}" pos="{numbers(anchor)}" {degree.mjcf(axis)}/>'

    def _geoms(self, name: str) -> Iterator[str]:
        belt = name in self.belts
        own = []
        for geom, friction in self.layout.geoms[name]:
            mj = self.names.geom(name)
            own.append(mj)
            slide = f'friction="{numbers([friction])} 0 0" {_BELT if belt else ""}'
            yield f'<geom name="{mj}" {geom.mjcf} {_TOUCHES_GROUND_ALONE} {slide}/>'
        if belt:
            self.names.belts[name] = tuple(own)
