"""Uploads of others are read in the sandbox that hide files, or somebody takes the risk aloud."""

from __future__ import annotations

import json
import platform
import sys
from pathlib import Path

import pytest

from checker.base.errors import CheckerError
from checker.base.sandbox.layers import (
    ACCOUNT,
    ALL,
    LANDLOCK,
    NAMESPACES,
    SECCOMP,
    Layer,
    hides_files,
)
from checker.service.exposure import risk_of
from checker.service.jobs.sandbox import layers_of_checks
from checker.service.store.store import Store
from tests.serving.conftest import Serve, wait_for
from tests.serving.test_serve import get, refused

BARE = (str(Path(__file__).with_name("bare_machine.py")),)
NO_CALLS = sys.platform != "linux" or platform.machine() not in ("x86_64", "aarch64")
linux = pytest.mark.skipif(NO_CALLS, reason="system calls are refused on Linux alone")
NETWORK = Layer(NAMESPACES, True, "no network")
FILTER = Layer(SECCOMP, True, "77 system calls are forbidden")
NONE = (
    NETWORK,
    Layer(ACCOUNT, False, "it is not started by root"),
    Layer(LANDLOCK, False, "the kernel has no Landlock"),
    FILTER,
)
OPEN = {"SUBT_CHECK_PUBLIC": "1"}
TOKENS = {"SUBT_CHECK_TOKENS": "s3cret"}


@pytest.mark.parametrize(
    ("layers", "hidden"),
    [
        ((), False),
        (NONE, False),
        ((Layer(LANDLOCK, False, "refused", hides=True),), False),
        ((*NONE, Layer(LANDLOCK, True, "version 1", hides=True)), True),
        ((*NONE, Layer(ACCOUNT, True, "user 61200", hides=True)), True),
        ((Layer(NAMESPACES, True, "bubblewrap", hides=True),), True),
    ],
)
def test_one_layer_that_hides_files_is_enough(layers: tuple[Layer, ...], hidden: bool) -> None:
    assert hides_files(layers) is hidden


def test_sandbox_of_this_machine_are_those_of_its_checks(tmp_path: Path) -> None:
    layers = layers_of_checks(Store(tmp_path / "data"))
    assert tuple(each.name for each in layers) == ALL
    assert hides_files(layers) == any(
        each.held and (each.name in (ACCOUNT, LANDLOCK) or "no other files" in each.words)
        for each in layers
    )
    assert not list((tmp_path / "data/incoming").iterdir())


@pytest.mark.parametrize("who", [OPEN, TOKENS])
def test_without_sandbox_others_are_not_let_in(who: dict[str, str]) -> None:
    with pytest.raises(CheckerError) as refusal:
        risk_of(who, lambda: NONE)
    said = str(refusal.value)
    assert "namespaces: no network; account: it is not started by root; landlock: the ker" in said
    assert "install bubblewrap" in said
    assert "--without-sandbox" in said
    assert len(said) < 900
    with pytest.raises(CheckerError, match="process that provides them ends immediately"):
        risk_of(who, lambda: ())


@pytest.mark.parametrize("who", [OPEN, TOKENS])
def test_the_risk_is_taken_aloud(who: dict[str, str]) -> None:
    taken = who | {"SUBT_CHECK_WITHOUT_SANDBOX": "1"}
    assert "can read all files of this user, including uploads of others" in risk_of(
        taken, lambda: NONE
    )
    sandbox = (*NONE, Layer(LANDLOCK, True, "version 1", hides=True))
    assert risk_of(taken, lambda: sandbox) == risk_of(who, lambda: sandbox) == ""


def test_of_this_machine_alone_nothing_is_asked() -> None:
    def never() -> tuple[Layer, ...]:
        raise AssertionError

    assert risk_of({}, never) == ""


@linux
def test_a_machine_without_sandbox_serves_others_only_on_purpose(serve: Serve) -> None:
    serving = serve("--public", program=BARE)
    refused(serving, "no sandbox layer hides files from uploads (namespaces: ")
    assert "landlock: the kernel has no Landlock" in serving.told
    serving = serve("--public", "--without-sandbox", "--workers", 1, program=BARE)
    url = serving.url
    assert "including uploads of others (--without-sandbox)\n" in serving.told
    wait_for(lambda: get(url, "/readyz")[0] == 200)
    (sandbox,) = json.loads(get(url, "/readyz")[1])["sandbox"].values()
    assert sandbox == [SECCOMP]
    assert "an upload that takes control of a check can read all files" in serving.told
    assert serving.stop() == 0


@linux
def test_a_machine_without_sandbox_serves_itself(serve: Serve) -> None:
    serving = serve("--workers", 1, program=BARE)
    wait_for(lambda: get(serving.url, "/readyz")[0] == 200)
    assert "--without-sandbox" not in serving.told


def test_a_worker_says_its_sandbox_in_one_line(serve: Serve) -> None:
    serving = serve("--workers", 1)
    wait_for(lambda: "is waiting for checks" in serving.told)
    (line,) = (each for each in serving.told.splitlines() if "layers of the sandbox: " in each)
    assert json.loads(line)["level"] == "info"
