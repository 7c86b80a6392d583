"""A section of specifications.md is missing or empty.

Teams choose a robot by these ten sections, and reviewers check them one by one. A section without
content still needs a sentence: "no additional restrictions".

Fix: add the section, or write one sentence into it.
Source: the template of the SubT challenge; 45 of 47 accepted sheets have all ten
(`subt_standards.json`).
"""

from collections.abc import Sequence

from checker.base.resources import table
from checker.model.specification.sheet import Section, Specification
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

KEY = "sections"


@rule("DOC001", "section-missing", Severity.WARNING, Concern.PAPERWORK)
def check(specification: Specification, *, sections: tuple[str, ...] = ()) -> Findings:
    """Look for headings that contain the words of `sections`, and for text below them.

    Options:
        sections: Words that some heading must contain, in upper or lower case; an empty list means
            the ten sections of the SubT template.
    """
    wanted: Sequence[str] = sections or table("subt_standards")["specifications_md"]["required"]
    of_words = {words: _sections(specification, words) for words in wanted}
    missing = [words for words, having in of_words.items() if not having]
    if missing and specification.unread:
        yield unchecked(specification.unread)
        missing = []
    empty = [
        having[0]
        for having in of_words.values()
        if having and all(specification.says_nothing(section) for section in having)
    ]
    phrases = []
    if missing:
        phrases.append(f"{_are(missing)} missing: {', '.join(missing)}")
    if empty:
        phrases.append(f"{_are(empty)} empty: {', '.join(section.title for section in empty)}")
    for section in empty:
        yield finding(section, "; ".join(phrases), key=KEY)
    if missing and not empty:
        yield finding(specification.source.whole(), phrases[0], key=KEY)


def _are(things: Sequence[object]) -> str:
    return "a section is" if len(things) == 1 else f"{len(things)} sections are"


def _sections(specification: Specification, words: str) -> list[Section]:
    """Return the sections whose headings contain the words, even joined to other words."""
    words = words.casefold()
    return [section for section in specification.sections if words in section.title.casefold()]


_HEADINGS = (
    "Description",
    "Usage Instructions",
    "Usage Rights",
    "Cost and Scale",
    "Sensors",
    "Control",
    "Motion Characteristics",
    "Endurance Characteristics",
    "Diversions from Physical Hardware of Rover",
    '<a name="validation_links"></a>Rover Validation and Specification Links',
)


def _sheet(without: str = "", mark: str = "", empty: str = "") -> str:
    sections = (
        f"## {heading}\n" if heading == empty else f"## {heading}\nWords.\n"
        for heading in _HEADINGS
        if heading != without
    )
    return f"# Rover{mark}\n" + "\n".join(sections)


_MARK = " <!-- ^ DOC001 -->"

GOOD = [
    {"specifications.md": _sheet()},
    {"specifications.md": _sheet().replace("## Motion", "#### Rover's motion").lower()},
    {
        "specifications.md": _sheet().replace(
            "Usage Instructions\nWords.", "Usage Instructions\n```\nroslaunch\n```"
        )
    },
    {"specifications.md": _sheet().replace("## Control\nWords.", "## Control\n### A\nWords.")},
]
BAD = [
    {"specifications.md": _sheet("Control", _MARK)},
    {"specifications.md": _sheet().replace("Usage Rights\nWords.", f"Usage Rights{_MARK}")},
    {
        "specifications.md": _sheet("Control").replace(
            "Usage Rights\nWords.", f"Usage Rights{_MARK}\n<!-- ask -->"
        )
    },
]
