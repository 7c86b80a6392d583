"""The upload form: a file in multipart/form-data (RFC 7578), never held in memory as a whole."""

from __future__ import annotations

import secrets
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from msgspec import field

from checker.base.record import Record

_PIECE = 1 << 16


class Form(Record):
    """A form with some fields and one file behind them.

    Attributes:
        file: What is sent.
        name: Of the file, as the service is told.
        fields: Texts by name.
        told: Called with the bytes of the file that are sent, now and then.
    """

    file: Path
    name: str
    fields: Mapping[str, str] = field(default_factory=dict)
    told: Callable[[int], None] = lambda _: None
    boundary: str = field(default_factory=lambda: secrets.token_hex(16))

    @property
    def content_type(self) -> str:
        """For the header of that name."""
        return f"multipart/form-data; boundary={self.boundary}"

    @property
    def length(self) -> int:
        """Bytes of the whole form.

        Raises:
            OSError: The file is gone.
        """
        return len(self._head()) + self.file.stat().st_size + len(self._tail())

    def pieces(self) -> Iterator[bytes]:
        """Yield the form from its start.

        Raises:
            OSError: The file cannot be read.
        """
        yield self._head()
        sent = 0
        with self.file.open("rb") as file:
            while piece := file.read(_PIECE):
                yield piece
                sent += len(piece)
                self.told(sent)
        yield self._tail()

    def _head(self) -> bytes:
        parts = [
            f'--{self.boundary}\r\nContent-Disposition: form-data; name="{_quoted(name)}"'
            f"\r\n\r\n{text}\r\n"
            for name, text in self.fields.items()
        ]
        parts.append(
            f'--{self.boundary}\r\nContent-Disposition: form-data; name="file"; '
            f'filename="{_quoted(self.name)}"\r\nContent-Type: application/octet-stream\r\n\r\n'
        )
        return "".join(parts).encode("utf-8", "replace")

    def _tail(self) -> bytes:
        return f"\r\n--{self.boundary}--\r\n".encode()


def _quoted(name: str) -> str:
    """Write a name as browsers do (HTML, multipart form data), so that it ends where it ends."""
    return name.replace('"', "%22").replace("\r", "%0D").replace("\n", "%0A")
