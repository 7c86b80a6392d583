"""What a person at a terminal reads."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.base.words import and_list, count, plain, shortened
from checker.finding import Concern, Edit, Fix, Place, Safety, Severity
from checker.report.figures import rows_of
from checker.report.render_settings import Palette, RenderSettings
from checker.report.report import (
    Cause,
    InheritedPart,
    NotChecked,
    NotOpened,
    PackageReport,
    Repeat,
    Report,
    ReportedFinding,
)
from checker.report.text_report import TextReport, to_text

LINE = "      <resolution>0.1</resolution>"
PLACE = Place("model.sdf", 141, 19, 141, 22, snippet=LINE)
FAULT = ReportedFinding(
    "SEN005",
    "lidar-scan-resolution",
    Severity.ERROR,
    Concern.INTERFACE,
    "scan resolution is 0.1, expected 1",
    "0" * 16,
    (PLACE,),
    why="Rays are lost.",
    how="write 1.",
)
PACKAGE = PackageReport("rover", "models/rover", "base_model", ())
SETTINGS = RenderSettings(Palette(enabled=False))


def text(*packages: PackageReport, not_opened: tuple[NotOpened, ...] = ()) -> str:
    return to_text(Report(packages, {}, not_opened), SETTINGS)


def lines(*findings: ReportedFinding) -> list[str]:
    return text(replace(PACKAGE, findings=findings)).splitlines()


def full(*findings: ReportedFinding) -> list[str]:
    package = replace(PACKAGE, findings=findings)
    return to_text(Report((package,), {}), replace(SETTINGS, full=True)).splitlines()


def test_a_report_begins_with_the_verdict_and_what_to_do_first() -> None:
    assert lines(FAULT) == [
        "rover  base model",
        "Not ready: 1 error of the interface to fix",
        "",
        "Do first:",
        "models/rover/model.sdf:141:19 error SEN005 lidar-scan-resolution: "
        "scan resolution is 0.1, expected 1",
        "    fix: write 1.",
        "",
        "rover: Not ready: 1 error of the interface to fix",
        "",
        "`subt-check rule SEN005` explains a rule, `--full` shows source lines and reasons",
    ]


def test_the_full_form_has_source_line_and_reason_too() -> None:
    assert full(FAULT)[5:] == [
        "    141 |       <resolution>0.1</resolution>",
        "        |                   ^^^",
        "    why: Rays are lost.",
        "    fix: write 1.",
        "",
        "rover: Not ready: 1 error of the interface to fix",
        "",
        "`subt-check rule SEN005` explains a rule",
    ]


def test_errors_come_in_the_order_of_loading_moving_and_sensing() -> None:
    rules = ["SEN005", "TRI003", "KIN001", "BRG002", "SDF001", "SDF001", "INE004", "PKG001"]
    concerns = {"PKG001": Concern.PAPERWORK}
    found = [
        replace(FAULT, rule=rule, message=str(number), concern=concerns.get(rule, Concern.ROBOT))
        for number, rule in enumerate(rules)
    ]
    warning = replace(FAULT, severity=Severity.WARNING)
    shown = [line.split(" lidar")[0].split(" ")[-1] for line in lines(warning, *found)[3:-4]]
    assert shown == [
        *("first:", "SDF001", "1.", "KIN001", "1.", "INE004", "1.", "TRI003", "1.", "BRG002", "1."),
        *("", "errors:", "SDF001", "SEN005", "1.", "PKG001", "1."),
        *("", "Warnings:", "SEN005"),
    ]


def test_the_line_to_write_is_that_of_the_fix() -> None:
    edit = Edit(PLACE, "1", "0.1")
    fixed = replace(FAULT, fix=Fix(Safety.SAFE, (edit,)))
    assert "    fix: write `<resolution>1</resolution>`" in lines(fixed)
    assert lines(fixed)[-1] == "`--fix` corrects 1 finding"
    twice = replace(fixed, fix=Fix(Safety.UNSAFE, (edit, edit)))
    assert "    fix: write `<resolution>1</resolution>`" in lines(twice)
    elsewhere = replace(edit, place=replace(PLACE, file="other.sdf"))
    both = replace(fixed, fix=Fix(Safety.UNSAFE, (edit, elsewhere)))
    assert "    fix: write 1." in lines(both)
    other = replace(fixed, fix=Fix(Safety.UNSAFE, (elsewhere, elsewhere)))
    written = (
        f"    fix: write `<resolution>1</resolution>` at models/rover/other.sdf:{PLACE.line}:1"
    )
    assert written in lines(other)
    assert lines(fixed, twice)[-2:] == [
        "`--fix` corrects 1 finding",
        "`--fix --unsafe` corrects 2 findings",
    ]


def test_a_line_that_stays_is_not_to_be_written() -> None:
    place = Place("model.sdf", 2, 8, 2, 8, snippet="  <a/>")
    added = Edit(replace(place, column=7, end_column=7), "\n  <b/>\n  <c/>", "")
    fixed = replace(FAULT, places=(place,), fix=Fix(Safety.SAFE, (added,)))
    assert "    fix: write `<b/> <c/>`" in lines(fixed)
    of_windows = replace(added, replacement=added.replacement.replace("\n", "\r\n"))
    assert "    fix: write `<b/> <c/>`" in lines(
        replace(fixed, fix=Fix(Safety.SAFE, (of_windows,)))
    )
    closed = replace(added.place, snippet="  </a>")
    behind = replace(fixed, fix=Fix(Safety.SAFE, (replace(added, place=closed),)))
    assert "    fix: write `<b/> <c/>`" in lines(behind)
    opened = replace(added.place, snippet="  <a>", column=6, end_column=6)
    inside = replace(fixed, fix=Fix(Safety.SAFE, (replace(added, place=opened),)))
    assert "    fix: write `<a> <b/> <c/>`" in lines(inside)


def test_rules_that_report_the_same_fault_are_named_once() -> None:
    repeat = Repeat("SEN003", "lidar-scan", Severity.WARNING, "is odd", (PLACE,))
    found = replace(FAULT, repeats=(repeat, replace(repeat, message="is odd, too")))
    assert [line for line in lines(found) if "SEN003" in line] == ["    also SEN003 lidar-scan"]
    report = Report((replace(PACKAGE, findings=(found,)),), {})
    concise = to_text(report, replace(SETTINGS, concise=True))
    assert "expected 1 [SEN005, also SEN003]\n" in concise


def test_a_finding_about_the_folder_shows_the_folder_alone() -> None:
    assert lines(replace(FAULT, places=(Place(""),)))[4].startswith("models/rover/ error SEN005 ")


def test_why_and_how_are_said_once_for_a_rule_in_a_package() -> None:
    other = replace(FAULT, message="differs")
    assert "\n".join(full(FAULT, other)).count("why: ") == 1
    assert "\n".join(full(FAULT, other)).count("141 |") == 2
    twice = text(
        replace(PACKAGE, findings=(FAULT, FAULT)), replace(PACKAGE, name="b", findings=(FAULT,))
    )
    assert twice.count("fix: ") == 2


def test_repeats_are_named_up_to_three_and_counted() -> None:
    places = tuple(replace(PLACE, line=line) for line in range(1, 26))
    (also,) = (line for line in lines(replace(FAULT, places=places)) if "also" in line)
    shown = [f"models/rover/model.sdf:{line}:19" for line in (2, 3, 4)]
    assert also == f"    also {', '.join(shown)} and 21 more places"
    four = [line for line in lines(replace(FAULT, places=places[:4])) if "also" in line]
    assert four == [f"    also {', '.join(shown)}"]


def test_places_of_one_line_are_counted() -> None:
    again = replace(PLACE, message="of another link")
    noted = replace(PLACE, note="the first one")
    elsewhere = replace(PLACE, line=9)
    found = replace(FAULT, places=(PLACE, again, again, noted, elsewhere))
    own = [line for line in full(found) if line.startswith("    ")]
    assert "    2 more from the same line" in own
    assert not any("of another link" in line for line in own)
    assert any(line.endswith(": the first one") for line in own)
    assert any("model.sdf:9:19" in line for line in own)


def test_figures_that_agree_are_one() -> None:
    figure = {"name": "torque", "label": "t", "unit": "N·m", "verdict": "ok", "rule": "TRI009"}
    alike, apart = (
        [{**figure, "limits": {}, "value": value} for value in values]
        for values in ((0.353, 0.354), (0.353, 0.36))
    )
    assert [row.value for row in rows_of(alike)] == ["0.354 N·m"]
    assert [row.value for row in rows_of(apart)] == ["0.353…0.36 N·m"]


def test_a_related_place_says_what_it_has_to_do_with_it() -> None:
    related = replace(PLACE, file="../other/model.sdf", line=3, note="the first of that name")
    assert "    models/other/model.sdf:3:19: the first of that name" in lines(
        replace(FAULT, places=(PLACE, related))
    )


def test_infos_are_counted_and_take_one_line_where_they_are_asked_for() -> None:
    package = replace(PACKAGE, findings=(replace(FAULT, severity=Severity.INFO),))
    assert lines(*package.findings)[2:] == [
        "1 info, show with --info",
        "rover: Ready: nothing to fix",
    ]
    shown = to_text(Report((package,), {}), replace(SETTINGS, infos=True)).splitlines()
    assert shown[3] == "Infos:"
    assert shown[4].startswith("models/rover/model.sdf:141:19 info SEN005 ")
    assert shown[5:7] == ["", "rover: Ready: nothing to fix"]


def test_quiet_shows_findings_and_nothing_else() -> None:
    report = Report((replace(PACKAGE, findings=(FAULT,)), PACKAGE), {})
    shown = to_text(report, replace(SETTINGS, quiet=True)).splitlines()
    assert shown[0].startswith("models/rover/model.sdf:141:19 error SEN005 ")
    assert shown[-2:] == ["    fix: write 1.", ""]


def test_concise_has_one_line_a_finding_and_the_verdict() -> None:
    more = replace(FAULT, places=(PLACE, PLACE, PLACE))
    report = Report((replace(PACKAGE, findings=(FAULT, more)),), {})
    place = "models/rover/model.sdf:141:19: error: scan resolution is 0.1, expected 1"
    assert to_text(report, replace(SETTINGS, concise=True)).splitlines() == [
        f"{place} [SEN005]",
        f"{place} (and 2 more) [SEN005]",
        "rover: Not ready: 2 errors of the interface to fix",
    ]


def test_a_package_waits_for_those_whose_files_it_reports() -> None:
    shared = replace(PLACE, file="../base/model.sdf")
    heir = replace(PACKAGE, name="a", path="m/a", findings=(replace(FAULT, places=(shared,)),))
    base = replace(PACKAGE, name="base", path="m/base", findings=(FAULT,))
    text = TextReport(SETTINGS, ["m/a", "m/b", "m/base"])
    assert list(text.add([heir], "m/a")) == []
    assert list(text.add([replace(PACKAGE, name="b", path="m/b")], "m/b")) == []
    told = list(text.add([base], "m/base"))
    assert [block.split()[0] for block in told] == ["a", "b:", "base"]
    assert "1 finding in base: listed there" in told[0]
    assert list(text.deferred_lines()) == []


def test_the_caret_stays_below_the_marked_words_of_a_long_line() -> None:
    start = 150
    place = Place("a", 7, start + 1, 7, start + 5, snippet="x" * start + "here" + "y" * 80)
    code, caret = full(replace(FAULT, places=(place,)))[5:7]
    at = caret.index("^")
    assert code[at : at + 4] == "here"
    assert caret[at:] == "^^^^"


def test_a_mark_that_spans_lines_ends_with_the_first() -> None:
    place = replace(PLACE, end_line=143, end_column=4)
    caret = full(replace(FAULT, places=(place,)))[6]
    assert caret.count("^") == len(LINE) - 18


def test_tabs_do_not_move_the_caret() -> None:
    place = Place("a", 1, 3, 1, 4, snippet="\t\tx")
    code, caret = full(replace(FAULT, places=(place,)))[5:7]
    assert code[caret.index("^")] == "x"


_places = st.builds(
    lambda line, column, width, snippet: Place(
        "a", line, column, line, column + width, "", "", snippet
    ),
    st.integers(1, 10**6),
    st.integers(1, 10**6),
    st.integers(0, 10**6),
    st.text(max_size=240),
)


@given(_places, st.text(), st.text())
def test_any_text_is_shown_without_control_characters_in_lines_of_bounded_length(
    place: Place, message: str, name: str
) -> None:
    finding = replace(FAULT, places=(place, replace(place, note=message)), message=message * 100)
    package = replace(
        PACKAGE,
        name=name,
        path="p",
        findings=(finding,),
        not_checked=(NotChecked("SEN001", message * 100, Cause.NOT_AT_HAND),),
        inherited=(InheritedPart(name, message, at_hand=False),),
        facts={"robot": name, "mass_kg": 1.0},
    )
    shown = text(package, not_opened=(NotOpened(name, message, failed=False),))
    assert plain(shown.replace("\n", "")) == shown.replace("\n", "")
    assert max(map(len, shown.split("\n"))) < 1000 + 4 * len(name + message)


def test_findings_in_a_sibling_that_is_checked_too_are_shown_there() -> None:
    foreign = replace(FAULT, places=(replace(PLACE, file="../base/model.sdf"),))
    package = replace(PACKAGE, findings=(foreign,))
    alone = text(package)
    assert "models/base/model.sdf:141:19 error" in alone
    unsaid = text(replace(PACKAGE, name="base", path="models/base"), package)
    assert "models/base/model.sdf:141:19 error" in unsaid
    own = replace(PACKAGE, name="base", path="models/base", findings=(FAULT,))
    both = text(own, package)
    assert "1 finding in base: listed there" in both
    assert both.count("models/base/model.sdf:141:19") == 1
    assert "rover: Not ready: 1 error to fix" in both


def test_what_was_not_checked_is_grouped_by_its_reason() -> None:
    reasons = [
        NotChecked("SEN001", "the model is not available", Cause.NOT_AT_HAND),
        NotChecked("SEN002", "the model is not available", Cause.NOT_AT_HAND),
        NotChecked("SEN003", "switched off", Cause.SWITCHED_OFF),
        NotChecked("SEN004", "the package carries no robot", Cause.NOT_APPLICABLE),
    ]
    shown = text(replace(PACKAGE, not_checked=tuple(reasons)))
    assert "not checked: SEN001, SEN002: the model is not available\n" in shown
    assert "not checked: SEN003: switched off\n" in shown
    assert "SEN004" not in shown
    assert shown.endswith(
        "rover: Incomplete: no error, but 2 rules for errors could not run: the model is not "
        "available (1 rule switched off)\n"
    )


def test_facts_have_their_units() -> None:
    facts = {
        "robot": "rover",
        "mass_kg": 18.4,
        "links": 10,
        "joints": 1,
        "drive": "no drive detected",
    }
    shown = text(replace(PACKAGE, facts=facts))
    assert "robot rover, mass 18.4 kg, 10 links, 1 joint, no drive detected\n" in shown


def test_objects_of_a_world_take_one_line() -> None:
    robot = {"robot": "rover", "joints": 2, "sensors": 0, "plugins": 1}
    objects = [{"robot": name, "joints": 0, "sensors": 0, "plugins": 0} for name in ("cone", "can")]
    shown = text(replace(PACKAGE, facts=robot, other_robots=tuple(objects)))
    assert "robot rover, 2 joints" in shown
    assert "robot cone" not in shown
    assert "2 objects without joints, sensors and plugins: cone and can\n" in shown


def test_inherited_parts_name_their_source() -> None:
    parts = (
        InheritedPart("model", "base", at_hand=True),
        InheritedPart("launch/a.launch", "base", at_hand=True),
        InheritedPart("spawner", "gone", at_hand=False),
    )
    shown = text(replace(PACKAGE, inherited=parts))
    assert "inherited from base: model and launch/a.launch\n" in shown
    assert "inherited from gone (not found): spawner\n" in shown


def test_several_packages_end_with_a_table_and_what_was_not_looked_at() -> None:
    shown = text(
        replace(PACKAGE, findings=(FAULT,)),
        replace(PACKAGE, name="long_name"),
        not_opened=(
            NotOpened("models/docs", "contains no package", failed=False),
            NotOpened("nowhere", "does not exist", failed=True),
        ),
    )
    assert shown.splitlines()[-8:] == [
        "package    verdict    errors  warnings  infos",
        "rover      not ready       1         0      0",
        "long_name  ready           0         0      0",
        "2 packages, 1 ready",
        "",
        "not opened: models/docs contains no package",
        "",
        "`subt-check rule SEN005` explains a rule, `--full` shows source lines and reasons",
    ]


def test_many_packages_end_with_what_to_do_first_in_all() -> None:
    others = [replace(PACKAGE, name=f"p{number}", path=f"p{number}") for number in range(5)]
    load = replace(FAULT, rule="SDF001", name="not-well-formed", message="a tag is open")
    broken = replace(PACKAGE, path="b", findings=(load,))
    shown = text(replace(PACKAGE, findings=(FAULT, FAULT)), *others, broken).splitlines()
    head = shown.index("Do first in all packages:")
    assert shown[head + 1 : head + 4] == [
        "b/model.sdf:141:19 error SDF001 not-well-formed: a tag is open",
        "models/rover/model.sdf:141:19 error SEN005 lidar-scan-resolution: scan resolution is 0.1, "
        "expected 1",
        "",
    ]


def test_packages_with_nothing_to_state_take_one_line() -> None:
    names = ("a_msgs", "b_msgs")
    ready = [replace(PACKAGE, name=name) for name in names]
    with_robot = replace(PACKAGE, facts={"robot": "rover", "mass_kg": 1.0})
    shown = text(*ready, with_robot).splitlines()
    assert shown[:3] == ["a_msgs: Ready: nothing to fix", "b_msgs: Ready: nothing to fix", ""]
    assert shown[3] == "rover  base model"


def test_nothing_checked_says_nothing() -> None:
    assert text() == ""


def test_wording() -> None:
    assert [count(n, "error") for n in (0, 1, 2)] == ["0 errors", "1 error", "2 errors"]
    assert [and_list(list("abc")[:n]) for n in range(4)] == ["", "a", "a and b", "a, b and c"]
    assert (shortened("abc", 3), shortened("abcd", 3)) == ("abc", "ab…")
    assert plain("a\x1b[31m\n\u202e\udcff") == "a\ufffd[31m\ufffd\ufffd\ufffd"


def test_an_edit_that_several_robots_bring_is_made_once() -> None:
    edits = tuple(Edit(replace(PLACE, element=name), "1", "0.1") for name in ("scout", "rover"))
    shown = lines(replace(FAULT, fix=Fix(Safety.SAFE, edits)))
    assert "    fix: write `<resolution>1</resolution>`" in shown


def test_a_copy_in_the_same_folder_has_one_line() -> None:
    first, copy = (
        replace(PACKAGE, name=name, path=f"models/{name}", findings=(FAULT,))
        for name in ("cone_1", "cone_2")
    )
    line = "cone_2: Not ready: 1 error of the interface to fix, the same as in cone_1\n"
    assert line in text(first, copy)
    assert line not in text(first, replace(copy, path="others/cone_2"))
    moved = replace(FAULT, places=(replace(PLACE, line=142),))
    assert line not in text(first, replace(copy, findings=(moved,)))
    assert line not in to_text(Report((first, copy), {}), replace(SETTINGS, full=True))
