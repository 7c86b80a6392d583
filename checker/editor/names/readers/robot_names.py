"""Names in URDF, also in the elements that xacro makes, and in SRDF: links, joints, sensors."""

from __future__ import annotations

import re

from checker.editor.name_kinds import ATTRIBUTES, BY_TAG, ELSEWHERE, is_srdf
from checker.editor.names.mention import (
    JOINT_ONLY,
    LINK_ONLY,
    SENSOR_ONLY,
    NameKind,
    Role,
    WrittenName,
)
from checker.editor.names.readers.expressions import EXPRESSION, is_computed
from checker.editor.names.readers.plugin_names import RESERVED, plugin_names, sensor_names, verbatim
from checker.editor.names.readers.values import scoped_names
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

_ROBOT = re.compile(rf"/?(?:{EXPRESSION.pattern})/(?=[^/]+\Z)")


class RobotNames:
    """The reading of one file.

    Attributes:
        names: What is written, as it is found.
    """

    def __init__(self, document: XmlDocument) -> None:
        """Read all of it."""
        self.names: list[WrittenName] = []
        self._is_srdf = is_srdf(document.source.file)
        self._walk(document.root, "", self._is_srdf)

    def _walk(self, element: Element, reference: str, elsewhere: bool) -> None:
        """Read what is in an element.

        Args:
            element: Any.
            reference: What the `<gazebo>` around it refers to.
            elsewhere: Whether joints in it are defined elsewhere.
        """
        for child in element.children:
            tag = child.tag
            self._attributes(child, reference, elsewhere)
            if tag == "plugin":
                self.names += plugin_names(child, "")
            elif tag == "sensor" and not elsewhere:
                self._sensor(child, reference)
            elif tag == "gazebo":
                self._walk(child, child.get("reference") or "", True)
            elif child.children:
                self._walk(child, reference, elsewhere or tag in ELSEWHERE)
            elif tag in ("parent", "child") and elsewhere:
                self._end(child)
            elif tag == "param" and child.get("name") == "mimic":
                self._name(verbatim(child.text), JOINT_ONLY, Role.NAMES)

    def _attributes(self, element: Element, reference: str, elsewhere: bool) -> None:
        tag = element.tag
        for name in element.attributes:
            kinds = ATTRIBUTES.get((tag, name))
            if kinds is not None:
                self._name(verbatim(element.attribute(name)), kinds, Role.NAMES)
            elif name == "name" and tag in BY_TAG:
                role = Role.NAMES if elsewhere else Role.DEFINES
                self._name(verbatim(element.attribute(name)), BY_TAG[tag], role)
            elif name == "name" and tag == "virtual_joint":
                self._name(verbatim(element.attribute(name)), JOINT_ONLY, Role.DEFINES)
        if elsewhere and tag == "sensor" and not self._is_srdf:
            parent = element.parent
            if parent is not None and parent.tag == "ros2_control":
                self._name(verbatim(element.attribute("name")), SENSOR_ONLY, Role.MAY_NAME)
            else:
                self._sensor(element, reference)

    def _sensor(self, element: Element, reference: str) -> None:
        name, parent = verbatim(element.attribute("name")), element.child("parent")
        if parent is not None and not reference:
            reference = _ROBOT.sub("", parent.get("link") or "")
        if name is not None and not is_computed(name.value):
            span = name.span
            full = f"{reference}::{name.value}" if reference else name.value
            self.names.append(WrittenName(SENSOR_ONLY, full, span.start, span.end, Role.DEFINES))
        self.names += sensor_names(element, "")
        for child in element.children:
            self._attributes(child, reference, True)

    def _end(self, element: Element) -> None:
        """Note the link that a joint of SDF in a `<gazebo>` names."""
        text, above = verbatim(element.text), element.parent
        if text is not None and above is not None and above.tag == "joint":
            self.names += scoped_names(text.value, text.span.start, LINK_ONLY, Role.MAY_NAME)

    def _name(self, text: Located[str] | None, kinds: tuple[NameKind, ...], role: Role) -> None:
        if text is not None and text.value not in RESERVED:
            start, name = text.span.start, text.value
            if before := _ROBOT.match(name):
                # `$(arg name)/base_link` is the link that the model calls base_link.
                start, name = start + before.end(), name[before.end() :]
            self.names.append(WrittenName(kinds, name, start, text.span.end, role))
