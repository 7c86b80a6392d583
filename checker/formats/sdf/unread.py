"""Elements of SDFormat without effect on the simulation of the target."""

from __future__ import annotations

from checker.source.xml import Element

READ_EVERYTHING = ("", "classic")
"""No particular release, and Gazebo Classic."""

UNREAD = frozenset(
    {
        *("always_on", "velocity_decay", "max_contacts", "provide_feedback"),
        *("kp", "kd", "max_vel", "min_depth", "soft_cfm", "soft_erp"),
        *("cfm_damping", "implicit_spring_damper", "fudge_factor", "suspension"),
    }
)
"""Elements that libsdformat has no value for and no system of Gazebo (Dome or later) reads.

Source: libsdformat 10, Sensor.cc, Link.cc, Collision.cc, Joint.cc and Surface.cc, which of the
contact parameters reads `<collide_bitmask>` alone.
"""
GRAVE_PARENTS = ("inertial", "inertia", "geometry", "joint", "axis", "limit")
"""Places where a lost element changes how the robot moves."""


def is_unread(tag: str, release: str) -> bool:
    """Return whether nothing in a release of Gazebo reads an element of this name."""
    return release not in READ_EVERYTHING and tag in UNREAD


def is_appearance(element: Element) -> bool:
    """Return whether an element is only about the appearance of a part."""
    return is_within(element, "material")


def is_within(element: Element, tag: str) -> bool:
    """Return whether an element, or one around it, has a tag."""
    at: Element | None = element
    while at is not None and at.tag != tag:
        at = at.parent
    return at is not None
