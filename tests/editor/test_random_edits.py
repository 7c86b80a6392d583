"""Random edits of real files: the server does not fall, and says what a fresh check says."""

from __future__ import annotations

import asyncio
import random
import shutil
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import pytest_lsp
from lsprotocol import types as lsp

from checker.editor.diagnostics import diagnostics_of
from checker.editor.documents import Document
from checker.editor.positions import Columns
from checker.editor.session import Session
from support.real_packages import CORPUS, MODERN, named_folder, needs
from tests.conftest import SAMPLES
from tests.editor.client import CONFIG, Client, Editor

pytestmark = pytest.mark.asyncio(loop_scope="module")

EDITS = 500
PASTED = (
    "<",
    ">",
    '"',
    "&amp;",
    "</link>",
    "<link name='x'/>",
    "π",
    "😀",
    "\r\n",
    "  ",
    "${",
    "\t",
)
CORPUS_FILES = (
    ("robotika_freyja_sensor_config_1", ("model.sdf", "launch/spawner.rb", "package.xml")),
    ("coro_mike_sensor_config_1", ("model.sdf", "specifications.md", "CMakeLists.txt")),
)
MODERN_FILES = (
    ("ros_gz_project_template", ("*.sdf", "*.launch.py", "*.yaml", "package.xml")),
    ("turtlebot3", ("*.urdf",)),
    ("gz_ros2_control", ("*.xacro", "*.yaml", "*.launch.py")),
)


@pytest_lsp.fixture(config=CONFIG, scope="module")
async def client(client: Client) -> AsyncIterator[None]:
    await Editor(client).begin()
    yield
    await client.shutdown_session()


def edited(text: str, draw: random.Random) -> str:
    """Return a text after one edit: something inserted, deleted or pasted from elsewhere."""
    at = draw.randrange(len(text) + 1)
    match draw.randrange(4):
        case 0:
            return text[:at] + draw.choice(PASTED) + text[at:]
        case 1:
            return text[:at] + text[at + draw.randrange(1, 40) :]
        case 2:
            lines = text.splitlines(keepends=True)
            taken = draw.randrange(len(lines))
            return "".join((*lines[:taken], *lines[taken + draw.randrange(1, 4) :]))
        case _:
            start = draw.randrange(len(text))
            return text[:at] + text[start : start + draw.randrange(1, 200)] + text[at:]


def fresh(folder: Path, path: Path, text: str) -> list[lsp.Diagnostic]:
    """Return what a check that knows nothing says of a file with a text."""
    path.write_text(text, "utf-8", newline="")
    session = Session([folder])
    try:
        state = session.state_of(path)
        assert state is not None
        document = Document(path.as_uri(), path, 1, text)
        return diagnostics_of(document, state, (), Columns())
    finally:
        session.close()


def told(diagnostics: list[lsp.Diagnostic]) -> set[tuple[object, ...]]:
    return {(d.range.start.line, d.range.start.character, d.code, d.message) for d in diagnostics}


def files_in(top: Path | None, wanted: tuple[tuple[str, tuple[str, ...]], ...]) -> list[Path]:
    """Return the files of real packages that are edited."""
    if top is None:
        return []
    return [
        path
        for name, patterns in wanted
        for pattern in patterns
        for path in sorted((top / name).rglob(pattern))[:2]
    ]


@pytest.mark.parametrize(
    ("top", "wanted", "edits"),
    [
        pytest.param(
            SAMPLES,
            (("broken_acme_scout", ("*.xacro", "*.yaml", "*.launch.py", "package.xml")),),
            40,
            id="samples",
        ),
        pytest.param(
            named_folder(CORPUS), CORPUS_FILES, EDITS // 2, marks=needs(CORPUS), id="corpus"
        ),
        pytest.param(
            named_folder(MODERN), MODERN_FILES, EDITS // 2, marks=needs(MODERN), id="modern"
        ),
    ],
)
async def test_random_edits_say_what_a_fresh_check_says(
    client: Client,
    tmp_path: Path,
    top: Path,
    wanted: tuple[tuple[str, tuple[str, ...]], ...],
    edits: int,
) -> None:
    editor, draw = Editor(client), random.Random(24)  # noqa: S311 - no secret
    files = files_in(top, wanted)
    assert files
    for number, source in enumerate(files):
        package = next(at for at in source.parents if (at / "package.xml").exists() or at == top)
        package = source.parent if package == top else package
        mine = shutil.copytree(package, (tmp_path / str(number) / package.name).resolve())
        other = shutil.copytree(package, (tmp_path / f"other{number}" / package.name).resolve())
        inside = source.relative_to(package)
        path, same, text = mine / inside, other / inside, source.read_text("utf-8")
        await editor.open(path, text)
        for step in range(-(-edits // len(files))):
            # Most edits leave a mess: one begins anew before all of the file is one.
            text = source.read_text("utf-8") if step % 6 == 0 else text
            text = edited(text, draw)
            editor.type(path, text)
            expected = await asyncio.to_thread(fresh, other, same, text)
            found = await editor.found(path)
            assert told(found) == told(expected), (str(inside), step)
        await editor.close(path)
