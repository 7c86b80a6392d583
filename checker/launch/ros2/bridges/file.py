"""The YAML file of a bridge between Gazebo and ROS 2: a sequence of topics and services."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

from checker.base.words import Suggestions
from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.bridges.entry import (
    BridgedService,
    BridgeFault,
    BridgeFaultKind,
    Passed,
)
from checker.source.text import Located

if TYPE_CHECKING:
    from checker.source.yaml import YamlDocument, YamlNode

DIRECTIONS: Mapping[str, Direction] = {
    "BIDIRECTIONAL": Direction.BOTH,
    "GZ_TO_ROS": Direction.TO_ROS,
    "ROS_TO_GZ": Direction.TO_IGN,
}
_TOPICS = ("topic_name", "ros_topic_name", "gz_topic_name")
_TYPES = ("ros_type_name", "gz_type_name")
_REQUIRED = {
    "topic_name": "TOPIC",
    "ros_type_name": "PACKAGE/msg/TYPE",
    "gz_type_name": "gz.msgs.TYPE",
}
"""Keys that an entry needs, each with a value to fill in."""
_OLD = {"ign_topic_name": "gz_topic_name", "ign_type_name": "gz_type_name"}
_SERVICE = ("service_name", "gz_req_type_name", "gz_rep_type_name")
_OTHERS = ("direction", "publisher_queue", "subscriber_queue", "lazy", "qos_profile", "frame_id")
_KNOWN = (*_TOPICS, *_TYPES, *_SERVICE, *_OTHERS)
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

Item = Passed | BridgedService | BridgeFault


def is_bridge_file(document: YamlDocument) -> bool:
    """Return whether a file that nothing names is one of a bridge, by its keys."""
    root = document.root
    if root is None:
        return False
    entries = root.items if root.kind == "sequence" else (root,)
    return any(entry.get(key) is not None for entry in entries for key in _MARKS)


def read_bridge_file(document: YamlDocument) -> Iterator[Item]:
    """Yield the topics and services that a file names, and what is wrong with it."""
    for fault in document.faults:
        if document.root is None:
            yield BridgeFault(
                BridgeFaultKind.UNREADABLE,
                fault.span,
                f"the file is not valid YAML, so nothing is bridged: {fault.message}",
            )
    root = document.root
    if root is None:
        return
    if root.kind != "sequence":
        message = f"the file contains a {root.kind}, expected a sequence: nothing is bridged"
        hint = "; write '- ' in front of each entry" if root.kind == "mapping" else ""
        yield BridgeFault(BridgeFaultKind.NO_SEQUENCE, root.span, message + hint)
        return
    for entry in root.items:
        yield from _entry(entry)


def _entry(entry: YamlNode) -> Iterator[Item]:
    if entry.kind != "mapping":
        message = f"the entry is a {entry.kind}, expected a mapping: the bridge ignores it"
        yield BridgeFault(BridgeFaultKind.DROPPED, entry.span, message)
        return
    unknown = [key for key, _ in entry.entries if _text(key) not in _KNOWN]
    free = {*_KNOWN} - {_text(key) for key, _ in entry.entries}
    suggestions = Suggestions(sorted(free))
    meant = {_meant(_text(key), free, suggestions): key for key in unknown}
    dropped: list[BridgeFault] = []
    if any(entry.get(key) is not None for key in _SERVICE):
        yield from _service(entry)
    else:
        dropped += _dropped(entry, meant)
        if not dropped and all(entry.get(key) is None for key in _OLD):
            yield from _passed(entry)
    yield from dropped
    reported = {id(fault.span) for fault in dropped}
    names = {id(key): name for name, key in meant.items()}
    for key in unknown:
        if id(key.span) not in reported:
            name = names.get(id(key))
            hint = f"; expected {name}" if name else ""
            message = f"the bridge ignores the key {_text(key)!r:.60}{hint}"
            yield BridgeFault(BridgeFaultKind.UNKNOWN_KEY, key.span, message, name or "")


def _dropped(entry: YamlNode, misspelt: Mapping[str, YamlNode]) -> Iterator[BridgeFault]:
    """Yield the faults for which the bridge ignores an entry."""
    both = entry.get("topic_name")
    for key in ("ros_topic_name", "gz_topic_name"):
        if both is not None and _text(both) and _text(entry.get(key)):
            message = f"topic_name and {key} are both set, expected one of them"
            yield _ignored(both, message, "; remove topic_name")
    # Files of older releases spell these with ign: whether they are still read is not known.
    if not any(entry.get(key) is not None for key in _OLD):
        yield from _missing(entry, misspelt)
    direction = entry.get("direction")
    if direction is not None and _text(direction) not in DIRECTIONS:
        message = f"direction is {direction.plain()!r:.60}, expected one of {', '.join(DIRECTIONS)}"
        meant = Suggestions(DIRECTIONS).closest(_text(direction))
        yield _ignored(direction, message, meant=meant or "")


def _meant(name: str, free: Collection[str], suggestions: Suggestions) -> str:
    """Return the key that another one is a misspelling of; one that the entry has is not meant."""
    usual = _NEAR.get(name, "")
    return usual if usual in free else suggestions.closest(name) or ""


def _missing(entry: YamlNode, misspelt: Mapping[str, YamlNode]) -> Iterator[BridgeFault]:
    """Yield the required keys that an entry lacks, each with its misspelling if there is one."""
    first = entry.entries[0][0] if entry.entries else entry
    named = any(_text(entry.get(key)) for key in _TOPICS)
    topic = next((key for key in _TOPICS if key in misspelt), _TOPICS[0])
    missing = [key for key in _TYPES if not _text(entry.get(key))]
    for key in missing if named else [topic, *missing]:
        written = misspelt.get(key)
        if written is not None:
            message = f"the key is {_text(written)!r:.60}, expected {key}"
            yield _ignored(written, message, meant=key)
        else:
            yield _ignored(first, f"the entry has no {key}", f"; write '{key}: {_REQUIRED[key]}'")


def _ignored(node: YamlNode, message: str, advice: str = "", meant: str = "") -> BridgeFault:
    text = f"{message}: the bridge ignores the entry{advice}"
    return BridgeFault(BridgeFaultKind.DROPPED, node.span, text, meant)


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


def _service(entry: YamlNode) -> Iterator[BridgedService]:
    """Yield a service; the effect of one without its name or type is not known."""
    name, ros_type = entry.get("service_name"), entry.get("ros_type_name")
    if name is not None and ros_type is not None and _text(ros_type):
        stated = (entry.get(key) for key in _SERVICE[1:])
        gz_types = tuple(_located(node) for node in stated if node is not None)
        yield BridgedService(_located(name), _located(ros_type), gz_types)


def _text(node: YamlNode | None) -> str:
    return "" if node is None or node.kind != "scalar" or node.scalar is None else str(node.scalar)


def _located(node: YamlNode) -> Located[str]:
    return Located(_text(node), node.span)
