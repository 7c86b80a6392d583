"""Other names for the parts of a robot without nested models, wherever they are named."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.finding import Edit
from checker.formats.sdf.flattening.draft import Draft, Holder
from checker.formats.sdf.flattening.names import FlatNames, names_in
from checker.model.robot import Robot

_PARTS = ("link", "joint", "frame", "gripper")


class Renaming(Record):
    """A robot and the new names of its parts."""

    robot: Robot
    names: FlatNames

    @property
    def edits(self) -> tuple[Edit, ...]:
        """The edits of the robot's file."""
        model = self.robot.element
        draft, holder = Draft(self.robot.document.source), Holder(model)
        canonical = model.attribute("canonical_link")
        if canonical is not None:
            draft.name(canonical, self.names.flat_name(canonical.value))
        for child in model.children:
            if child.tag in _PARTS:
                holder.rename(draft, child, self.names)
        return (*draft.edits, *self._of_plugins())

    def _of_plugins(self) -> Iterator[Edit]:
        """Yield the edits of plugins' parameters, in any file."""
        for plugin in self.robot.all_plugins:
            for named in names_in(plugin):
                if named.value in self.names.changed:
                    yield named.span.replacement(self.names.flat_name(named.value))
