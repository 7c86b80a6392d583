"""Names in one file, by the kind of the file."""

from __future__ import annotations

from checker.base.files import NotReadable
from checker.editor.name_kinds import is_srdf
from checker.editor.names.mention import FileNames
from checker.editor.names.readers.launch_names import launch_names
from checker.editor.names.readers.python_names import PythonNames
from checker.editor.names.readers.robot_names import RobotNames
from checker.editor.names.readers.ruby_names import ruby_names, ruby_values
from checker.editor.names.readers.sdf_names import SdfNames
from checker.editor.names.readers.xacro_names import XacroNames
from checker.editor.names.readers.yaml_names import yaml_names
from checker.editor.xacro_names import PREFIX
from checker.launch.ros2.python.launch_file import parse_source
from checker.package.package import Package
from checker.source.text import SourceText
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault
from checker.source.yaml import read_yaml

XML = (".sdf", ".world", ".urdf", ".xacro", ".srdf", ".launch", ".xml", ".gazebo")
YAML = (".yaml", ".yml", ".rviz")
SUFFIXES = (*XML, *YAML, ".rb", ".py")
SIZE_LIMIT = 3_000_000
"""Bytes; a larger file is not read."""


def holds_names(path: str, size: int) -> bool:
    """Return whether a file of a package may contain names."""
    name = path.lower()
    if size > SIZE_LIMIT or not name.endswith(SUFFIXES) or name.endswith("package.xml"):
        return False
    is_launch = name.endswith((".launch.py", "_launch.py")) or "launch/" in name
    return is_launch or not name.endswith(".py")


def file_names(package: Package, path: str, source: SourceText) -> FileNames:
    """Return the names of a file."""
    lower = path.lower()
    if lower.endswith(YAML):
        document = read_yaml(source)
        if document.root is None:
            fault = document.faults[0].message if document.faults else ""
            return FileNames(source, "yaml", fault=fault)
        return FileNames(source, "yaml", tuple(yaml_names(document.root)))
    if lower.endswith(".rb"):
        return FileNames(source, "ruby", tuple(ruby_names(source)), values=ruby_values(source))
    if lower.endswith(".py"):
        return _python(source)
    return _xml(package.xml(path), source)


def _python(source: SourceText) -> FileNames:
    tree = parse_source(source)
    if isinstance(tree, str):
        return FileNames(source, "python", fault=tree)
    found = PythonNames(source, tree)
    return FileNames(source, "python", tuple(found.names), values=frozenset(found.values))


def _xml(document: XmlDocument | XmlFault | NotReadable, source: SourceText) -> FileNames:
    """Return the names of an XML file by its outermost element."""
    if isinstance(document, XmlFault):
        return FileNames(source, "xml", fault=document.message)
    if isinstance(document, NotReadable):
        return FileNames(source, "xml", fault=document.reason)
    tag = document.root.tag
    if tag == "launch":
        return FileNames(source, "launch", tuple(launch_names(document)))
    if tag not in ("sdf", "robot", "gazebo", "model", "world"):
        return FileNames(source, "other")
    sdf = None if tag == "robot" else SdfNames(document)
    robot = "srdf" if is_srdf(source.file) else "robot"
    names = sdf.names if sdf else RobotNames(document).names
    included = sdf.included if sdf else []
    values: frozenset[str] = frozenset()
    parameters: frozenset[str] = frozenset()
    if PREFIX in source.text or "${" in source.text or "$(" in source.text:
        xacro = XacroNames(document)
        names, included = [*names, *xacro.names], [*included, *xacro.included]
        values, parameters = frozenset(xacro.values), frozenset(xacro.parameters)
    return FileNames(
        source,
        "sdf" if sdf else robot,
        tuple(names),
        tuple(included),
        values,
        parameters,
        sdf.model if sdf else document.root.get("name") or "",
    )
