"""docs/editors.md: each block is valid, and starts the server with the settings that it has."""

from __future__ import annotations

import json
import re
import tomllib
from typing import Any

from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
PAGE = (ROOT / "docs/editors.md").read_text("utf-8")
EDITORS = ("Visual Studio Code", "Neovim", "Helix", "Emacs", "Zed")


def defaults() -> dict[str, Any]:
    """What the server is given by the client for VS Code."""
    manifest = json.loads((ROOT / "editors/vscode/package.json").read_text("utf-8"))
    settings = manifest["contributes"]["configuration"]["properties"]
    return {name: settings[f"subt-check.{name}"]["default"] for name in ("trial", "debounce")}


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def section(editor: str) -> str:
    return PAGE.partition(f"\n## {editor}\n")[2].partition("\n## ")[0]


def test_each_editor_has_its_section() -> None:
    for editor in EDITORS:
        assert "subt-check" in section(editor), editor


def test_the_settings_of_helix() -> None:
    (helix,) = (tomllib.loads(block) for block in blocks("toml"))
    server = helix["language-server"]["subt-check"]
    assert [server["command"], *server["args"]] == ["subt-check", "server"]
    assert server["config"] == defaults()
    assert all("subt-check" in each["language-servers"] for each in helix["language"])


def test_the_settings_of_zed() -> None:
    tasks, settings = (json.loads(block) for block in blocks("json"))
    assert tasks[0]["command"] == "subt-check"
    assert settings["lsp"]["subt-check"]["binary"]["arguments"] == ["server"]
    assert settings["lsp"]["subt-check"]["initialization_options"] == defaults()


def test_the_settings_of_neovim_and_emacs() -> None:
    trial, debounce = defaults().values()
    assert 'cmd = { "subt-check", "server" }' in section("Neovim")
    assert f'{{ trial = "{trial}", debounce = {debounce} }}' in section("Neovim")
    assert '"subt-check" "server"' in section("Emacs")
    assert f'(:trial "{trial}" :debounce {debounce})' in section("Emacs")


def test_the_commands_are_those_that_the_client_calls() -> None:
    source = (ROOT / "editors/vscode/src/commands.ts").read_text("utf-8")
    called = re.findall(r"^  (\w+): \"subt-check: ", source, re.MULTILINE)
    named = re.findall(r"^\| `subt-check\.server\.(\w+)` \|", PAGE, re.MULTILINE)
    assert named == called == ["check", "show3d", "drive"]
