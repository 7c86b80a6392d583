"""The URDF descriptions of a package: chosen, expanded where they are xacro, and read."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType

from msgspec.structs import replace

from checker.base.files import NotReadable
from checker.formats.urdf.description import UrdfDescription, read_description
from checker.formats.urdf.macro_calls import MacroCall, minimal_call
from checker.formats.xacro.bare_tags import TAGS, bare_tags
from checker.formats.xacro.expansion import Expander, Expansions, Outcome, Unread, Wanted
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.launch.ros1.package_launch import SAMPLE_ARGUMENTS
from checker.launch.ros2.graph import Ros2Launch
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.robots.candidates import (
    Candidate,
    candidates,
    is_included,
    may_hold_description,
    unread_models,
    unused_parts,
)
from checker.robots.empty_arguments import SAMPLE, empty_arguments, is_refused_alike
from checker.robots.other_robots import Made, other_robots
from checker.robots.shown_only import shown_only
from checker.robots.started_loads import started_loads
from checker.robots.unloaded import may_be_loaded
from checker.robots.urdf_files import UrdfFiles
from checker.source.text import SourceText
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

_URDF_KINDS = (PackageKind.URDF_DESCRIPTION, PackageKind.SINGLE_FILE)
_CHOICES_LIMIT = 10
"""Choices for an argument that are tried."""
_CALLS_LIMIT = 20
"""Macros that are called though no file does so."""
_XACRO = re.compile(r"\bxacro:|\bxmlns:xacro\b")


class PackageDescriptions:
    """The reading of a package's descriptions: started at once, finished on request."""

    def __init__(
        self,
        package: Package,
        expander: Expander,
        *,
        only: str = "",
        args: Mapping[str, str] = MappingProxyType({}),
        ros2: Ros2Launch | None = None,
    ) -> None:
        """Choose the files and begin to expand those that need it.

        Args:
            package: The package of the files.
            expander: Expands the files that are xacro.
            only: The one file to read, whatever launch files load; empty to choose.
            args: Arguments for xacro, before those that launch files give.
            ros2: What the ROS 2 launch files of the package start, if it has any.
        """
        self._package = package
        self._args = args
        self._expander = expander
        self._for_rviz = package.kind not in _URDF_KINDS
        self._started = ros2.entries if ros2 is not None else ()
        self._candidates: Sequence[Candidate] = ()
        if only:
            self._candidates = [Candidate(only, loaded=True)]
        elif may_hold_description(package):
            self._candidates = candidates(package, started_loads(package, ros2))
        self._wanted = [
            self._wish(candidate)
            for candidate in self._candidates
            if _needs_xacro(package, candidate)
        ]
        self._expansions = Expansions(package, self._wanted, expander) if self._wanted else None
        self._taken = {wish.path: wish for wish in self._wanted}
        self._with_others = not only and not self._for_rviz

    def _wish(self, candidate: Candidate, choice: int = 0) -> Wanted:
        """Return what to expand, with one of the choices for arguments that are not given."""
        assumed = candidate.assumed_values(choice, self._args)
        args = {**SAMPLE_ARGUMENTS, **candidate.args, **assumed, **self._args}
        return Wanted(candidate.path, args)

    @property
    def applicable(self) -> bool:
        """True if there is a file that should contain a robot, or may."""
        return bool(self._candidates) or may_hold_description(self._package)

    @cached_property
    def files(self) -> UrdfFiles:
        """Results of the files; the first call waits for their expansion."""
        expanded = self._expanded
        unread, assumed = self._choose(expanded)
        old = self._expand_as_melodic(expanded)
        needed = self._needed(expanded)
        descriptions, faults, fragments = [], [], []
        for candidate in self._candidates:
            outcome = expanded.get(candidate.path) or _plain(self._package, candidate.path)
            if isinstance(outcome, XmlDocument):
                if self._is_fragment(outcome, candidate):
                    fragments.append(candidate.path)
                elif _holds_robot(outcome, candidate) or self._is_alone(outcome, candidate):
                    descriptions.append(self._read(outcome, candidate.path))
            elif isinstance(outcome, Unread):
                unread.append((candidate, self._unread(candidate, outcome.reason)))
            elif outcome.kind is XacroFaultKind.ARGUMENT and self._may_be_given(candidate, outcome):
                reason = f"{candidate.path} is not expanded: {outcome.message}"
                unread.append((candidate, self._unread(candidate, reason)))
            elif names := needed.get(candidate.path):
                given = " ".join(f"{name}:=…" for name in names)
                reason = f"{candidate.path} needs --xacro-arg {given} ({outcome.message})"
                unread.append((candidate, reason))
            else:
                faults.append(replace(outcome, loaded=candidate.loaded))
        descriptions = self._marked(descriptions)
        others = [*self._others(expanded)] if self._with_others else []
        faults += (it for it in others if isinstance(it, XacroFault))
        reasons = [reason for file, reason in unread if file.loaded or not self._for_rviz]
        if not self._for_rviz:
            holding = {description.file for description in descriptions}
            called = [*self._called(holding)]
            descriptions += called
            made = (description.file for description in called)
            reasons += unread_models(self._package, self._seen.union(made))
            if not descriptions:
                reasons += (
                    f"{path} is part of a robot that is not available" for path in fragments
                )
        return UrdfFiles(
            tuple(descriptions),
            tuple(faults),
            tuple(reasons),
            tuple(reason for file, reason in unread if self._for_rviz and not file.loaded),
            old,
            assumed,
            tuple(it for it in others if isinstance(it, UrdfDescription)),
        )

    def _read(self, document: XmlDocument, path: str) -> UrdfDescription:
        read = read_description(document, path, for_rviz=self._for_rviz)
        shown = "" if self._for_rviz else shown_only(self._package, path, document, self._started)
        return replace(read, shown_only=shown)

    def _marked(self, descriptions: Sequence[UrdfDescription]) -> list[UrdfDescription]:
        """Return descriptions; those that nothing loads, beside one that is loaded, say so."""
        loaded = {candidate.path for candidate in self._candidates if candidate.loaded}
        if (
            self._for_rviz
            or self._package.only
            or not any(it.file in loaded for it in descriptions)
        ):
            return [*descriptions]
        texts = self._package.workspace.launch_texts
        return [
            it
            if it.file in loaded or may_be_loaded(texts, it.file)
            else replace(it, unloaded=f"only in {it.file}, which no launch file loads")
            for it in descriptions
        ]

    def _others(self, expanded: Mapping[str, Outcome]) -> Iterator[UrdfDescription | XacroFault]:
        """Yield the robots that other values of arguments make, and the faults that they meet."""
        allowed = {it.path: {**it.choices, **it.offered} for it in self._candidates}
        loaded = {it.path for it in self._candidates if it.loaded}
        made = [
            Made(self._taken[path], outcome, allowed[path], path in loaded)
            for path, outcome in expanded.items()
            if isinstance(outcome, XmlDocument) and outcome.root.tag == "robot"
        ]
        yield from other_robots(self._package, self._expander, made, self._args)

    def _called(self, holding: set[str]) -> Iterator[UrdfDescription]:
        """Yield the robots of macros that are never called, each with its required arguments."""
        empty = {it.path for it in self._candidates if it.path not in holding and not it.loaded}
        paths = [*unused_parts(self._package, self._seen - empty)][:_CALLS_LIMIT]
        found = ((path, minimal_call(self._package, path)) for path in paths)
        calls: dict[str, MacroCall] = {path: call for path, call in found if call is not None}
        wanted = [
            Wanted(path, {**SAMPLE_ARGUMENTS, **self._args}, call=call.added)
            for path, call in calls.items()
        ]
        outcomes = Expansions(self._package, wanted, self._expander).outcomes() if wanted else []
        for path, outcome in zip(calls, outcomes, strict=True):
            # What a macro takes from the file that includes it is not known: that is no fault.
            if isinstance(outcome, XmlDocument) and _holds_robot(outcome, Candidate(path)):
                read = read_description(outcome, path, for_rviz=False)
                yield replace(read, call=calls[path])

    @property
    def _seen(self) -> frozenset[str]:
        """Files that were read, for themselves or as a part of another."""
        included = self._expansions.files if self._expansions is not None else ()
        return frozenset((*(candidate.path for candidate in self._candidates), *included))

    def _is_fragment(self, document: XmlDocument, candidate: Candidate) -> bool:
        """Return whether a file is part of a robot: joints lead out of it, others include it."""
        root = document.root
        if candidate.loaded or self._package.only or root.tag != "robot":
            return False
        links = {link.get("name") for link in root.all("link")}
        ends = (
            end
            for joint in root.all("joint")
            for end in (*joint.all("parent"), *joint.all("child"))
        )
        leads_out = any(end.get("link") not in links for end in ends)
        return leads_out and is_included(self._package, candidate.path)

    def _may_be_given(self, candidate: Candidate, fault: XacroFault) -> bool:
        """Return whether what starts a file may well give the argument that it lacks."""
        left = candidate.missing.keys() - self._args.keys()
        return not candidate.loaded or any(name in fault.message for name in left)

    def _unread(self, candidate: Candidate, reason: str) -> str:
        """Return a reason; it states which arguments a launch file leaves to the user."""
        known = self._args.keys() | candidate.choices.keys()
        missing = [name for name in candidate.missing if name not in known]
        if not missing:
            return reason
        file, given = candidate.missing[missing[0]], " ".join(f"{name}:=…" for name in missing)
        return f"{reason}; {file} has no value for {given}: set it with --xacro-arg"

    def _is_alone(self, document: XmlDocument, candidate: Candidate) -> bool:
        """Return whether an empty file is the one to check, and not a xacro file of macros."""
        plain = candidate.path.lower().endswith(".urdf")
        return plain and bool(self._package.only) and document.root.tag == "robot"

    @property
    def _expanded(self) -> dict[str, Outcome]:
        """Results of the files that xacro reads, by path."""
        outcomes = self._expansions.outcomes() if self._expansions is not None else []
        return dict(zip((wish.path for wish in self._wanted), outcomes, strict=True))

    def _choose(
        self, expanded: dict[str, Outcome]
    ) -> tuple[list[tuple[Candidate, str]], dict[str, str]]:
        """Expand with another choice for an argument what the first one does not fit.

        The result takes its place in `expanded`. Return why the first one does not fit, and
        what is assumed, by path.
        """
        assuming = [each for each in self._candidates if each.assumed_values(0, self._args)]
        assumed = {each.path: _in_words(each.assumed_values(0, self._args)) for each in assuming}
        misfits = {each.path: _misfit(expanded.get(each.path), each.path) for each in assuming}
        unfit = [each for each in assuming if misfits[each.path]]
        tried = [(each, number) for each in unfit for number in _further(each)]
        wanted = [self._wish(*each) for each in tried]
        outcomes = Expansions(self._package, wanted, self._expander).outcomes() if wanted else []
        unread = []
        for (candidate, number), outcome in zip(tried, outcomes, strict=True):
            if isinstance(outcome, XmlDocument) and (why := misfits.pop(candidate.path, "")):
                expanded[candidate.path] = outcome
                self._taken[candidate.path] = self._wish(candidate, number)
                taken = _in_words(candidate.assumed_values(number, self._args))
                unread.append((candidate, f"{why}; {taken} is used instead"))
                assumed[candidate.path] = taken
        return unread, assumed

    def _needed(self, expanded: Mapping[str, Outcome]) -> dict[str, list[str]]:
        """Return, by path, the arguments without which a file does not expand.

        They are empty by default; with a value the file expands, or is refused for another reason.
        """
        tried = [
            (self._wish(candidate), names)
            for candidate in self._candidates
            if isinstance(expanded.get(candidate.path), XacroFault)
            and (names := empty_arguments(self._package, candidate, self._args))
        ]
        wanted = [
            replace(wish, args={**wish.args, **dict.fromkeys(names, SAMPLE)})
            for wish, names in tried
        ]
        outcomes = Expansions(self._package, wanted, self._expander).outcomes() if wanted else []
        return {
            wish.path: names
            for (wish, names), outcome in zip(tried, outcomes, strict=True)
            if not is_refused_alike(outcome, expanded[wish.path])
        }

    def _expand_as_melodic(self, expanded: dict[str, Outcome]) -> tuple[XacroFault, ...]:
        """Expand what a newer xacro refuses as Melodic's does, and return what is refused.

        The result takes its place in `expanded`, also where that is only why nothing is known.
        """
        refused = {path: old for path in expanded if (old := _refusal(expanded[path], path))}
        again = [replace(wish, as_melodic=True) for wish in self._wanted if wish.path in refused]
        if not again:
            return ()
        expansions = Expansions(self._package, again, self._expander)
        causes: dict[str, XacroFault] = {}
        for wish, outcome in zip(again, expansions.outcomes(), strict=True):
            bare = {fault.file: fault for fault in bare_tags(self._package, wish.path)}
            if isinstance(outcome, XmlDocument) and _refusal(outcome, wish.path) is None:
                expanded[wish.path] = outcome
                self._taken[wish.path] = wish
                causes |= bare or {wish.path: refused[wish.path]}
            elif isinstance(outcome, Unread) and bare:
                expanded[wish.path] = outcome
                causes |= bare
        return tuple(causes.values())

    def stop(self) -> None:
        """Stop the expansions that still run."""
        if self._expansions is not None:
            self._expansions.stop()


def _misfit(outcome: Outcome | None, path: str) -> str:
    """Return why another value of an argument may do better; empty if none would."""
    if isinstance(outcome, XacroFault) and outcome.kind is XacroFaultKind.ARGUMENT:
        return f"{path} is not expanded: {outcome.message}"
    return outcome.reason if isinstance(outcome, Unread) else ""


def _further(candidate: Candidate) -> range:
    """Return the numbers of the choices behind the first one."""
    return range(1, min(max(map(len, candidate.choices.values())), _CHOICES_LIMIT))


def _in_words(args: Mapping[str, str]) -> str:
    return " ".join(f"{name}:={value}" for name, value in args.items())


def _refusal(outcome: Outcome, file: str) -> XacroFault | None:
    """Return what a newer xacro refuses that an older one may take."""
    if isinstance(outcome, XmlDocument):
        for child in outcome.root.children:
            if child.tag in TAGS:
                message = f"<{child.tag}> is not expanded"
                hint = f"write <xacro:{child.tag}>"
                return XacroFault(XacroFaultKind.EXPANSION, file, child.span, message, hint)
        return None
    if isinstance(outcome, XacroFault):
        return outcome if outcome.kind is XacroFaultKind.EXPANSION else None
    return None


def _needs_xacro(package: Package, candidate: Candidate) -> bool:
    """Return whether expanding a file can change it; a file that is empty has nothing to expand."""
    source = package.read(candidate.path)
    if not isinstance(source, SourceText) or not source.text.strip():
        return False
    if _XACRO.search(source.text):
        return True
    read_by_xacro = candidate.by_xacro or candidate.path.lower().endswith(".xacro")
    return read_by_xacro and "$" in source.text


def _plain(package: Package, path: str) -> Outcome:
    """Return a file that is loaded as it is."""
    document = package.xml(path)
    if isinstance(document, NotReadable):
        return Unread(f"{path} {document.reason}")
    if isinstance(document, XmlFault):
        empty = not document.span.source.text.strip()
        kind = XacroFaultKind.EMPTY if empty else XacroFaultKind.MALFORMED
        message = "is empty" if empty else document.message
        return XacroFault(kind, path, document.span, message, document.hint)
    return document


def _holds_robot(document: XmlDocument, candidate: Candidate) -> bool:
    """Return whether a document is a robot; a file of macros alone expands to nothing."""
    if document.root.tag != "robot":
        return False
    tags = {child.tag for child in document.root.children}
    return candidate.loaded or bool(tags & {"link", "joint"})
