"""Messages that a bridge of ROS 2 converts: which of Gazebo's to which of ROS."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from checker.base.resources import table


def ros_types(gz_message: str) -> Sequence[str]:
    """Return the ROS messages of one of Gazebo's, named without its package."""
    names: Sequence[str] = table("bridge_types")["pairs"].get(gz_message, ())
    return names


@cache
def gz_messages(ros_type: str) -> tuple[str, ...]:
    """Return Gazebo's messages of a ROS message."""
    pairs = table("bridge_types")["pairs"].items()
    return tuple(gz for gz, names in pairs if ros_type in names)


def meant_gz_message(text: str) -> str:
    """Return the message of Gazebo that another spelling means, by its last word; or nothing."""
    pairs = table("bridge_types")["pairs"]
    return next((name for name in pairs if _letters(name) == _letters(text)), "")


def meant_ros_type(text: str, among: Sequence[str]) -> str:
    """Return the ROS message that another spelling means, by its last word; or nothing."""
    return next((name for name in among if _letters(name) == _letters(text)), "")


def _letters(text: str) -> str:
    """Return the last word of a message without what spellings differ in."""
    return re.split(r"[./:]", text)[-1].lower().replace("_", "")


def all_ros_types() -> tuple[str, ...]:
    """Return every ROS message of the table."""
    names = (name for row in table("bridge_types")["pairs"].values() for name in row)
    return tuple(dict.fromkeys(names))


def service_messages(ros_type: str) -> Sequence[str] | None:
    """Return Gazebo's messages of request and reply of a ROS service; None if not known."""
    names: Sequence[str] | None = table("bridge_types")["services"].get(ros_type)
    return names


def meant_service(text: str) -> str:
    """Return the service that another spelling means, by its last word; or nothing."""
    return meant_ros_type(text, [*table("bridge_types")["services"]])
