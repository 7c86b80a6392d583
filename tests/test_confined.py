"""A child process with limits: it answers, or its parent knows why it did not."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from checker.confined import Child, Died, Limits, ask, tightened

LIMITS = Limits(seconds=5, memory=1_000_000_000)


def ask_for(body: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limits: Limits) -> object:
    """Let a child run the body of an `answer`."""
    (tmp_path / "some_work.py").write_text(f"def answer(request):\n    {body}\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    # Bytecode of the body before would count as that of one of the same length and second.
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    return ask("some_work", b"ping", limits)


def test_an_answer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = "print('noise'); return request + b' pong'"
    assert ask_for(body, tmp_path, monkeypatch, LIMITS) == b"ping pong"


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("raise ValueError", "failed"),
        ("raise SystemExit(0)", "ended without an answer"),
        ("import os; os._exit(0)", "ended without an answer"),
        ("return b''", "ended without an answer"),
        ("return b'x' * 2_000_000_000", "needs more than 1000 MB of memory"),
        ("import os; os.kill(os.getpid(), 11)", "ended in a crash (signal SIGSEGV)"),
    ],
)
def test_a_child_that_dies(
    body: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    died = ask_for(body, tmp_path, monkeypatch, LIMITS)
    assert isinstance(died, Died)
    assert died.reason.startswith(reason)


def test_an_answer_that_is_too_long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.confined.ANSWER_LIMIT", 10)
    assert isinstance(ask_for("return b'x' * 11", tmp_path, monkeypatch, LIMITS), Died)
    assert ask_for("return b'x' * 10", tmp_path, monkeypatch, LIMITS) == b"x" * 10


def test_a_child_that_never_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    died = ask_for("[0 for _ in iter(int, 1)]", tmp_path, monkeypatch, Limits(seconds=1))
    assert died == Died("needs more than 1 s of processor time")


def test_a_child_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "some_work.py").write_text("import time\ndef answer(r):\n    time.sleep(600)\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    child = Child("some_work", b"", LIMITS)
    child.deadline = 0.0
    assert isinstance(child.answer(), Died)


def test_a_child_that_waits_has_nothing_on_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "some_work.py").write_text(
        "import os\ndef answer(r):\n    return r + os.getcwd().encode()\n"
    )
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    child = Child("some_work", None, LIMITS)
    assert not list((tmp_path / "temporary").iterdir())
    child.give(b"in ")
    (folder,) = (tmp_path / "temporary").iterdir()
    assert child.answer() == f"in {folder}".encode()
    assert not list((tmp_path / "temporary").iterdir())


def test_a_child_that_is_given_nothing_ends(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "some_work.py").write_text("def answer(r):\n    raise ValueError\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    script = f"""
from checker.confined import Child, Limits
child = Child("some_work", None, {LIMITS})
child._process.stdin.close()
print(child._process.wait(20), child.answer())
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout == "0 Died(reason='was given nothing')\n"


def test_an_answer_is_a_file_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A child that was taken over makes its parent read no other, and wait for none."""
    for swap in ("os.symlink('/etc/hostname', 'answer')", "os.mkfifo('answer')"):
        body = f"import os; os.unlink('answer'); {swap}; os._exit(0)"
        died = ask_for(body, tmp_path, monkeypatch, LIMITS)
        assert isinstance(died, Died)
        assert died.reason.startswith("left an answer that ")


def test_tighter_limits_that_there_are_hold(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    body = "import resource; return str(resource.getrlimit(resource.RLIMIT_CPU)).encode()"
    assert ask_for(body, tmp_path, monkeypatch, LIMITS) == b"(5, 6)"
    script = f"""
import resource
from checker.confined import ask, Limits
resource.setrlimit(resource.RLIMIT_CPU, (3, 3))
print(ask("some_work", b"", {LIMITS}))
"""
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert done.stdout == "b'(3, 3)'\n"


LIMIT = st.integers(0, 2**40)
PAIR = st.tuples(LIMIT, LIMIT).map(lambda pair: (min(pair), max(pair)))
ENDLESS = -1
"""`resource.RLIM_INFINITY`."""


@given(
    given=PAIR | LIMIT.map(lambda soft: (soft, ENDLESS)) | st.just((ENDLESS, ENDLESS)), wanted=PAIR
)
@example(given=(5, ENDLESS), wanted=(3, 4))
def test_of_two_limits_the_tighter_holds(given: tuple[int, int], wanted: tuple[int, int]) -> None:
    soft, hard = tightened(given, *wanted)
    assert 0 <= soft <= hard
    for new, old, wish in zip((soft, hard), given, wanted, strict=True):
        assert new in (old, wish)
        assert new <= wish
        assert old == ENDLESS or new <= old
