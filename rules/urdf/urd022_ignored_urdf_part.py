"""An element in a robot, link or joint of a URDF that no reader reads there.

URDF readers ignore what they do not know, without a message. `<surface>`, `<mu>` and `<mu1>` in a
link give it no friction, a `<plugin>` outside of `<gazebo>` is not loaded, nor is a `<gazebo>` in a
link, a `<collision>` inside a `<visual>` touches nothing, and `<joint_properties>` adds no damping.
A `<geometry>` has one shape: urdfdom takes its first, MuJoCo a box before a mesh. Elements that
only other programs read, such as `<contact>` of Bullet, are not reported.

Fix: write the element where the message says.
Source: urdfdom, link.cpp and joint.cpp; MuJoCo, xml_urdf.cc; sdformat's parser_urdf.cc, which takes
`<gazebo>` tags of `<robot>` alone (`urdf_spec.json`).
"""

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.specification import stray_parts
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD022", "ignored-urdf-part", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report elements of SDF, of Gazebo and of the robot that are written in links and joints.

    It is an error for a plugin: what it would do is missing.
    """
    for part in stray_parts(description.document) if not description.for_rviz else ():
        tag, around = part.element.tag, part.path.rpartition("/")[2]
        owner = part.owner.get("name")
        yield finding(
            part.element,
            f"URDF readers ignore <{tag}> in <{around}> of {owner!r}: {part.advice}",
            severity=Severity.ERROR if tag == "plugin" else None,
            key=f"{around}/{tag}",
        )


def _lamp(link: str, joint: str = "") -> dict[str, str]:
    return {
        "@urdf": f"""<link name="lamp">
{link}
</link>
<joint name="j" type="continuous">
<parent link="upper_arm"/><child link="lamp"/>
{joint}
</joint>"""
    }


_MARK = "  <!-- ^ URD022 -->"
_BOX = "<collision><geometry><box size='1 1 1'/></geometry>\n@</collision>"
_TWO = f"<geometry><mesh filename='a.stl'/>\n<sphere radius='1'/>{_MARK}\n</geometry>"
GOOD = [
    _lamp(_BOX.replace("@", '<material name="red"/>') + "<contact><lateral_friction/></contact>"),
    _lamp('<origin xyz="0 0 0"/><gravity>true</gravity>'),
    _lamp("<sensor/>", '<dynamics damping="1"/>'),
    _lamp("", '<joint_properties damping="0.0" friction="0.0"/>'),
    {"@urdf": '<gazebo reference="upper_arm"><mu1>1</mu1></gazebo>'},
]
BAD = [
    _lamp(_BOX.replace("@", f"<surface><friction/></surface>{_MARK}\n")),
    _lamp(f"<mu>0</mu>{_MARK}"),
    _lamp(f"<mu1>1</mu1>{_MARK}\n<pose>0 0 1 0 0 0</pose>{_MARK}"),
    _lamp(f'<origin xyz="0 0 1"/>{_MARK}\n<sensor name="c" type="camera"/>{_MARK}'),
    _lamp(f"<gazebo><mu1>1</mu1></gazebo>{_MARK}"),
    _lamp(f"<visual>{_TWO}</visual>"),
    {"@urdf": f'<plugin name="lift" filename="liblift.so"/>{_MARK}'},
    _lamp(f'<plugin name="lift" filename="liblift.so"/>{_MARK}'),
    _lamp(f"<visual><geometry><box size='1 1 1'/></geometry>\n<collision/>{_MARK}\n</visual>"),
    _lamp(_BOX.replace("@", "") + f'\n<origin xyz="0 0 1"/>{_MARK}'),
    _lamp(_BOX.replace("/></g", f"/>\n<origin xyz='0 0 1'/>{_MARK}\n</g").replace("@", "")),
    _lamp("", f'<joint_properties damping="1"/>{_MARK}\n<stopErp>0.2</stopErp>{_MARK}'),
]
