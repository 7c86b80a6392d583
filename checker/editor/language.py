"""Language of an XML file, and the path of an element in it."""

from __future__ import annotations

from collections.abc import Sequence

from checker.base.record import Record
from checker.convert.gazebo_tags import short_tags
from checker.editor.xacro_names import PREFIX

_GAZEBO = "gazebo"
_MODEL = ("sdf", "model")


class Place(Record):
    """Path of an element in a language.

    Attributes:
        language: `sdf`, `urdf`, or empty for others.
        tags: Its path: from `sdf` down, or below `robot` (which is `()` itself).
        is_extension: Whether it is SDF inside a `<gazebo>` tag of URDF.
    """

    language: str
    tags: tuple[str, ...]
    is_extension: bool = False

    @property
    def path(self) -> str:
        """The tags as a path; `robot` for the robot itself."""
        return "/".join(self.tags) or "robot"


def place_of(tags: Sequence[str], *, refers: bool = True) -> Place:
    """Return where an element is.

    Tags of xacro's own are skipped: what is in a macro is where that is called.

    Args:
        tags: The tags from the root of the file down to the element.
        refers: Whether the `<gazebo>` tag around it, if any, refers to a link or joint.
    """
    own = tuple(tag for tag in tags if not tag.startswith(PREFIX))
    if not own:
        return Place("", ())
    if own[0] == "sdf":
        return Place("sdf", own)
    if own[0] != "robot":
        return Place("", own)
    below = own[1:]
    if len(below) > 1 and below[0] == _GAZEBO:
        return Place("sdf", _in_extension(below[1:], refers=refers), is_extension=True)
    return Place("urdf", below)


def _in_extension(tags: tuple[str, ...], *, refers: bool) -> tuple[str, ...]:
    """Return where SDF would have what is in a `<gazebo>` tag."""
    if not refers or tags[0] == "plugin":
        return (*_MODEL, *tags)
    of_link, of_joint = short_tags("link"), short_tags("joint")
    if (path := of_link.get(tags[0])) is not None:
        return (*_MODEL, *(path if path[0] == "link" else ("link", *path)), *tags[1:])
    if path := of_joint.get(tags[0]):
        return (*_MODEL, "joint", *path, *tags[1:])
    return (*_MODEL, "link", *tags)
