"""The parser of the command line: wrong usage takes two lines and names what is near."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Sequence
from typing import Any, NoReturn

from checker.base.output import EXIT_USAGE
from checker.base.words import Suggestions, plain, shortened

_CHOICE = re.compile(r"invalid choice: '([^']*)' \(choose from (.*)\)", re.DOTALL)
_UNKNOWN = re.compile(r"unrecognized arguments: .*?(?<!\S)(--?[\w-]+)", re.DOTALL)
_LONGEST = 300
"""Characters of a message."""


class Parser(argparse.ArgumentParser):
    """A parser of a command, or of all commands."""

    def parse_known_args(  # type: ignore[override] # the signature has overloads
        self, args: Sequence[str] | None = None, namespace: Any = None
    ) -> tuple[Any, list[str]]:
        """Refuse what is unknown here, where the options of the command are known."""
        options, unknown = super().parse_known_args(args, namespace)
        if unknown:
            self.error(f"unrecognized arguments: {' '.join(unknown)}")
        return options, []

    def error(self, message: str) -> NoReturn:
        """Say what is wrong, what may be meant, and where to read more, and exit."""
        text = plain(shortened(" ".join(message.split()), _LONGEST))
        more = f"`{self.prog} --help` lists what it takes"
        self.exit(EXIT_USAGE, f"{self.prog}: error: {text}{self._hint(message)}\n{more}\n")

    def _hint(self, message: str) -> str:
        known: Iterable[str] = ()
        if wrong := _CHOICE.search(message):
            known = re.findall(r"[\w.-]+", wrong[2])
        elif wrong := _UNKNOWN.search(message):
            known = self._option_string_actions
        return Suggestions(known).hint(wrong[1]) if wrong else ""
