"""The YAML file of a bridge between Gazebo and ROS 2: a sequence of topics."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.words import Suggestions
from checker.expand.launch.bridge import Direction
from checker.expand.ros2_launch.bridge_entry import BridgeFault, BridgeFaultKind, Passed
from checker.source.text import Located
from checker.source.yaml import YamlDocument, YamlNode

DIRECTIONS: Mapping[str, Direction] = {
    "BIDIRECTIONAL": Direction.BOTH,
    "GZ_TO_ROS": Direction.TO_ROS,
    "ROS_TO_GZ": Direction.TO_IGN,
}
_TOPICS = ("topic_name", "ros_topic_name", "gz_topic_name")
_TYPES = ("ros_type_name", "gz_type_name")
_OLD = {"ign_topic_name": "gz_topic_name", "ign_type_name": "gz_type_name"}
_SERVICE = ("service_name", "gz_req_type_name", "gz_rep_type_name")
_OTHERS = ("direction", "publisher_queue", "subscriber_queue", "lazy", "qos_profile", "frame_id")
_MARKS = ("gz_topic_name", "gz_type_name", *_OLD)
"""Keys that files of no other bridge have."""
_NEAR = {
    "ros_topic": "ros_topic_name",
    "gz_topic": "gz_topic_name",
    "ign_topic": "gz_topic_name",
    "topic": "topic_name",
    "ros_type": "ros_type_name",
    "gz_type": "gz_type_name",
    "ign_type": "gz_type_name",
    **_OLD,
}

Item = Passed | BridgeFault


def is_bridge_file(document: YamlDocument) -> bool:
    """Whether a file that nothing names is one of a bridge, by its keys."""
    root = document.root
    if root is None:
        return False
    entries = root.items if root.kind == "sequence" else (root,)
    return any(entry.get(key) is not None for entry in entries for key in _MARKS)


def read_bridge_file(document: YamlDocument) -> Iterator[Item]:
    """Yield the topics that a file names, and what is wrong with it."""
    for fault in document.faults:
        if document.root is None:
            yield BridgeFault(
                BridgeFaultKind.UNREADABLE, fault.span, f"the file is no YAML: {fault.message}"
            )
    root = document.root
    if root is None:
        return
    if root.kind != "sequence":
        message = f"the file holds a {root.kind} instead of a sequence: nothing is bridged"
        hint = "; write '- ' in front of each entry" if root.kind == "mapping" else ""
        yield BridgeFault(BridgeFaultKind.NO_SEQUENCE, root.span, message + hint)
        return
    for entry in root.items:
        yield from _entry(entry)


def _entry(entry: YamlNode) -> Iterator[Item]:
    if entry.kind != "mapping":
        message = f"an entry is a {entry.kind} instead of a mapping: it is left out"
        yield BridgeFault(BridgeFaultKind.DROPPED, entry.span, message)
        return
    yield from _unknown_keys(entry)
    if any(entry.get(key) is not None for key in _SERVICE):
        return
    dropped = [*_dropped(entry)]
    yield from dropped
    if not dropped and not any(entry.get(key) is not None for key in _OLD):
        yield from _passed(entry)


def _unknown_keys(entry: YamlNode) -> Iterator[BridgeFault]:
    known = (*_TOPICS, *_TYPES, *_SERVICE, *_OTHERS)
    suggestions = Suggestions(known)
    for key, _ in entry.entries:
        name = str(key.scalar)
        if key.kind == "scalar" and name not in known:
            near = _NEAR.get(name) or suggestions.near(name)
            message = f"the bridge ignores the key {name!r}"
            if near:
                message += f"; expected {near}"
            yield BridgeFault(BridgeFaultKind.UNKNOWN_KEY, key.span, message)


def _dropped(entry: YamlNode) -> Iterator[BridgeFault]:
    """Yield why the bridge leaves an entry out."""

    def fault(node: YamlNode, message: str) -> BridgeFault:
        return BridgeFault(BridgeFaultKind.DROPPED, node.span, f"{message}: the entry is left out")

    both = entry.get("topic_name")
    for key in ("ros_topic_name", "gz_topic_name"):
        if both is not None and _text(both) and _text(entry.get(key)):
            yield fault(both, f"topic_name and {key} exclude each other")
    # Files of older releases spell these with ign: whether they are still read is not known.
    old = any(entry.get(key) is not None for key in _OLD)
    first = entry.entries[0][0] if entry.entries else entry
    for key in _TYPES:
        if not old and not _text(entry.get(key)):
            yield fault(first, f"the entry has no {key}")
    if not old and not any(_text(entry.get(key)) for key in _TOPICS):
        yield fault(first, "the entry names no topic")
    direction = entry.get("direction")
    if direction is not None and _text(direction) not in DIRECTIONS:
        expected = ", ".join(DIRECTIONS)
        yield fault(direction, f"the direction {direction.plain()!r:.60} is none of {expected}")


def _passed(entry: YamlNode) -> Iterator[Passed]:
    ros, gz = (entry.get(key) for key in ("ros_topic_name", "gz_topic_name"))
    both = entry.get("topic_name")
    ros_name = next(filter(_text, (both, ros, gz)), None)
    gz_name = next(filter(_text, (both, gz, ros)), None)
    ros_type, gz_type = (entry.get(key) for key in _TYPES)
    if ros_name is None or gz_name is None or ros_type is None or gz_type is None:
        return
    direction = entry.get("direction")
    yield Passed(
        _located(gz_name),
        _located(ros_name),
        _located(ros_type),
        _located(gz_type),
        DIRECTIONS[_text(direction)] if direction is not None else Direction.BOTH,
        direction.span if direction is not None else gz_name.span,
        overrides_frame=entry.get("frame_id") is not None,
    )


def _text(node: YamlNode | None) -> str:
    return "" if node is None or node.kind != "scalar" or node.scalar is None else str(node.scalar)


def _located(node: YamlNode) -> Located[str]:
    return Located(_text(node), node.span)
