"""Work in forks: what dies has no result, and takes no other with it."""

from __future__ import annotations

import subprocess
import sys

import pytest

DIES = {
    "no result": "raise ValueError",
    "memory": "raise MemoryError",
    "crash": "os.kill(os.getpid(), 11)",
    "processor time": "[0 for _ in iter(int, 1)]",
    "an end without a word": "os._exit(0)",
    "a result without end": "say(b'\\xff' * 20); os._exit(0)",
    "a result that breaks off": "say((99).to_bytes(8, 'big') + b'cut'); os._exit(1)",
    "noise": "[say(b'\\xff' * 1_000_000) for _ in range(600)]; os._exit(1)",
}
BEGIN = """
import os, resource
from stat import S_ISFIFO
from time import monotonic, process_time, sleep
from checker.base.parts import WorkerFailed
from checker.base import forked_work
from checker.base.forked_work import forks_time, run_all_in_forks, run_in_fork

def say(data):
    descriptors = [int(name) for name in os.listdir("/dev/fd") if os.path.exists(f"/dev/fd/{name}")]
    os.write(max(n for n in descriptors if n > 2 and S_ISFIFO(os.fstat(n).st_mode)), data)
"""


def run(body: str) -> list[str]:
    """Return the lines that a script prints: a fork wants an interpreter without threads."""
    command = [sys.executable, "-c", BEGIN + body]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    return done.stdout.splitlines()


@pytest.mark.parametrize("how", DIES)
def test_work_may_die(how: str) -> None:
    body = f"def work():\n    {DIES[how]}\n"
    body += "print(type(run_in_fork(work, 1)).__name__, run_in_fork(lambda: b'well', 1))"
    assert run(body) == ["WorkerFailed b'well'"]


@pytest.mark.parametrize("how", DIES)
def test_one_of_several_may_die(how: str) -> None:
    body = f"""
def dies():
    {DIES[how]}
works = [lambda: b"1", dies, dies, lambda: b"", os.getcwdb]
first, *others = run_all_in_forks(works, 1, 1e9, "late")
print(first, type(others[0]).__name__, type(others[1]).__name__, others[2:] == [b"", os.getcwdb()])
"""
    assert run(body) == ["b'1' WorkerFailed WorkerFailed True"]


def test_who_was_killed_from_outside_may_do_well_the_next_time() -> None:
    body = """
def killed():
    os.kill(os.getpid(), 9)
def full():
    raise OSError(28, "No space left on device")
def spins():
    [0 for _ in iter(int, 1)]
print(*(run_in_fork(work, 1).momentary for work in (killed, full, spins)))
"""
    assert run(body) == ["True True False"]


def test_they_share_a_fork_until_one_ends_it() -> None:
    body = """
def dies():
    raise ValueError
def who():
    return str(os.getpid()).encode()
a, b, bad, c, d = run_all_in_forks([who, who, dies, who, who], 5, 1e9, "late")
print(a == b, isinstance(bad, WorkerFailed), c == d, a == c, a == who())
"""
    assert run(body) == ["True True True False False"]


def test_each_has_as_much_memory_as_the_first() -> None:
    """A few of these fit into the memory, not all of them; those that are done stay in it."""
    body = """
resource.setrlimit(resource.RLIMIT_AS, (600_000_000, 600_000_000))
kept = []
def large():
    kept.append(bytearray(150_000_000))
    return str(len(kept)).encode()
print(*run_all_in_forks([large] * 7, 5, 1e9, "late"))
"""
    counts = [int(count[2:-1]) for count in run(body)[0].split(" ")]
    assert counts == [1] * 7


def test_what_ends_a_shared_fork_is_tried_alone() -> None:
    body = """
begun = []
def first_only():
    begun.append(1)
    if len(begun) > 1:
        raise ValueError
    return b"done"
print(*run_all_in_forks([first_only] * 4, 5, 1e9, "late"))
"""
    assert run(body) == [" ".join(["b'done'"] * 4)]


def test_garbage_of_one_is_gone_before_the_next() -> None:
    body = """
class Node:
    pass
def cycle():
    node = Node()
    node.self, node.data = node, bytearray(60_000_000)
    return str(os.getpid()).encode()
print(len(set(run_all_in_forks([cycle] * 8, 5, 1e9, "late"))))
"""
    assert run(body) == ["1"]


def test_each_has_the_processor_for_as_long() -> None:
    """Together they take longer than one may."""
    body = """
def works():
    until = process_time() + 0.7
    while process_time() < until:
        pass
    return b"done"
print(*run_all_in_forks([works] * 4, 2, 1e9, "late"))
"""
    assert run(body) == [" ".join(["b'done'"] * 4)]


def test_none_is_begun_when_it_is_too_late() -> None:
    body = """
def works():
    until = process_time() + 0.6
    while process_time() < until:
        pass
    return b"done"
print(run_all_in_forks([works] * 4, 5, forks_time() + 1.5, "came too late"))
"""
    late = "WorkerFailed(reason='came too late', momentary=False)"
    assert run(body) == [f"[b'done', {late}, {late}, {late}]"]


def test_a_clock_that_runs_on_makes_nothing_too_late() -> None:
    """Where others have the processor, a second of it takes longer."""
    body = """
def waits():
    sleep(0.4)
    return b"done"
print(*run_all_in_forks([waits] * 4, 5, forks_time() + 1.1, "came too late"))
"""
    assert run(body) == [" ".join(["b'done'"] * 4)]


def test_what_takes_long_is_done_after_all_others() -> None:
    body = """
def long():
    until = process_time() + 3.2
    while process_time() < until:
        pass
    return b"long"
forked_work._BRIEF = 1
print(*run_all_in_forks([long, lambda: b"1", lambda: b"2"], 4, forks_time() + 3.9, "came too late"))
"""
    (line,) = run(body)
    assert line.startswith("WorkerFailed")
    assert line.endswith("b'1' b'2'")


def test_limits_that_there_are_stay() -> None:
    body = """
resource.setrlimit(resource.RLIMIT_CPU, (3, 3))
print(run_in_fork(lambda: str(resource.getrlimit(resource.RLIMIT_CPU)).encode(), 20))
"""
    assert run(body) == ["b'(3, 3)'"]
