"""`subt-check mcp`: what a client of the protocol gets, and what it is refused."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import anyio
import pytest
from mcp import Client, StdioServerParameters

from checker.base.allowance import Exceeded
from checker.base.errors import CheckerError
from checker.cli.mcp.server import server_of
from checker.cli.mcp.tools import Tools
from checker.cli.mcp.workspace import Workspace
from tests.conftest import SAMPLES

BROKEN = "broken_acme_scout"
HIDDEN = "a_secret_outside"
Call = Callable[..., Awaitable[Any]]


class Refused(Exception):
    """A tool returned an error."""


def served(work: Callable[[Call], Awaitable[None]], *words: object) -> None:
    """Start the server as a client does, over its standard input and output, and work with it."""
    kept = {name: value for name, value in os.environ.items() if name.startswith("SUBT_CHECK")}
    server = StdioServerParameters(
        command=sys.executable, args=["-m", "checker.cli", "mcp", *map(str, words)], env=kept
    )
    anyio.run(_with_client, server, work)


async def _with_client(server: Any, work: Callable[[Call], Awaitable[None]]) -> None:
    async with Client(server, read_timeout_seconds=120) as client:

        async def call(tool: str, **arguments: Any) -> Any:
            result = await client.call_tool(tool, arguments)
            text = result.content[0].text
            assert "Traceback" not in text
            if result.is_error:
                raise Refused(text)
            return json.loads(text) if text.startswith("{") else text

        await work(call)


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A folder with a broken package, and beside it what no tool may read."""
    shutil.copytree(SAMPLES / BROKEN, tmp_path / "ws" / BROKEN)
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "secret.urdf").write_text(f'<robot name="{HIDDEN}"><link name="l"/></robot>')
    (tmp_path / "ws/link").symlink_to(outside)
    (tmp_path / "ws/link.urdf").symlink_to(outside / "secret.urdf")
    (tmp_path / "ws/inside").symlink_to(tmp_path / "ws" / BROKEN)
    return tmp_path / "ws"


def _found(checked: dict[str, Any]) -> set[tuple[str, str]]:
    return {(it["rule"], it["message"]) for each in checked["packages"] for it in each["findings"]}


@pytest.mark.slow
@pytest.mark.parametrize("unsafe", [False, True])
def test_check_explain_fix_and_check_again(workspace: Path, unsafe: bool) -> None:
    async def work(call: Call) -> None:
        before = await call("check", path=BROKEN)
        (package, *_) = before["packages"]
        assert (package["name"], package["verdict"]) == (BROKEN, "not_ready")
        assert package["summary"].startswith("Not ready: ")
        safe = next(it for it in package["findings"] if it["fix"] == "safe")
        page = await call("explain", rule_id=safe["rule"])
        assert page.startswith(f"{safe['rule']} {safe['name']} (")

        shown = await call("fix", path=BROKEN, unsafe=unsafe)
        assert not shown["applied"]
        assert _found(await call("check", path=BROKEN)) == _found(before)

        done = await call("fix", path=BROKEN, unsafe=unsafe, apply=True)
        assert done == {**shown, "applied": True}
        corrected = {(it["rule"], it["message"]) for it in done["corrects"]}
        assert (safe["rule"], safe["message"]) in corrected
        after = _found(await call("check", path=BROKEN))
        assert after.isdisjoint(corrected)
        assert len(after) < len(_found(before))

    served(work, workspace, "--write")


def test_the_diff_is_what_git_applies(workspace: Path) -> None:
    async def work(call: Call) -> None:
        shown = await call("fix", path=f"./{BROKEN}")
        assert f"--- a/{BROKEN}/package.xml\n+++ b/{BROKEN}/package.xml\n" in shown["diff"]

    served(work, workspace)


def test_without_write_nothing_is_applied(workspace: Path) -> None:
    def files() -> dict[Path, bytes]:
        return {path: path.read_bytes() for path in (workspace / BROKEN).rglob("*.*")}

    before = files()

    async def work(call: Call) -> None:
        with pytest.raises(Refused, match="apply is refused: the server only reads"):
            await call("fix", path=BROKEN, apply=True)

    served(work, workspace)
    assert files() == before


def test_paths_that_lead_outside_are_refused(workspace: Path) -> None:
    outside = workspace.parent / "outside"
    refused = {
        "../outside": "contains '..'",
        f"{BROKEN}/../{BROKEN}": "contains '..'",
        str(outside): "is outside",
        str(outside / "nowhere"): "is outside",
        "/": "is outside",
        "link": "is a link that leads outside",
        "link/secret.urdf": "is a link that leads outside",
        "link.urdf": "is a link that leads outside",
        "nowhere": "does not exist in the workspace",
        "a\0b": "cannot be opened",
    }

    async def work(call: Call) -> None:
        for path, reason in refused.items():
            for tool in ("check", "robot", "fix", "trial"):
                with pytest.raises(Refused) as error:
                    await call(tool, path=path)
                assert reason in str(error.value)
        for path in (BROKEN, "inside", ".", str(workspace / BROKEN)):
            (package, *_) = (await call("check", path=path))["packages"]
            assert package["name"] == BROKEN

    served(work, workspace)


def test_a_link_inside_a_package_leads_nowhere(workspace: Path) -> None:
    (workspace / BROKEN / "urdf/secret.urdf").symlink_to(workspace.parent / "outside/secret.urdf")

    async def work(call: Call) -> None:
        for tool in ("check", "robot", "fix"):
            assert HIDDEN not in json.dumps(await call(tool, path=BROKEN))

    served(work, workspace)


def test_facts_and_a_trial(workspace: Path) -> None:
    shutil.copytree(SAMPLES / "acme_scout", workspace / "acme_scout")

    async def work(call: Call) -> None:
        assert "left_wheel_joint (continuous" in await call("robot", path="acme_scout")
        facts = await call("robot", path="acme_scout", format="json")
        assert facts["packages"][0]["robots"][0]["name"] == "scout"
        (package, *_) = (await call("trial", path="acme_scout"))["packages"]
        (robot,) = package["robots"]
        assert (robot["robot"], robot["verdict"], robot["drive"]) == (
            *("scout", "ok", "differential drive"),
        )
        speed = next(it for it in robot["measures"] if it["measure"].startswith("speed reached"))
        assert speed["verdict"] == "ok"
        assert package["findings"] == []

    served(work, workspace)


def test_mistakes_get_a_message(workspace: Path) -> None:
    (workspace / "empty").mkdir()

    async def work(call: Call) -> None:
        for tool, arguments, reason in (
            ("explain", {"rule_id": "GEO999"}, "there is no rule 'GEO999'"),
            ("check", {"path": "empty"}, "is an empty folder"),
            ("robot", {"path": "empty"}, "is an empty folder"),
            ("robot", {"path": BROKEN, "format": "xml"}, "format"),
            ("check", {}, "path"),
        ):
            with pytest.raises(Refused) as error:
                await call(tool, **arguments)
            assert reason in str(error.value)

    served(work, workspace)


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (RuntimeError("boom"), "internal error (RuntimeError: boom); please report it"),
        (Exceeded("needs more than 60 s"), "the check needs more than 60 s"),
        (CheckerError("no\x1b[1m"), "no\N{REPLACEMENT CHARACTER}[1m"),
    ],
)
def test_what_goes_wrong_is_a_message(
    error: BaseException, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_: Tools, path: str) -> None:
        assert path == "x"
        raise error

    monkeypatch.setattr(Tools, "check", fail)

    async def work(call: Call) -> None:
        for _ in range(2):  # the server goes on
            with pytest.raises(Refused) as refused:
                await call("check", path="x")
            assert str(refused.value) == f"Error executing tool check: {message}"

    anyio.run(_with_client, server_of(Tools(Workspace.at(tmp_path))), work)


def test_the_page_has_each_tool_and_argument(tmp_path: Path) -> None:
    page = (SAMPLES.parent / "docs/mcp.md").read_text("utf-8")

    async def compare() -> None:
        for writes in (False, True):
            async with Client(server_of(Tools(Workspace.at(tmp_path), writes))) as client:
                for tool in (await client.list_tools()).tools:
                    (row,) = (line for line in page.splitlines() if f"| `{tool.name}(" in line)
                    assert [
                        name for name in tool.input_schema["properties"] if name not in row
                    ] == []
                    assert tool.annotations is not None
                    assert tool.annotations.read_only_hint == (tool.name != "fix" or not writes)

    anyio.run(compare)


def test_other_commands_do_not_load_the_protocol() -> None:
    code = (
        "import sys; from checker.cli import build_parser; build_parser();"
        "print(sorted({'mcp', 'pydantic', 'starlette'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
