"""A name as a file writes it, and the thing that it mentions."""

from __future__ import annotations

from enum import StrEnum

from checker.base.record import Record
from checker.source.text import SourceText


class NameKind(StrEnum):
    """Kind of thing that a name represents."""

    MODEL = "model"
    LINK = "link"
    JOINT = "joint"
    FRAME = "frame"
    SENSOR = "sensor"
    TOPIC = "topic"
    MACRO = "macro"
    ARGUMENT = "argument"
    PROPERTY = "property"


PARTS = (NameKind.LINK, NameKind.FRAME, NameKind.MODEL, NameKind.JOINT)
"""Kinds of parts that are allowed where SDFormat expects a frame."""
FRAMES = (NameKind.LINK, NameKind.FRAME)
"""Kinds of parts that transforms of ROS connect."""
MODEL_ONLY, LINK_ONLY, JOINT_ONLY = (NameKind.MODEL,), (NameKind.LINK,), (NameKind.JOINT,)
SENSOR_ONLY, TOPIC_ONLY = (NameKind.SENSOR,), (NameKind.TOPIC,)
ANY_PART = (NameKind.JOINT, NameKind.LINK, NameKind.FRAME)
"""Kinds of parts that a text without a description may name."""


class Mention(Record):
    """A place where a thing is named.

    Attributes:
        kind: The kind of the thing.
        name: Its full name, as `arm::wrist`; two mentions of one thing have the same.
        scope: Path of the file that the thing belongs to: a model, the first of the xacro files
            that include each other, a launch file. Empty for the robot of the package.
        path: The file of the mention, relative to the package.
        start: Offset of the name's first character; of `arm::wrist`, that of `wrist`.
        end: Offset behind its last one.
        is_definition: Whether the thing is made here.
    """

    kind: NameKind
    name: str
    scope: str
    path: str
    start: int
    end: int
    is_definition: bool = False


class Role(StrEnum):
    """Certainty that a written name is the name of something.

    `DEFINES`: it makes the thing. `STATES`: it names a thing, and makes a frame where there is
    none. `NAMES`: it names a thing, which may be missing. `MAY_NAME`: it names a thing if there is
    one of that name.
    """

    DEFINES = "defines"
    STATES = "states"
    NAMES = "names"
    MAY_NAME = "may_name"


class WrittenName(Record):
    """A name in a file, before it is known what other files make of it.

    Attributes:
        kinds: What it may name, the likeliest first.
        name: The full name within the file; expressions as they are written.
        start: Offset of the name's first character.
        end: Offset behind its last one.
        role: The certainty of the mention.
        files: The names of files that an argument may be passed to, if it is passed on.
    """

    kinds: tuple[NameKind, ...]
    name: str
    start: int
    end: int
    role: Role
    files: tuple[str, ...] = ()


class Included(Record):
    """A file that another one includes.

    Attributes:
        uri: The URI as it is written.
        name: Full name of the model that it becomes, as far as the includer gives one; of a model
            whose parts become the includer's own, the prefix of these.
        merged: Whether they do.
        by_xacro: Whether xacro includes it.
    """

    uri: str
    name: str = ""
    merged: bool = False
    by_xacro: bool = False


class FileNames(Record, eq=False):
    """The names of one file.

    Attributes:
        source: The text that they were read from.
        format: `sdf`, `robot` (URDF, xacro), `srdf`, `launch`, `yaml`, `ruby` or `python`.
        names: The names in no order.
        included: Files that it includes.
        values: Texts that expressions of the file may have as values.
        parameters: Names of the parameters of its macros.
        model: Name of the model or robot that the file contains.
        fault: The reason why it cannot be read; empty if it can.
    """

    source: SourceText
    format: str
    names: tuple[WrittenName, ...] = ()
    included: tuple[Included, ...] = ()
    values: frozenset[str] = frozenset()
    parameters: frozenset[str] = frozenset()
    model: str = ""
    fault: str = ""
