"""The URDF for RViz as a xacro file, whose argument `name` goes in front of every link."""

from __future__ import annotations

from collections.abc import Callable

from lxml import etree

from checker.convert.sdf_to_urdf import urdf_of
from checker.model.robot import Robot

XACRO = "http://www.ros.org/wiki/xacro"
_MARK = "\ue000"
"""Stands for the argument until all else is escaped; of no use to robots, and legal in XML."""
_NAME = "${name}/"


def xacro_of(robot: Robot, *, name: str, mesh_uri: Callable[[str], str]) -> etree._Element:
    """Return the `<robot>` of a xacro file with `${name}/` in front of every link.

    Args:
        robot: From SDF.
        name: Of the package; the default of the argument `name`.
        mesh_uri: Gives the URI to write for a mesh or texture, as written in the robot's file.
    """
    urdf = urdf_of(robot, mesh_uri=mesh_uri, prefix=_MARK)
    root = etree.Element("robot", name=name, nsmap={"xacro": XACRO})
    etree.SubElement(root, f"{{{XACRO}}}arg", {"name": "name", "default": name})
    etree.SubElement(root, f"{{{XACRO}}}property", {"name": "name", "value": "$(arg name)"})
    for node in urdf.iter(etree.Element):
        for key, value in node.attrib.items():
            node.set(key, _escaped(str(value)).replace(_MARK, _NAME))
    root.extend(list(urdf))
    return root


def _escaped(value: str) -> str:
    """Return a value that xacro leaves as it is."""
    return value.replace("${", "$${").replace("$(", "$$(")
