"""Work within this process is interrupted when it has used too much, and what follows goes on."""

from __future__ import annotations

import resource
import signal
import threading
from contextlib import suppress
from time import process_time

import pytest

from checker.base.allowance import Allowance, Exceeded


def spin(seconds: float) -> None:
    until = process_time() + seconds
    while process_time() < until:
        pass


def test_work_within_its_allowance_goes_on() -> None:
    before = signal.getsignal(signal.SIGPROF)
    with Allowance(seconds=5.0).piece():
        spin(0.2)
    assert signal.getsignal(signal.SIGPROF) is before
    assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)


def test_work_that_takes_too_long_is_interrupted() -> None:
    begun = process_time()
    words = r"needs more than 0\.2 s of processor time"
    with pytest.raises(Exceeded, match=words), Allowance(seconds=0.2).piece():
        spin(60.0)
    assert process_time() - begun < 5.0


def test_who_swallows_every_error_is_interrupted_again() -> None:
    def swallow() -> None:
        with suppress(BaseException):
            spin(60.0)
        spin(60.0)

    with pytest.raises(Exceeded), Allowance(seconds=0.2).piece():
        swallow()


def test_an_error_that_is_no_matter_of_time_comes_through() -> None:
    with pytest.raises(KeyError), Allowance().piece():
        raise KeyError("wheel")


def test_work_that_takes_too_much_memory_is_interrupted() -> None:
    held: list[bytearray] = []
    words = r"needs more than 0\.1 GB of memory"
    with pytest.raises(Exceeded, match=words), Allowance(memory=100_000_000).piece():
        held.extend(bytearray(b"x" * 1_000_000) for _ in range(1000))
    assert len(held) < 1000


def test_an_end_of_all_memory_is_told_as_such() -> None:
    with pytest.raises(Exceeded, match="needs more memory than there is"), Allowance().piece():
        raise MemoryError


def test_pieces_share_what_there_is_for_all() -> None:
    allowance = Allowance(seconds=0.3, seconds_for_all=0.4)
    with pytest.raises(Exceeded, match=r"^needs more than 0\.3 s"), allowance.piece():
        spin(60.0)
    with pytest.raises(Exceeded, match=r"^the package takes more than 0\.4 s"), allowance.piece():
        spin(60.0)
    with pytest.raises(Exceeded, match=r"^was not begun: the package"), allowance.piece():
        pytest.fail("it was begun")


def test_a_piece_within_another_is_part_of_it() -> None:
    inner = Allowance(seconds=60.0)
    with pytest.raises(Exceeded, match=r"0\.2 s"), Allowance(seconds=0.2).piece(), inner.piece():
        spin(60.0)


def test_a_limit_of_the_process_itself_leaves_room_for_the_report() -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_CPU)
    resource.setrlimit(resource.RLIMIT_CPU, (int(process_time()) + 30, hard))
    try:
        with pytest.raises(Exceeded, match="was not begun"), Allowance().piece():
            pytest.fail("it was begun")
    finally:
        resource.setrlimit(resource.RLIMIT_CPU, (soft, hard))


def test_in_other_threads_nothing_is_interrupted() -> None:
    done = []

    def work() -> None:
        with Allowance(seconds=0.05).piece():
            spin(0.3)
            done.append(True)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert done
