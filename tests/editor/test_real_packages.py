"""Each feature of a real language server, on real packages."""

from __future__ import annotations

import re
import shutil
from collections.abc import AsyncIterator, Sequence
from pathlib import Path

import pytest
import pytest_lsp
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from support.real_packages import CORPUS, MODERN, named_folder, needs
from tests.editor.client import CONFIG, Client, Editor

pytestmark = pytest.mark.asyncio(loop_scope="module")

_FILES = [
    pytest.param(CORPUS, "robotika_freyja_sensor_config_1", "model.sdf", marks=needs(CORPUS)),
    pytest.param(CORPUS, "costar_husky_sensor_config_1", "model.sdf", marks=needs(CORPUS)),
    pytest.param(
        MODERN,
        "create3_sim/irobot_create_common/irobot_create_description",
        "urdf/create3.urdf.xacro",
        marks=needs(MODERN),
    ),
    pytest.param(
        MODERN,
        "ros_gz_project_template/ros_gz_example_description",
        "models/diff_drive/model.sdf",
        marks=needs(MODERN),
    ),
]
_LINK = re.compile(r'<link\s+name=["\']([\w.-]+)["\']')


@pytest_lsp.fixture(config=CONFIG, scope="module")
async def client(client: Client) -> AsyncIterator[None]:
    await Editor(client).begin()
    yield
    await client.shutdown_session()


@pytest.mark.parametrize(("variable", "package", "file"), _FILES)
async def test_all_features(
    client: Client, tmp_path: Path, variable: str, package: str, file: str
) -> None:
    top = named_folder(variable)
    assert top is not None
    # With its siblings: what it inherits is read as well.
    home = shutil.copytree((top / package).parent, tmp_path.resolve() / "home", symlinks=True)
    editor, path = Editor(client), home / Path(package).name / file
    found = await editor.open(path)
    await fixes(editor, path, found)
    link = _LINK.search(editor.text(path))
    assert link is not None
    await names(editor, path, link)
    await shapes(editor, path, link[1])
    await completes(editor, path)
    await editor.close(path)


async def fixes(editor: Editor, path: Path, found: Sequence[lsp.Diagnostic]) -> None:
    for diagnostic in [each for each in found if each.code][:5]:
        actions = await editor.actions(path, [diagnostic])
        assert any("switch off" in each.title for each in actions)
        for action in actions:
            for text in editor.applied(action.edit).values():
                assert text
    for action in await editor.actions(path, [], only=["source.fixAll.subt-check"]):
        text = editor.applied(action.edit).get(path.as_uri())
        if text is not None:
            after = await editor.change(path, text)
            assert len(after) <= len(found)


async def names(editor: Editor, path: Path, link: re.Match[str]) -> None:
    name = link[1]
    where = editor.where(path, link[0], link.start(1) - link.start())
    hover = await editor.client.text_document_hover_async(lsp.HoverParams(**where))
    assert hover is not None
    assert isinstance(hover.contents, lsp.MarkupContent)
    assert name in hover.contents.value
    found = await editor.client.text_document_definition_async(lsp.DefinitionParams(**where))
    assert isinstance(found, Sequence)
    assert path.as_uri() in {each.uri for each in found}
    asked = lsp.ReferenceParams(context=lsp.ReferenceContext(True), **where)
    assert len(await editor.client.text_document_references_async(asked) or ()) > 1
    wanted = lsp.RenameParams(new_name=f"{name}_renamed", **where)
    try:
        edit = await editor.client.text_document_rename_async(wanted)
    except JsonRpcException as refusal:
        assert re.search(r"cannot rename: .{20}", str(refusal))  # noqa: PT017 - either will do
    else:
        assert f"{name}_renamed" in editor.applied(edit)[path.as_uri()]


async def shapes(editor: Editor, path: Path, name: str) -> None:
    file = lsp.TextDocumentIdentifier(path.as_uri())
    asked = lsp.DocumentSymbolParams(file)
    outline = await editor.client.text_document_document_symbol_async(asked)
    waiting, seen = list(outline or ()), set()
    while waiting:
        symbol = waiting.pop()
        assert isinstance(symbol, lsp.DocumentSymbol)
        seen.add(symbol.name)
        waiting += symbol.children or ()
    assert name in seen
    folds = await editor.client.text_document_folding_range_async(lsp.FoldingRangeParams(file))
    assert len(folds or ()) > 10
    lenses = await editor.client.text_document_code_lens_async(lsp.CodeLensParams(file))
    assert any(lens.command and " kg · " in lens.command.title for lens in lenses or ())


async def completes(editor: Editor, path: Path) -> None:
    text = editor.text(path)
    link = _LINK.search(text)
    assert link is not None
    end = text.index(">", link.end()) + 1
    if text[end - 2] == "/":
        return
    await editor.change(path, f"{text[:end]}<\n{text[end:]}")
    where = editor.where(path, text[link.start() : end] + "<\n", end - link.start() + 1)
    found = await editor.client.text_document_completion_async(lsp.CompletionParams(**where))
    assert isinstance(found, lsp.CompletionList)
    assert {"collision", "visual"} <= {item.label for item in found.items}
