"""Names of submissions in running text: whose package a sentence is about."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import SequenceMatcher

NAME = re.compile(r"(?<![\w/-])[a-z0-9]+(?:_[a-z0-9]+){0,8}?_sensor_config_\d{1,4}(?!\w)", re.I)
"""A package name of the challenge's form, such as `acme_rover_sensor_config_1`."""

NAME_IN_PATH = re.compile(
    r"(?<![a-z0-9])[a-z0-9]+(?:_[a-z0-9]+){0,8}?_sensor_config_\d{1,4}(?!\w)", re.I
)
"""The same, also as a part of a URI or path."""

_TEMPLATE = re.compile(
    r"\bThe (\w{1,100}_\w{1,100})(?P<kind>(?: [a-z]{1,30}){1,3})? package\b", re.I
)
"""The description that `catkin_create_pkg` writes; authors add what kind of robot it is."""
_SUBJECT = re.compile(r"\W*The (\w{1,200}_sensor_config_\d{1,4}) (?:is|has)\b", re.I)
_EXPLAINED = re.compile(r" (?:based|derived|like)\b", re.I)

_ONE = r"(\d{1,3})\b(?!\s*(?:to|and|-|,|&|or)\s*\d)"
NUMBERED = rf"(?:sensor[\s_]+)?config(?:uration)?[\s_#]+{_ONE}"
"""A configuration by its number, in plain words: `Sensor Config 1`."""

_TITLE = re.compile(r"^#{1,3}[ \t]*(\S[^\n]*?sensor[ _]config(?:uration)?[ _]\d+)", re.M | re.I)
_NUMBERED = re.compile(rf"(?<![a-z])config(?:uration)?[\s_#-]{{0,3}}{_ONE}", re.I)
_MEANT = re.compile(
    r"\b(?:as|based|copy|copied|derived|extends|from|identical|in|inherits|like|of|on|see|than"
    r"|same|to|uses|version|with)\W+(?:\w+\W+){0,2}\Z",
    re.I,
)
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_NOT_LINE_END = re.compile(r"[^\r\n]")
_LOOK_BACK = 60
_DIGITS = 6
_NUMBER = re.compile(r"_sensor_config_\d+\Z", re.I)


def robot_of(name: str) -> str:
    """Return a package's name without the number of its configuration."""
    return _NUMBER.sub("", name)


def configuration_number(name: str) -> int | None:
    """Return the number of a package's configuration; None if its name has none."""
    match = _NUMBER.search(name)
    digits = match.group().rpartition("_")[2] if match else ""
    return int(digits) if 0 < len(digits) <= _DIGITS else None


def described_package(text: str, *names: str) -> str:
    """Return the other package that a description of the template's form is about, else nothing."""
    match = _TEMPLATE.search(text) or _SUBJECT.match(text)
    if match is None:
        return ""
    other = match[1].casefold()
    # `arm_interfaces` may say that its interfaces are those of the package `arm`.
    if any(name.casefold() == other or name.casefold().startswith(f"{other}_") for name in names):
        return ""
    if _MEANT.search(text[max(0, match.start() - _LOOK_BACK) : match.start()]):
        return ""
    kind = match.groupdict().get("kind") or ""
    # With more words than the template has, only the name of a submission is surely a package's.
    return "" if kind and (_EXPLAINED.search(kind) or not NAME.fullmatch(match[1])) else match[1]


def stated_number(text: str) -> int | None:
    """Return the one configuration that plain words name; None if they name none or several."""
    numbers = set(map(int, _NUMBERED.findall(text)))
    return numbers.pop() if len(numbers) == 1 else None


def is_same_robot(name: str, other: str) -> bool:
    """Return whether two packages are configurations of one robot, of any organization."""
    short, long = sorted((robot_of(name).casefold(), robot_of(other).casefold()), key=len)
    return f"_{long}".endswith(f"_{short}")


_NEAR = 0.7
_SHORT = 3
_WORD = re.compile(r"[_-]")


def is_slip_for(written: str, meant: str) -> bool:
    """Return whether a package's name is another one's with one word misspelt or left out.

    Words with digits and short ones distinguish robots, and so does a first word that only one of
    them has: none of these is a slip.
    """
    short, long = sorted((_WORD.split(written.casefold()), _WORD.split(meant.casefold())), key=len)
    if "".join(short) == "".join(long):
        return True
    differing = [
        index for index, pair in enumerate(zip(short, long, strict=False)) if len(set(pair)) > 1
    ]
    if len(short) == len(long):
        words = [(short[index], long[index]) for index in differing]
        return len(words) == 1 and all(map(str.isalpha, words[0])) and _is_near(*words[0])
    if len(short) + 1 != len(long):
        return False
    at = differing[0] if differing else len(short)
    lost = long[at]
    is_left_out = short == [*long[:at], *long[at + 1 :]]
    return is_left_out and (not differing if lost.isdigit() else at > 0 and len(lost) > _SHORT)


def _is_near(word: str, other: str) -> bool:
    near = SequenceMatcher(None, word, other).ratio() >= _NEAR
    return near and min(len(word), len(other)) > _SHORT


def blank_xml_comments(text: str) -> str:
    """Replace XML comments by blanks, every other character where it was."""
    if "-->" not in text:
        return text
    last = text.rindex("-->") + 3
    blanked = _COMMENT.sub(lambda comment: _NOT_LINE_END.sub(" ", comment.group()), text[:last])
    return blanked + text[last:]


def left_from_copying(text: str, own: str) -> Iterator[re.Match[str]]:
    """Yield the names of other robots' packages that no word in front explains.

    `derived from x1_sensor_config_4` states where a robot comes from; `The x1_sensor_config_4
    package` is left from a copy.
    """
    for match in NAME.finditer(text):
        before = text[max(0, match.start() - _LOOK_BACK) : match.start()]
        if not is_same_robot(match.group(), own) and _MEANT.search(before) is None:
            yield match


def title_of_another(sheet: str, own: str) -> re.Match[str] | None:
    """Return the title of a specification sheet if it shares no word with the robot's name."""
    title = _TITLE.search(sheet)
    words = set(re.split(r"[\W_]+", title.group(1).casefold())) if title else set()
    is_other = words.isdisjoint(robot_of(own).casefold().split("_"))
    return title if is_other else None
