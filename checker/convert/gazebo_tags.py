"""Content of `<gazebo reference=…>` tags, by the link or joint to which they refer."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from checker.base.record import Record
from checker.convert.conversion import Notes
from checker.formats.urdf.description import UrdfDescription
from checker.model.robot import Robot
from checker.source.xml import Element

_COLLISION: Mapping[str, tuple[str, ...]] = {
    "mu1": ("surface", "friction", "ode", "mu"),
    "mu2": ("surface", "friction", "ode", "mu2"),
    "fdir1": ("surface", "friction", "ode", "fdir1"),
    "slip1": ("surface", "friction", "ode", "slip1"),
    "slip2": ("surface", "friction", "ode", "slip2"),
    "kp": ("surface", "contact", "ode", "kp"),
    "kd": ("surface", "contact", "ode", "kd"),
    "maxVel": ("surface", "contact", "ode", "max_vel"),
    "minDepth": ("surface", "contact", "ode", "min_depth"),
    "maxContacts": ("max_contacts",),
    "max_contacts": ("max_contacts",),
    "laserRetro": ("laser_retro",),
}
_LINK: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "selfCollide": (("self_collide",),),
    "self_collide": (("self_collide",),),
    "gravity": (("gravity",),),
    "kinematic": (("kinematic",),),
    "enable_wind": (("enable_wind",),),
    "dampingFactor": (("velocity_decay", "linear"), ("velocity_decay", "angular")),
}
_JOINT: Mapping[str, tuple[str, ...]] = {
    "springStiffness": ("axis", "dynamics", "spring_stiffness"),
    "springReference": ("axis", "dynamics", "spring_reference"),
    "initialJointPosition": ("axis", "initial_position"),
    "provideFeedback": ("physics", "provide_feedback"),
    "implicitSpringDamper": ("physics", "ode", "implicit_spring_damper"),
    "cfmDamping": ("physics", "ode", "implicit_spring_damper"),
    "fudgeFactor": ("physics", "ode", "fudge_factor"),
    "stopCfm": ("physics", "ode", "limit", "cfm"),
    "stopErp": ("physics", "ode", "limit", "erp"),
}
_LUMPING = frozenset({"preserveFixedJoint", "disableFixedJointLumping"})
_WHOLE = frozenset({"static", "self_collide", "allow_auto_disable", "enable_wind"})
_INTO_MODEL = frozenset({"plugin", "model", "include", "link", "joint", "frame", "gripper"})
COPIED = frozenset({"sensor", "light", "plugin", "projector", "audio_sink", "audio_source"})
"""SDF inside a link's tag that is added to the link as it is."""
_EVERY_SHAPE = frozenset({"visual", "collision"})
_FALSE = ("0", "false")


def short_tags(reference: str) -> Mapping[str, tuple[str, ...]]:
    """Return the short tags of `<gazebo>` and the SDF that each represents, as a path.

    Args:
        reference: What it refers to: `link`, `joint`, or nothing for the model. Paths of a link's
            begin with `link` or `collision`.
    """
    if reference == "joint":
        return {**_JOINT, **dict.fromkeys(_LUMPING, ())}
    if not reference:
        return {tag: (tag,) for tag in _WHOLE}
    of_link = {tag: ("link", *paths[0]) for tag, paths in _LINK.items()}
    return of_link | {tag: ("collision", *path) for tag, path in _COLLISION.items()}


class Setting(Record, eq=False):
    """A value to be written at a path below an element of the result.

    Attributes:
        path: Tags, from the outside inwards.
        value: Its text.
        element: The element that states it.
    """

    path: tuple[str, ...]
    value: str
    element: Element


@dataclass
class GazeboSettings:
    """Settings of `<gazebo>` tags for one link, joint, or the whole robot.

    Attributes:
        link: The content for the link itself.
        collision: The content for each of its collisions.
        joint: The content for the joint.
        whole: The content for the model.
        materials: Names of materials of Gazebo; the last counts.
        shapes: `<visual>` and `<collision>`, whose content is added to each of the link's.
        copied: SDF that is added as it is.
    """

    link: list[Setting] = field(default_factory=list)
    collision: list[Setting] = field(default_factory=list)
    joint: list[Setting] = field(default_factory=list)
    whole: list[Setting] = field(default_factory=list)
    materials: list[Element] = field(default_factory=list)
    shapes: list[Element] = field(default_factory=list)
    copied: list[Element] = field(default_factory=list)


def gazebo_tags(
    robot: Robot, description: UrdfDescription, notes: Notes
) -> dict[str, GazeboSettings]:
    """Sort the content of a description's tags by the name they refer to; empty for the robot.

    A tag about a name that is neither link nor joint is noted and left out.
    """
    settings: dict[str, GazeboSettings] = {}
    for tag in description.gazebo:
        reference = tag.reference.value
        kinds = _kinds_of(reference, robot)
        if not kinds:
            notes.say(tag, f"<gazebo> refers to {reference!r}, which does not exist: left out")
            continue
        here = settings.setdefault(reference, GazeboSettings())
        for element in tag.element.children:
            if not _sort(element, here, kinds):
                notes.say(element, f"<{element.tag}> of a <gazebo> tag is left out")
    return settings


def _kinds_of(reference: str, robot: Robot) -> Collection[str]:
    """Return what a name refers to: a link and a joint may share it."""
    if not reference:
        return ("robot",)
    kinds = (("link", robot.links_by_name), ("joint", robot.joints_by_name))
    return [kind for kind, names in kinds if reference in names]


def _sort(element: Element, settings: GazeboSettings, kinds: Collection[str]) -> bool:
    """Enter an element where it belongs; return whether it is known to belong somewhere."""
    known = False
    if "robot" in kinds:
        known = _of_whole(element, settings)
    if "link" in kinds:
        known = _of_link(element, settings)
    if "joint" in kinds:
        known = _of_joint(element, settings, alone="link" not in kinds) or known
    return known


def _of_joint(element: Element, settings: GazeboSettings, *, alone: bool) -> bool:
    if element.tag in _JOINT:
        settings.joint.append(Setting(_JOINT[element.tag], value_of(element), element))
    elif element.tag == "sensor" and alone:
        settings.copied.append(element)
    else:
        return element.tag in _LUMPING
    return True


def value_of(element: Element) -> str:
    """Return a tag's value: its attribute `value`, which Gazebo's parser takes first, or text."""
    return element.get("value") or element.text.value


def _of_whole(element: Element, settings: GazeboSettings) -> bool:
    if element.tag in _WHOLE:
        settings.whole.append(Setting((element.tag,), value_of(element), element))
    elif element.tag in _INTO_MODEL:
        settings.copied.append(element)
    else:
        return False
    return True


def _of_link(element: Element, settings: GazeboSettings) -> bool:
    tag, value = element.tag, value_of(element)
    if tag in _COLLISION:
        settings.collision.append(Setting(_COLLISION[tag], value, element))
    elif tag in _LINK:
        settings.link += [Setting(path, value, element) for path in _LINK[tag]]
    elif tag == "turnGravityOff":
        acts = "true" if value.lower() in _FALSE else "false"
        settings.link.append(Setting(("gravity",), acts, element))
    elif tag == "material" and not element.children:
        settings.materials.append(element)
    elif tag in _EVERY_SHAPE:
        settings.shapes.append(element)
    elif tag in COPIED:
        settings.copied.append(element)
    else:
        return False
    return True
