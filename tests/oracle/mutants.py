"""SDF files with random faults: elements, attributes and values that somebody got wrong."""

from __future__ import annotations

import copy
import random
from collections.abc import Callable, Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

WORDS = (
    *("nan", "inf", "-1", "0", "1e400", "word", "1,5", "", " ", "1.5x", "0x10", "true", "1 2 3"),
    *("0 0 0", "1 2 3 0.1 0.2 0.3", "world", "__model__", "__root__", "fixed", "prismatic"),
)
TAGS = (
    *("link", "joint", "frame", "model", "pose", "inertial", "mass", "inertia", "axis", "limit"),
    *("sensor", "collision", "visual", "geometry", "box", "parent", "child", "include", "static"),
    *("plugin", "unknown_thing"),
)
ATTRIBUTES = (
    *("name", "type", "relative_to", "attached_to", "frame", "expressed_in", "degrees"),
    *("canonical_link", "placement_frame", "rotation_format", "unknown"),
)
VERSIONS = ("1.5", "1.6", "1.7", "1.8", "1.9", "1.20", "", "x")


def mutant(text: str, seed: int) -> str:
    """Return the text of an SDF file after one to three accidents, the same for the same seed."""
    chance = random.Random(seed)  # noqa: S311
    root = ElementTree.fromstring(text)  # noqa: S314
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        chance.choice(ACCIDENTS)(root, chance)
    return ElementTree.tostring(root, encoding="unicode")


def _inside(root: Element, chance: random.Random) -> tuple[Element, Element] | None:
    """Return an element with its parent; parts that place and tie others come more often."""
    pairs = [(parent, child) for parent in root.iter() for child in parent if parent is not root]
    grave = [pair for pair in pairs if pair[1].tag in TAGS]
    return chance.choice(grave if grave and chance.random() < 0.8 else pairs) if pairs else None


def _drop(root: Element, chance: random.Random) -> None:
    if pair := _inside(root, chance):
        pair[0].remove(pair[1])


def _repeat(root: Element, chance: random.Random) -> None:
    if pair := _inside(root, chance):
        pair[0].append(copy.deepcopy(pair[1]))


def _rename(root: Element, chance: random.Random) -> None:
    if pair := _inside(root, chance):
        pair[1].tag = chance.choice(TAGS) if chance.random() < 0.5 else pair[1].tag[:-1] + "_x"


def _move(root: Element, chance: random.Random) -> None:
    pair, other = _inside(root, chance), _inside(root, chance)
    if pair and other and other[1] not in pair[1].iter():
        pair[0].remove(pair[1])
        other[1].append(pair[1])


def _swap(root: Element, chance: random.Random) -> None:
    if pair := _inside(root, chance):
        chance.shuffle(children := list(pair[0]))
        pair[0][:] = children


def _change_value(root: Element, chance: random.Random) -> None:
    leaves = [each for each in root.iter() if len(each) == 0 and (each.text or "").strip()]
    if not leaves:
        return
    leaf = chance.choice(leaves)
    words = (leaf.text or "").split()
    match chance.randrange(4):
        case 0:
            leaf.text = chance.choice(WORDS)
        case 1:
            words[chance.randrange(len(words))] = chance.choice(WORDS)
            leaf.text = " ".join(words)
        case 2:
            leaf.text = " ".join(words[:-1])
        case _:
            leaf.text = f"{leaf.text} {chance.choice(WORDS)}"


def _take_another_name(root: Element, chance: random.Random) -> None:
    """Let a name, or what names one, be another name of the file."""
    names = [name for each in root.iter() if (name := each.get("name"))]
    places = [
        each for each in root.iter() if "name" in each.attrib or each.tag in ("parent", "child")
    ]
    if not names or not places:
        return
    place, name = chance.choice(places), chance.choice((*names, *WORDS))
    if place.tag in ("parent", "child"):
        place.text = name
    else:
        place.set("name", name)


def _change_attribute(root: Element, chance: random.Random) -> None:
    holders = [each for each in root.iter() if each.attrib and each is not root]
    if not holders:
        return
    holder = chance.choice(holders)
    name = chance.choice(sorted(holder.attrib))
    match chance.randrange(3):
        case 0:
            del holder.attrib[name]
        case 1:
            holder.set(chance.choice(ATTRIBUTES), holder.attrib.pop(name))
        case _:
            holder.set(name, chance.choice(WORDS))


def _add_attribute(root: Element, chance: random.Random) -> None:
    names = [name for each in root.iter() if (name := each.get("name"))]
    if pair := _inside(root, chance):
        pair[1].set(chance.choice(ATTRIBUTES), chance.choice((*names, *WORDS)))


def _change_version(root: Element, chance: random.Random) -> None:
    root.set("version", chance.choice(VERSIONS))


ACCIDENTS: Sequence[Callable[[Element, random.Random], None]] = (
    *(_drop, _repeat, _rename, _move, _swap, _change_value, _change_value, _take_another_name),
    *(_take_another_name, _change_attribute, _add_attribute, _change_version),
)
