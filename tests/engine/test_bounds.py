"""What is too much for one package is told, and the rest of the check goes on."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.allowance import Allowance
from checker.base.files import TooLarge
from checker.base.parts import NotAvailable, type_name
from checker.engine.subject import Subject
from checker.launch.ros1.graph import LaunchGraph
from checker.package.inputs import open_input
from checker.package.package import DOCUMENTS_FOR_ALL
from checker.pipeline import check_package
from checker.report.report import Cause, VerdictKind
from checker.rule_testing import write_example
from checker.settings import Settings
from checker.source.text import SourceText
from checker.source.xml import (
    ATTRIBUTES_FOR_ONE,
    ELEMENTS_LIMIT,
    XmlDocument,
    elements_in,
    parse_xml,
)
from tests.conftest import SAMPLES

GOOD = SAMPLES / "subtcheck_quadro_sensor_config_1"
_REMEDY = "SUBT_CHECK_ELEMENTS=100000 doubles the limit"


def test_a_part_that_needs_too_much_is_not_available_and_not_tried_again() -> None:
    with open_input(GOOD) as opened:
        subject = Subject(opened.packages[0], allowance=Allowance(seconds_for_all=0.0))
        missing = subject.part(type_name(LaunchGraph))
        assert isinstance(missing, NotAvailable)
        assert missing.reason.startswith("the launch graph cannot be had: it was not begun")
        assert subject.part(type_name(LaunchGraph)) is missing


@pytest.mark.parametrize(
    "text", ["<a/>", "<a><b x='1'/><!-- c --><b></b></a>", "<?xml version='1.0'?><a><b/>x</a>"]
)
def test_elements_are_counted_before_they_are_parsed(text: str) -> None:
    document = parse_xml(SourceText("a.sdf", text))
    assert isinstance(document, XmlDocument)
    assert elements_in(text) == len(document.elements)


def test_a_file_of_too_many_attributes_is_not_read(tmp_path: Path) -> None:
    attributes = (f"a{n}='1'" for n in range(ELEMENTS_LIMIT * ATTRIBUTES_FOR_ONE + 1))
    text = f"<launch {' '.join(attributes)}/>"
    package = write_example({"launch/a.launch": text}, tmp_path)
    with open_input(package) as opened:
        read = opened.packages[0].xml("launch/a.launch")
    assert isinstance(read, TooLarge)
    most = "only files of up to 100,000 are checked"
    assert read.reason == f"has 100,001 attributes; {most} ({_REMEDY})"


def test_a_model_of_too_many_elements_is_not_checked_and_the_others_are(tmp_path: Path) -> None:
    many = f"<link name='l'/>{'<visual/>' * ELEMENTS_LIMIT}"
    package = write_example({"@fragment": many, "urdf/broken.urdf": "<robot>"}, tmp_path)
    (report,) = check_package(package, Settings(trial=False, cache=False)).packages
    assert report.verdict is not VerdictKind.READY
    reasons = {unseen.reason for unseen in report.not_checked if unseen.cause is Cause.NOT_AT_HAND}
    assert any("model.sdf has 50," in reason and _REMEDY in reason for reason in reasons)
    assert not report.crashed
    assert {each.places[0].file for each in report.findings if each.rule == "SDF001"} == {
        "urdf/broken.urdf"
    }


def test_the_limit_of_elements_can_be_raised(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    example = {"launch/a.launch": f"<launch>{'<node/>' * ELEMENTS_LIMIT}</launch>"}
    package = write_example(example, tmp_path)
    settings = Settings(trial=False, select=("SDF001",))
    monkeypatch.setenv("SUBT_CHECK_CACHE", str(tmp_path / "cache"))

    def reasons() -> list[str]:
        (report,) = check_package(package, settings).packages
        assert not report.findings
        return [unseen.reason for unseen in report.not_checked if unseen.rule == "SDF001"]

    (reason,) = reasons()
    assert reason.startswith("launch/a.launch has 50,001 elements")
    monkeypatch.setenv("SUBT_CHECK_ELEMENTS", "100000")
    assert not reasons()


def test_a_description_of_too_many_elements_is_the_reason_that_there_is_no_robot(
    tmp_path: Path,
) -> None:
    urdf = f"<robot name='r'>{'<link/>' * (ELEMENTS_LIMIT + 1)}</robot>"
    example = {"package.xml": "<package/>", "urdf/r.urdf": urdf}
    folder = tmp_path / "r_description"
    for path, text in example.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, "utf-8")
    settings = Settings(trial=False, cache=False, profile="urdf")
    (report,) = check_package(folder, settings).packages
    (reason,) = {unseen.reason for unseen in report.not_checked if unseen.rule == "KIN001"}
    most = "only files of up to 50,000 are checked"
    assert reason == f"urdf/r.urdf has 50,002 elements; {most} ({_REMEDY})"


def test_files_share_what_there_is_for_one_package(tmp_path: Path) -> None:
    text = f"<launch>{'<node/>' * 45_000}</launch>"
    package = write_example({f"launch/{n}.launch": text for n in range(9)}, tmp_path)
    with open_input(package) as opened:
        (found,) = opened.packages
        read = [isinstance(found.xml(f"launch/{n}.launch"), XmlDocument) for n in range(9)]
        assert read.count(True) * 45_000 <= ELEMENTS_LIMIT * DOCUMENTS_FOR_ALL
        assert read == sorted(read, reverse=True)
        assert len(found.too_large) == read.count(False) > 0
        assert "for all" in found.too_large[0].reason


@pytest.mark.slow
def test_a_xacro_file_of_too_many_elements_is_not_checked(tmp_path: Path) -> None:
    """Forty macros, each of which calls the one before twice: a bound of ours, no error of it.

    On a slow machine the bound of processor time comes first.
    """
    macros = "".join(
        f'<xacro:macro name="m{n}"><xacro:m{n - 1}/><xacro:m{n - 1}/></xacro:macro>'
        for n in range(1, 41)
    )
    body = f'<xacro:macro name="m0"><link name="l"/></xacro:macro>{macros}<xacro:m40/>'
    text = f'<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">{body}</robot>'
    (tmp_path / "r.urdf.xacro").write_text(text)
    settings = Settings(trial=False, cache=False, select=("URD001",))
    (report,) = check_package(tmp_path / "r.urdf.xacro", settings).packages
    assert report.verdict is VerdictKind.INCOMPLETE
    assert not report.findings
    (reason,) = {unseen.reason for unseen in report.not_checked if unseen.rule == "URD001"}
    start, _, bound = reason.partition(": ")
    assert start == "r.urdf.xacro is not expanded"
    assert bound in (
        "it expands to more than 50000 elements",
        "expanding it needs more than 5 s of processor time",
    )
