"""A name in a xacro file that lacks the prefix which links and joints have there.

The robot works as long as the prefix is empty. With `prefix:=left_`, the mimic joint, `<gazebo>`
tag, joint of ros2_control or frame names something that does not exist: two arms in one cell, or
two robots in one world, fail while one alone works.

Fix: write the prefix in front of the name, as the message says.
Source: general knowledge; the value of `${prefix}` is not known until the file is included.
"""

import re
from collections.abc import Iterator

from checker.formats.urdf.macro_calls import macro_around
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

_PREFIXED = re.compile(r"(\$\{\w{0,40}prefix\}|\$\(arg \w{0,40}prefix\))(.{1,200})", re.DOTALL)
_CONTROL = ("ros2_control", "transmission")
_ATTRIBUTES = (("mimic", "joint"), ("gazebo", "reference"), ("parent", "link"), ("child", "link"))
_TEXTS = ("frame_id", "frameName", "joint", "Joint", "joint_name", "jointName", "bodyName")
"""Ends of the tags in plugins and sensors that name a joint or frame."""


@rule("URD024", "name-without-prefix", Severity.WARNING, Concern.ROBOT)
def check(package: Package) -> Findings:
    """Report names without the prefix that the same name has where it is defined.

    A name that is defined anywhere in the package without a prefix is right as it is.
    """
    files = (package.xml(file.path) for file in package.index.with_suffix(".xacro"))
    documents = [document for document in files if isinstance(document, XmlDocument)]
    plain = {
        name.value
        for document in documents
        for element in document.elements
        for name in _own_name(element)
    }
    for document in documents:
        scopes: dict[Element | None, list[Element]] = {}
        for element in document.elements:
            scopes.setdefault(macro_around(element), []).append(element)
        for elements in scopes.values():
            yield from _unprefixed_names(elements, plain)


def _unprefixed_names(elements: list[Element], plain: set[str]) -> Iterator[Finding]:
    prefixed = {
        match[2]: match.group()
        for element in elements
        for name in _own_name(element)
        if (match := _PREFIXED.fullmatch(name.value))
    }
    for element in elements if prefixed else ():
        for name in _referred_names(element):
            whole = prefixed.get(name.value.strip())
            if whole is not None and name.value.strip() not in plain:
                yield finding(
                    name,
                    f"<{element.tag}> names {name.value.strip()!r}, which exists only if the "
                    f"prefix is empty: write {whole}",
                )


def _own_name(element: Element) -> Iterator[Located[str]]:
    """Yield the name of a link or joint of the robot."""
    name = element.attribute("name")
    if name is not None and (element.tag == "link" or _is_joint(element)):
        yield name


def _is_joint(element: Element) -> bool:
    return element.tag == "joint" and element.get("type") is not None


def _referred_names(element: Element) -> Iterator[Located[str]]:
    """Yield the names of links and joints that an element refers to."""
    for tag, attribute in _ATTRIBUTES:
        name = element.attribute(attribute) if element.tag == tag else None
        if name is not None:
            yield name
    around = element.parent.tag if element.parent is not None else ""
    if element.tag == "joint" and around in _CONTROL:
        name = element.attribute("name")
        if name is not None:
            yield name
    elif not element.children and element.tag.endswith(_TEXTS):
        yield element.text


def _gripper(inside: str, more: str = "") -> object:
    return {
        "@urdf": True,
        "urdf/gripper.xacro": f"""<robot name="gripper" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:macro name="gripper" params="parent prefix:=''">
  <link name="${{prefix}}finger"/>
  <joint name="${{prefix}}slide" type="prismatic">
    <parent link="${{parent}}"/><child link="${{prefix}}finger"/>
  </joint>
  {inside}
</xacro:macro>{more}
</robot>
""",
    }


_MARK = "  <!-- ^ URD024 -->"
GOOD = [
    _gripper('<gazebo reference="${prefix}finger"/>'),
    _gripper('<gazebo reference="finger"/>', '<link name="finger"/>'),
    _gripper("<gazebo><plugin><topic>finger</topic></plugin></gazebo>"),
    _gripper("", '<gazebo reference="finger"/>'),
]
BAD = [
    _gripper(f'<gazebo reference="finger"/>{_MARK}'),
    _gripper(f'<joint name="${{prefix}}b" type="prismatic"><mimic joint="slide"/>{_MARK}</joint>'),
    _gripper(f'<ros2_control><joint name="slide"/>{_MARK}</ros2_control>'),
    _gripper(f"<gazebo><plugin><left_joint>slide</left_joint>{_MARK}</plugin></gazebo>"),
]
