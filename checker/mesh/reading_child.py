"""What a child has read: as many answers as there were files, or why there are none."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any, TypeVar

from checker.confined import Child, Died

T = TypeVar("T")


def all_read(child: Child, number: int, from_json: Callable[[Any], T]) -> list[T] | str:
    """Wait for a child that reads mesh files.

    Args:
        child: It answers with a JSON list.
        number: Of files that it was given.
        from_json: Makes what was read of an entry; raises TypeError or ValueError for nonsense.

    Returns:
        What was read, in the order of the files; else why it was not, the end of a sentence.
    """
    answer = child.answer()
    if isinstance(answer, Died):
        return f"was not read: its reader {answer.reason}"
    try:
        read = [from_json(each) for each in json.loads(answer)]
    except (TypeError, ValueError):
        read = []
    return read if len(read) == number else "was not read: its reader answered with nonsense"
