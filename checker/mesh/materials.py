"""Pictures that a material file (`.mtl`) of OBJ names."""

from __future__ import annotations

import re

_NUMBER = r"[-+]?[\d.]+(?:[eE][-+]?\d+)?"
_OPTION = rf"-(?:[ost](?:\s+{_NUMBER}){{1,3}}|mm\s+{_NUMBER}\s+{_NUMBER}|[A-Za-z]+\s+\S+)\s+"
_MAP = re.compile(
    rf"^[ \t]*(?:map_\w+|norm|bump|disp|decal)[ \t]+(?:{_OPTION}){{0,8}}(\S[^\r\n]*)",
    re.IGNORECASE | re.MULTILINE,
)

SIZE_LIMIT = 1_000_000
"""Bytes of a material file."""


def textures_in(material_file: bytes) -> tuple[str, ...]:
    """Return the pictures of a material file as named there, each once."""
    text = material_file.decode("utf-8", "replace")
    return tuple(dict.fromkeys(found[1].strip() for found in _MAP.finditer(text)))
