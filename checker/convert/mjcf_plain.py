"""The document of an exported robot, cleared of what its scene has for the trial alone."""

from __future__ import annotations

import math

from lxml import etree

from checker.convert.mjcf_files import COLLISIONS, VISUALS, add_studio
from checker.convert.mjcf_parts import section
from checker.convert.xml_writer import document_text, number, numbers
from checker.physics.trial.mjcf.scene import GROUND

_TURNS = 4 * math.pi
"""rad beyond which a limit means that the joint turns without end."""


def scene_text(file: str) -> str:
    """Return a scene with ground and light around the robot of a file."""
    root = etree.Element("mujoco", model=f"{file.rpartition('.')[0]} on the ground")
    etree.SubElement(root, "include", file=file)
    etree.SubElement(root, "asset")
    world = etree.SubElement(root, "worldbody")
    etree.SubElement(world, "geom", name=GROUND, type="plane", size="0 0 1")
    add_studio(root)
    return document_text(root)


def without_trial(root: etree._Element, height: float) -> list[str]:
    """Replace what is for the trial alone: solver, and shapes that touch only the ground.

    Args:
        root: The scene of a trial.
        height: z of the robot's frame in it, metres; it becomes 0.

    Returns:
        Names of the joints whose range is left out, as they turn without end.
    """
    compiler, option = section(root, "compiler"), section(root, "option")
    compiler.attrib.clear()
    compiler.set("angle", "radian")
    option.set("integrator", "implicitfast")
    root.remove(section(root, "size"))
    default = etree.Element("default")
    for name, attributes in {
        "visual": {"group": VISUALS, "contype": "0", "conaffinity": "0"},
        "collision": {"group": COLLISIONS},
    }.items():
        of_class = etree.SubElement(default, "default", {"class": name})
        etree.SubElement(of_class, "geom", attributes, mass="0")
    option.addnext(default)
    raise_by(root, -height)
    for geom in section(root, "worldbody").iter("geom"):
        _set_class(geom)
    endless = []
    for joint in root.iter("joint"):
        joint.attrib.pop("limited", "")
        bounds = [abs(float(bound)) for bound in (joint.get("range") or "0").split()]
        if joint.get("type") == "hinge" and max(bounds) > _TURNS:
            del joint.attrib["range"]
            endless.append(joint.get("name") or "")
    return endless


def _set_class(geom: etree._Element) -> None:
    if geom.get("name") == GROUND:
        for name in ("contype", "conaffinity", "priority"):
            geom.attrib.pop(name)
        return
    seen = geom.get("contype") == geom.get("conaffinity") == "0"
    for name in ("name", "group", "contype", "conaffinity", "condim", "priority"):
        geom.attrib.pop(name, "")
    if friction := geom.get("friction"):
        geom.set("friction", number(float(friction.split()[0])))
    geom.set("class", "visual" if seen else "collision")


def raise_by(root: etree._Element, height: float) -> None:
    """Move the robot up, by metres."""
    for body in section(root, "worldbody").iterchildren("body"):
        x, y, z = map(float, (body.get("pos") or "").split())
        body.set("pos", numbers((x, y, z + height)))


def finish(root: etree._Element) -> None:
    """Remove the ground, default values and empty sections; visuals get their class."""
    world = section(root, "worldbody")
    world.remove(section(world, f"geom[@name='{GROUND}']"))
    for geom in world.iter("geom"):
        if geom.get("class") is None:
            _set_class(geom)
    for part in world.iter("*"):
        _shorten(part)
    for empty in [it for it in root if not len(it) and not it.attrib]:
        root.remove(empty)


def _shorten(part: etree._Element) -> None:
    """Write the numbers of a pose without what rounding left, and none that is the default."""
    for name in ("pos", "quat", "axis"):
        if (stated := part.get(name)) is not None:
            part.set(name, numbers(map(float, stated.split())))
    for name, default in (("pos", "0 0 0"), ("quat", "1 0 0 0")):
        if part.get(name) == default and part.tag != "inertial":
            del part.attrib[name]


def is_fixed(body: etree._Element) -> bool:
    """Return whether no joint is between a body and the world."""
    at: etree._Element | None = body
    while at is not None and at.tag == "body":
        if at.find("joint") is not None or at.find("freejoint") is not None:
            return False
        at = at.getparent()
    return body.tag == "body"
