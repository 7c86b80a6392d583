"""What the parts of nested models are called once all stand in one model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.model.components import Frame, Joint, Link, Model
from checker.model.frames import MODEL_FRAME
from checker.model.robot import Robot

SEPARATOR = "__"
"""Between the name of a model and those of its parts, as in `arm__wrist`."""
_SCOPE = "::"


class FlatNames(Record):
    """New names by scoped names; what stands in the outermost model keeps its own."""

    changed: Mapping[str, str]

    @classmethod
    def of(cls, robot: Robot) -> FlatNames:
        """Name the parts of a robot's nested models."""
        taken = {MODEL_FRAME, *_names(robot, nested=False)}
        changed: dict[str, str] = {}
        numbers: dict[str, int] = {}
        for scoped in dict.fromkeys(_names(robot, nested=True)):
            flat = wanted = scoped.replace(_SCOPE, SEPARATOR)
            while flat in taken:
                numbers[wanted] = numbers.get(wanted, 1) + 1
                flat = f"{wanted}_{numbers[wanted]}"
            taken.add(flat)
            changed[scoped] = flat
        return cls(changed)

    def flat(self, scoped: str) -> str:
        """Return the name that stands for a scoped one; itself where no part changes that name."""
        return self.changed.get(scoped, scoped)


def _names(robot: Robot, *, nested: bool) -> Iterator[str]:
    """Yield the scoped names of what stands in nested models, or of what does not."""
    parts: tuple[Model | Link | Frame | Joint, ...] = (*robot.models, *robot.links)
    for part in (*parts, *robot.frames, *robot.joints):
        # A nested model leaves its name to the frame that stands where it stood.
        stays = part.element.parent is robot.element and not isinstance(part, Model)
        if nested is not stays:
            yield part.scoped_name
