"""Plugins of the target: libraries, classes, parameters and their usual values."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.resources import table
from checker.editor.completion.item import Completion, CompletionKind, Request
from checker.editor.completion.snippet import escaped
from checker.editor.plugin_facts import Parameter, known_plugins, plugin_facts
from checker.editor.xml_context import Where

_BOOLEANS = ("true", "false")


def plugins(request: Request) -> Iterator[Completion]:
    """Yield libraries and classes, in the attributes of a `<plugin>`."""
    xml = request.xml
    if xml.tag != "plugin" or xml.attribute not in ("filename", "name"):
        yield from _hardware(request)
        return
    other = xml.attributes.get("filename", "") if xml.attribute == "name" else ""
    chosen = plugin_facts(other, "", request.target) if other else None
    if chosen is None:
        class_ = xml.attributes.get("name", "") if xml.attribute == "filename" else ""
        for facts in known_plugins(request.target):
            rank = 0 if class_ and class_ in facts.classes else 5
            offered = (facts.library,) if xml.attribute == "filename" else facts.classes
            for label in offered:
                yield request.item(label, CompletionKind.PLUGIN, detail=facts.title, rank=rank)
        return
    for label in chosen.classes:
        yield request.item(label, CompletionKind.PLUGIN, detail=chosen.library, rank=0)


def _hardware(request: Request) -> Iterator[Completion]:
    """Yield the hardware components of ros2_control that are known by name."""
    if request.xml.where is Where.TEXT and request.xml.tags[-2:] == ("hardware", "plugin"):
        for entry in table("ros2_control_hardware")["plugins"]:
            detail = ", ".join(entry["distros"])
            yield request.item(entry["name"], CompletionKind.PLUGIN, detail=detail, rank=2)


def parameters(request: Request) -> Iterator[Completion]:
    """Yield the parameters of the plugin around the caret."""
    facts = request.plugin_facts
    if request.plugin is None or facts is None:
        return
    below = "".join(f"{tag}/" for tag in request.tags_below_plugin)
    for path, parameter in facts.parameters.items():
        if "@" in path:
            continue
        inner = path.removeprefix(below)
        if "/" in below and "/" in path and inner == path:
            continue
        yield _parameter(request, parameter, inner.split("/")[0], facts.title)


def _parameter(request: Request, known: Parameter, tag: str, title: str) -> Completion:
    is_whole = known.path.endswith(tag)
    place = f"${{1:{escaped(known.usual)}}}" if known.usual and is_whole else "$1"
    text = f"{tag}>{place}</{tag}>" if is_whole else f"{tag}>\n  $0\n</{tag}>"
    innermost = request.xml.innermost
    was_set = innermost is not None and tag in innermost.children
    return request.element(
        tag,
        text,
        kind=CompletionKind.PARAMETER,
        detail=known.words,
        documentation=title,
        rank=7 if was_set else 4,
    )


def parameter_attributes(request: Request) -> Iterator[Completion]:
    """Yield the attributes that a parameter of the plugin around the caret may have."""
    facts = request.plugin_facts
    if request.plugin is None or facts is None:
        return
    for path, parameter in facts.parameters.items():
        name = path.rpartition("@")[2]
        if "@" in path and name not in request.xml.attributes:
            yield request.attribute(name, parameter.usual, parameter.words)


def parameter_values(request: Request) -> Iterator[Completion]:
    """Yield what the parameter at the caret usually states."""
    facts = request.plugin_facts
    if request.plugin is None or facts is None or not request.tags_below_plugin:
        return
    path = "/".join(request.tags_below_plugin)
    known = facts.parameters.get(path) or facts.parameters.get(path.rpartition("/")[2])
    if known is None:
        return
    if known.words.startswith("bool"):
        for word in _BOOLEANS:
            yield request.item(word, CompletionKind.VALUE, rank=2)
    if known.usual and "{" not in known.usual:
        yield request.item(known.usual, CompletionKind.VALUE, detail="often set", rank=3)
