"""What a child has read: as many answers as there were files, or why there are none."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from checker.base.child_process import NONSENSE, Child, Died, from_json

T = TypeVar("T")


def all_read(child: Child, number: int, decode: Callable[[Any], T]) -> list[T] | str:
    """Wait for a child that reads mesh files.

    Args:
        child: It answers with a JSON list.
        number: Of files that it was given.
        decode: Makes what was read of an entry; what it raises for nonsense is in `NONSENSE`.

    Returns:
        What was read, in the order of the files; else why it was not, the end of a sentence.
    """
    answer = child.answer()
    if isinstance(answer, Died):
        return f"was not read: its reader {answer.reason}"
    try:
        read = [decode(each) for each in from_json(answer)]
    except NONSENSE:
        read = []
    return read if len(read) == number else "was not read: its reader answered with nonsense"
