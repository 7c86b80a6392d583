"""A process in the sandbox attacks the launcher, by which it may ask for others."""

from __future__ import annotations

import json
import os
import signal
from time import monotonic

import pytest

from checker.base.child_process import Child, Limits
from checker.base.sandbox import launcher, layers, namespaces
from checker.base.sandbox.launcher import OwnLauncher
from tests.sandbox.assets import Outside
from tests.sandbox.attempts import ATTEMPTS
from tests.sandbox.test_layers import need

DEEDS = ("full_pipe", "nonsense", "no_descriptors", "stopped", "greedy_orders")
NO_OPENING = {
    *("become_root", "dump_core", "many_processes", "outlive", "raise_limits"),
    *("see_process", "state_of_file"),
}
"""What a filter of calls that opens nothing does not hold."""


@pytest.mark.parametrize("names", [layers.ALL, (layers.NAMESPACES,)], ids=["all", "namespaces"])
@pytest.mark.parametrize("deed", DEEDS)
def test_none_of_its_processes_is_left(
    deed: str, names: tuple[str, ...], outside: Outside, monkeypatch: pytest.MonkeyPatch
) -> None:
    if namespaces.bubblewrap():
        pytest.skip(f"only bubblewrap's namespaces end all: {namespaces.bubblewrap()}")
    monkeypatch.setattr(launcher, "_ENDS_SECONDS", 3.0)
    work = outside.folder.parent / "work"
    work.mkdir(mode=0o700)
    starter = OwnLauncher(work, names)
    need(starter)
    request = json.dumps({"deed": deed, "assets": outside.given}).encode()
    child = Child("greedy", request, Limits(seconds=5), starter=starter, works=True)
    assert child.ends(8.0)
    said = child.answered(1_000)
    asked = json.dumps({"names": [], "assets": outside.given | {"works": False}}).encode()
    others = Child("hostile", asked, Limits(seconds=5), starter=starter).answer()
    begins = monotonic()
    child.stop()
    starter.close()
    survivors = outside.survivors()
    for each in survivors:
        os.kill(each, signal.SIGKILL)
    assert isinstance(said, tuple), said
    assert others == b"{}"
    assert survivors == []
    assert monotonic() - begins < 12.0


def test_the_guard_of_xacro_lets_native_code_open_nothing(outside: Outside) -> None:
    with_filter = OwnLauncher(names=(layers.SECCOMP,))
    need(with_filter)
    with_filter.close()
    starter = OwnLauncher(names=())
    names = [name for name in ATTEMPTS if name not in NO_OPENING]
    asked = {"names": names, "assets": outside.given | {"works": False}}
    request = json.dumps(asked).encode()
    said = Child("guarded", request, Limits(seconds=20), starter=starter).answer()
    starter.close()
    assert isinstance(said, bytes), said
    seen = outside.got()
    found = json.loads(said)
    # The child of the guard has the variables of its parent in memory, none of them a secret.
    assert [name for name in names if seen.get(name, found[name].startswith("got"))] == []
