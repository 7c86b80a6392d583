"""A gzip file as a stream of at most so many bytes, whatever it promises."""

from __future__ import annotations

import zlib
from typing import IO

from checker.package.archive_index import DamagedArchive

CHUNK = 65_536


class GzipStream:
    """The unpacked bytes of a gzip file, at most `bound` of them."""

    def __init__(self, file: IO[bytes], bound: int) -> None:
        self._file = file
        self._left = bound
        self._packed = b""
        self._inflate = zlib.decompressobj(16 + zlib.MAX_WBITS)

    def read(self, size: int) -> bytes:
        """Return `size` bytes, fewer only at the end.

        Raises:
            DamagedArchive: The file ends early, or holds more than the bound.
        """
        pieces = []
        while size > 0 and not self._inflate.eof:
            if not self._packed:
                self._packed = self._file.read(CHUNK)
                if not self._packed:
                    raise DamagedArchive("ends too early")
            piece = self._inflate.decompress(self._packed, min(size, CHUNK))
            self._packed = self._inflate.unconsumed_tail
            size -= len(piece)
            self._left -= len(piece)
            if self._left < 0:
                raise DamagedArchive("unpacks to far more than its entries say")
            pieces.append(piece)
        return b"".join(pieces)
