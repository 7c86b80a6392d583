"""The verdict on the package of an open file, which the server sends to clients that show it."""

from __future__ import annotations

from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import pytest_lsp
from lsprotocol import types as lsp

from checker.editor.commands import CHECK
from checker.pipeline import check_package
from checker.report.summary import sentence
from checker.settings import Settings
from tests.editor.client import CONFIG, ROVER, SCOUT, Client, Editor

pytestmark = pytest.mark.asyncio(loop_scope="module")
_LINK = "<link name='far'/></robot>"


@pytest_lsp.fixture(config=CONFIG, scope="module")
async def client(client: Client, folder: Path) -> AsyncIterator[None]:
    await Editor(client).begin(folder, options={"verdict": True})
    yield
    await client.shutdown_session()


@pytest.mark.slow
async def test_it_is_that_of_a_check(editor: Editor, folder: Path) -> None:
    model = folder / SCOUT / "urdf/scout.urdf.xacro"
    await editor.open(model)
    told = await editor.verdict(model)
    report = check_package(folder / SCOUT, Settings(trial=False)).packages[0]
    assert told.package == SCOUT
    assert told.verdict == report.verdict == "ready"
    assert told.sentence == str(sentence(report)) == "Ready: nothing to fix (trial not run)"
    assert (told.text, told.errors, told.warnings) == ("Ready", 0, 0)
    await editor.close(model)


async def test_it_follows_the_text(editor: Editor, folder: Path) -> None:
    model = folder / SCOUT / "urdf/scout.urdf.xacro"
    await editor.open(model)
    await editor.verdict(model, lambda it: it.verdict == "ready")
    before = editor.text(model)
    await editor.change(model, before.replace("</robot>", _LINK))
    worse = await editor.verdict(model, lambda it: it.verdict == "not_ready")
    assert worse.text == f"Not ready: {worse.errors} error" + "s" * (worse.errors > 1)
    await editor.change(model, before)
    assert (await editor.verdict(model, lambda it: it.verdict == "ready")).errors == 0
    await editor.close(model)


async def test_each_file_has_that_of_its_package(editor: Editor, folder: Path) -> None:
    good, bad = folder / SCOUT / "urdf/scout.urdf.xacro", folder / ROVER / "model.sdf"
    await editor.open(good)
    await editor.open(bad)
    assert (await editor.verdict(good)).verdict == "ready"
    worse = await editor.verdict(bad)
    assert (worse.package, worse.verdict) == (ROVER, "not_ready")
    for path in (good, bad):
        await editor.close(path)


@pytest.mark.slow
async def test_a_check_with_weights_counts(editor: Editor, folder: Path) -> None:
    model = folder / ROVER / "model.sdf"
    await editor.open(model)
    still = await editor.verdict(model)
    assert "trial not run" in still.sentence
    asked = lsp.ExecuteCommandParams(CHECK, [model.as_uri()])
    await editor.client.workspace_execute_command_async(asked)
    full = await editor.verdict(model, lambda it: "trial not run" not in it.sentence)
    assert full.errors > still.errors
    await editor.close(model)


async def test_a_file_outside_of_packages_has_none(editor: Editor, tmp_path: Path) -> None:
    lone = tmp_path / "notes.xml"
    await editor.open(lone, "<notes/>")
    assert (await editor.verdict(lone)).verdict == "none"
    await editor.close(lone)


async def test_settings_that_cannot_be_used(editor: Editor, folder: Path) -> None:
    settings, model = folder / ROVER / "subt-check.toml", folder / ROVER / "model.sdf"
    settings.write_text("[rules]\nselect = 3\n", "utf-8")
    await editor.open(model)
    editor.save(model)
    told = await editor.verdict(model, lambda it: it.verdict == "not_checked")
    assert told.text == "Not checked"
    assert "select" in told.sentence
    settings.unlink()
    editor.save(model)
    await editor.verdict(model, lambda it: it.verdict == "not_ready")
    await editor.close(model)
