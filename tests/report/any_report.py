"""Reports of all kinds for property tests: any text, any places, everything that may be absent."""

from __future__ import annotations

from hypothesis import strategies as st

from checker.finding import Concern, Edit, Fix, Place, Safety, Severity
from checker.report.launched import Launched, LaunchedNode, LaunchedTopic, LaunchedTransform
from checker.report.report import (
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Repeat,
    Report,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)

HOSTILE = ("</script>", "##[error]x", "::error::x", "@all #1", "a|b`c", "\x1b[31m", "\u202e", "%0A")
TEXT = st.one_of(
    st.sampled_from(HOSTILE), st.text(st.characters(exclude_categories=()), max_size=20)
)
RULE = st.from_regex(r"[A-Z][A-Z0-9]{2}[0-9]{3}", fullmatch=True)
FILES = st.one_of(st.sampled_from(["", "model.sdf", "a b/ü%.sdf", "../other/model.sdf"]), TEXT)


@st.composite
def places(draw: st.DrawFn) -> Place:
    """Draw a place; it ends where it begins or later."""
    line, column = draw(st.integers(1, 9)), draw(st.integers(1, 9))
    end = draw(st.integers(line, 10))
    end_column = draw(st.integers(column if end == line else 1, 12))
    file, element, note, snippet = (draw(each) for each in (FILES, TEXT, TEXT, TEXT))
    return Place(file, line, column, end, end_column, element, note, snippet)


FIXES = st.builds(
    lambda safety, edits: Fix(safety, tuple(edits)),
    st.sampled_from(Safety),
    st.lists(st.builds(Edit, places(), TEXT, TEXT), min_size=1, max_size=3),
)
NAME = st.from_regex(r"[a-z]+(-[a-z0-9]+)*", fullmatch=True).map(lambda name: name[:60])
MESSAGE = TEXT.map(lambda text: f"x{text}")
PLACES = st.lists(places(), min_size=1, max_size=3).map(tuple)
REPEATS = st.builds(Repeat, RULE, NAME, st.sampled_from(Severity), MESSAGE, PLACES)
FINDINGS = st.builds(
    ReportedFinding,
    RULE,
    NAME,
    st.sampled_from(Severity),
    st.sampled_from(Concern),
    MESSAGE,
    st.from_regex(r"[0-9a-f]{16}", fullmatch=True),
    PLACES,
    st.none() | FIXES,
    TEXT,
    TEXT,
    title=TEXT,
    source=TEXT,
    repeats=st.lists(REPEATS, max_size=2).map(tuple),
)
TOPICS = st.lists(TEXT, max_size=2).map(tuple)
LAUNCHED = st.builds(
    Launched,
    TEXT,
    TOPICS,
    st.lists(st.builds(LaunchedNode, TEXT, TOPICS, TOPICS), max_size=3).map(tuple),
    st.lists(st.builds(LaunchedTopic, TEXT, TOPICS), max_size=3).map(tuple),
    st.lists(st.builds(LaunchedTransform, TEXT, TEXT, TEXT), max_size=4).map(tuple),
    TEXT,
)
PACKAGES = st.builds(
    PackageReport,
    TEXT,
    TEXT,
    st.just("robot"),
    st.lists(FINDINGS, max_size=3).map(tuple),
    st.lists(st.builds(NotChecked, RULE, TEXT, st.sampled_from(Cause)), max_size=2).map(tuple),
    facts=st.dictionaries(st.sampled_from(["robot", "drive"]), TEXT, max_size=2),
    timings=st.just({"open": 1234.5}),
    fail_on=st.sampled_from([Severity.ERROR, Severity.WARNING]),
    suppressed=st.lists(
        st.builds(Suppressed, FINDINGS, st.sampled_from(SuppressedBy), TEXT, st.none() | places()),
        max_size=2,
    ).map(tuple),
    looked=st.lists(RULE, max_size=2).map(tuple),
    launched=st.lists(LAUNCHED, max_size=2).map(tuple),
)
REPORTS = st.builds(
    Report,
    st.lists(PACKAGES, max_size=2).map(tuple),
    st.just({"subt-check": "1.0"}),
    st.lists(st.builds(NotOpened, TEXT, TEXT, st.booleans()), max_size=2).map(tuple),
)


def many(number: int, rule: str = "SDF004", severity: Severity = Severity.ERROR) -> Report:
    """Return a report with as many findings of one rule, each with all that one can have."""
    place = Place("model.sdf", 3, 5, 3, 9, "sdf/model[m]", snippet="    <a/>" + "x" * 200)
    findings = tuple(
        ReportedFinding(
            rule,
            "unknown-element",
            severity,
            Concern.PORTABILITY,
            f"element {index} " + "\N{ROBOT FACE}" * 900,
            f"{index:016x}",
            (Place("model.sdf", index + 1, 1, index + 1, 4, snippet="<a/>"), place),
            why="It is ignored.",
            how="take it out.",
        )
        for index in range(number)
    )
    return Report((PackageReport("rover", "models/rover", "robot", findings),), {})
