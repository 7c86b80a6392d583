"""An element or attribute of URDF whose name is misspelt.

URDF readers ignore unknown names without a message. A link with `<colision>` touches nothing, and
an `<origin xzy="…">` is at zero. A collision that is lost of a part that is fixed to a heavier one
with a collision, such as a camera at a chassis, is a warning.

Fix: write the name as the message says.
Source: URDF specification; urdfdom reads elements and attributes by their names
(`urdf_spec.json`).
"""

from checker.finding import Fix
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.specification import MisspeltPart, misspelt_parts
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Safety, Severity, finding, rule

_ONLY_LOOKS = "link/visual"
_COLLISION = "<collision>"


@rule("URD015", "misspelt-urdf-part", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report unknown names that resemble one that is missing there.

    What only changes how a part looks is a warning, and so is a description for RViz. An attribute
    of zeros in `<origin>` is an info: they count without it too.
    """
    robot = description.robot
    for part in misspelt_parts(description.document):
        harmless = description.for_rviz or part.path.startswith(_ONLY_LOOKS)
        harmless = harmless or (part.meant == _COLLISION and _is_attached(part, robot))
        yield finding(
            part.span,
            f"URDF readers do not know {part.name} in <{part.around.tag}>; did you mean "
            f"{part.meant}?",
            severity=Severity.INFO if part.is_zero else Severity.WARNING if harmless else None,
            key=f"{part.around.tag}/{part.name}",
            fix=Fix(Safety.UNSAFE, part.edits) if part.edits else None,
        )


def _is_attached(part: MisspeltPart, robot: Robot) -> bool:
    """Return whether the link is fixed to one with a collision that weighs at least as much."""
    link = robot.links_by_name.get(part.around.get("name") or "")
    if link is None:
        return False
    bodies = robot.tree.rigid_bodies.links.values()
    body = next((it for it in bodies if link.scoped_name in it), ())
    others = (robot.tree.links[name] for name in body if name != link.scoped_name)
    return any(other.collisions and other.mass >= link.mass for other in others)


def _tip(content: str) -> dict[str, str]:
    joint = '<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>'
    return {"@urdf": f'<link name="tip">\n{content}\n</link>\n{joint}'}


_BOX = '<geometry><box size="1 1 1"/></geometry>'
_MARK = "  <!-- ^ URD015 -->"
GOOD = [
    _tip(f"<collision>{_BOX}</collision>"),
    _tip(f'<collision>{_BOX}<origin xyz="0 0 1"/></collision><self_collision_checking/>'),
    _tip("<contact><lateral_friction/></contact><sensor/>"),
]
BAD = [
    _tip(f"<colision>{_MARK}{_BOX}</colision>"),
    _tip(f'<collision>{_BOX}<origin xzy="0 0 1"/>{_MARK}</collision>'),
    _tip(f"<visual>{_MARK}<geometri/></visual>"),
    _tip(f'<collision>{_BOX}<origin pry="0 0 0"/>{_MARK}</collision>'),
]
