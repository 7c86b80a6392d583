"""A model file that its own package calls an unused copy."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.package.kind import PackageKind
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.package import Package

MODEL = "model.sdf"
_README = re.compile(r"readme(?:\.\w{1,8})?", re.IGNORECASE)
_SENTENCE = re.compile(r"(?<=[.!?])\s+|\n\s*\n")
_UNUSED = re.compile(
    r"\b(?:unused|(?:is|are|was)\s*(?:not|n['’]t)\s+(?:\w+\s+)?(?:used|loaded|read)"
    r"|never\s+(?:use[ds]|load(?:ed|s)|reads?)|(?:only|just|merely)\s+(?:a|as\s+a)\s+copy)\b",
    re.IGNORECASE,
)


def unused_model(package: Package) -> str:
    """Return the path of the model file if the README states that nothing loads it; else nothing.

    What the README states about it is in one sentence: "model.sdf is an unused copy of …".
    """
    submission = package.kind in (PackageKind.ROBOT, PackageKind.CONFIGURATION)
    if not submission or package.index.find(MODEL) is None:
        return ""
    for file in package.index.files:
        text = package.read(file.path) if _README.fullmatch(file.path) else None
        if isinstance(text, SourceText) and any(map(_says_so, _SENTENCE.split(text.text))):
            return MODEL
    return ""


def _says_so(sentence: str) -> bool:
    return MODEL in sentence and _UNUSED.search(sentence) is not None
