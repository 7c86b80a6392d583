"""Shared libraries (`.so`): the machine they are built for and the libraries they need.

Only headers and the dynamic section are read. The file is a stranger's, so its reader gets a
budget: offsets and counts in it may say anything.
"""

from __future__ import annotations

import io

from checker.base.record import Record

BUDGET = 1_000_000
"""Bytes that may be read of one file; real libraries need a few thousand."""
_COST = 32
"""What every single read costs beside its bytes, so that empty reads end, too."""


class SharedLibrary(Record):
    """What the headers of an ELF file say.

    Attributes:
        machine: As pyelftools names it: `x64`, `x86`, `AArch64`.
        needed: File names of the libraries it is linked to: `libignition-gazebo4.so.4`.
    """

    machine: str
    needed: tuple[str, ...]


def read_shared_library(data: bytes) -> SharedLibrary | None:
    """Read the headers of an ELF file; None when it is none or makes no sense.

    Args:
        data: The whole file.
    """
    from elftools.common.exceptions import ELFError
    from elftools.elf.dynamic import DynamicSegment
    from elftools.elf.elffile import ELFFile

    try:
        elf = ELFFile(_Budgeted(data))
        needed = [
            str(tag.needed)  # type: ignore[attr-defined]  # set by name in its constructor
            for segment in elf.iter_segments()
            if isinstance(segment, DynamicSegment)
            for tag in segment.iter_tags()
            if tag["d_tag"] == "DT_NEEDED"
        ]
        return SharedLibrary(elf.get_machine_arch(), tuple(needed))
    except (ELFError, ArithmeticError, AssertionError, AttributeError, LookupError, TypeError):
        return None
    except ValueError:  # text that is no UTF-8, negative offsets
        return None


class _BudgetSpent(ValueError):
    """Too much was read."""


class _Budgeted(io.BytesIO):
    """A file of which only so much may be read."""

    _left = BUDGET

    def read(self, size: int | None = -1, /) -> bytes:
        """Read as usual.

        Raises:
            _BudgetSpent: The file makes its reader go round.
        """
        data = super().read(size)
        self._left -= len(data) + _COST
        if self._left < 0:
            raise _BudgetSpent
        return data
