"""A child process with limits: it answers, or its parent knows why it did not."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from checker.base.child_process import Child, Limits
from checker.base.files import NotReadable
from checker.base.parts import WorkerFailed
from checker.base.sandbox.files import Damaged, from_disk, read, write
from checker.base.sandbox.launcher import OwnLauncher
from checker.base.system import tighter_limits

LIMITS = Limits(seconds=5, memory=1_000_000_000)


@contextmanager
def starter(body: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[OwnLauncher]:
    """Give a launcher whose processes find the module `some_work`."""
    (tmp_path / "some_work.py").write_text(body)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    # Bytecode of the body before would count as that of one of the same length and second.
    monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
    with closing(OwnLauncher()) as found:
        yield found


def ask_for(
    body: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    limits: Limits = LIMITS,
    files: tuple[tuple[str, int], ...] = (),
) -> object:
    """Let a child run the body of an `answer`."""
    module = f"def answer(request, files):\n    {body}\n"
    with starter(module, tmp_path, monkeypatch) as found:
        return Child("some_work", b"ping", limits, from_disk(files), found).answer()


def test_an_answer(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = "print('noise'); return request + b' pong'"
    assert ask_for(body, tmp_path, monkeypatch, LIMITS) == b"ping pong"


def test_a_child_computes_with_the_numeric_kernels_of_its_parent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OPENBLAS_CORETYPE", "Haswell")
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "7")
    monkeypatch.setenv("AWS_SECRET", "unknown to it")
    body = "import os; return ' '.join(f'{k}={v}' for k, v in os.environ.items()).encode()"
    answer = ask_for(body, tmp_path, monkeypatch)
    assert isinstance(answer, bytes)
    assert {b"OPENBLAS_CORETYPE=Haswell", b"OPENBLAS_NUM_THREADS=1"} <= set(answer.split())
    assert b"SECRET" not in answer


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("raise ValueError", "failed"),
        ("raise SystemExit(0)", "failed"),
        ("import os; os._exit(0)", "ended without an answer"),
        ("return b''", "ended without an answer"),
        ("return b'x' * 2_000_000_000", "needs more than 1000 MB of memory"),
        ("import os; os.kill(os.getpid(), 11)", "crashed (signal SIGSEGV)"),
        ("raise OSError(12, 'Cannot allocate memory')", "needs more than 1000 MB of memory"),
        ("raise FileNotFoundError(2, 'none')", "failed"),
    ],
)
def test_a_child_that_dies(
    body: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    died = ask_for(body, tmp_path, monkeypatch, LIMITS)
    assert isinstance(died, WorkerFailed)
    assert died.reason.startswith(reason)
    assert not died.momentary


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("import os; os.kill(os.getpid(), 9)", "was killed from outside"),
        ("raise OSError(28, 'No space left on device')", "failed because the disk or the system"),
    ],
)
def test_a_child_that_dies_of_what_may_pass(
    body: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    died = ask_for(body, tmp_path, monkeypatch, LIMITS)
    assert isinstance(died, WorkerFailed)
    assert died.reason.startswith(reason)
    assert died.momentary


def test_an_answer_that_is_too_long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.base.child_process.ANSWER_LIMIT", 10)
    assert isinstance(ask_for("return b'x' * 11", tmp_path, monkeypatch, LIMITS), WorkerFailed)
    assert ask_for("return b'x' * 10", tmp_path, monkeypatch, LIMITS) == b"x" * 10


def test_a_child_that_never_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    died = ask_for("[0 for _ in iter(int, 1)]", tmp_path, monkeypatch, Limits(seconds=1))
    assert died == WorkerFailed("needs more than 1 s of processor time")


def test_a_child_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    body = "import time\ndef answer(request, files):\n    time.sleep(600)\n"
    with starter(body, tmp_path, monkeypatch) as found:
        child = Child("some_work", b"", LIMITS, starter=found)
        assert child.alive
        child.deadline = 0.0
        stopped = child.answer()
        assert isinstance(stopped, WorkerFailed)
        assert stopped.momentary
        assert not child.alive


def test_a_busy_machine_stops_no_child() -> None:
    """What counts is processor time; where five processes share two cores, clocks run fast."""
    assert Limits(seconds=20).clock_seconds >= 10 * 20


def test_files_are_handed_over_and_no_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_bytes(b"content")
    (tmp_path / "link").symlink_to("file")
    paths = [str(tmp_path / name) for name in ("file", "link", "none")]
    body = f"return repr([files.read(path) for path in {paths}]).encode()"
    said = ask_for(body, tmp_path, monkeypatch, files=tuple((path, 10) for path in paths))
    assert isinstance(said, bytes)
    first, link, none = eval(said, {"NotReadable": NotReadable})  # noqa: S307 - our own words
    assert first == b"content"
    assert isinstance(link, NotReadable)
    assert isinstance(none, NotReadable)
    assert "No such file" in none.reason
    (large,) = (ask_for(body, tmp_path, monkeypatch, files=((paths[0], 6),)),)
    assert b"more than the limit of 6e-06 MB" in large  # type: ignore[operator]


def test_a_child_leaves_nothing_on_the_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    body = "def answer(request, files):\n    return request + b'pong'\n"
    with starter(body, tmp_path, monkeypatch) as found:
        child = Child("some_work", None, LIMITS, starter=found)
        child.give(b"ping ")
        assert not list((tmp_path / "temporary").iterdir())
        assert child.answer() == b"ping pong"


def test_a_child_that_is_given_nothing_ends(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    body = "def answer(request, files):\n    raise ValueError\n"
    with starter(body, tmp_path, monkeypatch) as found:
        child = Child("some_work", None, LIMITS, starter=found)
        child.stop()
        child.stop()
        assert isinstance(child.answer(), WorkerFailed)


@pytest.mark.parametrize(
    "said",
    [
        b"",
        b"x",
        b"x" * 16,
        b"\xff" * 40,
        bytes(16),
        b"{}" + bytes(15) + b"\x02" + b"\0",
        b'{"a": [0, 9]}' + bytes(15) + b"\x0d",
        b'{"a": [-1, 1]}' + bytes(15) + b"\x0e",
        b'{"a": [0, -1]}' + bytes(15) + b"\x0e",
        b'{"a": [0]}' + bytes(15) + b"\x0a",
        b"[[[[" + bytes(15) + b"\x04",
        b"[" * 100_000 + bytes(13) + (100_000).to_bytes(3, "big"),
    ],
)
def test_nonsense_is_no_answer(said: bytes) -> None:
    """What a child that was taken over writes is measured before it is read."""
    with tempfile.TemporaryFile() as file:
        file.write(said)
        file.flush()
        if said == bytes(16):
            said = b""
        with pytest.raises(Damaged):
            read(file.fileno(), 1000)


@given(st.binary(max_size=200), st.dictionaries(st.text(max_size=20), st.binary(max_size=200)))
def test_what_is_written_is_read(message: bytes, contents: dict[str, bytes]) -> None:
    with tempfile.TemporaryFile() as file:
        write(file, message, contents.items())
        said, files = read(file.fileno(), 1000)
        assert said == message
        assert {name: files.read(name) for name in files.names} == contents
        assert {name: files.size(name) for name in files.names} == {
            name: len(content) for name, content in contents.items()
        }


def test_tighter_limits_that_there_are_hold(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    body = "import resource; return str(resource.getrlimit(resource.RLIMIT_CPU)).encode()"
    assert ask_for(body, tmp_path, monkeypatch, LIMITS) == b"(5, 6)"
    script = f"""
import resource
from checker.base.child_process import ask, Limits
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
    soft, hard = tighter_limits(given, *wanted)
    assert 0 <= soft <= hard
    for new, old, wish in zip((soft, hard), given, wanted, strict=True):
        assert new in (old, wish)
        assert new <= wish
        assert old == ENDLESS or new <= old
