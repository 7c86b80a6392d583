"""Items of a completion, and the place for which they are offered."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from functools import cached_property
from html import escape

from checker.base.record import Record
from checker.editor.completion.snippet import escaped
from checker.editor.language import Place, place_of
from checker.editor.plugin_facts import PluginFacts, plugin_facts
from checker.editor.target import schema_version
from checker.editor.xacro_names import PREFIX, XacroNames, xacro_names
from checker.editor.xml_context import Context as XmlPlace
from checker.editor.xml_context import OpenElement, Where
from checker.engine.subject import Subject
from checker.rule import Context


class CompletionKind(StrEnum):
    """Kind of a completion item."""

    ELEMENT = "element"
    ATTRIBUTE = "attribute"
    VALUE = "value"
    LINK = "link"
    JOINT = "joint"
    FRAME = "frame"
    SENSOR = "sensor"
    MODEL = "model"
    PLUGIN = "plugin"
    PARAMETER = "parameter"
    MACRO = "macro"
    PROPERTY = "property"
    ARGUMENT = "argument"
    PACKAGE = "package"
    FOLDER = "folder"
    FILE = "file"


class Completion(Record):
    """Something to write.

    Attributes:
        label: What the list shows.
        kind: What it is.
        detail: A few words next to the label.
        documentation: Markdown; empty for none.
        insert: The text to put in place of the characters from `start` to `end`.
        start: Offset in the text.
        end: Offset behind the last character that is replaced.
        is_snippet: Whether `insert` has places to fill in, as LSP writes them.
        sort: What the list is sorted by.
    """

    label: str
    kind: CompletionKind
    detail: str
    documentation: str
    insert: str
    start: int
    end: int
    is_snippet: bool
    sort: str


class Request(Record, eq=False, dict=True):
    """A request for completion.

    Attributes:
        subject: The package, with the last text of the file that could be read.
        path: The path of the file.
        text: The current text of the file.
        offset: The offset of the caret.
        xml: What is around the caret.
        target: What the package is written for.
    """

    subject: Subject
    path: str
    text: str
    offset: int
    xml: XmlPlace
    target: Context

    def item(
        self,
        label: str,
        kind: CompletionKind,
        *,
        insert: str | None = None,
        detail: str = "",
        documentation: str = "",
        rank: int = 5,
        is_snippet: bool = False,
        start: int | None = None,
    ) -> Completion:
        """Return something to write in place of the word at the caret.

        Args:
            label: What the list shows.
            kind: What it is.
            insert: The text; the label, as XML writes it, where it is None.
            detail: A few words next to the label.
            documentation: Markdown.
            rank: 0 comes first, 9 last.
            is_snippet: Whether `insert` has places to fill in.
            start: The start of the replaced text, if not at the start of the word.
        """
        begin = self.xml.start if start is None else start
        text = escape(label, quote=False) if insert is None else insert
        sort = f"{rank}{label}"
        return Completion(
            label, kind, detail, documentation, text, begin, self.xml.end, is_snippet, sort
        )

    def element(
        self,
        tag: str,
        snippet: str,
        *,
        kind: CompletionKind = CompletionKind.ELEMENT,
        detail: str = "",
        documentation: str = "",
        rank: int = 5,
    ) -> Completion:
        """Return an element to write: its name alone where the rest of its tag is there.

        Args:
            tag: Its name.
            snippet: The whole, without its first `<`.
            kind: What it is.
            detail: As of `item`; likewise the others.
            documentation: Markdown.
            rank: 0 comes first, 9 last.
        """
        in_text = self.xml.where is Where.TEXT
        is_bare = in_text or not (self.xml.attributes or self._following in (">", "/"))
        insert = (f"<{snippet}" if in_text else snippet) if is_bare else tag
        return self.item(
            tag, kind, insert=insert, detail=detail, documentation=documentation, rank=rank,
            is_snippet=is_bare,
        )  # fmt: skip

    def attribute(
        self, name: str, default: str, detail: str, documentation: str = "", rank: int = 5
    ) -> Completion:
        """Return an attribute with a place for its value, unless that is there already."""
        has_value = self._following == "="
        place = f"${{1:{escaped(default)}}}" if default else "$1"
        return self.item(
            name, CompletionKind.ATTRIBUTE, insert=name if has_value else f'{name}="{place}"',
            detail=detail, documentation=documentation, rank=rank, is_snippet=not has_value,
        )  # fmt: skip

    @property
    def _following(self) -> str:
        """The character behind the word."""
        return self.text[self.xml.end : self.xml.end + 1]

    @cached_property
    def enclosing_place(self) -> Place:
        """Place of the innermost element around the caret."""
        return place_of(self.xml.tags, refers=self.refers)

    @cached_property
    def own_place(self) -> Place:
        """Place of the element whose start tag or text contains the caret."""
        tags = (*self.xml.tags, self.xml.tag) if self.xml.tag else self.xml.tags
        return place_of(tags, refers=self.refers)

    @property
    def refers(self) -> bool:
        """True if the `<gazebo>` tag around the caret refers to a link or joint."""
        return any(it.tag == "gazebo" and "reference" in it.attributes for it in self.xml.around)

    @property
    def version(self) -> str:
        """SDF version to judge by."""
        outer = self.xml.around[0].attributes if self.xml.around else {}
        stated = "" if self.enclosing_place.is_extension else outer.get("version", "")
        return schema_version(stated.strip(), self.target)

    @property
    def is_xacro(self) -> bool:
        """True if xacro reads the file."""
        return "xmlns:xacro" in self.text or self.path.lower().endswith(".xacro")

    @cached_property
    def names(self) -> XacroNames:
        """Names that xacro files define."""
        return xacro_names(self.subject.package, self.path)

    @cached_property
    def plugin(self) -> OpenElement | None:
        """The plugin around the caret."""
        return next((it for it in reversed(self.xml.around) if it.tag == "plugin"), None)

    @cached_property
    def plugin_facts(self) -> PluginFacts | None:
        """Facts about that plugin; None if it is not known."""
        stated = self.plugin.attributes if self.plugin is not None else {}
        return plugin_facts(stated.get("filename", ""), stated.get("name", ""), self.target)

    @property
    def tags_below_plugin(self) -> tuple[str, ...]:
        """The tags between that plugin and the caret."""
        tags = tuple(tag for tag in self.xml.tags if not tag.startswith(PREFIX))
        at = len(tags) - list(reversed(tags)).index("plugin") if "plugin" in tags else len(tags)
        return tags[at:]


def sort_by_rank(items: Iterable[Completion]) -> tuple[Completion, ...]:
    """Return items as a list shows them; of two with one label, the first.

    What a list cannot show, such as a name with a line break, is left out.
    """
    unique: dict[str, Completion] = {}
    for item in items:
        if item.label and item.label.isprintable():
            unique.setdefault(item.label, item)
    return tuple(sorted(unique.values(), key=lambda item: item.sort))
