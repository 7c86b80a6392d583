"""Random XML trees in random formatting, written down together with the place of everything."""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st

NAMES = st.sampled_from(["a", "link", "xyz", "größe", "名前", "a-b.c_1"])
BLANKS = st.sampled_from(["", " ", "\t", "\n", "\r\n", "\r\n\t  "])
GAPS = BLANKS.filter(bool)
_ENTITIES = {"&amp;": "&", "&lt;": "<", "&gt;": ">", "&#x3b1;": "α", "&#x1F600;": "😀"}
_WORD = st.one_of(
    st.sampled_from(sorted(_ENTITIES)), st.text("ab1.é世😀'/=-", min_size=1, max_size=4)
)


@dataclass
class Written:
    """One element as it must be found again: character offsets and values."""

    tag: str
    start: int
    start_end: int = -1
    end_start: int = -1
    end: int = -1
    name: tuple[int, int] = (-1, -1)
    attributes: dict[str, tuple[int, int, int, int, str]] = field(default_factory=dict)
    text: str = ""
    text_range: tuple[int, int] | None = None


@dataclass
class Page:
    """A text that grows, and the elements on it in document order."""

    text: str = ""
    elements: list[Written] = field(default_factory=list)

    def write(self, piece: str) -> tuple[int, int]:
        start = len(self.text)
        self.text += piece
        return start, len(self.text)


def resolved(written: str) -> str:
    for entity, character in _ENTITIES.items():
        if entity != "&amp;":
            written = written.replace(entity, character)
    return written.replace("&amp;", "&").replace("\r\n", "\n")


@st.composite
def pages(draw: st.DrawFn) -> Page:
    page = Page()
    if draw(st.booleans()):
        page.write('<?xml version="1.0"?>')
    page.write(draw(BLANKS))
    page.write(draw(st.sampled_from(["", "<!-- über <a> -->", "<?pi > ?>"])))
    _write_element(draw, page, 0)
    page.write(draw(BLANKS))
    return page


def _write_element(draw: st.DrawFn, page: Page, depth: int) -> None:
    tag = draw(NAMES)
    element = Written(tag, page.write("<")[0])
    page.elements.append(element)
    element.name = page.write(tag)
    for name in draw(st.lists(NAMES, unique=True, max_size=3)):
        _write_attribute(draw, page, element, name)
    page.write(draw(BLANKS))
    if draw(st.integers(0, 3)) == 0:
        element.start_end = element.end_start = element.end = page.write("/>")[1]
        return
    element.start_end = page.write(">")[1]
    _write_content(draw, page, element, depth)
    element.end_start = page.write(f"</{tag}")[0]
    element.end = page.write(draw(BLANKS) + ">")[1]


def _write_attribute(draw: st.DrawFn, page: Page, element: Written, name: str) -> None:
    page.write(draw(GAPS))
    key = page.write(name)
    page.write(draw(BLANKS) + "=" + draw(BLANKS))
    quote, other = draw(st.sampled_from(["\"'", "'\""]))
    words = st.one_of(_WORD.filter(lambda word: "'" not in word), st.sampled_from([">", other]))
    written = draw(BLANKS).join(draw(st.lists(words, max_size=3)))
    page.write(quote)
    value = page.write(written)
    page.write(quote)
    # XML turns each line end and tab of an attribute into one blank.
    blank = written.replace("\r\n", " ").replace("\n", " ").replace("\t", " ")
    element.attributes[name] = (*key, *value, resolved(blank))


def _write_content(draw: st.DrawFn, page: Page, element: Written, depth: int) -> None:
    kinds = ["text", "comment", "cdata", "instruction", *(["element"] * (depth < 4))]
    before_child = True
    for kind in draw(st.lists(st.sampled_from(kinds), max_size=4)):
        if kind == "element":
            before_child = False
            _write_element(draw, page, depth + 1)
        elif kind == "comment":
            page.write("<!-- <not> 世 & -->")
        elif kind == "instruction":
            page.write("<?format 'a > b' ?>")
        else:
            _write_text(draw, page, element if before_child else None, kind == "cdata")
    element.text = element.text.strip(" \t\n")


def _write_text(draw: st.DrawFn, page: Page, element: Written | None, cdata: bool) -> None:
    front, word, back = draw(BLANKS), draw(_WORD), draw(BLANKS)
    page.write("<![CDATA[" if cdata else "")
    page.write(front)
    start, end = page.write(word)
    page.write(back)
    page.write("]]>" if cdata else "")
    if element is None:
        return
    value = front + word + back
    element.text += value.replace("\r\n", "\n") if cdata else resolved(value)
    first = element.text_range[0] if element.text_range else start
    element.text_range = (first, end)
