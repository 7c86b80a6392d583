"""Faults after which a reader continues: rules turn them into findings."""

from __future__ import annotations

import enum

from checker.base.record import Record
from checker.source.text import Span


class FaultKind(enum.Enum):
    """Kind of a fault that a reader found."""

    VALUE = "a value is not of its type"
    FRAME = "a frame is unknown or depends on itself"
    INCLUDE = "an included model cannot be read"


class Fault(Record, eq=False):
    """One fault in a user's file."""

    kind: FaultKind
    span: Span
    message: str
