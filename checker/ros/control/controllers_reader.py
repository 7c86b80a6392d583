"""Controllers out of YAML texts: which mapping is one, its joints and its gains.

rosparam puts a mapping's keys together to names: `gurdy: {arm: {type: …}}` configures `/gurdy/arm`;
a key that starts with `/` names an absolute one wherever it stands.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from checker.launch.ros1.graph import resolve_name
from checker.model.ros_parameters import flat_parameters
from checker.ros.control.controllers import Controller, Gain, SimulatorGains
from checker.source.text import Located, Span

if TYPE_CHECKING:
    from checker.source.yaml import YamlNode

MANAGER_PLUGIN = "gazebo_ros_control"
GAINS = ("p", "i", "d")
_OF_NODE = "ros__parameters"
"""The key of a node's parameters, below the key with its name."""
_TYPE = re.compile(r"\w{1,200}/\w{1,200}\Z")
_JOINTS = (
    *("joint", "joints", "left_wheel", "right_wheel"),
    *("left_wheel_names", "right_wheel_names", "front_wheel", "rear_wheel"),
)
_OWN = "pid"
_ANGLE = re.compile(r"(?:rad|deg)\(.{0,100}\)\Z")
"""Texts of YAML that rosparam reads as a number."""


def read_controllers(
    root: YamlNode, namespace: str, loaded_by: Span | None
) -> Iterator[Controller | SimulatorGains]:
    """Yield what a YAML text configures for control.

    Args:
        root: The root node of the text.
        namespace: Absolute namespace under which its keys are set.
        loaded_by: The `<rosparam>` that loads it; None if no launch file does.
    """
    inside = namespace if _is_controller(root) and namespace != "/" else ""
    if inside:
        yield _controller(inside, root.span, root, loaded_by)
    waiting = [(root, namespace, inside)]
    while waiting:
        node, above, inside = waiting.pop()
        below: list[tuple[YamlNode, str, str]] = []
        for key, value in node.entries:
            name = _name(key)
            # Whatever is within a controller is its own, but for absolute names.
            if value.kind != "mapping" or not name or (inside and not name.startswith("/")):
                continue
            full = above if name == _OF_NODE else resolve_name(name, above)
            if full.endswith(f"/{MANAGER_PLUGIN}"):
                yield from _simulator_gains(value)
                continue
            is_one = _is_controller(value)
            if is_one:
                yield _controller(full, key.span, value, loaded_by)
            below.append((value, full, full if is_one else ""))
        waiting += reversed(below)


def _name(key: YamlNode) -> str:
    return str(key.scalar)[:500] if key.kind == "scalar" and key.scalar is not None else ""


def _is_controller(node: YamlNode) -> bool:
    kind = node.get("type")
    if kind is not None:
        return isinstance(kind.scalar, str) and _TYPE.match(kind.scalar) is not None
    return bool(node.get("joint") or node.get("joints")) and bool(
        node.get(_OWN) or node.get("gains")
    )


def _controller(full_name: str, span: Span, node: YamlNode, loaded_by: Span | None) -> Controller:
    written = node.get("type")
    kind = Located(str(written.scalar), written.span) if written is not None else None
    above, _, name = full_name.rpartition("/")
    joints = tuple(_joints(node))
    return Controller(
        name,
        above or "/",
        kind,
        joints,
        _gains(node, joints),
        span,
        loaded_by,
        dict(flat_parameters(node)),
    )


def _joints(node: YamlNode) -> Iterator[Located[str]]:
    for key in _JOINTS:
        named = node.get(key)
        if named is None:
            continue
        for item in named.items if named.kind == "sequence" else (named,):
            if isinstance(item.scalar, str) and "$(" not in item.scalar:
                yield Located(item.scalar, item.span)


def _gains(node: YamlNode, joints: tuple[Located[str], ...]) -> dict[str, Mapping[str, Gain]]:
    """Return gains by joint: below `pid`, `gains/<joint>` or `<joint>/pid`."""
    own, by_joint = node.get(_OWN), node.get("gains")
    gains: dict[str, Mapping[str, Gain]] = {}
    for joint in joints:
        name = joint.value
        part = node.get(name)
        places = (by_joint.get(name) if by_joint else None, part.get(_OWN) if part else None, own)
        stated = next((place for place in places if place is not None), None)
        if stated is not None:
            gains[name] = read_gains(stated)
    return gains


def _simulator_gains(plugin: YamlNode) -> Iterator[SimulatorGains]:
    """Yield the gains below `pid_gains`."""
    gains = plugin.get("pid_gains")
    for key, value in gains.entries if gains is not None else ():
        if value.kind == "mapping":
            yield SimulatorGains(_name(key), read_gains(value), key.span)


def read_gains(node: YamlNode) -> dict[str, Gain]:
    """Return the gains of a mapping, by `p`, `i`, `d`."""
    gains = {}
    for name in GAINS:
        value = node.get(name)
        if value is not None:
            gains[name] = Gain(_number(value), value.span.text[:80], value.span)
    return gains


def _number(node: YamlNode) -> float | None:
    value = node.scalar
    if isinstance(value, str):
        return math.nan if "$(" in value or _ANGLE.match(value) else None
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf
