"""The parts of a robot that an SRDF names, and what MoveIt loses where one is unknown."""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum

from checker.base.record import Record
from checker.source.text import Located
from checker.source.xml import Element


class Loss(StrEnum):
    """What srdfdom drops where a name is unknown, the most severe first."""

    SUBGROUP = "group"
    CHAIN = "chain"
    JOINT = "joint of a group"
    LINK = "link of a group"
    END_EFFECTOR = "end effector"
    PARENT_GROUP = "parent group of an end effector"
    VIRTUAL_JOINT = "virtual joint"
    STATE = "state"
    STATE_JOINT = "joint of a state"
    PASSIVE_JOINT = "passive joint"
    PAIR = "collision pair"


class NamedPart(Record, eq=False):
    """A name in an SRDF.

    Attributes:
        kind: `link`, `joint` or `group`.
        name: The name.
        loss: What is lost if there is no such part.
        owner: The name of the group, state or other element that is around it.
    """

    kind: str
    name: Located[str]
    loss: Loss
    owner: str


_IN_GROUPS = (
    ("joint", "name", "joint", Loss.JOINT),
    ("link", "name", "link", Loss.LINK),
    ("group", "name", "group", Loss.SUBGROUP),
    ("chain", "base_link", "link", Loss.CHAIN),
    ("chain", "tip_link", "link", Loss.CHAIN),
)
_BELOW = (
    ("group_state", "group", "group", Loss.STATE),
    ("end_effector", "group", "group", Loss.END_EFFECTOR),
    ("end_effector", "parent_link", "link", Loss.END_EFFECTOR),
    ("end_effector", "parent_group", "group", Loss.PARENT_GROUP),
    ("virtual_joint", "child_link", "link", Loss.VIRTUAL_JOINT),
    ("passive_joint", "name", "joint", Loss.PASSIVE_JOINT),
    *(
        (f"{verb}able_collisions", name, "link", Loss.PAIR)
        for verb in ("dis", "en")
        for name in ("link1", "link2")
    ),
)
"""Elements, their attributes, the kind of part that these name, and what is lost."""


def named_parts(root: Element) -> Iterator[NamedPart]:
    """Yield the parts that a `<robot>` of SRDF names; names that xacro computes are left out."""
    for group in root.all("group"):
        yield from _named(group, _IN_GROUPS, group.get("name") or "")
    for state in root.all("group_state"):
        joints = (("joint", "name", "joint", Loss.STATE_JOINT),)
        yield from _named(state, joints, state.get("name") or "")
    yield from _named(root, _BELOW, "")


def _named(
    element: Element,
    rows: tuple[tuple[str, str, str, Loss], ...],
    owner: str,
) -> Iterator[NamedPart]:
    for tag, attribute, kind, loss in rows:
        for child in element.all(tag):
            name = child.attribute(attribute)
            if name is not None and name.value.strip() and not _is_computed(child, name):
                stated = Located(name.value.strip(), name.span)
                yield NamedPart(kind, stated, loss, owner or child.get("name") or "")


def _is_computed(element: Element, name: Located[str]) -> bool:
    origin = element.written
    literal = name.value in (origin.get(each) for each in origin.attributes)
    return "$" in name.value or not literal


def names_of(root: Element, tag: str) -> frozenset[str]:
    """Return the names of the elements of a tag: `group`, `virtual_joint`."""
    return frozenset((element.get("name") or "").strip() for element in root.all(tag))
