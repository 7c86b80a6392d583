"""Interface for authors of rules: `@rule`, `finding`, severities and fixes."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import Any, Protocol, get_type_hints

from msgspec.structs import replace

from checker.base.parts import Need, need_of
from checker.base.record import Record
from checker.base.resources import table
from checker.base.words import Suggestions
from checker.finding import Concern, Fix, Place, Safety, Severity
from checker.source.text import Located, Span

__all__ = [
    "Concern",
    "Context",
    "Finding",
    "Findings",
    "Rule",
    "Safety",
    "Severity",
    "Unchecked",
    "finding",
    "misspelt",
    "rename",
    "replace_text",
    "respelling",
    "rule",
    "unchecked",
]


class HasSpan(Protocol):
    """Anything that knows the text it was read from: a link, a value, an XML element."""

    @property
    def span(self) -> Span:
        """The text it was read from."""
        ...


Where = HasSpan | Place


class Finding(Record):
    """Finding of a rule at one place; the engine adds the rule, its severity and its page.

    Attributes:
        places: The main place first, then related ones.
        message: The thing and its value, and what was expected.
        severity: The severity, if it differs from the rule's own.
        key: Findings of one rule with one key are one fault in many places.
        fix: Text edits that correct it.
        covered_by: Ids of more precise rules: where one of them reports the same place, or all
            related places, at least as severely, it is the same fault and reported once.
    """

    places: tuple[Place, ...]
    message: str
    severity: Severity | None = None
    key: str = ""
    fix: Fix | None = None
    covered_by: tuple[str, ...] = ()


class Unchecked(Record):
    """Something that a rule should look at and cannot.

    Attributes:
        reason: The end of a sentence.
        severity: The severity of what may be missed, if it differs from the rule's own.
    """

    reason: str
    severity: Severity | None = None


Findings = Iterator[Finding | Unchecked]
"""Results that a rule yields."""


def unchecked(reason: str) -> Unchecked:
    """State that a part of what the rule looks at is not available, and why."""
    return Unchecked(reason)


def finding(
    where: Where,
    message: str,
    *,
    severity: Severity | None = None,
    key: str = "",
    related: Iterable[tuple[Where, str]] = (),
    fix: Fix | None = None,
    covered_by: tuple[str, ...] = (),
) -> Finding:
    """Make a finding.

    Args:
        where: The element or value that the message names.
        message: Present tense; names the thing, its value, and what was expected, with its unit.
        severity: The severity, if it differs from the rule's own.
        key: What repeated findings have in common; the message when empty.
        related: Other places, each with a note that states what it has to do with the finding.
        fix: Text edits that correct it.
        covered_by: Rules that report the same fault more precisely where they report the same
            place, or all the related ones.
    """
    others = tuple(replace(_place(other), note=note) for other, note in related)
    return Finding((_place(where), *others), message, severity, key, fix, covered_by)


def lessened(found: Finding, clause: str, own: Severity = Severity.ERROR) -> Finding:
    """Return a finding that weighs a step less, at least an info.

    Args:
        found: The finding.
        clause: Why it does, for its message.
        own: The severity of its rule.
    """
    severity = (found.severity or own).weaker
    return replace(found, message=f"{found.message} ({clause})", severity=severity)


def _place(where: Where) -> Place:
    return where if isinstance(where, Place) else where.span.place()


def replace_text(where: HasSpan, replacement: str, safety: Safety = Safety.SAFE) -> Fix:
    """Return the fix that writes `replacement` over the text of `where`."""
    return Fix(safety, (where.span.replacement(replacement),))


def rename(where: Located[str], name: str) -> Fix | None:
    """Return the fix that writes another name; None if the file puts the one there together."""
    text = where.span.text
    if text.strip("\"' ") != where.value:
        return None
    return replace_text(where, text.replace(where.value, name), Safety.UNSAFE)


def respelling(where: Located[str], names: Suggestions) -> Fix | None:
    """Return the fix that writes the one known name that is meant; None if several may be."""
    sure = names.correction(where.value)
    return rename(where, sure) if sure else None


def misspelt(
    where: Located[str],
    message: str,
    names: Suggestions,
    *,
    severity: Severity | None = None,
    key: str = "",
) -> Finding:
    """Make a finding about a name that does not exist.

    Args:
        where: The name.
        message: As of `finding`; the known name that is nearest is added.
        names: The known names. Where one alone can be meant, a fix writes it.
        severity: The severity, if it differs from the rule's own.
        key: See `finding`.
    """
    message += names.hint(where.value)
    return finding(where, message, severity=severity, key=key, fix=respelling(where, names))


class Context(Record):
    """Facts about the check that a rule may use.

    Attributes:
        profile: Name of the profile that judges the package (`subt`, `sdf`, …).
        release: Gazebo release that the profile aims at (`dome`, `harmonic`, `classic`).
        sdf_version: SDF version that the profile requires; empty if the file's own counts.
        reads: Newest SDF version that the target knows: it converts older files to that one, so
            that its new elements count in them too.
        distro: ROS 2 distribution (`humble`, `jazzy`, …); empty for a profile without one.
        distro_is_known: True if the user or the package names it; False for the default.
        payload: Mass that an arm is to carry at its end, kg.
    """

    profile: str = "subt"
    release: str = "dome"
    sdf_version: str = "1.6"
    reads: str = "1.7"
    distro: str = ""
    distro_is_known: bool = False
    payload: float = 0.0

    @property
    def is_subt(self) -> bool:
        """True if every model is a robot of SubT that drives by itself."""
        return self.release == "dome"

    @property
    def is_gazebo_sim(self) -> bool:
        """True if the target is a release of Gazebo later than the one of SubT."""
        return self.release in ("fortress", "harmonic", "ionic", "jetty")

    @property
    def is_gazebo_alone(self) -> bool:
        """True if the profile is for a release of Gazebo, whatever starts it."""
        return self.profile.startswith("gazebo")

    @property
    def is_classic(self) -> bool:
        """True if the target is Gazebo Classic with ROS 2."""
        return self.release == "classic" and bool(self.distro)


Check = Callable[..., Findings]


class Rule(Record, dict=True):
    """A rule of the book: one function, and its properties.

    Attributes:
        id: Three letters of its group and a number: `SEN005`.
        name: What is wrong, in words joined by hyphens.
        severity: Unless a finding states otherwise.
        concern: What its findings are about.
        check: The function.
        page: The module's docstring: what, why, how to fix, source.
        good: Examples in which the rule finds nothing.
        bad: Examples with a marker `^ SEN005` on each line that must be reported.
        judges: Figures of the trial that it judges; each finding has those that it is about as key.
    """

    id: str
    name: str
    severity: Severity
    concern: Concern
    check: Check
    page: str
    good: Sequence[Any] = ()
    bad: Sequence[Any] = ()
    judges: tuple[str, ...] = ()

    @property
    def group(self) -> str:
        """The letters of the id."""
        return self.id.rstrip("0123456789")

    @property
    def names(self) -> tuple[str, ...]:
        """The id, the name, and the names that the rule had before."""
        return self.id, self.name, *table("former_rule_names")["names"].get(self.id, ())

    @property
    def selectors(self) -> tuple[str, ...]:
        """Words for `--select` and `--ignore` that include the rule, alone or with others."""
        return *self.names, self.group, f"concern:{self.concern}"

    @cached_property
    def needs(self) -> dict[str, str]:
        """Parts of the package that the function needs: names of types by parameter name.

        Each with its module, as `checker.base.parts.type_name` returns it.
        """
        return {name: need.kind for name, need in self._needs}

    @cached_property
    def optional_parts(self) -> frozenset[str]:
        """Names of the parameters for parts that a rule can do without: `Specification | None`."""
        return frozenset(name for name, need in self._needs if need.optional)

    @property
    def _needs(self) -> list[tuple[str, Need]]:
        """The types of the parameters."""
        hints = get_type_hints(self.check)
        parameters = inspect.signature(self.check).parameters.items()
        keyword = inspect.Parameter.KEYWORD_ONLY
        return [(name, need_of(hints[name])) for name, it in parameters if it.kind is not keyword]

    @cached_property
    def options(self) -> dict[str, Any]:
        """Options with their defaults: the function's keyword-only parameters."""
        return {
            name: parameter.default
            for name, parameter in inspect.signature(self.check).parameters.items()
            if parameter.kind is inspect.Parameter.KEYWORD_ONLY
        }


def rule(
    id: str, name: str, severity: Severity, concern: Concern, *, judges: tuple[str, ...] = ()
) -> Callable[[Check], Rule]:
    """Make a rule of a function; the page is the docstring of its module.

    Args:
        id: The id, such as `SEN005`; never reused.
        name: What is wrong, such as `lidar-scan-resolution`.
        severity: Unless a finding states otherwise.
        concern: What its findings are about.
        judges: Figures of the trial that it judges.
    """

    def decorate(check: Check) -> Rule:
        page = inspect.getdoc(inspect.getmodule(check)) or ""
        return Rule(id, name, severity, concern, check, page, judges=judges)

    return decorate
