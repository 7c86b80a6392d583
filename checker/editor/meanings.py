"""Meanings and allowed words of elements and attributes, from the table `xml_meanings.json`."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from checker.base.record import Record
from checker.base.resources import table
from checker.formats.urdf.specification import AttributeSpec
from checker.model.sensing.kind import sensor_types
from checker.ros.ros2_control.hardware import STANDARD_INTERFACES, TYPES
from checker.rule import Context

_BOOLEANS = ("true", "false")


class Meaning(Record):
    """Meaning of an element or attribute.

    Attributes:
        unit: Empty for none.
        words: A sentence; empty if nothing is known.
    """

    unit: str = ""
    words: str = ""


def meaning_of(language: str, tags: Sequence[str], attribute: str = "") -> Meaning:
    """Return what an element or an attribute of it means.

    Args:
        language: `sdf` or `urdf`.
        tags: The tags of the elements around it and its own tag.
        attribute: Its name; empty for the element.
    """
    known = table("xml_meanings")[language]
    keys = [f"{tags[-1]}/@{attribute}"] if attribute else ["/".join(tags[-2:]), tags[-1]]
    entry = next((known[key] for key in keys if key in known), ("", ""))
    return Meaning(*entry)


def words_of_sdf(tags: Sequence[str], attribute: str, kind: str, target: Context) -> list[str]:
    """Return the words among which an element or attribute of SDF chooses; none if any may be.

    Args:
        tags: The tags of the elements around it and its own tag.
        attribute: Its name; empty for a text.
        kind: Its type in the schema.
        target: The target whose sensors count.
    """
    if kind == "bool":
        return list(_BOOLEANS)
    known = table("sdf_words")
    if attribute == "type" and tags[-1] == "joint":
        return list(table("joint_types")["types"]["sdf"])
    if attribute == "type" and tags[-1] == "sensor":
        types = sensor_types(target.release)
        return sorted(types.known - types.lost)
    if attribute:
        return list(known["attributes"].get(f"{tags[-1]}/{attribute}", ()))
    if tuple(tags[-2:]) == ("image", "format"):
        return list(table("camera_formats")["names"])
    return list(known["elements"].get("/".join(tags[-2:]), ()))


def words_of_urdf(path: str, attribute: str) -> list[str]:
    """Return the words among which an attribute of URDF chooses; none if any may be."""
    if (path, attribute) == ("joint", "type"):
        return list(table("joint_types")["types"]["urdf"])
    if (path, attribute) == ("ros2_control", "type"):
        return list(TYPES)
    if attribute == "name" and path.endswith("_interface"):
        return list(STANDARD_INTERFACES)
    return []


@cache
def urdf_attributes(path: str) -> dict[str, AttributeSpec]:
    """Return the attributes of an element of URDF.

    Args:
        path: The path below `<robot>`. In a macro it may begin anywhere: then the last tag alone
            counts.
    """
    path = _table_path(path)
    beside = table("xml_meanings")["beside"].get(path, {"attributes": ()})
    known = {name: AttributeSpec() for name in beside["attributes"]}
    specified = table("urdf_spec")["elements"].get(path, {})
    return known | {name: AttributeSpec(**entry) for name, entry in specified.items()}


@cache
def urdf_children(path: str) -> tuple[str, ...]:
    """Return the elements that may be below one of URDF, those that have to first.

    Args:
        path: The path, as in `urdf_attributes`; `robot` for the robot itself.
    """
    path, spec = _table_path(path), table("urdf_spec")
    needed = list(spec["needs"].get(path, ()))
    if path in ("link/visual/geometry", "link/collision/geometry"):
        needed += spec["shapes"]
    if path == "joint":
        needed += ["parent", "child"]
    start = f"{path}/"
    below = [it.removeprefix(start).split("/")[0] for it in _paths() if it.startswith(start)]
    beside = table("xml_meanings")["beside"].get(path, {"children": ()})["children"]
    return tuple(dict.fromkeys([*needed, *beside, *below]))


def _table_path(path: str) -> str:
    """Return the path of the tables that a path in a macro represents, else itself."""
    known = _paths()
    if path in known:
        return path
    end = f"/{path.rpartition('/')[2]}"
    return next((it for it in known if it.endswith(end)), path)


@cache
def _paths() -> tuple[str, ...]:
    """Return the paths of all elements that the tables know, those around others too."""
    named = [it for it in table("xml_meanings")["beside"] if it != "_"]
    paths = [*table("urdf_spec")["elements"], *named]
    steps = (path.split("/") for path in paths)
    return tuple(
        dict.fromkeys("/".join(step[:end]) for step in steps for end in range(1, len(step) + 1))
    )
