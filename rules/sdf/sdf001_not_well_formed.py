"""An XML file that is not well-formed.

A parser stops at the first such error, so the simulator or roslaunch refuses the whole file.
Gazebo's own parser (tinyxml2) accepts a blank line before the XML declaration, `--` inside a
comment, `&` for `&amp;`, `<` for `&lt;` inside a value, control characters and a second root
element. In files that only Gazebo, pluginlib, Nav2 or MoveIt reads these are infos; the other
parsers of ROS refuse them. A script `NAME.launch` that begins with `#!`, and a launch file in
Python of that name, which `ros2 launch` reads as well, are not XML, and are not checked. So are
faults of files in a folder of tests whose name says that a test expects them (`invalid_tree.urdf`),
and of templates: files with `[PLACEHOLDER]` in a folder `templates`. An empty file that no launch
file names is a warning, unless a xacro file that is loaded includes it; so are such an SRDF, and a
fragment of a URDF without `<robot>`, which other programs paste into a robot.

Fix: correct what the message names, at the place of the finding; restore an empty file from an
earlier commit, or delete it where nothing uses it.
Source: Extensible Markup Language 1.0, "well-formed documents"; tinyxml2 9.0, tested; pluginlib,
`ClassLoader::processSingleXMLPluginFile`, which reads with tinyxml2.
"""

import posixpath
import re
from collections.abc import Iterator

from checker.base.files import NotReadable, TooLarge
from checker.finding import Fix, Safety
from checker.launch.ros2.package_files import is_python_launch
from checker.package.inheritance import Found
from checker.package.package import Package
from checker.robots.candidates import including
from checker.robots.unloaded import means_others
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import SourceText, Span
from checker.source.xml_errors import GAZEBO_FILES, is_lenient
from checker.source.xml_positions import XmlFault

_DESCRIPTIONS = (".urdf", ".xacro", ".sdf", ".world")
_FOLDERS = {"template", "templates"}
_BUILDER = "MoveItConfigsBuilder"
"""What reads an SRDF without naming it."""
_PLACEHOLDER = re.compile(r"\[[A-Z][A-Z0-9_]{1,80}\]")


@rule("SDF001", "not-well-formed", Severity.ERROR, Concern.ROBOT)
def check(package: Package) -> Findings:
    """Report files that an XML parser refuses, and those that only a tolerant one reads."""
    model = package.model_path
    paths = list(package.xml_files)
    if isinstance(model, Found) and model.path not in paths:
        paths.append(model.path)
    for path in paths:
        document = package.xml(path)
        if isinstance(document, TooLarge):
            yield unchecked(f"{path} {document.reason}")
        elif isinstance(document, NotReadable):
            yield finding(_top(path), f"{path} {document.reason}")
        elif isinstance(document, XmlFault):
            yield from _refused(path, document, package)
        else:
            yield from _unread_encoding(path, document.source)
            for fault in document.tolerated:
                severity = Severity.INFO if is_lenient(document.source) else None
                yield _finding(path, fault, severity)


def _unread_encoding(path: str, source: SourceText) -> Iterator[Finding]:
    if path.endswith(GAZEBO_FILES) and source.encoding.startswith(("utf-16", "utf-32")):
        yield finding(
            source.whole(), f"{path} is {source.encoding.upper()} text, but Gazebo reads only UTF-8"
        )


def _refused(path: str, fault: XmlFault, package: Package) -> Iterator[Finding]:
    source = fault.span.source
    if path.endswith(".launch") and (source.text.startswith("#!") or is_python_launch(source)):
        return  # a script, or a launch file in Python
    if not fault.span.source.text.strip():
        yield _empty(path, fault, package)
    elif _FOLDERS & set(path.split("/")) and _PLACEHOLDER.search(fault.span.source.text):
        yield finding(fault.span, _message(path, fault), severity=Severity.INFO)
    else:
        is_part = path.endswith(".urdf") and "<robot" not in fault.span.source.text
        is_srdf = path.endswith(".srdf") and not package.workspace.launches_with(_BUILDER)
        minor = (is_part or is_srdf) and not _is_used(path, package)
        yield _finding(path, fault, Severity.WARNING if minor else None)


def _empty(path: str, fault: XmlFault, package: Package) -> Finding:
    """Return the finding of an empty file: a warning where nothing needs its content."""
    includer = _loaded_including(path, package)
    if includer:
        return finding(fault.span, f"{path} is empty, and xacro stops: {includer} includes it")
    is_used = _is_used(path, package)
    # Accepted packages keep an empty urdf/model.urdf beside the xacro file that they use.
    if is_used and not path.startswith("urdf/"):
        return _finding(path, fault)
    is_left = not is_used and path.endswith(_DESCRIPTIONS)
    advice = ", and no launch file loads it: restore it, or delete it" if is_left else ""
    return finding(fault.span, f"{path} is empty{advice}", severity=Severity.WARNING)


def _loaded_including(path: str, package: Package, levels: int = 5) -> str:
    """Return the file that includes a file and that a launch file loads, if any, itself or not."""
    same = _of_same_name(path, package)
    for source in including(package, path) if levels else ():
        if means_others(source.text, posixpath.basename(path), same):
            continue
        launched = package.workspace.launches_file(posixpath.basename(source.file))
        if launched or _loaded_including(source.file, package, levels - 1):
            return source.file
    return ""


def _of_same_name(path: str, package: Package) -> list[str]:
    return [it for it in package.index.ending(posixpath.basename(path)) if it != path]


def _is_used(path: str, package: Package) -> bool:
    """Return whether a file is the model or manifest of a package, or a launch file names it."""
    name = posixpath.basename(path)
    model = package.model_path
    if name == "package.xml" or (isinstance(model, Found) and model.path == path):
        return not package.only
    same = _of_same_name(path, package)
    texts = package.workspace.launch_texts.values()
    return not all(means_others(text, name, same) for text in texts)


def _finding(path: str, fault: XmlFault, severity: Severity | None = None) -> Finding:
    fix = Fix(Safety.UNSAFE, (fault.edit,)) if fault.edit else None
    return finding(fault.span, _message(path, fault), severity=severity, fix=fix)


def _message(path: str, fault: XmlFault) -> str:
    hint = f": {fault.hint}" if fault.hint else ""
    breaks = "; colcon and catkin cannot read the package" if path == "package.xml" else ""
    return f"{path} is not well-formed: {fault.message}{hint}{breaks}"


def _top(path: str) -> Span:
    return SourceText(path, "").whole()


GOOD = [
    {"test/drive.launch": "#! /usr/bin/env python3\nimport launch\n"},
    {"launch/arm.launch": "import launch\n\ndef generate_launch_description():\n    pass\n"},
    {"worlds/example.sdf": "<sdf version='1.6'><world name='w'/></sdf>"},
    {"rviz/rviz.config": "Panels:\n  - Class: rviz_common/Displays\n"},
]
BAD = [
    {
        "worlds/example.sdf": """<sdf version="1.6">
  <world name="w">
    <mass>3.6/mass>
  </world>  <!-- ^ SDF001 -->
</sdf>
"""
    },
    {"@urdf": True, "config/arm.srdf": '<robot name="arm">\n</robt><!-- ^ SDF001 -->\n'},
    {"worlds/example.sdf": "<sdf version='1.6'>\n<world>\n</wrld><!-- ^ SDF001 -->\n</sdf>\n"},
    {
        "launch/view.launch": """<launch>
  <node name="rviz" pkg="rviz" type="rviz">
</launch>  <!-- ^ SDF001 -->
"""
    },
    {
        "worlds/example.sdf": """<sdf version="1.6">
  <world name="w">
    <gravity>0 0 -9.8
  </world>  <!-- ^ SDF001 -->
</sdf>
"""
    },
    {
        "@urdf": True,
        "urdf/a.urdf.xacro": """<robot name="a">
  <xacro:property name="b" value="1"/>  <!-- ^ SDF001 -->
</robot>
""",
    },
    {
        "launch/description.launch": """<launch>
  <arg name="name/>
  <param name="x"/>  <!-- ^ SDF001 -->
</launch>
"""
    },
    {"model.config": "\n<?xml version='1.0'?><!-- ^ SDF001 -->\n<model/>\n"},
    {"worlds/example.sdf": "<sdf><!-- & --><world name='a & b'/></sdf><!-- ^ SDF001 -->"},
    {"worlds/example.sdf": "<sdf version='1.6'/>\n<sdf version='1.7'/><!-- ^ SDF001 -->\n"},
    {
        "@urdf": True,
        "urdf/a.urdf": "<!-- a -->\n<?xml version='1.0'?><!-- ^ SDF001 -->\n<robot/>\n",
    },
    {"plugins.xml": "<library path='a'><class type='a<b>'/></library><!-- ^ SDF001 -->"},
    {"templates/a.launch": "<launch><arg [NAME]/></launch><!-- ^ SDF001 -->"},
    {"launch/a.launch": "<launch><arg name='a<b>'/></launch><!-- ^ SDF001 -->"},
    {"urdf/model.urdf": "", "@reported": ["urdf/model.urdf:1"]},
]
