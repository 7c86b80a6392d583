"""Expands the xacro files of a package: calls the child process, and keeps its answers."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache, key_of
from checker.base.child_process import Limits
from checker.base.child_server import Server
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.formats.xacro.expanded import expanded_document
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.formats.xacro.files import Gathered, path_of
from checker.formats.xacro.worker import SECONDS_FOR_ALL
from checker.package.package import Package
from checker.source.text import Span
from checker.source.xml import XmlDocument

# What the process that expands xacro files may answer: it may be compromised.


_KINDS = frozenset(kind.value for kind in XacroFaultKind)


def is_answer(data: Any) -> bool:
    """Return whether something has the form of the result of one file (`processor.expand`)."""
    match data:
        case {"xml": str(), "origins": list(origins), "files": list(files)}:
            return all(map(_is_place, origins)) and all(isinstance(file, str) for file in files)
        case {"kind": str(kind), "message": str()}:
            return kind in _KINDS and _is_location(data.get("at"), data.get("through"))
        case {"refused": str(), "expression": str()}:
            return _is_location(data.get("at"), None)
        case {"missing": str()} | {"unread": str()}:
            return True
    return False


def _is_place(data: Any) -> bool:
    match data:
        case [int(), int()]:
            return True
    return False


def _is_location(at: Any, through: Any) -> bool:
    """Return whether a fault reports its place and macros, if it has any."""
    match at:
        case None | [str(), int()]:
            macros = [] if through is None else through
            return isinstance(macros, list) and all(isinstance(macro, str) for macro in macros)
    return False


MEMORY = 500_000_000
"""Bytes of address space."""
_LIMITS = Limits(SECONDS_FOR_ALL, MEMORY)
_WORKER = f"{__package__}.worker"
_ROUNDS = 6
"""Greatest number of requests of the child for files whose names are computed."""


class Wanted(Record):
    """A file to expand.

    Attributes:
        path: The path as the package lists it.
        args: Arguments by name.
        as_melodic: Whether as xacro 1.13 of ROS Melodic does it.
        call: What is added to it: `text`, a robot whose elements come last; `number`, the element
            of the file where they are; `name`, of the robot, where the file has none.
    """

    path: str
    args: Mapping[str, str]
    as_melodic: bool = False
    call: Mapping[str, str | int] | None = None


class Unread(Record):
    """A file that could not be expanded for no fault of its own; the reason ends a sentence."""

    reason: str


Outcome = XmlDocument | XacroFault | Unread


class XacroArguments(Record):
    """Arguments that the user gives, before those of launch files."""

    values: Mapping[str, str]


class Expander(Record, eq=False):
    """Expands files, one request after the other.

    Attributes:
        cache: The cache of results.
        server: The process that expands; it is started when a file is not in the cache.
    """

    cache: Cache
    server: Server


def xacro_server() -> Server:
    """Return what expands xacro files, its process not started yet."""
    return Server(_WORKER, _LIMITS)


class Expansions:
    """The expansion of some files of one package, begun at once and waited for later."""

    def __init__(self, package: Package, wishes: Sequence[Wanted], expander: Expander) -> None:
        """Begin; files that were expanded before are taken from the cache."""
        self._expander = expander
        self._gathered = Gathered(package)
        self._jobs: list[dict[str, Any]] = [
            {"file": path_of(package, wish.path), "args": dict(wish.args)}
            | ({"as_melodic": True} if wish.as_melodic else {})
            | ({"call": dict(wish.call)} if wish.call is not None else {})
            for wish in wishes
        ]
        self._gathered.follow(job["file"] for job in self._jobs)
        self._begun = self._begin(self._jobs)

    def outcomes(self) -> list[Outcome]:
        """Wait, and return the result of each file, in the order wanted."""
        answers = self._answers
        return [
            self._outcome(job["file"], answers[number]) for number, job in enumerate(self._jobs)
        ]

    @cached_property
    def _answers(self) -> Mapping[int, dict[str, Any] | WorkerFailed]:
        """The answers by the numbers of jobs; those that lack a file are asked again with it."""
        answers: dict[int, dict[str, Any] | WorkerFailed] = {}
        asked: Sequence[int] = range(len(self._jobs))
        for _ in range(_ROUNDS):
            results = self._begun.results()
            answers |= {number: results[self._key(self._jobs[number])] for number in asked}
            missing = {
                number: answer["missing"]
                for number, answer in answers.items()
                if not isinstance(answer, WorkerFailed) and "missing" in answer
            }
            if not missing:
                break
            self._gathered.follow(missing.values())
            asked = [*missing]
            self._begun = self._begin([self._jobs[number] for number in asked])
        return answers

    @property
    def files(self) -> frozenset[str]:
        """Files of the package that were given to xacro."""
        return frozenset(source.file for source in self._gathered.sources.values())

    def stop(self) -> None:
        """Stop the expansion if it still runs."""
        self._begun.stop()

    def _begin(self, jobs: Sequence[Mapping[str, Any]]) -> Background[dict[str, Any]]:
        """Look up each job, and run unknown ones in a child process."""
        common = self._gathered.request
        texts = json.dumps(common, sort_keys=True)
        self._basis = work_key([texts], ["formats/xacro"], ["xacro", "pyyaml"])
        items = {self._key(job): job for job in jobs}
        work = Work("xacro", _WORKER, _LIMITS, items, _answer, common, lasts=_lasts)
        begun = Background(work, self._expander.cache, self._expander.server)
        begun.begin()
        return begun

    def _key(self, job: Mapping[str, Any]) -> str:
        return key_of(self._basis, json.dumps(job, sort_keys=True))

    def _outcome(self, file: str, answer: dict[str, Any] | WorkerFailed) -> Outcome:
        label = self._file_label(file)
        if isinstance(answer, WorkerFailed):
            return Unread(f"{label} is not expanded: the process that expands it {answer.reason}")
        if "xml" in answer:
            document = expanded_document(answer, self._gathered, file)
            return document or Unread(f"the expanded text of {label} cannot be read")
        if "kind" in answer:
            return self._fault(file, answer)
        if "refused" in answer:
            return Unread(f"{label} is not expanded: {self._refusal(answer)}")
        if "missing" in answer:
            return Unread(f"{label} includes too many files with computed names")
        return Unread(f"{label} is not expanded: {answer['unread']}")

    def _file_label(self, file: str) -> str:
        source = self._gathered.sources.get(file)
        return source.file if source is not None else file.rpartition("/")[2]

    def _fault(self, file: str, answer: Mapping[str, Any]) -> Outcome:
        source = self._gathered.sources.get(file)
        if source is None:
            return Unread(f"{self._file_label(file)} cannot be read")
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
        """Return what an expression uses that is not evaluated, and where it is."""
        message = f"expression uses {answer['refused']}: '{answer['expression']}'"
        span = self._element(*answer["at"]) if answer.get("at") else None
        if span is None:
            return message
        place = span.place()
        return f"{message} at {place.file}:{place.line}"

    def _element(self, path: str, number: int) -> Span | None:
        document = self._gathered.documents.get(path)
        if document is None or not 0 <= number < len(document.elements):
            return None
        return document.elements[number].span


def _answer(data: Any) -> dict[str, Any]:
    """Return the result of one file.

    Raises:
        ValueError: It is something else.
    """
    if not is_answer(data):
        raise ValueError("no answer")
    return dict(data)


def _lasts(answer: Mapping[str, Any]) -> bool:
    """Return whether an answer is permanent: at another time there may be more memory.

    So do those that want another file: the key states which files are there.
    """
    return answer.get("kind") not in ("limit", "recursion")
