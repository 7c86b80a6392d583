"""Hovers, completions and names, as a real language server answers for real kinds of files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from tests.editor.client import ROVER, SCOUT, Editor

pytestmark = pytest.mark.asyncio(loop_scope="module")


def lines(locations: object) -> set[tuple[str, int]]:
    assert isinstance(locations, Sequence)
    return {(Path(each.uri).name, each.range.start.line + 1) for each in locations}


async def hovered(editor: Editor, path: Path, needle: str, into: int = 0) -> str:
    asked = lsp.HoverParams(**editor.where(path, needle, into))
    hover = await editor.client.text_document_hover_async(asked)
    if hover is None:
        return ""
    assert isinstance(hover.contents, lsp.MarkupContent)
    return hover.contents.value


async def test_hovers_of_a_link_and_of_a_finding(editor: Editor, folder: Path) -> None:
    model = folder / ROVER / "model.sdf"
    await editor.open(model)
    link = await hovered(editor, model, 'link name="base_link"', 12)
    assert "kg" in link
    page = await hovered(editor, model, "rear_right_wheels", 3)
    assert page.startswith("**KIN001 unknown-joint-link**")
    assert "in the rule book" in page
    await editor.close(model)


async def test_a_joint_is_found_in_all_files(editor: Editor, folder: Path) -> None:
    xacro, config = (
        folder / SCOUT / "urdf/scout.urdf.xacro",
        folder / SCOUT / "config/controllers.yaml",
    )
    await editor.open(xacro)
    await editor.open(config)
    name = "left_wheel_joint"
    assert name in editor.text(config)
    where = editor.where(config, name, 2)
    found = await editor.client.text_document_definition_async(lsp.DefinitionParams(**where))
    assert {file for file, _ in lines(found)} == {"scout.urdf.xacro"}
    context = lsp.ReferenceContext(include_declaration=True)
    asked = lsp.ReferenceParams(context=context, **where)
    found = await editor.client.text_document_references_async(asked)
    assert {file for file, _ in lines(found)} >= {"scout.urdf.xacro", "controllers.yaml"}
    # Its name is put together in a macro, of which there are two calls.
    wanted = lsp.RenameParams(new_name="port_wheel_joint", **where)
    with pytest.raises(JsonRpcException, match=r"cannot rename: .*scout\.urdf\.xacro:26"):
        await editor.client.text_document_rename_async(wanted)
    await editor.close(xacro)
    await editor.close(config)


async def test_a_link_is_renamed_in_all_files(editor: Editor, folder: Path) -> None:
    model = folder / ROVER / "model.sdf"
    before = await editor.open(model)
    where = editor.where(model, 'link name="rear_left_wheel"', 14)
    asked = lsp.PrepareRenameParams(**where)
    assert await editor.client.text_document_prepare_rename_async(asked) is not None
    edit = await editor.client.text_document_rename_async(
        lsp.RenameParams(new_name="port_wheel", **where)
    )
    changed = editor.applied(edit)
    assert model.as_uri() in changed
    assert not any("rear_left_wheel" in text for text in changed.values())
    after = await editor.change(model, changed[model.as_uri()])
    rules = sorted(str(each.code) for each in before if each.code)
    assert sorted(str(each.code) for each in after if each.code) == rules
    await editor.close(model)


async def test_a_name_that_is_taken_is_refused(editor: Editor, folder: Path) -> None:
    model = folder / ROVER / "model.sdf"
    await editor.open(model)
    where = editor.where(model, 'joint name="front_left_joint"', 14)
    wanted = lsp.RenameParams(new_name="front_right_joint", **where)
    with pytest.raises(JsonRpcException, match="cannot rename: "):
        await editor.client.text_document_rename_async(wanted)
    await editor.close(model)


async def test_the_outline_is_the_tree_of_links_also_while_it_is_broken(
    editor: Editor, folder: Path
) -> None:
    model = folder / ROVER / "model.sdf"
    await editor.open(model)
    asked = lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(model.as_uri()))
    outline = await editor.client.text_document_document_symbol_async(asked)
    names = set(named(outline))
    assert {"base_link", "front_left_joint", "lidar"} <= names
    found = await editor.change(model, editor.text(model).replace("</link>", "</lin", 1))
    assert "SDF001" in {each.code for each in found}
    again = await editor.client.text_document_document_symbol_async(asked)
    assert set(named(again)) == names
    folding = lsp.FoldingRangeParams(lsp.TextDocumentIdentifier(model.as_uri()))
    assert len(await editor.client.text_document_folding_range_async(folding) or ()) > 20
    await editor.close(model)


def named(symbols: object) -> list[str]:
    assert isinstance(symbols, Sequence)
    return [name for each in symbols for name in (each.name, *named(each.children or ()))]


async def labels(editor: Editor, path: Path, needle: str, into: int) -> set[str]:
    asked = lsp.CompletionParams(**editor.where(path, needle, into))
    found = await editor.client.text_document_completion_async(asked)
    assert isinstance(found, lsp.CompletionList)
    return {item.label for item in found.items}


async def test_what_may_be_written_is_offered_while_it_is_no_xml(
    editor: Editor, folder: Path
) -> None:
    model = folder / ROVER / "model.sdf"
    await editor.open(model)
    text = editor.text(model)
    broken = text.replace("    <joint ", "    <link name='new'>\n      <\n    <joint ", 1)
    await editor.change(model, broken)
    assert {"inertial", "collision", "visual"} <= await labels(editor, model, "      <\n", 7)
    half = text.replace("<child>rear_right_wheels</child>", "<child>rear_", 1)
    await editor.change(model, half)
    assert "rear_right_wheel" in await labels(editor, model, "<child>rear_\n", 12)
    await editor.close(model)


async def test_properties_are_offered_in_xacro(editor: Editor, folder: Path) -> None:
    xacro = folder / SCOUT / "urdf/scout.urdf.xacro"
    await editor.open(xacro)
    text = editor.text(xacro)
    await editor.change(xacro, text.replace("</robot>", '<link name="${"/></robot>'))
    offered = await labels(editor, xacro, '<link name="${', 14)
    assert offered
    await editor.close(xacro)
