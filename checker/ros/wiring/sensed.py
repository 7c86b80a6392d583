"""Inputs of nodes that a parameter names, and the robots and drivers that publish such messages."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator

from checker.ros.wiring.endpoints import Endpoint
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring

_TYPES = (
    "nav_msgs/msg/Odometry",
    *(f"sensor_msgs/msg/{name}" for name in ("Imu", "LaserScan", "PointCloud2", "Range")),
)


def unpublished_inputs(
    wiring: Wiring, published: Collection[str]
) -> Iterator[tuple[Endpoint, str]]:
    """Yield inputs that a parameter names and no known publisher serves, each with its type.

    Args:
        wiring: The launch whose nodes read.
        published: The topics that something publishes.
    """
    for wanted in wiring.endpoints:
        stated = wanted.parameter and not wanted.publishes and wanted.certain
        message = next((it for it in wanted.types if it in _TYPES), "")
        if stated and message and wanted.topic not in published:
            yield wanted, message


def sources(
    wiring: Wiring, wanted: Endpoint, message: str, read: Collection[str]
) -> list[Endpoint]:
    """Return what publishes a type itself: robots and drivers, not nodes that pass messages on.

    Topics whose names are like the wanted one come first.

    Args:
        wiring: The launch that publishes.
        wanted: The input.
        message: The type: `nav_msgs/msg/Odometry`.
        read: Topics that are left out, since its node reads them.
    """
    readers = {id(it.owner) for it in wiring.endpoints if not it.publishes and message in it.types}
    found = [
        each
        for each in wiring.endpoints
        if each.publishes and each.certain and message in each.types and each.topic not in read
        if not (isinstance(each.owner, WiredNode) and id(each.owner) in readers)
    ]
    return sorted(found, key=lambda it: not alike(wanted, it))


def topics_read_by(wiring: Wiring, owner: object) -> set[str]:
    """Return the topics that a node of a launch reads."""
    return {it.topic for it in wiring.endpoints if it.owner is owner and not it.publishes}


def where_published(message: str, others: Iterable[Endpoint]) -> str:
    """Return where the messages of a type are, for a message: `Odometry is on /base/odom`."""
    names = dict.fromkeys(it.topic for it in others)
    return f"{message.rpartition('/')[2]} is on {', '.join(names)}"


def alike(first: Endpoint, second: Endpoint) -> bool:
    """Return whether two topics differ only in separators and case."""
    one, two = (re.sub(r"[\W_]", "", it.topic).casefold() for it in (first, second))
    return one == two
