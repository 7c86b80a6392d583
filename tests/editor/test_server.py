"""The language server as an editor meets it: a real process, on samples."""

from __future__ import annotations

import asyncio
import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from lsprotocol import types as lsp

from checker.pipeline import check_package
from checker.rulebook.rule_index import rules
from checker.settings import Settings
from tests.editor.client import ROVER, SCOUT, SECONDS, Editor, shown

pytestmark = pytest.mark.asyncio(loop_scope="module")


@pytest.fixture
def model(folder: Path) -> Iterator[Path]:
    """The model of the broken rover, as it was after each test."""
    path = folder / ROVER / "model.sdf"
    before = path.read_text("utf-8")
    yield path
    path.write_text(before, "utf-8")


def replaced(path: Path, old: str, new: str) -> str:
    text = path.read_text("utf-8")
    assert text.count(old) >= 1
    return text.replace(old, new, 1)


async def test_findings_are_those_of_a_check(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    report = check_package(model.parent, Settings(trial=False)).packages[0]
    expected = {
        (place.line, finding.rule, place.message or finding.message)
        for finding in report.findings
        for place in finding.places
        if place.file == "model.sdf" and not place.note
    }
    told = shown(found)
    measured = {"INE", "GEO", "SEN", "TRI", "BAL"}
    assert told <= expected
    assert {each[1][:3] for each in expected - told} <= measured
    assert len(told) > 30
    await editor.close(model)


async def test_a_finding_has_its_rule_related_places_and_hint(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    by_rule = {each.code: each for each in found}
    unknown = by_rule["KIN001"]
    assert unknown.severity is lsp.DiagnosticSeverity.Error
    assert unknown.code_description is not None
    assert unknown.code_description.href.endswith("/rules/KIN001.html")
    assert any(each.related_information for each in found)
    hints = [each for each in found if each.severity is lsp.DiagnosticSeverity.Hint]
    assert len(hints) == 1
    assert "could not run" in hints[0].message
    await editor.close(model)


async def test_the_text_of_the_editor_counts_and_not_the_disk(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    assert "KIN001" in {each.code for each in found}
    wrong = "<child>rear_right_wheels</child>"
    mended = replaced(model, wrong, "<child>rear_right_wheel</child>")
    found = await editor.change(model, mended)
    assert "KIN001" not in {each.code for each in found}
    assert wrong in model.read_text("utf-8")
    editor.save(model)
    found = await editor.change(model, mended + "\n")
    assert "KIN001" not in {each.code for each in found}
    await editor.close(model)


async def test_other_files_of_the_package_see_it(editor: Editor, model: Path) -> None:
    sheet = model.parent / "specifications.md"
    before = await editor.open(sheet)
    await editor.open(model)
    camera = r'<sensor name="camera_front" type="rgbd_camera">.*?</sensor>'
    text = re.sub(camera, "", editor.text(model), flags=re.DOTALL)
    editor.type(model, text)
    await editor.found(model)
    after = await editor.found(sheet)
    assert any("RealSense" in message for _, _, message in shown(after) - shown(before))
    await editor.close(model)
    await editor.close(sheet)


async def test_text_that_is_no_xml_just_now(editor: Editor, model: Path) -> None:
    await editor.open(model)
    broken = replaced(model, "</link>", "</lin")
    found = await editor.change(model, broken)
    assert {each.code for each in found if each.severity is lsp.DiagnosticSeverity.Error} == {
        "SDF001"
    }
    found = await editor.change(model, model.read_text("utf-8"))
    assert "SDF001" not in {each.code for each in found}
    await editor.close(model)


async def test_a_fix_mends_its_finding(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    angle = next(each for each in found if each.code == "GEO001")
    actions = await editor.actions(model, [angle])
    first = actions[0]
    assert first.is_preferred
    assert first.title.startswith("GEO001: replace '1.57' with '1.57079")
    (text,) = editor.applied(first.edit).values()
    found = await editor.change(model, text)
    assert (angle.range.start.line, "GEO001") not in {(d.range.start.line, d.code) for d in found}
    await editor.close(model)


async def test_all_safe_fixes_at_once(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    actions = await editor.actions(model, [], only=["source.fixAll.subt-check"])
    (everything,) = actions
    ((uri, text),) = editor.applied(everything.edit).items()
    assert uri == model.as_uri()
    after = await editor.change(model, text)
    assert len(shown(after)) < len(shown(found))
    assert await editor.actions(model, [], only=["source.fixAll.subt-check"]) == []
    await editor.close(model)


@pytest.mark.parametrize(
    ("file", "comment"),
    [
        ("model.sdf", "<!-- subt-check: ignore["),
        ("launch/spawner.rb", "# subt-check: ignore["),
    ],
)
async def test_a_finding_is_suppressed_with_a_reason(
    editor: Editor, folder: Path, file: str, comment: str
) -> None:
    path = folder / ROVER / file
    found = await editor.open(path)
    before = len(shown(found))
    finding = next(each for each in found if each.severity is lsp.DiagnosticSeverity.Error)
    actions = await editor.actions(path, [finding])
    suppress = next(each for each in actions if "suppress here" in each.title)
    (text,) = editor.applied(suppress.edit).values()
    assert f"{comment}{finding.code}] TODO: say why" in text
    after = await editor.change(path, text)
    assert len(shown(after)) < before
    assert finding.message not in {each.message for each in after}
    await editor.close(path)


async def test_a_rule_is_switched_off(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    angle = next(each for each in found if each.code == "GEO001")
    actions = await editor.actions(model, [angle])
    off = next(each for each in actions if "switch off" in each.title)
    assert off.edit is not None
    assert isinstance((off.edit.document_changes or ())[0], lsp.CreateFile)
    ((uri, text),) = editor.applied(off.edit).items()
    assert text == 'ignore = ["GEO001"]\n'
    settings = model.parent / "subt-check.toml"
    assert uri == settings.as_uri()
    settings.write_text(text)
    try:
        editor.save(model)
        found = await editor.change(model, editor.texts[model.as_uri()] + "\n")
        assert "GEO001" not in {each.code for each in found}
    finally:
        settings.unlink()
    await editor.close(model)


async def test_settings_that_cannot_be_used(editor: Editor, folder: Path) -> None:
    scout = folder / SCOUT / "package.xml"
    settings = folder / SCOUT / "subt-check.toml"
    settings.write_text("profiles = 1\n")
    try:
        found = await editor.open(scout)
        assert [each.message for each in found if "unknown key" in each.message]
        assert "unknown key 'profiles'" in (await editor.open(settings))[0].message
        await editor.close(settings)
    finally:
        settings.unlink()
    editor.save(scout)
    found = await editor.change(scout, editor.texts[scout.as_uri()] + "\n")
    assert not [each.message for each in found if "unknown key" in each.message]
    await editor.close(scout)


async def test_lenses_tell_mass_and_verdict(editor: Editor, model: Path) -> None:
    await editor.open(model)
    identifier = lsp.TextDocumentIdentifier(model.as_uri())
    lenses = await editor.client.text_document_code_lens_async(lsp.CodeLensParams(identifier))
    titles = [lens.command.title for lens in lenses or () if lens.command]
    assert len(titles) == 3
    assert titles[0].startswith("18.5 kg · Not ready: ")
    assert titles[1:] == ["show in 3D", "drive it"]
    assert {lens.range.start.line for lens in lenses or ()} == {2}
    await editor.close(model)


@pytest.mark.slow
async def test_a_drive_tells_what_came_of_it(editor: Editor, folder: Path) -> None:
    robot = folder / SCOUT / "urdf" / "scout.urdf.xacro"
    found = await editor.open(robot)
    measured = {rule.id for rule in rules_that_measure()}
    assert not measured & {str(each.code) for each in found}
    asked = lsp.ExecuteCommandParams("subt-check.server.drive", [robot.as_uri()])
    told = await editor.client.workspace_execute_command_async(asked)
    assert "drives at 0." in str(told)
    told_of = [each for reports in editor.client.progress_reports.values() for each in reports]
    assert {"begin", "end"} <= {dict(each)["kind"] for each in told_of}
    await editor.close(robot)


@pytest.mark.slow
async def test_weights_are_told_by_command_and_stay(editor: Editor, model: Path) -> None:
    found = await editor.open(model)
    assert not any(each.code == "INE003" for each in found)
    asked = lsp.ExecuteCommandParams("subt-check.server.check", [model.as_uri()])
    sentence = await editor.client.workspace_execute_command_async(asked)
    assert str(sentence).startswith("Not ready: ")
    measured = {rule.id for rule in rules_that_measure()}
    text = "<!-- a line above -->\n" + editor.texts[model.as_uri()].removeprefix("\ufeff")
    text = editor.texts[model.as_uri()].replace("<sdf", "<!-- a line more -->\n<sdf", 1)
    after = await editor.change(model, text)
    found = [each for each in after if each.code in measured]
    assert found
    await editor.close(model)


@pytest.mark.slow
async def test_the_robot_is_shown_in_3d(editor: Editor, folder: Path) -> None:
    robot = folder / SCOUT / "urdf" / "scout.urdf.xacro"
    await editor.open(robot)
    asked = lsp.ExecuteCommandParams("subt-check.server.show3d", [robot.as_uri()])
    answer = await editor.client.workspace_execute_command_async(asked)
    page = Path(answer["uri"].removeprefix("file://"))
    assert "<html" in page.read_text("utf-8")[:500]
    assert (page.parent / "robot.glb").read_bytes()[:4] == b"glTF"
    assert any(each.uri == answer["uri"] for each in editor.client.shown_documents)
    shutil.rmtree(page.parent)
    await editor.close(robot)


async def test_a_file_outside_of_packages(editor: Editor, tmp_path: Path) -> None:
    path = tmp_path / "notes.xml"
    path.write_text("<notes/>")
    assert await editor.open(path) == []
    await editor.close(path)


async def test_a_lone_model_that_is_not_on_disk_yet(editor: Editor, folder: Path) -> None:
    path = folder / ROVER / "launch" / "new.launch"
    found = await editor.open(path, "<launch><node></launch>")
    assert "SDF001" in {each.code for each in found}
    assert not path.exists()
    await editor.close(path)


def rules_that_measure() -> list[object]:
    from checker.base.cache import NO_CACHE
    from checker.editor.check import is_measured

    return [rule for rule in rules(NO_CACHE) if is_measured(rule)]


async def test_a_check_with_trial_is_cancelled(editor: Editor, folder: Path) -> None:
    robot = folder / SCOUT / "urdf" / "scout.urdf.xacro"
    await editor.open(robot, (folder / SCOUT / "urdf/scout.urdf.xacro").read_text() + "<!-- 1 -->")
    known = set(editor.client.progress_reports)
    asked = lsp.ExecuteCommandParams("subt-check.server.check", [robot.as_uri()])
    answer = asyncio.ensure_future(editor.client.workspace_execute_command_async(asked))
    async with asyncio.timeout(SECONDS):
        while not (begun := set(editor.client.progress_reports) - known):
            await asyncio.sleep(0.01)
    (token,) = begun
    cancel = lsp.WorkDoneProgressCancelParams(token)
    editor.client.window_work_done_progress_cancel(cancel)
    assert await answer is None
    assert editor.client.messages[-1].message == "the check was stopped"
    await editor.close(robot)


@pytest.mark.slow
async def test_each_save_weighs_where_the_user_wants_it(editor: Editor, model: Path) -> None:
    measured = {rule.id for rule in rules_that_measure()}
    editor.configure({"subt-check": {"trial": "save"}})
    try:
        await editor.open(model, model.read_text("utf-8") + "\n")
        editor.save(model)
        await editor.told(
            lambda params: (
                params.uri == model.as_uri()
                and any(each.code in measured for each in params.diagnostics)
            )
        )
    finally:
        editor.configure({"subt-check": {"trial": "command"}})
    await editor.close(model)
