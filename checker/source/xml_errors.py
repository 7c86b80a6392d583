"""Explanation of a parser's error for people, and its likely cause."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from difflib import get_close_matches
from xml.parsers import expat

from checker.finding import Edit
from checker.source.text import SourceText, Span
from checker.source.xml_positions import XmlFault

# What tinyxml2, and hence Gazebo, forgives though XML forbids it.
#
# Each function blanks the forgiven characters out, so that offsets stay the same, and reports them.


GAZEBO_FILES = (".sdf", ".world", ".config")
"""Endings of files that only Gazebo reads."""
_LENIENT_ROOTS = ("<library", "<class_libraries", "<mujoco", "<mujocoinclude")
_BEHAVIOR_TREE = re.compile(r"<BehaviorTree\b")
_FIRST_TAG = re.compile(r"<[A-Za-z_]+")


def is_lenient(source: SourceText) -> bool:
    """Return whether tinyxml2 alone reads a file, for Gazebo, MuJoCo, pluginlib, Nav2 or MoveIt."""
    if source.file.endswith((*GAZEBO_FILES, ".srdf")):
        return True
    first = _FIRST_TAG.search(source.text)
    root = first.group() if first is not None else ""
    is_tree = root == "<root" and _BEHAVIOR_TREE.search(source.text) is not None
    return is_tree or root in _LENIENT_ROOTS


_LATE_DECLARATION = re.compile(r"\s+(<\?xml\s[^>]*?\?>)")
_HYPHENS = re.compile(r"-{2,}|-\Z")
_TWO_HYPHENS = ("'--' inside a comment", "XML forbids two hyphens in a comment; write one")
_REPORTED = 100


def mend_declaration(source: SourceText) -> tuple[str, list[XmlFault]]:
    """Forgive blanks before the XML declaration."""
    text = source.text
    late = _LATE_DECLARATION.match(text)
    if late is None:
        return text, []
    fault = XmlFault(
        Span(source, *late.span(1)),
        "the XML declaration is not at the very start of the file",
        "remove the space or lines before it",
    )
    # Line ends stay: lxml counts lines.
    blank = re.sub(r"[^\r\n]", " ", late.group())
    return blank + text[late.end() :], [fault]


def mend_comments(source: SourceText, text: str) -> tuple[str, list[XmlFault]]:
    """Forgive `--` inside comments; the first ones are reported."""
    faults: list[XmlFault] = []
    parts: list[str] = []
    at = 0
    for start, end in _comment_bodies(text):
        for hyphens in _HYPHENS.finditer(text[start:end]):
            first, last = start + hyphens.start(), start + hyphens.end()
            parts += [text[at:first], " " * (last - first)]
            at = last
            if len(faults) < _REPORTED:
                faults.append(XmlFault(Span(source, first, last), *_TWO_HYPHENS))
    return "".join([*parts, text[at:]]), faults


_ENTITY = r"&(?!(?:amp|lt|gt|quot|apos);|#[0-9]+;|#x[0-9A-Fa-f]+;)"
_FORGIVEN = re.compile(
    rf"<!--.*?-->|<!\[CDATA\[.*?]]>|{_ENTITY}|[\x01-\x08\x0b\x0c\x0e-\x1f]", re.S
)
_ENTITY_FAULT = ("an '&' that starts no entity", "write &amp; for &")


def mend_characters(source: SourceText, text: str) -> tuple[str, list[XmlFault]]:
    """Forgive `&` that starts no entity, and control characters; the first ones are reported."""
    faults: list[XmlFault] = []

    def blanked(match: re.Match[str]) -> str:
        found = match.group()
        if len(found) > 1:
            return found
        if len(faults) < _REPORTED:
            character = (f"the character U+{ord(found):04X} is not allowed in XML", "remove it")
            words = _ENTITY_FAULT if found == "&" else character
            faults.append(XmlFault(Span(source, *match.span()), *words))
        return " "

    return _FORGIVEN.sub(blanked, text), faults


_VALUE = re.compile(r"""=\s{0,9}(?:"[^"\n]{0,999}"|'[^'\n]{0,999}')(?=[\s/>])""")
_ANGLE_FAULT = ("a '<' inside a value", "write &lt; for <")


def mend_angles(source: SourceText, text: str) -> tuple[str, list[XmlFault]]:
    """Forgive `<` inside the values of attributes; the first ones are reported."""
    values = [value.span() for value in _VALUE.finditer(text) if "<" in value.group()]
    for start, end in values:
        text = text[:start] + text[start:end].replace("<", " ") + text[end:]
    spans = (Span(source, *value) for value in values[:_REPORTED])
    return text, [XmlFault(span, *_ANGLE_FAULT) for span in spans]


_SECOND_ROOT = "junk after document element"


def mend_roots(text: str, fault: XmlFault) -> tuple[str, list[XmlFault]]:
    """Forgive further elements behind the root: tinyxml2 keeps them, and Gazebo reads the first."""
    at = fault.span.start
    if fault.message != _SECOND_ROOT or not _holds_elements_alone(text[at:]):
        return text, []
    return text[:at] + re.sub(r"[^\r\n]", " ", text[at:]), [fault]


def _holds_elements_alone(text: str) -> bool:
    """Return whether a text is a sequence of well-formed elements without text between them."""
    depth = 0
    stray = False
    parser = expat.ParserCreate()

    def start(*_: object) -> None:
        nonlocal depth
        depth += 1

    def end(*_: object) -> None:
        nonlocal depth
        depth -= 1

    def characters(data: str) -> None:
        nonlocal stray
        stray |= depth == 1 and bool(data.strip())

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler = characters
    try:
        parser.Parse(f"<roots>{text}</roots>", True)
    except expat.ExpatError:
        return False
    return not stray


def _comment_bodies(text: str) -> Iterator[tuple[int, int]]:
    """Yield where the inside of each comment begins and ends; CDATA is ignored."""
    at = text.find("<!")
    while at >= 0:
        for opening, closing in (("<!--", "-->"), ("<![CDATA[", "]]>")):
            if text.startswith(opening, at):
                start = at + len(opening)
                end = text.find(closing, start)
                if end < 0:
                    return
                if opening == "<!--":
                    yield start, end
                at = end
                break
        at = text.find("<!", at + 1)


_OPENING = re.compile(r"<([^\s>/]{1,100})")
_CLOSING = re.compile(r"[^\s>/<]{1,100}")
_CLOSED_EARLY = re.compile(
    r"<[A-Za-z_][\w:.-]{0,100}\s*>\s{0,100}[\w:.-]{1,100}\s{0,9}=\s{0,9}[\"']"
)
_ALONE = re.compile(r"(?P<tag><[^<>]{1,1000}>)\s*(?P<content>[^<>]{0,1000}?)\s*")
"""A start tag, and text up to the next tag."""
_NEAR = 200
"""Characters around a fault in which its cause is looked for."""


def explain(source: SourceText, message: str, at: int, still_open: list[int]) -> XmlFault:
    """Return what is wrong.

    Args:
        source: The text.
        message: expat's own.
        at: Offset of the character that expat could not accept.
        still_open: Offsets of the start tags that are open there, outermost first.
    """
    if not source.text.strip():
        return XmlFault(source.whole(), "the file is empty")
    if message == "mismatched tag" and still_open:
        return _mismatched(source, at, still_open)
    if message == "no element found":
        return _too_early(source, at, still_open)
    if message in ("not well-formed (invalid token)", "syntax error"):
        return _invalid(source, at)
    if message == "unclosed CDATA section":
        at = source.text.rfind("<![CDATA[")
    hint = _HINTS[message](source.text, at) if message in _HINTS else ""
    return XmlFault(Span(source, at, min(at + 1, len(source.text))), message, hint)


def _mismatched(source: SourceText, at: int, still_open: list[int]) -> XmlFault:
    closing = _CLOSING.match(source.text, at)
    name = closing.group() if closing else ""
    names = [_name(source, opened) for opened in still_open]
    if source.wrapper and name == source.wrapper:
        # The inner text is over: its own last characters are the place to look at.
        return _too_early(source, at - len("</"), still_open)
    end = source.text.find(">", at) + 1 or len(source.text)
    span = Span(source, at - len("</"), end)
    if len(names) == 1 and source.wrapper:
        return XmlFault(span, f"</{name}> closes no open element")
    opened = still_open[-1]
    message = f"</{name}> is here while <{names[-1]}> of line {_line(source, opened)} is still open"
    hint = _never_closed(source, opened, at)
    edit = _bracket(source, opened, at) if hint else _closing(source, names, still_open, at)
    return XmlFault(span, message, hint or _wrong_name(name, names), edit)


def _closing(source: SourceText, names: list[str], opened: list[int], at: int) -> Edit | None:
    """Return the edit of a misspelt end tag, or of an element without others that has none."""
    name, text = source.text[at : source.text.find(">", at)].rstrip(), source.text[: at - len("</")]
    if name not in names and get_close_matches(name, names[-1:]):
        return Span(source, at, at + len(name)).replacement(names[-1])
    alone = _ALONE.fullmatch(text, opened[-1])
    if alone is None or names[-2:-1] != [name]:
        return None
    end = alone.end("content") if alone["content"] else alone.end("tag") - 1
    return Span(source, end, end).replacement(f"</{names[-1]}>" if alone["content"] else "/")


def _wrong_name(name: str, names: list[str]) -> str:
    if name in names:
        return f"close <{names[-1]}> first"
    if get_close_matches(name, names[-1:]):
        return f"write </{names[-1]}>"
    return f"no <{name}> is open"


def _too_early(source: SourceText, at: int, still_open: list[int]) -> XmlFault:
    span = Span(source, at, at)
    if not still_open:
        return XmlFault(span, "the file contains no element")
    opened = still_open[-1]
    label = f"<{_name(source, opened)}> of line {_line(source, opened)}"
    hint = _never_closed(source, opened, at)
    hint = f"{label} is never closed" + (f": {hint}" if hint else "")
    return XmlFault(span, "the file ends too early", hint)


def _never_closed(source: SourceText, opened: int, at: int) -> str:
    """Return the reason why the element that begins at `opened` has no end tag before `at`."""
    name = _name(source, opened)
    if _CLOSED_EARLY.match(source.text, opened):
        return f"<{name}> is closed before its attributes"
    lost = _lost_end_tag(source, opened, at)
    if lost is None:
        return ""
    return f"write </{name}> for {lost.group()} in line {_line(source, lost.start())}"


def _bracket(source: SourceText, opened: int, at: int) -> Edit | None:
    """Return the edit that gives an end tag its `<`."""
    lost = _lost_end_tag(source, opened, at)
    return Span(source, lost.start(), lost.start()).replacement("<") if lost else None


def _lost_end_tag(source: SourceText, opened: int, at: int) -> re.Match[str] | None:
    name = re.escape(_name(source, opened))
    return re.compile(rf"(?<!<)/{name}>").search(source.text, opened, at)


def _name(source: SourceText, opened: int) -> str:
    match = _OPENING.match(source.text, opened)
    return match.group(1) if match else "?"


def _line(source: SourceText, at: int) -> int:
    """Return a line as a person finds it, which for emitted text is one of the Ruby file."""
    return Span(source, at, at).line


_NO_VALUE = (
    r"<[\w:.-]{1,100}(?:\s{1,9}[\w:.-]{1,100}\s{0,9}=\s{0,9}(?:\"[^\"<]{0,200}\"|'[^'<]{0,200}'))"
    r"{0,20}\s{1,9}[\w:.-]{1,100}\s{0,99}\Z"
)
"""A tag that ends in a name after its attributes."""
_CAUSES: tuple[tuple[re.Pattern[str], re.Pattern[str], str], ...] = tuple(
    (re.compile(before), re.compile(after), hint)
    for before, after, hint in (
        (r"&\Z", r"", "write &amp; for &"),
        (r"&[\w#]{1,40}\Z", r"", "write &amp; for &, or end the entity with ;"),
        (r"]]\Z", r">", "write ]]&gt; for ]]>"),
        (r"<!\Z|<!-\Z", r"", "a comment starts with <!-- and ends with -->"),
        (r"<!--(?:[^-]|-[^-]){0,200}--\Z", r"", "a comment ends at -->, not before"),
        (r"</\Z", r"\s", "remove the space after </"),
        (r"<[^<>]{0,200}=\s*\Z", r"[^\s\"'<>]", "an attribute's value needs quotes"),
        (r"<[^<>]{0,200}[\s\"'][\w:.-]{1,100}\s*\Z", r"/?>|[\w:.-]", "an attribute needs a value"),
        (r"=\s*([\"'])[^\"'<>]{0,200}\1\Z", r"[\w:]", "attributes need a space between them"),
        (r"=\s*([\"'])[^\"']{0,200}\1\s*\Z", r"<", "the tag before this is not closed by >"),
        (_NO_VALUE, r"<", "an attribute before this has no value, and its tag is not closed by >"),
        (r"=\s*([\"'])[^<]{0,200}\Z", r"<", "the closing quote of a value before this is missing"),
        (r"<[\w:.-]{1,100}\s*\Z", r"<", "the tag before this is not closed by >"),
        (r"<\Z", r"/[\w:]", "there is no element left to close"),
        (r"<\Z", r"", "write &lt; for <"),
        (r"/\Z", r"[\s/]", "an empty element ends with />"),
    )
)
"""Texts before and after the character that is refused, and their meaning."""


def _invalid(source: SourceText, at: int) -> XmlFault:
    """Explain a character that cannot stand where it does."""
    span = Span(source, at, min(at + 1, len(source.text)))
    character = source.text[at : at + 1]
    if character and not character.isprintable() and not character.isspace():
        code = f"U+{ord(character):04X}"
        return XmlFault(span, f"the character {code} is not allowed in XML", "remove it")
    before, after = source.text[max(0, at - _NEAR) : at], source.text[at : at + _NEAR]
    message = f"{character!r} is not allowed here" if character else "the text ends too early"
    if not before.strip() or "<" not in source.text[:at]:
        return XmlFault(span, message, "an XML file starts with <")
    for tail, head, hint in _CAUSES:
        if head.match(after) and tail.search(before):
            return XmlFault(span, message, hint)
    return XmlFault(span, message)


def _second_root(text: str, at: int) -> str:
    match = _OPENING.match(text, at)
    what = f"<{match.group(1)}>" if match else "text"
    if what == "<library>":
        return "put all <library> into one <class_libraries>"
    return f"an XML file has one root element, but {what} follows it"


def _unclosed(text: str, at: int) -> str:
    if text.startswith("<!--", at):
        return "the comment that starts here has no -->"
    tag_end = text.find(">", at)
    if tag_end < 0:
        return "the tag that starts here has no >"
    if text.startswith("<?", at):
        return "the declaration that starts here has no ?>"
    return "a quote of the tag that starts here is missing"


_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


def _late_declaration(text: str, at: int) -> str:
    if _COMMENT.sub("", text[:at]).strip():
        return "remove the second <?xml …?>"
    return f"move line {text.count(chr(10), 0, at) + 1}, <?xml …?>, to the beginning of the file"


_HINTS: Mapping[str, Callable[[str, int], str]] = {
    "junk after document element": _second_root,
    "unclosed token": _unclosed,
    "unclosed CDATA section": lambda *_: "the CDATA section that starts here has no ]]>",
    "undefined entity": lambda *_: "XML knows only &amp; &lt; &gt; &quot; and &apos;",
    "duplicate attribute": lambda *_: "keep one of them",
    "XML or text declaration not at start of entity": _late_declaration,
    "reference to invalid character number": lambda *_: "this number is not a character",
}
