"""Names inside models: how a name as written becomes one that is unique in the robot."""

from __future__ import annotations

from collections.abc import Mapping

from checker.base.record import Record
from checker.formats.sdf.poses import frame_of, in_degrees, transform_of
from checker.model.components import Pose
from checker.model.faults import FaultKind
from checker.model.frames import MODEL_FRAME, FrameGraph
from checker.model.geometry.transform import Transform, Vector, rotation_from_quaternion
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

_ZEROS = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Scope(Record):
    """A model whose inside is being read.

    Attributes:
        prefix: Prefix of names inside: empty for the robot, `arm::` for a model in it.
        model_frame: Scoped name of the model's own frame.
        version: SDF version of the file, as (1, 6).
        values: Reads values, collects faults.
        graph: Takes the frames.
        renamed: Parts inside that libsdformat calls otherwise than they are written.
    """

    prefix: str
    model_frame: str
    version: tuple[int, int]
    values: ValueReader
    graph: FrameGraph
    renamed: Mapping[Element, str] = {}

    def scoped(self, name: str) -> str:
        """Return the unique name of a frame as written inside this model."""
        name = name.strip()
        if name in (MODEL_FRAME, ""):
            return self.model_frame
        name = name.removesuffix(f"::{MODEL_FRAME}")
        return name if name == "world" else self.prefix + name

    def name(self, part: Element) -> Located[str]:
        """Return the name of a link, joint or frame inside this model."""
        written = self.values.name(part)
        return Located(self.renamed[part], written.span) if part in self.renamed else written

    def pose(self, parent: Element) -> Pose:
        """Read the `<pose>` of an element; zeros when it has none."""
        element = parent.child("pose")
        if element is None:
            numbers = tuple(Located(0.0, parent.span, stated=False) for _ in _ZEROS)
            return Pose(Transform(), "", numbers, parent.span)
        named = frame_of(element, self.version)
        numbers, transform = self._numbers(element)
        frame = self.scoped(named.value) if named is not None else ""
        in_radians = len(numbers) == len(_ZEROS) and not in_degrees(element)
        return Pose(transform, frame, numbers, element.span, in_radians)

    def _numbers(self, element: Element) -> tuple[tuple[Located[float], ...], Transform]:
        if not element.text.stated:
            return tuple(Located(0.0, element.span, stated=False) for _ in _ZEROS), Transform()
        if element.get("rotation_format") == "quat_xyzw":
            numbers = self._finite_numbers(element, (*_ZEROS, 1.0))
            x, y, z, qx, qy, qz, qw = (number.value for number in numbers)
            return numbers, self._from_quaternion(element, (x, y, z), (qw, qx, qy, qz))
        numbers = self._finite_numbers(element, _ZEROS)
        return numbers, transform_of(element, (number.value for number in numbers))

    def _finite_numbers(
        self, element: Element, default: tuple[float, ...]
    ) -> tuple[Located[float], ...]:
        return self.values.finite(self.values.numbers_of(element, default, commas=True))

    def _from_quaternion(
        self,
        element: Element,
        xyz: Vector,
        quaternion: tuple[float, float, float, float],
    ) -> Transform:
        if not any(quaternion):
            self.values.fault(
                FaultKind.VALUE, element.span, "a quaternion of zeros is not a rotation"
            )
            return Transform(translation=xyz)
        return Transform(rotation_from_quaternion(*quaternion), xyz)
