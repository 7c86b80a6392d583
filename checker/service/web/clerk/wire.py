"""What a clerk in another process is told, and what it answers: a line of JSON each."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from msgspec import to_builtins

from checker.service.jobs.port import JobsUnreachable
from checker.service.web.clerk.port import Slip
from checker.service.web.refusal import Refused


class ClerkFailed(Exception):
    """A clerk came upon a fault of ours; its log tells."""


def slip_to_line(number: int, slip: Slip) -> bytes:
    """Return an upload and its number as a line."""
    return _line([number, to_builtins(slip)])


def slip_from_line(line: bytes) -> tuple[int, Slip]:
    """Return the upload that a line tells of, and its number."""
    number, slip = json.loads(line)
    return number, Slip(**slip)


def answer_line(number: int, take: Callable[[], str], on_fault: Callable[[], object]) -> bytes:
    """Take an upload, and return what became of it as a line.

    Args:
        number: Of the upload.
        take: Returns the id of a check, or raises what `Clerk.take` says.
        on_fault: Called while any other exception is handled.
    """
    return _line([number, _answer(take, on_fault)])


def _answer(take: Callable[[], str], on_fault: Callable[[], object]) -> Mapping[str, Any]:
    try:
        return {"id": take()}
    except Refused as refused:
        return {"refused": to_builtins(refused)}
    except JobsUnreachable as error:
        return {"unreachable": str(error)}
    except OSError as error:
        return {"disk": [error.errno, error.strerror]}
    except Exception:  # noqa: BLE001 - whatever it is, the next upload is taken all the same
        on_fault()
        return {}


def answer_from_line(line: bytes) -> tuple[int, Mapping[str, Any]]:
    """Return what a line answers, for `id_in`, and the number of the upload."""
    number, answer = json.loads(line)
    return number, answer


def id_in(answer: Mapping[str, Any]) -> str:
    """Return the id of the check that was ordered.

    Raises:
        Refused: The upload was refused.
        JobsUnreachable: The order could not be taken.
        OSError: The upload could not be kept.
        ClerkFailed: The clerk has a fault.
    """
    match answer:
        case {"id": str(id)}:
            return id
        case {"refused": dict(refused)}:
            raise Refused(**refused)
        case {"unreachable": str(reason)}:
            raise JobsUnreachable(reason)
        case {"disk": [number, reason]}:
            raise OSError(number, reason)
        case _:
            raise ClerkFailed


def _line(said: object) -> bytes:
    return json.dumps(said).encode() + b"\n"
