"""Compiles models in MuJoCo and simulates them: the module behind `checker.base.child_process`."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from checker.base.sandbox.files import NO_FILES, Files
from checker.physics.compiled.first_second import first_second
from checker.physics.compiled.parts import model_parts, stated_line
from checker.physics.compiled.rangefinders import own_hits

_LEAVES_OUT = re.compile(
    r"unrecognized attribute|bad format in attribute|invalid keyword|unknown default class"
    r"|not found in geom|does not have enough data|has too much data|unknown transmission"
)
"""Messages about an attribute, or about what only an actuator needs."""
_QUOTED = re.compile(r"'([^']*)'")
_ATTRIBUTE = re.compile(r' ([\w:.-]+)="([^"]*)"')
_LEAF = re.compile(r"<(\w+)[^>]*></\1>")
_MAY_GO = ("class", "childclass", "material", "texture")
"""Attributes that name something and that a model can do without."""
_LEAVES = (
    *("general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder"),
    *("muscle", "adhesion", "exclude", "pair"),
)
"""Elements to which no other one refers."""
_REFUSALS_LIMIT = 20


def answer(request: bytes, files: Files = NO_FILES) -> bytes:
    """Compile models.

    Args:
        request: JSON; `items` with `text`, `attached` and `files` each, as `MujocoText` has them.
        files: The content of the files, by their paths on disk.

    Returns:
        JSON of what MuJoCo made of each; see `checker.physics.compiled.model`.
    """
    return json.dumps([_compiled(item, files) for item in json.loads(request)["items"]]).encode()


def _compiled(item: Mapping[str, Any], files: Files) -> dict[str, Any]:
    import mujoco

    attached = {name: text.encode() for name, text in item["attached"].items()}
    assets = dict[str, bytes]()
    for name, place in item["files"].items():
        content = files.read(place)
        if isinstance(content, bytes):
            assets[name] = content
    text, refusals = item["text"], list[dict[str, Any]]()
    while len(refusals) < _REFUSALS_LIMIT:
        try:
            spec = mujoco.MjSpec.from_string(text, include=attached | assets, assets=assets)
            model = spec.compile()
        except (ValueError, mujoco.FatalError) as refusal:
            refused = str(refusal)
            refusals.append({"text": refused, "line": stated_line(refused)})
            mended = _without(text, refused, refusals[-1]["line"])
            if mended == text:
                break
            text = mended
        else:
            lacks = {"lacks_meshes": _lacks(spec, item["absent"])}
            return {
                "refusals": refusals,
                **lacks,
                **model_parts(spec, model),
                **first_second(model),
                "own_hits": own_hits(spec, model, item["absent"]),
            }
    return {"refusals": refusals}


def _without(text: str, refused: str, number: int) -> str:
    """Return the text without what MuJoCo refuses on a line, so that more can be judged.

    An attribute that its message names, or whose value it names, is left out, or else the whole
    element if nothing else refers to it. The same text is returned if that is not possible.
    """
    lines = text.split("\n")
    if not (0 < number <= len(lines) and _LEAVES_OUT.search(refused)):
        return text
    line, named = lines[number - 1], _QUOTED.findall(refused)
    stated = _ATTRIBUTE.findall(line)
    for name, value in stated:
        if name in named or (name in _MAY_GO and value in named):
            lines[number - 1] = line.replace(f' {name}="{value}"', "", 1)
            return "\n".join(lines)
    leaf = _LEAF.match(line)
    if leaf is not None and leaf[1] in _LEAVES:
        lines[number - 1] = line[leaf.end() :]
        return "\n".join(lines)
    return text


def _lacks(spec: Any, absent: list[str]) -> bool:
    """Return whether a shape of an absent mesh or height field collides or has mass."""
    names = {*absent}
    return any(
        (geom.meshname or geom.hfieldname) in names
        and (
            geom.contype
            or geom.conaffinity
            or not (geom.parent.explicitinertial or geom.mass == 0 or geom.density == 0)
        )
        for geom in spec.geoms
    )
