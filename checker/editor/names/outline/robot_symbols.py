"""Outlines of robots and worlds: SDF, URDF and xacro."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from checker.editor.names.outline.link_tree import JointSymbol, link_tree
from checker.editor.names.outline.symbol import Symbol, SymbolKind, element_symbol
from checker.source.xml import Element

_MACRO = "xacro:macro"
_OF_XACRO = {"xacro:property": SymbolKind.PROPERTY, "xacro:arg": SymbolKind.ARGUMENT}
_CLOSED = frozenset({"plugin", "ros2_control", "transmission", "sensor", "link", "joint"})
"""Elements in which nothing of an outline is looked for."""


def sdf_symbols(root: Element) -> tuple[Symbol, ...]:
    """Return the outline of an SDF file: worlds with their models, models with their links."""
    return tuple(_in_sdf(root))


def _in_sdf(element: Element) -> Iterator[Symbol]:
    for child in element.children:
        if child.tag == "world":
            parts = tuple(_sorted([*_in_sdf(child), *_plugins(child)]))
            yield element_symbol(child, SymbolKind.WORLD, parts)
        elif child.tag == "model":
            yield _model(child)
        elif child.tag == "include":
            yield _include(child)
        elif child.tag.startswith("xacro:"):
            yield from _of_xacro(child)


def _model(model: Element) -> Symbol:
    links = [_with_sensors(link, SymbolKind.LINK) for link in model.all("link")]
    joints = [_sdf_joint(joint) for joint in model.all("joint")]
    frames = [element_symbol(frame, SymbolKind.FRAME) for frame in model.all("frame")]
    parts = [*link_tree(links, joints), *frames, *_in_sdf(model), *_plugins(model)]
    return element_symbol(model, SymbolKind.MODEL, tuple(_sorted(parts)))


def _sdf_joint(joint: Element) -> JointSymbol:
    symbol = _with_sensors(joint, SymbolKind.JOINT, joint.get("type") or "")
    ends = (joint.child(end) for end in ("parent", "child"))
    parent, child = (end.value if end is not None else "" for end in ends)
    return JointSymbol(symbol, parent, child)


def _with_sensors(element: Element, kind: SymbolKind, detail: str = "") -> Symbol:
    sensors = tuple(_sensor(it) for it in element.all("sensor"))
    return element_symbol(element, kind, sensors, detail)


def _sensor(sensor: Element) -> Symbol:
    plugins = tuple(_plugins(sensor))
    return element_symbol(sensor, SymbolKind.SENSOR, plugins, sensor.get("type") or "")


def _plugins(element: Element) -> Iterator[Symbol]:
    for plugin in element.all("plugin"):
        symbol = element_symbol(plugin, SymbolKind.PLUGIN, (), plugin.get("filename") or "")
        yield replace(symbol, name=symbol.name.rpartition("::")[2] or symbol.name)


def _include(include: Element) -> Symbol:
    name, uri = include.child("name"), include.child("uri")
    detail = uri.value if uri is not None else ""
    symbol = element_symbol(include, SymbolKind.INCLUDE, tuple(_plugins(include)), detail)
    shown = name if name is not None and name.value else uri
    if shown is None or not shown.value:
        return symbol
    place = shown.text_span
    last = shown.value.rstrip("/").rpartition("/")[2] if shown is uri else shown.value
    return replace(symbol, name=last, name_start=place.start, name_end=place.end)


def urdf_symbols(root: Element) -> tuple[Symbol, ...]:
    """Return the outline of a URDF or xacro file: its links as a tree, and what xacro knows."""
    return (element_symbol(root, SymbolKind.ROBOT, _in_robot(root)),)


def _in_robot(element: Element) -> tuple[Symbol, ...]:
    """Return the symbols of a robot, or of a macro."""
    found = [*_reached(element)]
    sensors: dict[str, list[Symbol]] = defaultdict(list)
    others: list[Symbol] = []
    parts = {"link": SymbolKind.LINK, "joint": SymbolKind.JOINT}
    for it in found:
        if it.tag == "gazebo":
            others += _plugins(it)
            sensors[it.get("reference") or ""] += [_sensor(sensor) for sensor in it.all("sensor")]
        elif it.tag == "sensor" and it.parent is not None and it.parent.tag != "gazebo":
            others.append(_sensor(it))
        elif it.tag not in parts:
            others += _of_xacro(it)
    links, joints = [], []
    for it in found:
        if it.tag in parts:
            name = it.get("name") or ""
            detail = it.get("type") or ""
            symbol = element_symbol(it, parts[it.tag], tuple(sensors.pop(name, ())), detail)
            if it.tag == "link":
                links.append(symbol)
            else:
                joints.append(JointSymbol(symbol, _end(it, "parent"), _end(it, "child")))
    others += [sensor for left in sensors.values() for sensor in left]
    return tuple(_sorted([*link_tree(links, joints), *others]))


def _reached(element: Element) -> Iterator[Element]:
    """Yield the elements that belong to a robot or macro itself, also below conditions."""
    waiting = [*reversed(element.children)]
    while waiting:
        child = waiting.pop()
        yield child
        if child.tag not in _CLOSED and child.tag != _MACRO:
            waiting += reversed(child.children)


def _end(joint: Element, tag: str) -> str:
    end = joint.child(tag)
    return (end.get("link") or "") if end is not None else ""


def _of_xacro(element: Element) -> Iterator[Symbol]:
    if element.tag == _MACRO:
        detail = " ".join((element.get("params") or "").split())
        yield element_symbol(element, SymbolKind.MACRO, _in_robot(element), detail)
    elif element.tag == "xacro:include":
        yield element_symbol(element, SymbolKind.INCLUDE, attribute="filename")
    elif (kind := _OF_XACRO.get(element.tag)) is not None:
        detail = element.get("value") or element.get("default") or ""
        yield element_symbol(element, kind, (), detail)


def _sorted(symbols: Iterable[Symbol]) -> list[Symbol]:
    return sorted(symbols, key=lambda it: it.start)
