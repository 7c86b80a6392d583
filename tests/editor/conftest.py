"""A real language server in a workspace of two packages, and the editor that talks to it."""

from __future__ import annotations

import shutil
from collections.abc import AsyncIterator
from pathlib import Path

import pytest
import pytest_lsp

from tests.conftest import SAMPLES
from tests.editor.client import CONFIG, ROVER, SCOUT, Client, Editor


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A workspace with two packages."""
    folder = tmp_path_factory.mktemp("workspace").resolve()
    for name in (ROVER, SCOUT):
        shutil.copytree(SAMPLES / name, folder / name)
    return folder


@pytest_lsp.fixture(config=CONFIG, scope="module")
async def client(client: Client, folder: Path) -> AsyncIterator[None]:
    await Editor(client).begin(folder)
    yield
    await client.shutdown_session()


@pytest.fixture
def editor(client: Client) -> Editor:
    return Editor(client)
