"""The list of known differences is the one in the document."""

from __future__ import annotations

import re
from pathlib import Path

from tests.oracle.known import READ_OTHERWISE, REFUSED_BY_THEM, REFUSED_BY_US

DOCUMENT = Path(__file__).parents[2] / "docs/oracles.md"


def test_the_document_gives_every_difference_its_reason() -> None:
    text = DOCUMENT.read_text("utf-8").partition("## Known differences")[2]
    tables = [
        re.findall(r"^\| (?!difference )(.+?) \| .+ \|$", part, re.M) for part in text.split("###")
    ]
    ours = (REFUSED_BY_US, REFUSED_BY_THEM, READ_OTHERWISE)
    assert tables[1:] == [[each.title for each in known] for known in ours]
