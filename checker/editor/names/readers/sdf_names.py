"""Names in an SDF file: models, links, joints, frames, sensors and topics."""

from __future__ import annotations

from collections.abc import Iterator

from checker.editor.name_kinds import ATTRIBUTES, TEXTS
from checker.editor.names.mention import (
    MODEL_ONLY,
    PARTS,
    Included,
    NameKind,
    Role,
    WrittenName,
)
from checker.editor.names.readers.expressions import is_computed
from checker.editor.names.readers.plugin_names import RESERVED, plugin_names, sensor_names, verbatim
from checker.editor.names.readers.values import scoped_names
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

_OWN = "::__model__"
_KINDS = {"link": NameKind.LINK, "joint": NameKind.JOINT, "frame": NameKind.FRAME}


class SdfNames:
    """The reading of one file.

    Attributes:
        names: What is written, as it is found.
        included: Models that are included.
        model: Name of the file's model.
    """

    def __init__(self, document: XmlDocument) -> None:
        """Read all of it."""
        self.names: list[WrittenName] = []
        self.included: list[Included] = []
        self.model = ""
        self._walk(document.root, "", "")

    def _walk(self, element: Element, prefix: str, part: str) -> None:
        """Read what is in an element.

        Args:
            element: Any.
            prefix: The prefix of the model around it: empty, or `robot::`.
            part: Full name of the link or joint around it.
        """
        for child in element.children:
            tag = child.tag
            if child.attributes:
                self._attributes(child, prefix)
            if tag == "model":
                self._walk(child, self._model(child, prefix), "")
            elif tag == "include":
                self._include(child, prefix)
            elif tag in _KINDS:
                self._part(child, prefix)
                self._walk(child, prefix, f"{prefix}{child.get('name') or ''}")
            elif tag == "sensor":
                self._sensor(child, prefix, part)
            elif tag == "plugin":
                self.names += plugin_names(child, prefix)
            else:
                self._text(child, prefix)
                if child.children:
                    self._walk(child, prefix, part)

    def _define(
        self, kind: NameKind, name: Located[str] | None, full: str, role: Role = Role.DEFINES
    ) -> None:
        if name is not None and name.value not in RESERVED and "::" not in name.value:
            span = name.span
            self.names.append(WrittenName((kind,), full, span.start, span.end, role))

    def _model(self, element: Element, prefix: str) -> str:
        """Note a model; return the prefix of what is in it."""
        name = verbatim(element.attribute("name"))
        value = element.get("name") or ""
        self._define(NameKind.MODEL, name, prefix + value)
        above = element.parent
        is_first = not self.model and above is not None and above.tag == "sdf"
        if is_first:
            self.model = value
        return prefix if is_first else f"{prefix}{value}::"

    def _include(self, element: Element, prefix: str) -> None:
        """Note a model that is included; without its own name, it has that of its file."""
        name, uri = element.child("name"), element.child("uri")
        text = verbatim(name.text) if name is not None else None
        value = text.value if text is not None else ""
        if text is not None:
            self._define(NameKind.MODEL, text, prefix + value)
        if uri is not None:
            merged = (element.get("merge") or "").strip() in ("true", "1")
            self.included.append(
                Included(uri.text.value, prefix if merged else prefix + value, merged)
            )
        inside = f"{prefix}{value}::" if value else prefix
        for child in element.children:
            if child.attributes and child.tag == "pose":
                self._attributes(child, prefix)
            if child.tag == "plugin":
                self.names += plugin_names(child, inside)
            elif child.tag == "placement_frame":
                self._refer(verbatim(child.text), inside, PARTS)

    def _part(self, element: Element, prefix: str) -> None:
        name = verbatim(element.attribute("name"))
        if name is not None and not is_computed(name.value):
            self._define(_KINDS[element.tag], name, prefix + name.value)

    def _sensor(self, element: Element, prefix: str, part: str) -> None:
        name = verbatim(element.attribute("name"))
        if name is not None and not is_computed(name.value):
            full = f"{part}::{name.value}" if part else prefix + name.value
            self._define(NameKind.SENSOR, name, full)
        self.names += sensor_names(element, prefix)
        for child in element.descendants():
            if child.attributes:
                self._attributes(child, prefix)
            if child.tag == "plugin":
                self.names += plugin_names(child, prefix)

    def _attributes(self, element: Element, prefix: str) -> None:
        for name in element.attributes:
            kinds = ATTRIBUTES.get((element.tag, name))
            if kinds is not None:
                self._refer(verbatim(element.attribute(name)), prefix, kinds)

    def _text(self, element: Element, prefix: str) -> None:
        above = element.parent.tag if element.parent is not None else ""
        kinds = TEXTS.get((above, element.tag))
        if element.tag == "frame_id":
            kinds = MODEL_ONLY if above == "include" else PARTS
        if kinds is not None and not element.children:
            self._refer(verbatim(element.text), prefix, kinds)

    def _refer(self, text: Located[str] | None, prefix: str, kinds: tuple[NameKind, ...]) -> None:
        self.names += references_in(text, prefix, kinds)


def references_in(
    text: Located[str] | None, prefix: str, kinds: tuple[NameKind, ...]
) -> Iterator[WrittenName]:
    """Yield what a text of SDF names, which is looked up in the model around it."""
    if text is None or text.value in RESERVED:
        return
    name = text.value.removesuffix(_OWN)
    of_model = MODEL_ONLY if name != text.value else kinds
    yield from scoped_names(name, text.span.start, of_model, Role.NAMES, prefix)
