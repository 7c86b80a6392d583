"""A name that Gazebo removes when it merges fixed joints.

Gazebo Classic merges links that fixed joints connect: the lower link and the joint no longer exist.
A plugin that names them ends with an error or does nothing; a contact sensor that names the old
collision never reports a contact. Frames of robot_state_publisher are not affected: it reads the
URDF file. Nor are plugins of sensors, which look up no link.

Fix: name the link into which it is merged; or keep the joint with `<preserveFixedJoint>true` below
`<gazebo reference="joint">` (`<disableFixedJointLumping>` keeps only the link).
Source: sdformat 6, parser_urdf.cc, ReduceFixedJoints: collisions become
`parent_fixed_joint_lump__child_collision`; ReduceSDFExtensionPluginFrameReplace replaces `bodyName`
and `frameName`; plugins look up `linkName` and `jointName` in the model.
"""

from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.fixed_joints import Lumping
from checker.model.components import Plugin, Sensor
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

OF_LINKS = ("bodyName", "linkName", "link_name", "body_name")
"""Parameters of plugins that name a link of the simulated model."""
_WRITTEN_ANEW = "bodyName"
"""Gazebo puts the link that is left into it, where the plugin belongs to the whole robot."""
OF_JOINTS = ("jointName", "joint_name")
_COLLISION = "_collision"


@rule("URD009", "frame-lost-by-lumping", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report plugins and contact sensors that name merged links, joints or collisions."""
    if description.for_rviz:
        return
    lumping, robot = Lumping(description), description.robot
    for plugin in robot.all_plugins:
        yield from _names_of(plugin, lumping)
    for sensor in robot.sensors:
        if sensor.type.value == "contact":
            yield from _contact(sensor, lumping)


def _names_of(plugin: Plugin, lumping: Lumping) -> Iterator[Finding]:
    holder = plugin.element.parent
    if holder is not None and holder.tag == "sensor":
        return  # those look up no link: what they measure is their sensor's
    of_robot = holder is not None and holder.tag == "gazebo" and not holder.get("reference")
    tags = [tag for tag in OF_LINKS if not (of_robot and tag == _WRITTEN_ANEW)]
    for name in plugin.values(*tags):
        if name.value in lumping.merged:
            yield finding(
                name,
                f"plugin {plugin.name.value!r} names link {name.value!r}, which Gazebo merges "
                f"into {lumping.holder(name.value)!r}",
                key=name.value,
            )
    joints = {joint.name.value for joint in lumping.merged.values()}
    for name in plugin.values(*OF_JOINTS):
        if name.value in joints:
            yield finding(
                name,
                f"plugin {plugin.name.value!r} names joint {name.value!r}, which is fixed: Gazebo "
                "merges its links and removes it",
                key=name.value,
            )


def _contact(sensor: Sensor, lumping: Lumping) -> Iterator[Finding]:
    for holder in sensor.element.all("contact"):
        for named in holder.all("collision"):
            link = named.text.value.removesuffix(_COLLISION)
            if named.text.value.endswith(_COLLISION) and link in lumping.merged:
                merged = f"{lumping.holder(link)}_fixed_joint_lump__{named.text.value}"
                yield finding(
                    named.text,
                    f"contact sensor {sensor.name.value!r} names {named.text.value!r}, which "
                    f"Gazebo renames when it merges link {link!r}; expected {merged!r}",
                )


_HAND = """<link name="hand"/>
<joint name="wrist" type="fixed"><parent link="upper_arm"/><child link="hand"/></joint>
"""
_KEPT = '<gazebo reference="wrist"><preserveFixedJoint>true</preserveFixedJoint></gazebo>'


def _plugin(parameter: str) -> str:
    return f"""<gazebo><plugin name="p" filename="libgazebo_ros_p3d.so">
{parameter}
</plugin></gazebo>"""


def _sensor(collision: str) -> str:
    return f"""<gazebo reference="hand"><sensor name="bumper" type="contact"><contact>
<collision>{collision}
</contact></sensor></gazebo>"""


_MARK = "  <!-- ^ URD009 -->"
GOOD = [
    {"@urdf": _HAND + _plugin("<bodyName>upper_arm</bodyName><frameName>hand</frameName>")},
    {"@urdf": _HAND + _KEPT + _plugin("<linkName>hand</linkName>")},
    {"@urdf": _HAND + _plugin("<bodyName>hand</bodyName>")},
    {"@urdf": _HAND + _sensor("upper_arm_fixed_joint_lump__hand_collision</collision>")},
]
BAD = [
    {"@urdf": _HAND + _plugin(f"<linkName>hand</linkName>{_MARK}")},
    {"@urdf": _HAND + _plugin(f"<jointName>wrist</jointName>{_MARK}")},
    {"@urdf": _HAND + _sensor(f"hand_collision</collision>{_MARK}")},
]
