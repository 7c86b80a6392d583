"""Doing one thing after the other in several processes, which all end when one is interrupted.

The workers of `concurrent.futures` continue with their next item when they should terminate, and
its executor waits for them: an interrupted check would end after some twenty seconds.
"""

from __future__ import annotations

import multiprocessing
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, TypeVar

from checker.base.garbage_collection import collect_between
from checker.base.output import Say

Given = TypeVar("Given")
Made = TypeVar("Made")
_SAID, _MADE, _RAISED = "said", "made", "raised"
"""Kinds of what a process sends."""
_ENDS_SECONDS = 0.3
"""Time for running work to end; processes that still run then are killed."""


def map_in_processes(
    work: Callable[[Given, Say], Made], items: Sequence[Given], processes: int, say: Say
) -> Iterator[Made]:
    """Yield what is made of each item, in their order.

    Args:
        work: A function that another process can import; it is called with an item, and with what
            it may call with a message.
        items: What can be sent to another process; none of them is None.
        processes: The greatest number of processes.
        say: Called here with the messages of all processes.

    Raises:
        RuntimeError: A process ended before its work was done.
    """
    started = [_Process(work) for _ in range(min(processes, len(items)))]
    try:
        yield from _made(started, items, say)
        for process in started:
            process.finish()
    finally:
        # An interrupt does not wait for the work of the others.
        for process in started:
            process.ask_to_end()
        for process in started:
            process.end()


def _made(processes: Sequence[_Process], items: Sequence[Any], say: Say) -> Iterator[Any]:
    """Hand out the items, and yield what comes back in their order."""
    at = {process.connection: process for process in processes}
    waiting = list(range(len(items)))[::-1]
    known: dict[int, Any] = {}
    for process in processes:
        process.take(waiting.pop(), items)
    for number in range(len(items)):
        while number not in known:
            for connection in wait([process.connection for process in processes]):
                process = at[connection]  # type: ignore[index]  # we gave connections alone
                kind, value = process.receive()
                if kind == _SAID:
                    say(value)
                    continue
                known[process.number] = value
                if waiting:
                    process.take(waiting.pop(), items)
        yield known.pop(number)


class _Process:
    """A process, and the number of the item that it works on."""

    def __init__(self, work: Callable[[Any, Say], Any]) -> None:
        self.number = 0
        self.connection, theirs = multiprocessing.Pipe()
        self._process: BaseProcess = multiprocessing.get_context().Process(
            target=_serve, args=(theirs, work)
        )
        self._process.start()
        theirs.close()

    def take(self, number: int, items: Sequence[Any]) -> None:
        self.number = number
        self.connection.send(items[number])

    def receive(self) -> tuple[str, Any]:
        """Return a message or a result, with its kind."""
        try:
            kind, value = self.connection.recv()
        except EOFError:
            raise RuntimeError("a process ended before its work was done") from None
        if kind == _RAISED:
            raise value
        return kind, value

    def finish(self) -> None:
        """Let it end by itself."""
        # Not by closing the pipe: processes that were forked later hold it, too.
        self.connection.send(None)
        self._process.join()

    def ask_to_end(self) -> None:
        if self._process.is_alive():
            self._process.terminate()

    def end(self) -> None:
        self._process.join(_ENDS_SECONDS)
        if self._process.is_alive():
            self._process.kill()


def _serve(connection: Connection, work: Callable[[Any, Say], Any]) -> None:
    """Work on what comes, until nothing can come any more."""
    # A key that interrupts reaches all processes of a terminal: the parent ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # What it has begun is put away on the way out.
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))

    def say(words: str) -> None:
        connection.send((_SAID, words))

    with suppress(EOFError, BrokenPipeError):
        for item in collect_between(iter(connection.recv, None)):
            try:
                answer: tuple[str, Any] = _MADE, work(item, say)
            except Exception as error:  # noqa: BLE001 - raised again in the parent
                answer = _RAISED, error
            connection.send(answer)
