"""Links of a sheet to measurements of the real robot: videos, recordings, logs."""

from __future__ import annotations

import enum
import re
from collections.abc import Iterator

from checker.source.markdown import MAX_LENGTH
from checker.source.text import SourceText, Span


class Proven(enum.Enum):
    """Quality that a measurement proves; the words identify the sentences about it."""

    ENDURANCE = r"endurance|batter(?:y|ies)|run(?:ning)?[ -]?times?|drain\w*"
    SPEED = r"speeds?|velocit(?:y|ies)|motion|linear"


_COMMENT = re.compile(r"<!--.*?(?:-->|\Z)", re.DOTALL)
_URL = re.compile(r"https?://[^\s)>\]\\]{3,2000}")
_PLACEHOLDER = re.compile(r"x{3,}|\.\.\.|…|//(?:www\.)?example\.", re.IGNORECASE)
_OF_THE_ROBOT = (
    r"validat\w*|endurance|(?:top |max\w* )?speeds?|velocit(?:y|ies)|turning|rotation|motion"
    r"|acceleration|flights?|driv(?:es?|ing)|telemetry|run(?:ning)?[ -]?times?"
)
_RECORDED = re.compile(
    r"\b(?:tests?|testing|videos?|record\w*|(?:data)?logs?|bags?|bagfiles?|measure\w*"
    rf"|experiments?|{_OF_THE_ROBOT})\b",
    re.IGNORECASE,
)
_ROBOT = re.compile(rf"\b(?:{_OF_THE_ROBOT})\b", re.IGNORECASE)
_DEVICE = re.compile(
    r"\b(?:lidars?|(?:web)?cam(?:era)?s?|imus?|rgb-?d|sensors?|gimbals?|altimeters?|compass(?:es)?"
    r"|magnetometers?|radars?|gps|gnss|encoders?|detectors?|computers?|controllers?|radios?"
    r"|motors?|lens(?:es)?|datasheets?)\b",
    re.IGNORECASE,
)
_SHARED = re.compile(
    r"//(?:[\w-]+\.)*(?:youtube\.com|youtu\.be|vimeo\.com|drive\.google\.com|docs\.google\.com"
    r"|dropbox\.com|onedrive\.live\.com|1drv\.ms|box\.com)/",
    re.IGNORECASE,
)
"""Sites where teams publish videos and logs; manufacturers' pages are elsewhere."""
_DATASHEETS = re.compile(r"\b(?:sensors?|specifications?|datasheets?|components?|parts)\b", re.I)
_WORD = re.compile(r"[^\W\d_]{2}")

_PRODUCT = re.compile(rf"{_DEVICE.pattern}|\bproducts?\b", re.IGNORECASE)

# Sentences that say that a test was not made, or is still planned.
_SENTENCE = re.compile(r"(?:[^.\n]|\.(?=\w)){1,1000}")
_TEST = r"(?:tests?|testing|tested|validat\w*|measure\w*|videos?|proofs?|recordings?|data|logs?)"
_DO = r"(?:perform|make|do|run|conduct|test|measure|validate|provide|verify|complete|record)"
_DONE = (
    r"(?:made|done|tested|validated|measured|verified|performed|completed?|conducted|carried out"
    r"|finished|recorded|available|provided|added|uploaded|confirmed|determined|possible|able)"
)
_OPEN = re.compile(
    rf"(?:\bnot|n't|\bnever)(?: \w+){{0,2}} {_DONE}\b|\buntested\b|\bTB[DA]\b|\bTODO\b"
    rf"|\bto be {_DONE}\b|\b(?:will|shall) be {_DONE}\b|\b(?:pending|outstanding)\b"
    rf"|\buntil\b.{{0,80}}?\b{_TEST}\b|\b(?:unable to|could not|couldn't|cannot) {_DO}\b"
    r"|\bno (?:\w+ ){0,2}(?:tests?|validation|measurements?|videos?|recordings?|proof)\b",
    re.IGNORECASE,
)
_ABOUT_TESTS = re.compile(rf"\b{_TEST}\b", re.IGNORECASE)
_ABOUT = {what: re.compile(rf"\b(?:{what.value})\b", re.IGNORECASE) for what in Proven}
MAX_LINKS = 500
_NEAR = 500
"""Characters before and behind a link that may state what it is about."""
_TURNING = re.compile(r"\b(?:angular|turning|radius|rotation\w*|yaw)\b", re.IGNORECASE)
_LINEAR = re.compile(r"\b(?:linear|[xyz])\b", re.IGNORECASE)
_OTHER = re.compile(r"\b(?:mass|weight|acceleration\w*|flippers?)\b", re.IGNORECASE)


def is_left_open(text: str, what: Proven, *, alone: bool) -> bool:
    """Return whether a text states that the test was not made or is still planned.

    Args:
        text: The text of a section.
        what: The subject of the test; sentences about the test of something else do not count.
        alone: Whether the section is about that alone: then `the tests are not completed` is, too.
    """
    for match in _SENTENCE.finditer(text[:MAX_LENGTH]):
        sentence = _URL.sub(" ", match.group())
        if _OPEN.search(sentence) and (
            _is_about(sentence, what) or (alone and _is_about_tests(sentence))
        ):
            return True
    return False


def is_about(link: Span, what: Proven) -> bool:
    """Return whether the line of a link names the subject of the test, near the link."""
    text = link.source.text
    before = text[max(0, link.start - _NEAR) : link.start].rpartition("\n")[2]
    behind = text[link.end : link.end + _NEAR].partition("\n")[0]
    return _is_about(_URL.sub(" ", f"{before} {behind}"), what)


def _is_about(sentence: str, what: Proven) -> bool:
    if _ABOUT[what].search(sentence) is None:
        return False
    turning = _TURNING.search(sentence) and not _LINEAR.search(sentence)
    return what is not Proven.SPEED or not turning


def _is_about_tests(sentence: str) -> bool:
    """Return whether a sentence is about tests in general."""
    particular = [_TURNING, _OTHER, *_ABOUT.values()]
    return _ABOUT_TESTS.search(sentence) is not None and not any(
        each.search(sentence) for each in particular
    )


def links_in_list(source: SourceText, start: int, end: int) -> Iterator[Span]:
    """Yield links to measurements in the section on validation.

    Words in the line such as `speed test` state what a link is; one without any word counts, unless
    it is below a line such as `Sensors:` or is that of a product. Lines about a device or about
    a planned test prove nothing, nor do placeholders such as `https://youtu.be/xxxx`.
    """
    label = ""
    for offset, line in _lines(source, start, end):
        words = _URL.sub(" ", line)
        plain = _WORD.search(words) is None
        for match in _URL.finditer(line) if not _OPEN.search(words) else ():
            if plain:
                product = _DATASHEETS.search(label) or _PRODUCT.search(match.group())
                counts = _is_shared(match.group()) or not product
            else:
                recorded = _is_shared(match.group()) or _RECORDED.search(words)
                counts = bool(recorded) and not _is_of_device(words)
            if counts and not _PLACEHOLDER.search(match.group()):
                yield Span(source, offset + match.start(), offset + match.end())
        if offset > start and words == line and line.strip():
            label = line


def links_in_text(source: SourceText, start: int, end: int) -> Iterator[Span]:
    """Yield links to videos and logs in the section about what they prove: the host states it."""
    for offset, line in _lines(source, start, end):
        for match in _URL.finditer(line) if not _is_of_device(_URL.sub(" ", line)) else ():
            if _is_shared(match.group()) and not _PLACEHOLDER.search(match.group()):
                yield Span(source, offset + match.start(), offset + match.end())


def _is_shared(url: str) -> bool:
    return _SHARED.search(url) is not None


def _is_of_device(words: str) -> bool:
    return _DEVICE.search(words) is not None and _ROBOT.search(words) is None


def _lines(source: SourceText, start: int, end: int) -> Iterator[tuple[int, str]]:
    # Blanks of the same length keep the offsets.
    text = _COMMENT.sub(lambda match: " " * len(match.group()), source.text[:MAX_LENGTH])
    offset = start
    for line in text[start:end].splitlines(keepends=True):
        yield offset, line
        offset += len(line)
