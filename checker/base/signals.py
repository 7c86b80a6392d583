"""Requests to end, which come as signals."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Collection


def on_requests_to_end(numbers: Collection[signal.Signals], *do: Callable[[], object]) -> None:
    """Run one function at the first of some signals, another at the second, and so on.

    A separate thread does it, woken by the signal itself. Python runs handlers in the main thread
    alone: that sleeps on where the system gives the signal to another thread, as it does now and
    then where threads start processes, and a handler may interrupt it within `Event.wait`, where it
    holds the lock that `Event.set` waits for.

    Args:
        numbers: The numbers of the signals.
        do: The actions, in this order; further signals do nothing.
    """
    reader, writer = os.pipe()  # open until the process ends
    if sys.platform != "win32":
        os.set_blocking(writer, False)

    def in_turn() -> None:
        for action in do:
            while os.read(reader, 1)[0] not in numbers:
                pass  # a signal that other code handles
            action()

    threading.Thread(target=in_turn, daemon=True, name="requests to end").start()
    signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    for number in numbers:
        signal.signal(number, _do_nothing)


def _do_nothing(_number: int, _frame: object) -> None:
    """Handle a signal, so that it is reported and does not end the process."""
