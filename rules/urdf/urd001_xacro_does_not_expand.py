"""A URDF or xacro file that does not produce a robot.

The launch file that loads it ends with an error, or loads a robot whose names still contain xacro
expressions. Files that contain only macros are not reported, nor files that only need an argument
at launch: one without a default, or with an empty default that makes the expansion fail. A part of
a robot that no file includes at present is an info: it has no link, or it lacks a macro or property
of another file, and launch files load another robot or its joints lead to links of others.
Further values that the file or a launch file names for an argument are tried too. Braces without a
dollar sign in a `<transmission>` are an info in ROS 2, which does not read it; in a `<gazebo>` that
only changes how a link looks they are a warning. A tag of xacro in a file that nothing expands is a
warning: readers of URDF ignore it. Such a file was made by xacro, or launch files of ROS 1 load its
text, with `cat` or `textfile`. An expression in a plain file that no launch file loads is a warning
too.

Fix: correct the error that the message names; to reproduce it, run `xacro FILE name:=x`. Where the
file is loaded without xacro, load it with xacro instead of `cat`, or write the values. Include a
part that is included nowhere, or delete it. URD014 reports what xacro refuses from ROS Noetic on.
Source: xacro, "unknown macro name", "Undefined substitution argument"; ros/xacro#282.
"""

import re
from collections.abc import Iterator

from msgspec.structs import replace

from checker.finding import Fix
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.extensions import simulates
from checker.formats.xacro.bare_tags import TAGS
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.formats.xacro.names import BRACES
from checker.robots.urdf_files import UrdfFiles
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    Unchecked,
    finding,
    lessened,
    replace_text,
    rule,
    unchecked,
)
from checker.source.xml import Element

_EXPRESSION = re.compile(r"\$\{[^}]{0,500}\}|\$\((?:arg|find|eval)\s[^)]{0,200}\)")
_PRIVATE = re.compile(r"double underscore:\s{0,8}(__\w{1,100})")
_LOADED = "the file is loaded without xacro"
_FOREIGN = ("gazebo",)
"""Elements with content that URDF does not define, so braces may mean anything."""


@rule("URD001", "xacro-does-not-expand", Severity.ERROR, Concern.ROBOT)
def check(files: UrdfFiles, context: Context) -> Findings:
    """Report files that xacro refuses, and expressions that it leaves."""
    for reason in files.unread:
        yield unchecked(reason)
    for reason in files.unused:
        yield Unchecked(reason, Severity.WARNING if files.descriptions else None)
    for fault in files.faults:
        if fault.kind is XacroFaultKind.MALFORMED:  # SDF001 says so.
            yield unchecked(f"{fault.file} is not well-formed")
        elif fault.kind is XacroFaultKind.LIMIT:
            yield unchecked(f"{fault.file} is not expanded: {fault.message}")
        else:
            yield _refused(fault)
    for description in files.descriptions:
        for found in _left_behind(description, context):
            yield _of_unloaded(found, description.unloaded) if description.unloaded else found


def _of_unloaded(found: Finding, clause: str) -> Finding:
    stated = replace(found, message=found.message.replace(_LOADED, "xacro alone does so"))
    return stated if found.severity is Severity.INFO else lessened(stated, clause)


def _refused(fault: XacroFault) -> Finding:
    if fault.kind is XacroFaultKind.EMPTY:
        return finding(fault, f"{fault.file} is empty, expected a robot")
    if fault.kind is XacroFaultKind.PART:
        return finding(
            fault,
            f"{fault.file} is included nowhere, and is no robot by itself: {fault.message}",
            severity=Severity.INFO,
            key="part",
        )
    hint = f": {fault.hint}" if fault.hint else ""
    if private := _PRIVATE.search(fault.message):
        hint = (
            f": rename {private[1]}, xacro refuses names that begin with __ from 1.13.13 (Melodic) "
            "and 1.14.9 (Noetic) on"
        )
    severity = Severity.WARNING if fault.kind is XacroFaultKind.ENVIRONMENT else None
    message = f"{fault.file} does not expand: {fault.message}{hint}"
    key = private[1] if private else ""
    return finding(fault, message, severity=severity, key=key)


def _left_behind(description: UrdfDescription, context: Context) -> Iterator[Finding]:
    root = description.document.root
    for child in root.children:
        if child.tag in TAGS:
            yield finding(
                child.span,
                f"<{child.tag}> is not expanded: write <xacro:{child.tag}>",
                key=f"<{child.tag}>",
            )
        elif child.tag in _FOREIGN:
            found = () if description.for_rviz else _leftover_expressions(child)
            level = None if simulates(child) else Severity.WARNING
            yield from (replace(it, severity=level) for it in found)
        elif child.tag == "transmission" and context.distro:
            for element in (child, *child.descendants()):
                found = _leftover_expressions(element)
                yield from (replace(it, severity=Severity.INFO) for it in found)
        else:
            for element in (child, *child.descendants()):
                is_tag = element.tag.startswith("xacro:")
                yield from _leftover_tag(element) if is_tag else _leftover_expressions(element)


def _leftover_tag(element: Element) -> Iterator[Finding]:
    yield finding(
        element,
        f"<{element.tag}> is not expanded: readers of URDF ignore it",
        severity=Severity.WARNING,
        key="left by xacro",
    )


def _leftover_expressions(element: Element) -> Iterator[Finding]:
    for name, value in element.attributes.items():
        if match := _EXPRESSION.search(value):
            yield finding(
                element.attribute(name) or element,
                f"{match.group()} is not expanded: {_LOADED}",
                key="without xacro",
            )
        elif match := BRACES.search(value):
            yield finding(
                element.attribute(name) or element,
                f"{name} is {value[:80]!r}; did you mean ${{{match[1]}}}?",
                key=match.group(),
                fix=_as_expression(element, name, match),
            )


def _as_expression(element: Element, name: str, braces: re.Match[str]) -> Fix | None:
    """Return the fix that writes `$` in front of braces, in a file that xacro reads."""
    value = element.attribute(name)
    read_by_xacro = element.written is not element
    if value is None or value.span.text != value.value or not read_by_xacro:
        return None
    start = braces.start()
    text = f"{value.value[:start]}${value.value[start:]}"
    return replace_text(value, text, Safety.UNSAFE)


_DESCRIPTION = "urdf/robot_from_sdf.xacro"
_LAUNCH = "launch/description.launch"
_LOADING = """<launch>
  <arg name="name"/>
  <arg name="world_name"/>
  <param name="$(arg name)/robot_description"
         command="$(find xacro)/xacro $(find acme_rover_sensor_config_1)/urdf/robot_from_sdf.xacro
                  name:=$(arg name)"/>
</launch>
"""
_CAT = _LOADING.replace("$(find xacro)/xacro", "cat").replace("name:=$(arg name)", "")
_HEAD = '<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">\n'


def _example(body: str, head: str = _HEAD) -> dict[str, str]:
    return {_LAUNCH: _LOADING, _DESCRIPTION: f"{head}{body}\n</robot>\n"}


_MARK = "  <!-- ^ URD001 -->"
_MADE = "<!-- This document was autogenerated by xacro from arm.xacro -->\n"
_TAG = "<link name='b'><xacro:lens/></link>"
_MACROS = """
<xacro:macro name="wheel" params="side"><link name="$(arg name)/${side}_wheel"/></xacro:macro>
"""
_MODEL = '<xacro:arg name="model" default=""/>\n<xacro:include filename="$(arg model).xacro"/>'
_LARGE = _MODEL.replace('""', '"large"')
_STATE = """        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': Command(
                 ['xacro ', in_package('urdf', 'arm.urdf.xacro'), ' model:=', @])}]),"""


def _choice_example(value: str, mark: str = "") -> dict[str, str]:
    xacro = f'<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">\n{_MODEL}{mark}\n</robot>'
    links = '<robot name="arm"><link name="base_link"/></robot>'
    return {
        "@ros2": _STATE.replace("@", value),
        "urdf/arm.urdf.xacro": xacro,
        "urdf/large.xacro": links,
    }


def _camera_example(including: str, mark: str = "") -> dict[str, str]:
    macro = '<xacro:macro name="body" params="name"><link name="${name}"/></xacro:macro>'
    return {
        "@ros2": _STATE.replace("@", "'large'"),
        "urdf/arm.urdf.xacro": f'{_HEAD}{macro}<xacro:body name="arm"/>{including}</robot>',
        "urdf/eye.xacro": f'{_HEAD}<xacro:body name="eye"/>{mark}\n<link name="lens"/></robot>',
    }


_EYE = '<xacro:include filename="eye.xacro"/>'
GOOD = [
    _camera_example(_EYE),
    _choice_example("'large'"),
    {"urdf/arm.urdf.xacro": f'{_HEAD}{_MODEL}<link name="base_link"/></robot>'},
    _example(f'<xacro:arg name="name" default="x"/>{_MACROS}<xacro:wheel side="left"/>'),
    _example('<link name="$(arg name)/base_link"/>'),
    {"urdf/wheel.xacro": f"{_HEAD}{_MACROS}</robot>"},
    {"urdf/arm.urdf.xacro": f'{_HEAD}<link name="$(arg arm)"/></robot>'},
    _example('<link name="a"/><gazebo><plugin name="p" filename="f"><t>{x}</t></plugin></gazebo>'),
]
BAD = [
    _camera_example("", _MARK),
    _camera_example(f"<!-- {_EYE} -->", _MARK),
    {"@urdf": f'<gazebo reference="{{side}}_arm">{_MARK}\n<mu1>1</mu1>\n</gazebo>'},
    _example(f'<xacro:wheel side="left"/>{_MARK}'),
    _example(f'<link name="$(arg nmae)/base_link"/>{_MARK}'),
    _example(f'<link name="${{nmae}}/base_link"/>{_MARK}'),
    _example(f'<link name="{{name}}/base_link"/>{_MARK}'),
    _example(f'<xacro:include filename="wheel.xacro"/>{_MARK}'),
    _example(f"{_MACROS}<xacro:wheel/>{_MARK}"),
    {
        _LAUNCH: _LOADING.replace('command="$(find xacro)/xacro', 'textfile="').replace(
            "name:=$(arg name)", ""
        ),
        _DESCRIPTION: f'<robot name="rover"><macro name="m"/>{_MARK}\n<link name="a"/></robot>',
    },
    {_LAUNCH: _CAT, _DESCRIPTION: f'{_HEAD}<link name="${{1 + 1}}"/>{_MARK}\n</robot>'},
    {
        _LAUNCH: _CAT,
        _DESCRIPTION: f'{_HEAD}<xacro:include filename="$(find tools)/a.xacro"/>{_MARK}\n'
        '<link name="a"/></robot>',
    },
    {_LAUNCH: _LOADING, _DESCRIPTION: "", "@reported": [f"{_DESCRIPTION}:1"]},
    {"@urdf": f'<link name="$(arg name)/hand"/>{_MARK}'},
    {"@urdf": True, "urdf/made.urdf": f"{_MADE}{_HEAD}<link name='a'/>{_TAG}{_MARK}\n</robot>"},
    _choice_example("'lagre'", _MARK),
    _example(f'<xacro:arg name="prefix" default=""/><xacro:wheel side="left"/>{_MARK}'),
    _example(f"{_MODEL}{_MARK}"),
    _example(f'<xacro:property name="__size" value="1"/>{_MARK}'),
    {
        "urdf/arm.urdf.xacro": f"{_HEAD}{_LARGE}</robot>",
        "urdf/large.xacro": f'{_HEAD}<link name="base_link"/></robot>',
        "urdf/small.xacro": f'{_HEAD}<link name="${{nmae}}"/>{_MARK}</robot>',
    },
]
