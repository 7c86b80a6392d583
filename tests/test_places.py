"""Every finding points at the words it is about: its place is read again from the file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from checker.finding import Place
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.pipeline import check_package
from checker.report.report import ReportedFinding
from checker.settings import Settings
from checker.source.text import SNIPPET_LIMIT, SourceText
from tests.conftest import SAMPLES

ABOUT_SOMETHING_MISSING = {
    "PKG001": "the folder's name is nowhere in a file",
    "PKG003": "a missing file has no place",
    "PKG008": "what is not installed belongs into the install() that is marked",
    "PKG005": "the description may spell the number in letters",
    "PKG019": "what does not start the robot has no place where it ought to",
    "SDF001": "the mark is where the parser stops; the message says what it met",
    "SPW004": "leftover text is described in words",
    "SPW010": "the height is worked out from the marked pose",
    "SPW005": "the marked pose is what does not use the coordinate",
    "DRV010": "the thrust is worked out from the marked speed",
    "CTL004": "the namespaces belong to the node whose controllers are marked",
    "DOC001": "a missing section has no place in the sheet",
    "DOC004": "the sensor is missing in the marked section",
    "DOC008": "the link is missing in the marked item",
    "BAT005": "the minutes are worked out from the marked time",
    "SEN021": "the marked value says that the sensor is visualized",
    "LCH001": "the path is put together in the marked call",
    "URD008": "interfaces may be written with the package in front",
}
"""Rules whose message names what is not at the marked place, and why."""

Reported = tuple[Package, ReportedFinding]


@cache
def reported(folder: Path) -> tuple[Reported, ...]:
    """Return every finding about the packages in a folder."""
    with open_input(folder) as opened:
        packages = {(package.root, package.name): package for package in opened.packages}
    report = check_package(folder, Settings())
    return tuple(
        (packages[Path(each.path).resolve(), each.name], finding)
        for each in report.packages
        for finding in each.findings
    )


@pytest.fixture(
    scope="module", params=["samples", pytest.param("corpus", marks=pytest.mark.corpus)]
)
def findings(request: pytest.FixtureRequest) -> tuple[Reported, ...]:
    folder = SAMPLES if request.param == "samples" else request.getfixturevalue("corpus")
    return reported(folder)


def text_of(package: Package, place: Place) -> SourceText:
    source = package.read(place.file)
    assert isinstance(source, SourceText), f"{place} cannot be read again"
    return source


def marked(source: SourceText, place: Place) -> str:
    """Return the text from the first to the last marked character, by lines and columns alone."""
    lines = source.text.split("\n")[place.line - 1 : place.end_line]
    lines[-1] = lines[-1][: place.end_column - 1]
    lines[0] = lines[0][place.column - 1 :]
    return "\n".join(lines)


def is_in_a_text(place: Place) -> bool:
    """Say whether a place marks words: not a folder, nor a file as a whole."""
    return bool(place.file) and place != Place(place.file, message=place.message)


def in_files(findings: tuple[Reported, ...]) -> Iterator[tuple[Package, ReportedFinding, Place]]:
    for package, finding in findings:
        for place in finding.places:
            if is_in_a_text(place):
                yield package, finding, place


def test_there_is_something_to_look_at(findings: tuple[Reported, ...]) -> None:
    assert len(list(in_files(findings))) > 20


def test_every_place_lies_within_its_file(findings: tuple[Reported, ...]) -> None:
    for package, finding, place in in_files(findings):
        lines = text_of(package, place).text.split("\n")
        assert 1 <= place.line <= place.end_line <= len(lines), (finding.rule, place)
        assert 1 <= place.column <= len(lines[place.line - 1]) + 1, (finding.rule, place)
        assert 1 <= place.end_column <= len(lines[place.end_line - 1]) + 1, (finding.rule, place)
        assert (place.line, place.column) <= (place.end_line, place.end_column)


def test_the_shown_line_is_the_one_in_the_file(findings: tuple[Reported, ...]) -> None:
    for package, finding, place in in_files(findings):
        line = text_of(package, place).text.split("\n")[place.line - 1].rstrip("\r")
        assert place.snippet == line[:SNIPPET_LIMIT], (finding.rule, place)


def test_a_place_without_a_file_is_the_whole_package(findings: tuple[Reported, ...]) -> None:
    for _, finding in findings:
        for place in finding.places:
            if not place.file:
                assert place == Place("", message=place.message), finding.rule


def test_the_marked_words_are_what_the_message_names(findings: tuple[Reported, ...]) -> None:
    for package, finding, place in in_files(findings):
        worked_out = place.element.endswith("/pose")  # where a part is, not what is written
        if not (worked_out or place.note or finding.rule in ABOUT_SOMETHING_MISSING):
            text, message = marked(text_of(package, place), place), place.message or finding.message
            assert names(message, text), (finding.rule, str(place), message, text)


def test_each_exception_is_a_rule_that_reports_something(corpus: Path) -> None:
    rules = {finding.rule for folder in (SAMPLES, corpus) for _, finding in reported(folder)}
    assert ABOUT_SOMETHING_MISSING.keys() <= rules


def names(message: str, text: str) -> bool:
    """Say whether a message names the marked text.

    Either holds the other's words: the message has the marked value, the tag or the name of the
    marked element (of a class its last word), a number of the marked words; or the text has a
    value that the message quotes. What xacro and roslaunch work out cannot be compared.
    """
    plain = " ".join(text.replace("`", "").split())
    if plain and re.search(rf"(?<!\w){re.escape(plain)}(?!\w)", message):
        return True
    if "$(" in plain or "${" in plain:  # the message has what is worked out of it
        return True
    tag = re.match(r"<([\w:.-]+)", text)
    if tag:
        quoted = re.findall(r"=\s*[\"']([^\"']+)[\"']", text)
        words = [
            tag[1].rpartition(":")[2],
            *quoted,
            *(value.rsplit("::", 1)[-1] for value in quoted),
        ]
        return any(word in message for word in words)
    values = re.findall(r"'([^']+)'|(\d+(?:\.\d+)?)", message)
    return any(value and value in plain for pair in values for value in pair)


@pytest.mark.parametrize(
    ("message", "text", "expected"),
    [
        ("scan resolution is 0.1, expected 1", "0.1", True),
        ("<alwaysOn> in <sensor> is unknown", "<alwaysOn>", True),
        ("model 'arm' is nested in model 'rover'", '<model name="arm">', True),
        ("lists 2 × camera, but the model has 1", "2x camera, `camera` plugin", True),
        ("mass is 5 kg", "<pose>", False),
        ("joint 'a' has child 'b', which does not exist", "c", False),
        ("scan resolution is 0.1, expected 1", "", False),
    ],
)
def test_what_counts_as_named(message: str, text: str, expected: bool) -> None:
    assert names(message, text) is expected
