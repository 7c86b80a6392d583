"""A model whose parts are being moved, and what they call each other."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.fix.flattening.draft import Draft
from checker.fix.flattening.names import FlatNames
from checker.model.frames import MODEL_FRAME
from checker.source.text import Located
from checker.source.xml import Element

_NAMING = {
    "pose": ("relative_to", "frame"),
    "frame": ("attached_to",),
    "xyz": ("expressed_in",),
    "mimic": ("joint",),
    "parent": ("link",),
    "child": ("link",),
}
"""Attributes that name a part, by the elements that have them."""
_NAMED = ("parent", "child", "gearbox_reference_body", "gripper_link", "palm_link")
"""Elements whose text names a part."""


class Holder(Record):
    """A model whose parts are being moved.

    Attributes:
        element: The `<model>`.
        prefix: What stands in front of scoped names in it; empty for the robot.
        frame: Scoped name of its own frame.
    """

    element: Element
    prefix: str = ""
    frame: str = MODEL_FRAME

    @property
    def nested(self) -> bool:
        """Whether it is a model within the robot's."""
        return self.frame != MODEL_FRAME

    def scoped(self, name: str) -> str:
        """Return the unique name of what is called so inside."""
        if name in ("", MODEL_FRAME):
            return self.frame
        return name if name == "world" else self.prefix + name.removesuffix(f"::{MODEL_FRAME}")

    def rename(self, draft: Draft, part: Element, names: FlatNames) -> None:
        """Have a part, and what it names, stand under their new names."""
        name = part.attribute("name")
        if name is not None:
            draft.name(name, names.changed.get(self.scoped(name.value), name.value))
        for element in (part, *part.descendants()):
            for named in self._named(element):
                scoped = self.scoped(named.value)
                draft.name(named, names.changed.get(scoped, named.value))

    def _named(self, element: Element) -> Iterator[Located[str]]:
        for name in _NAMING.get(element.tag, ()):
            attribute = element.attribute(name)
            # What a nested model's poses name before SDF 1.7 is worked into their numbers.
            if attribute is not None and attribute.value and not (name == "frame" and self.nested):
                yield attribute
        if element.tag in _NAMED and element.text.stated:
            yield element.text
