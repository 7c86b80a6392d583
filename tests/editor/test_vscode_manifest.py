"""The manifest of the client for VS Code agrees with the project, its documents and itself."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path
from typing import Any

from checker.base.resources import tool_version
from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
FOLDER = ROOT / "editors/vscode"
MANIFEST: dict[str, Any] = json.loads((FOLDER / "package.json").read_text("utf-8"))
SETTINGS: dict[str, Any] = MANIFEST["contributes"]["configuration"]["properties"]


def documents() -> list[str]:
    return [path.read_text("utf-8") for path in (FOLDER / "README.md", ROOT / "docs/editors.md")]


def test_it_is_of_the_same_version_and_licence() -> None:
    assert MANIFEST["version"] == tool_version()
    assert MANIFEST["license"] == "Apache-2.0"


def test_its_publisher_keeps_the_repository() -> None:
    assert MANIFEST["repository"]["url"].split("/")[-2] == MANIFEST["publisher"]


def test_the_marketplace_takes_the_icon() -> None:
    """It wants a PNG of 128 pixels or more."""
    head = (FOLDER / MANIFEST["icon"]).read_bytes()
    assert len(head) < 20_000
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">II", head[16:24]) == (128, 128)


def test_the_changelog_has_the_version() -> None:
    assert f"## {MANIFEST['version']} " in (FOLDER / "CHANGELOG.md").read_text("utf-8")


def test_the_walkthrough_calls_what_is_there() -> None:
    (walkthrough,) = MANIFEST["contributes"]["walkthroughs"]
    commands = {command["command"] for command in MANIFEST["contributes"]["commands"]}
    sources = "".join(file.read_text("utf-8") for file in (FOLDER / "src").glob("*.ts"))
    for step in walkthrough["steps"]:
        assert (FOLDER / step["media"]["markdown"]).is_file()
        told = json.dumps([step["description"], step["completionEvents"]])
        called = re.findall(r"[cC]ommand:(subt-check\.\w+)", told)
        assert set(called) <= commands
        assert set(re.findall(r"onSettingChanged:([\w.-]+)", told)) <= SETTINGS.keys()
        for context in re.findall(r"onContext:([\w.-]+)", told):
            assert f'"setContext", "{context}"' in sources


def test_versions_are_pinned_without_a_lock_file() -> None:
    pinned = MANIFEST["dependencies"] | MANIFEST["devDependencies"]
    assert not {name: it for name, it in pinned.items() if not re.fullmatch(r"\d+\.\d+\.\d+", it)}
    assert not list(FOLDER.glob("*lock*"))


def test_types_are_those_of_the_oldest_vs_code_that_it_runs_in() -> None:
    oldest = MANIFEST["engines"]["vscode"].removeprefix("^")
    assert MANIFEST["devDependencies"]["@types/vscode"] == oldest


def test_each_setting_is_explained() -> None:
    for setting, form in SETTINGS.items():
        assert setting.startswith("subt-check.")
        assert {"type", "default", "scope", "markdownDescription"} <= form.keys()
        for document in documents():
            assert f"`{setting}`" in document


def test_a_workspace_that_is_not_trusted_names_no_program() -> None:
    limited = MANIFEST["capabilities"]["untrustedWorkspaces"]
    assert limited["supported"] == "limited"
    assert set(limited["restrictedConfigurations"]) == {
        name for name, form in SETTINGS.items() if form["scope"] == "machine-overridable"
    }


def test_each_command_is_explained() -> None:
    (readme, _) = documents()
    for command in MANIFEST["contributes"]["commands"]:
        assert f"{command['category']}: {command['title']}" in readme


def test_names_of_the_server_are_left_to_the_server() -> None:
    """The language client registers the server's commands itself: a second name would clash."""
    commands = [command["command"] for command in MANIFEST["contributes"]["commands"]]
    assert not [name for name in commands if name.startswith("subt-check.server.")]
    source = Path(FOLDER / "src/commands.ts").read_text("utf-8")
    named = re.findall(r"^  (\w+): \"subt-check: ", source, re.MULTILINE)
    assert {f"subt-check.{name}" for name in named} <= set(commands)
