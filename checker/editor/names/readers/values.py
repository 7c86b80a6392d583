"""Names in texts that have no schema: values of YAML, Ruby, Python and launch files, and of macros.

Only a whole text counts, a word of a command line, or a whole step of a path such as
`arm::wrist`, `/model/X1/link/wrist` or `$(arg name)/wrist`; never a part of another word.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from checker.editor.names.mention import (
    ANY_PART,
    FRAMES,
    JOINT_ONLY,
    LINK_ONLY,
    MODEL_ONLY,
    SENSOR_ONLY,
    TOPIC_ONLY,
    NameKind,
    Role,
    WrittenName,
)
from checker.editor.names.readers.expressions import is_composed, is_computed
from checker.editor.names.readers.topics import is_topic, topic_key

ELSEWHERE = ("",)
"""Represents any file but the one that passes an argument."""
LENGTH_LIMIT = 20_000
"""Characters; a longer text names nothing."""

_EXPRESSION = r"\$\([^()]{0,400}\)|\$\{[^{}]{0,400}\}|#\{[^{}]{0,400}\}"
_WORD = re.compile(
    rf"""(?:{_EXPRESSION}|[^\s"',\[\]=])+(?:=(?:{_EXPRESSION}|[^\s"',])*|[\[\]@]\S*)?"""
)
_LISTED = re.compile(rf"(?:{_EXPRESSION}|[^\s,\[\]\"'])+")
_COMPUTED = re.compile(_EXPRESSION)
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_PASSED = re.compile(r"([A-Za-z_]\w*):=")
_REMAPPED = re.compile(r"((?:/|~/)[^\s:]*):=")
_STEP = re.compile(r"(?<![^/])(model|link|joint|sensor)/([^/]+)")
_FILE = re.compile(r"(?<![\w.-])[\w.-]{1,200}\.(?:launch(?:\.(?:py|xml|ya?ml))?|xacro|urdf|xml)\b")
STEP_KINDS = {
    "model": MODEL_ONLY,
    "link": LINK_ONLY,
    "joint": JOINT_ONLY,
    "sensor": SENSOR_ONLY,
}
_NAMES_NO_PART = frozenset(
    (
        *("name", "names", "type", "class", "pkg", "package", "exec", "executable", "ns", "output"),
        *("namespace", "plugin", "filename", "file", "url", "uri", "doc", "description", "node"),
        *("path", "world", "world_name", "robot_name", "encoding", "direction", "respawn", "if"),
        *("unless", "condition", "version", "xmlns", "machine", "required", "launch_prefix"),
        *("ros_type_name", "gz_type_name", "ign_type_name", "battery_name", "plugin_type"),
        *("command_interfaces", "state_interfaces", "interface_name", "on_exit", "cmd"),
    )
)
"""Keys whose values name no part of a robot."""
_BY_WORD: Mapping[str, tuple[NameKind, ...]] = {
    "topic": TOPIC_ONLY,
    "remap": TOPIC_ONLY,
    "sensor": SENSOR_ONLY,
    "frame": FRAMES,
    "joint": JOINT_ONLY,
    "wheel": (NameKind.JOINT, NameKind.LINK),
    "link": LINK_ONLY,
}
"""Kinds of names of a value, by a word in its key; the first that fits counts."""


def kinds_of(key: str) -> tuple[NameKind, ...]:
    """Return what a value may name by the key, tag or argument that it is given to."""
    word = key.lower()
    if word in _NAMES_NO_PART:
        return ()
    for part, kinds in _BY_WORD.items():
        if part in word:
            return kinds
    return ANY_PART


def files_named(text: str) -> tuple[str, ...]:
    """Return the names of launch and xacro files in a text, without their folders."""
    return tuple(dict.fromkeys(_FILE.findall(text)))


def names_in(
    value: str, start: int, key: str = "", *, words: bool = False
) -> Iterator[WrittenName]:
    """Yield what a text may name.

    Args:
        value: The text.
        start: Its offset in the file.
        key: The key of the value, which determines what it may name.
        words: Whether it is a command line, each word of which counts.
    """
    if not 0 < len(value) <= LENGTH_LIMIT:
        return
    if not words and ":=" not in value:
        stripped = value.strip()
        if not any(map(str.isspace, _without_expressions(stripped))):
            yield from _names_in_word(stripped, start + value.index(stripped), key)
        return
    files = files_named(value)
    for match in _WORD.finditer(value):
        yield from _names_in_argument(match.group(), start + match.start(), key, files)


def words_in(value: str, start: int, key: str = "") -> Iterator[WrittenName]:
    """Yield what a list of words, with blanks or commas between, may name."""
    for match in _LISTED.finditer(value[:LENGTH_LIMIT]):
        yield from _names_in_word(match.group(), start + match.start(), key)


def _without_expressions(text: str) -> str:
    return _COMPUTED.sub("", text)


def _names_in_argument(
    word: str, start: int, key: str, files: tuple[str, ...]
) -> Iterator[WrittenName]:
    """Yield what a word of a command line may name: `x:=y`, `topic@type[type`, or a name."""
    if passed := _PASSED.match(word):
        name, end = passed[1], start + len(passed[1])
        kinds = (NameKind.ARGUMENT,)
        yield WrittenName(kinds, name, start, end, Role.MAY_NAME, files or ELSEWHERE)
        yield from _names_in_word(word[passed.end() :], start + passed.end(), name)
    elif remapped := _REMAPPED.match(word):
        yield from _topic(remapped[1], start)
        yield from _topic(word[remapped.end() :], start + remapped.end())
    elif "@" in word:
        topic = word.partition("@")[0]
        yield from _topic(topic, start)
        yield from steps_in(topic, start)
    else:
        yield from _names_in_word(word, start, key)


def _names_in_word(word: str, start: int, key: str) -> Iterator[WrittenName]:
    kinds = kinds_of(key)
    if not word or _NUMBER.fullmatch(word):
        return
    if "@" in word and "/" in word and re.search(r"@[\w./]+[@\[\]]", word):
        yield from _names_in_argument(word, start, key, ())
        return
    plain = _without_expressions(word)
    if "://" in plain or not kinds:
        return
    if "::" in plain:
        yield from scoped_names(word, start, kinds, Role.MAY_NAME)
    elif "/" in plain:
        yield from steps_in(word, start)
        yield from _prefixed(word, start, kinds)
        if kinds == TOPIC_ONLY or plain.startswith("/") or word.startswith(("$(arg", "#{")):
            yield from _topic(word, start)
    elif kinds == TOPIC_ONLY:
        yield from _topic(word, start)
    elif not is_computed(word):
        yield WrittenName(kinds, word, start, start + len(word), Role.MAY_NAME)


def _topic(word: str, start: int) -> Iterator[WrittenName]:
    if is_topic(word):
        key, own = topic_key(word)
        yield WrittenName(TOPIC_ONLY, key, start + own, start + len(word), Role.MAY_NAME)


def steps_in(word: str, start: int) -> Iterator[WrittenName]:
    """Yield the parts that a topic of Gazebo names: `model/X1/link/base_link/sensor/imu`."""
    above: list[str] = []
    for match in _STEP.finditer(word):
        kind, name = match.groups()
        if is_computed(name):
            continue
        at = start + match.start(2)
        full = f"{above[-1]}::{name}" if kind == "sensor" and above else name
        yield WrittenName(STEP_KINDS[kind], full, at, at + len(name), Role.MAY_NAME)
        if kind in ("link", "joint"):
            above.append(name)


def _prefixed(word: str, start: int, kinds: tuple[NameKind, ...]) -> Iterator[WrittenName]:
    """Yield the frame of a text such as `$(arg name)/base_link`."""
    first, _, rest = word.rpartition("/")
    is_prefix = bool(first) and "/" not in _without_expressions(first)
    if not is_prefix or not rest or "$(find" in first or is_computed(rest):
        return
    if kinds == FRAMES or (is_composed(first) and kinds != TOPIC_ONLY):
        at = start + len(first) + 1
        yield WrittenName(kinds, rest, at, at + len(rest), Role.MAY_NAME)


def scoped_names(
    name: str, start: int, kinds: tuple[NameKind, ...], role: Role, prefix: str = ""
) -> Iterator[WrittenName]:
    """Yield each part of a scoped name: of `arm::wrist`, the model and what is in it.

    Args:
        name: The name as it is written.
        start: Its offset.
        kinds: What the last part may be.
        role: The role of all parts.
        prefix: Its prefix: empty, or `robot::`.
    """
    steps = name.split("::")
    at, full = start, prefix
    for number, step in enumerate(steps, 1):
        is_last = number == len(steps)
        full += step
        if step and not is_computed(step):
            above = MODEL_ONLY if role is not Role.MAY_NAME else (NameKind.MODEL, NameKind.LINK)
            yield WrittenName(kinds if is_last else above, full, at, at + len(step), role)
        at, full = at + len(step) + 2, full + "::"
