"""Progress on one line of a terminal, which is overwritten each time."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

from checker.base.words import plain, shortened

_COLUMNS = 80
"""Width of a terminal that does not report it."""
_BAR = 20
"""Characters of the bar."""


class ProgressLine:
    """Progress of a run on one line of a terminal; no output if standard error is no terminal.

    Attributes:
        total: Things to do; the bar is shown when there are several.
        done: The finished items.
    """

    def __init__(self, total: int = 1) -> None:
        self.total = total
        self.done = 0
        self._is_shown = False
        self._is_visible = sys.stderr.isatty()

    def say(self, words: str) -> None:
        """Show what begins."""
        self._write(shortened(f"{self._bar()}{plain(words)}", self._width()))
        self._is_shown = True

    def advance(self) -> None:
        """Count one more thing as done."""
        self.done += 1
        if self.done < self.total:
            self.say("")

    def clear(self) -> None:
        """Leave the line to what is printed next."""
        if self._is_shown:
            self._write("")
            self._is_shown = False

    def _bar(self) -> str:
        if self.total < 2:
            return ""
        full = _BAR * self.done // self.total
        return f"[{'#' * full}{'.' * (_BAR - full)}] {self.done} of {self.total}  "

    @staticmethod
    def _width() -> int:
        try:
            columns = os.get_terminal_size(sys.stderr.fileno()).columns
        except OSError:
            columns = 0
        return max(20, (columns or _COLUMNS) - 1)

    def _write(self, text: str) -> None:
        if self._is_visible:
            with suppress(OSError):
                sys.stderr.write(f"\r\x1b[K{text}")
                sys.stderr.flush()
