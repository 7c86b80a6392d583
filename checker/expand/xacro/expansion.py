"""Expands the xacro files of a package: asks the child process, and keeps what it answers."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from checker.base.cache import Cache, code_hash, key_of
from checker.base.child_process import Child, Died, Limits, from_json
from checker.base.record import Record
from checker.base.resources import version_of
from checker.expand.xacro.expanded import expanded_document
from checker.expand.xacro.fault import XacroFault, XacroFaultKind
from checker.expand.xacro.included_texts import Gathered
from checker.expand.xacro.paths import path_of
from checker.expand.xacro.worker import SECONDS_FOR_ALL
from checker.package.package import Package
from checker.source.text import Span
from checker.source.xml import XmlDocument

# What the process that expands xacro files may answer: it may have been taken over.


_KINDS = frozenset(kind.value for kind in XacroFaultKind)


def is_answer(said: Any) -> bool:
    """Say whether something has the form of what became of one file (`processor.expand`)."""
    match said:
        case {"xml": str(), "origins": list(origins), "files": list(files)}:
            return all(map(_is_place, origins)) and all(isinstance(each, str) for each in files)
        case {"kind": str(kind), "message": str()}:
            return kind in _KINDS and _is_told(said.get("at"), said.get("through"))
        case {"refused": str(), "expression": str()}:
            return _is_told(said.get("at"), None)
        case {"missing": str()} | {"unread": str()}:
            return True
    return False


def _is_place(said: Any) -> bool:
    match said:
        case [int(), int()]:
            return True
    return False


def _is_told(at: Any, through: Any) -> bool:
    """Say whether a fault tells of its place and macros as such, if at all."""
    match at:
        case None | [str(), int()]:
            macros = [] if through is None else through
            return isinstance(macros, list) and all(isinstance(each, str) for each in macros)
    return False


MEMORY = 500_000_000
"""Bytes of address space."""
_ROUNDS = 6
"""How often the child may ask for a file whose name is computed."""
_KIND = "xacro"


class Wanted(Record):
    """A file to expand.

    Attributes:
        path: As the package lists it.
        args: Arguments by name.
    """

    path: str
    args: Mapping[str, str]


class Unread(Record):
    """A file that could not be expanded for no fault of its own; the reason ends a sentence."""

    reason: str


Outcome = XmlDocument | XacroFault | Unread


class Expansions:
    """The expansion of some files of one package, begun at once and waited for later."""

    def __init__(self, package: Package, wanted: Sequence[Wanted], cache: Cache) -> None:
        """Begin; files that were expanded before are taken from the cache."""
        self._package = package
        self._cache = cache
        self._gathered = Gathered(package)
        self._files = [path_of(package, each.path) for each in wanted]
        self._jobs = [
            {"file": file, "args": dict(each.args)}
            for file, each in zip(self._files, wanted, strict=True)
        ]
        self._gathered.follow(self._files)
        self._keys: list[str] = []
        self._answers: list[Any] = []
        self._child: Child | None = None
        self._ask()

    def outcomes(self) -> list[Outcome]:
        """Wait, and return what became of each file, in the order wanted."""
        for _ in range(_ROUNDS):
            self._take_answer()
            missing = [each["missing"] for each in self._answers if "missing" in each]
            if not missing:
                break
            self._gathered.follow(missing)
            self._ask()
        self.stop()
        pairs = zip(self._files, self._answers, strict=True)
        return [self._outcome(file, answer) for file, answer in pairs]

    def stop(self) -> None:
        """End the child, if nobody has waited for it."""
        if self._child is not None:
            self._child.stop()
            self._child = None

    def _ask(self) -> None:
        """Look up each job; ask a child about those that are not known."""
        basis = json.dumps(self._gathered.request(()), sort_keys=True)
        basis = key_of(basis, version_of("xacro"), version_of("pyyaml"), code_hash("expand/xacro"))
        self._keys = [key_of(basis, json.dumps(job, sort_keys=True)) for job in self._jobs]
        self._answers = [self._known(key) for key in self._keys]
        open_jobs = self._open_jobs()
        if open_jobs:
            request = self._gathered.request([self._jobs[number] for number in open_jobs])
            limits = Limits(SECONDS_FOR_ALL, MEMORY)
            self._child = Child("checker.expand.xacro.worker", json.dumps(request).encode(), limits)

    def _known(self, key: str) -> Any:
        found = self._cache.get(_KIND, key)
        return found if is_answer(found) else None

    def _open_jobs(self) -> list[int]:
        return [number for number, answer in enumerate(self._answers) if answer is None]

    def _take_answer(self) -> None:
        open_jobs = self._open_jobs()
        if not open_jobs or self._child is None:
            return
        said = self._child.answer()
        self._child = None
        for number, answer in zip(open_jobs, _read(said, len(open_jobs)), strict=True):
            self._answers[number] = answer
            # Another day, or another machine, may have the time or the memory.
            if answer.get("kind") != "limit" and not {"missing", "unread"} & answer.keys():
                self._cache.put(_KIND, self._keys[number], answer)

    def _outcome(self, file: str, answer: Mapping[str, Any]) -> Outcome:
        shown = self._shown(file)
        if "xml" in answer:
            document = expanded_document(answer, self._gathered, file)
            return document or Unread(f"{shown} was expanded into what cannot be read")
        if "kind" in answer:
            return self._fault(file, answer)
        if "refused" in answer:
            return Unread(f"{shown} is not expanded: {self._refusal(answer)}")
        if "missing" in answer:
            return Unread(f"{shown} includes too many files by computed names")
        return Unread(f"{shown} is not expanded: {answer.get('unread', 'no answer came')}")

    def _shown(self, file: str) -> str:
        source = self._gathered.sources.get(file)
        return source.file if source is not None else file.rpartition("/")[2]

    def _fault(self, file: str, answer: Mapping[str, Any]) -> Outcome:
        source = self._gathered.sources.get(file)
        if source is None:
            return Unread(f"{self._shown(file)} cannot be read")
        through = ", ".join(dict.fromkeys(answer.get("through") or ()))
        message = str(answer["message"]) + (f" (in the macro {through})" if through else "")
        span, hint = source.whole(), ""
        if answer.get("at"):
            path, number = answer["at"]
            if number < 0 and path in self._gathered.faults:
                fault = self._gathered.faults[path]
                span, message, hint = fault.span, fault.message, fault.hint
            else:
                span = self._element(path, number) or span
        return XacroFault(XacroFaultKind(answer["kind"]), source.file, span, message, hint)

    def _refusal(self, answer: Mapping[str, Any]) -> str:
        """Say what an expression uses that is not evaluated, and where it stands."""
        said = f"expression uses {answer['refused']}: '{answer['expression']}'"
        span = self._element(*answer["at"]) if answer.get("at") else None
        if span is None:
            return said
        place = span.place()
        return f"{said} at {place.file}:{place.line}"

    def _element(self, path: str, number: int) -> Span | None:
        document = self._gathered.documents.get(path)
        if document is None or not 0 <= number < len(document.elements):
            return None
        return document.elements[number].span


def _read(said: bytes | Died, number: int) -> list[dict[str, Any]]:
    """Return as many answers as were asked for."""
    if isinstance(said, Died):
        return [{"unread": f"the process that expands it {said.reason}"}] * number
    try:
        answers = from_json(said)
    except ValueError:
        answers = None
    if isinstance(answers, list) and len(answers) == number and all(map(is_answer, answers)):
        return answers
    return [{"unread": "the process that expands it answered with nonsense"}] * number
