"""Values below `<gazebo>` tags: `<kp>1e6</kp>`, and `<kp value="1e6"/>` as older files have it."""

from __future__ import annotations

from checker.model.values import parse_number
from checker.source.text import Located
from checker.source.xml import Element

OF_LINKS = frozenset(
    {
        *("dampingFactor", "fdir1", "gravity", "kd", "kp", "laserRetro", "material", "maxContacts"),
        *("maxVel", "minDepth", "mu1", "mu2", "selfCollide", "self_collide", "sensor"),
        *("turnGravityOff", "visual", "collision"),
    }
)
"""Elements that a `<gazebo>` tag with the name of a link may contain."""
OF_JOINTS = frozenset(
    {
        *("cfmDamping", "disableFixedJointLumping", "fudgeFactor", "implicitSpringDamper"),
        *("preserveFixedJoint", "provideFeedback", "provide_feedback", "springReference"),
        *("springStiffness", "stopCfm", "stopErp"),
    }
)
"""Elements that a `<gazebo>` tag with the name of a joint may contain."""
_TRUE = ("1", "true")


def extension_text(element: Element) -> Located[str]:
    """Return what an element states; an attribute `value` counts more than the text.

    Source: sdformat, parser_urdf.cc, GetKeyValueAsString.
    """
    return element.attribute("value") or element.text


def extension_number(tag: Element, name: str) -> Located[float] | None:
    """Return the number in a child of a `<gazebo>` tag; None if none reads as one."""
    child = tag.child(name)
    if child is None:
        return None
    text = extension_text(child)
    value = parse_number(text.value.strip())
    return None if value is None else Located(value, text.span)


def extension_flag(tag: Element, name: str) -> bool:
    """Return whether a child of a `<gazebo>` tag is there and states true."""
    child = tag.child(name)
    return child is not None and extension_text(child).value.strip().lower() in _TRUE


_WITHOUT_EFFECT = frozenset(
    {
        *("disableFixedJointLumping", "implicitSpringDamper", "laserRetro", "material"),
        *("preserveFixedJoint", "provideFeedback", "provide_feedback", "visual"),
        *("dampingFactor", "kd", "kp", "maxContacts", "maxVel", "minDepth"),
        *("mu1", "mu2", "selfCollide", "self_collide"),
    }
)
"""Elements without which a robot moves and senses in the same way, or slips more or less."""


def simulates(tag: Element) -> bool:
    """Return whether a robot moves or senses in another way without this `<gazebo>` tag."""
    return not _WITHOUT_EFFECT.issuperset(child.tag for child in tag.children)


_DEFAULTS = {
    "mu1": 1.0,
    "mu2": 1.0,
    "slip1": 0.0,
    "slip2": 0.0,
    "kp": 1e12,
    "kd": 1.0,
    "maxVel": 0.01,
    "minDepth": 0.0,
}
"""What SDFormat has for the contacts of a link that states nothing."""


def states_defaults(tag: Element) -> bool:
    """Return whether all that a `<gazebo>` tag has is what counts without it."""
    numbers = {child.tag: extension_number(tag, child.tag) for child in tag.children}
    return bool(numbers) and all(
        number is not None and number.value == _DEFAULTS.get(name)
        for name, number in numbers.items()
    )
