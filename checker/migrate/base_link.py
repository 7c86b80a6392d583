"""The link that carries all others gets the name that SubT's tools expect: `base_link`."""

from __future__ import annotations

from lxml import etree

from checker.convert.conversion import Conversion
from checker.convert.writing import numbers
from checker.migrate.xml_parts import put
from checker.model.sdf.pose_numbers import transform_of
from checker.model.transform import Transform
from checker.model.values import parse_number

BASE = "base_link"
_POSED = ("inertial", "collision", "visual", "sensor", "light")
_ENDS = ("parent", "child")
_NUMBERS = 6


def call_base_link(conversion: Conversion) -> list[str]:
    """Rename the root of a model that has no `base_link`; return what was done.

    Where the source has a link of that name, merged into the root, the root takes its frame, so
    that the name means the same place as before.
    """
    links = {each.get("name") or "": each for each in conversion.tree.iter("link")}
    joints = list(conversion.tree.iter("joint"))
    below = {joint.findtext("child", "").strip() for joint in joints}
    roots = [name for name in links if name not in below]
    if BASE in links or len(roots) != 1:
        return []
    (old,) = roots
    merged = conversion.lumped.get(BASE)
    if merged is not None and merged.link == old:
        _shift(links[old], merged.pose)
    links[old].set("name", BASE)
    for end in (end for joint in joints for end in joint if end.tag in _ENDS):
        if (end.text or "").strip() == old:
            end.text = BASE
    return [f"link {old!r}, which carries the others, is called {BASE!r}"]


def _shift(link: etree._Element, new_frame: Transform) -> None:
    """Move a link's frame, and leave its parts where they are.

    Args:
        link: Of the model.
        new_frame: Its new frame in its old one.
    """
    _pose(link, _pose_of(link) @ new_frame)
    for part in link:
        if part.tag in _POSED:
            _pose(part, new_frame.inverse @ _pose_of(part))


def _pose_of(element: etree._Element) -> Transform:
    pose = element.find("pose")
    words = (pose.text or "").split() if pose is not None else []
    if pose is None or len(words) != _NUMBERS:
        return Transform()
    return transform_of(pose, (parse_number(word) or 0.0 for word in words))


def _pose(element: etree._Element, pose: Transform) -> None:
    fresh = element.find("pose") is None
    written = put(element, "pose", f"{numbers(pose.translation)} {numbers(pose.rpy)}")
    written.attrib.pop("degrees", "")
    if fresh:
        element.insert(0, written)
