"""A friction that Gazebo drops, because the collision has its own name.

`<mu1>` and `<mu2>` below `<gazebo reference="link">` are for the collisions of that link. Gazebo
finds these by their names in SDF, which it derives from the link's name where a collision has none.
A collision with another name keeps the default friction of 1: a caster that should slide drags.
Where a fixed joint merges the link into its parent, the name must be that of the link, without a
suffix.

Fix: remove `name` from the collision, or write what the message says.
Source: sdformat, parser_urdf.cc, `InsertSDFExtensionCollision`; what libsdformat 12 makes of URDFs
with such names.
"""

from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.extensions import extension_number
from checker.formats.urdf.fixed_joints import Lumping
from checker.model.components import Link
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_FRICTION = ("mu1", "mu2")
_DEFAULT = 1.0


@rule("URD027", "friction-lost-on-named-collision", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report named collisions that lose a friction which is not the default."""
    if description.for_rviz:
        return
    merged = Lumping(description).merged
    for tag in description.gazebo:
        link = description.robot.links_by_name.get(tag.reference.value)
        numbers = ((name, extension_number(tag.element, name)) for name in _FRICTION)
        stated = [(name, mu) for name, mu in numbers if mu is not None and mu.value != _DEFAULT]
        if link is None or not stated:
            continue
        (first, mu), is_merged = stated[0], link.name.value in merged
        for name in _names_without_friction(link, merged=is_merged):
            yield finding(
                mu,
                f"Gazebo drops <{first}> {mu.value:g} of link {link.name.value!r}, because its "
                f"collision has the name {name.value!r}: remove it, or write {link.name.value!r}",
                related=[(name, "the collision")],
                key=first,
            )


def _names_without_friction(link: Link, *, merged: bool) -> Iterator[Located[str]]:
    """Yield the names of collisions that the friction of a link does not reach."""
    for collision in link.collisions:
        name = collision.element.attribute("name")
        if name is None or not name.value:
            continue
        begins = f"{link.name.value}_collision" if merged else link.name.value
        if not f"{name.value}_collision".startswith(begins):
            yield name


def _wheel(collision: str, joint: str, friction: str = "<mu1>0.01</mu1>", mark: str = "") -> object:
    return {
        "@urdf": f"""<link name="ball">
<collision{collision}><geometry><sphere radius="0.1"/></geometry></collision>
</link>
<joint name="axle" type="{joint}"><parent link="upper_arm"/><child link="ball"/></joint>
<gazebo reference="ball">
{friction}{mark}
</gazebo>"""
    }


_MARK = "  <!-- ^ URD027 -->"
GOOD = [
    _wheel("", "fixed"),
    _wheel(' name="ball"', "fixed"),
    _wheel(' name="ball_1"', "continuous"),
    _wheel(' name="body"', "fixed", "<mu1>1.0</mu1>"),
    _wheel(' name="body"', "fixed", "<material>Gazebo/Red</material>"),
]
BAD = [
    _wheel(' name="body"', "fixed", mark=_MARK),
    _wheel(' name="ball_1"', "fixed", mark=_MARK),
    _wheel(' name="body"', "continuous", mark=_MARK),
]
