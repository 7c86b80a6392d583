"""Room on the disk for uploads under way: never more is promised than there is."""

from __future__ import annotations

from contextlib import ExitStack, suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.service.web.answers.refusal import Refused
from checker.service.web.config import Config
from checker.service.web.limits.space import Claim, Space

MB = 1_000_000
KEPT, PER_CLIENT = 200 * MB, 500 * MB


class Disk:
    """A disk that uploads are written to, with room for them."""

    def __init__(self, free: int) -> None:
        self.free = free
        self.space = Space(lambda: self.free, KEPT, PER_CLIENT)

    def write(self, claim: Claim, size: int) -> None:
        self.space.extend(claim, claim.written + size)
        claim.written += size
        self.free -= size


def test_to_announce_uploads_takes_no_room_from_others() -> None:
    disk = Disk(700 * MB)
    with ExitStack() as stack:
        for number in range(200):
            stack.enter_context(disk.space.reserve(f"silent {number}", 95 * MB))
        with disk.space.reserve("one", 95 * MB) as claim:
            for _ in range(95):
                disk.write(claim, MB)
        assert claim.bytes_to_come == 95 * MB  # the copy that its index is read from


def test_an_upload_ends_where_the_disk_gets_full_meanwhile() -> None:
    disk = Disk(700 * MB)
    with disk.space.reserve("one", 95 * MB) as first, disk.space.reserve("two", 95 * MB) as second:
        disk.write(first, 20 * MB)
        disk.write(second, 20 * MB)
        disk.free -= 350 * MB  # somebody else writes
        with pytest.raises(Refused) as refused:
            disk.write(second, 30 * MB)
        assert refused.value.status == 503
        assert refused.value.headers == {"Retry-After": "60"}
        assert "No space left on device" in refused.value.error
        disk.write(first, 20 * MB)  # which is reserved


def test_small_uploads_get_in_while_large_ones_are_under_way() -> None:
    disk = Disk(700 * MB)
    space = disk.space
    with space.reserve("one", 95 * MB) as first, space.reserve("two", 95 * MB) as second:
        disk.write(first, 90 * MB)
        disk.write(second, 95 * MB)
        with pytest.raises(Refused) as refused, space.reserve("three", 95 * MB):
            pass
        assert refused.value.status == 503
        for _ in range(50):
            with space.reserve("four", MB) as small:
                disk.write(small, MB)
    with pytest.raises(Refused), space.reserve("one", 185 * MB):
        pass
    with space.reserve("one", 130 * MB):  # what ended without being kept would be free again
        pass


def test_one_client_has_half_of_the_room_but_may_always_send_one() -> None:
    space = Disk(700 * MB).space
    with space.reserve("one", 95 * MB):
        with pytest.raises(Refused) as refused, space.reserve("one", 95 * MB):
            pass
        assert "95 MB are in progress from this address" in refused.value.error
        with space.reserve("one", 20 * MB), space.reserve("two", 95 * MB):
            pass
    with space.reserve("one", 249 * MB):
        pass


def test_one_client_holds_so_much_however_large_the_disk_is() -> None:
    space = Disk(10**13).space
    with ExitStack() as stack:
        for _ in range(5):
            stack.enter_context(space.reserve("one", 100 * MB))
        with pytest.raises(Refused):
            stack.enter_context(space.reserve("one", MB))
        stack.enter_context(space.reserve("two", 100 * MB))
    with space.reserve("one", 100 * MB), space.reserve("one", 100 * MB):
        pass


def test_a_disk_that_does_not_answer_is_noticed_by_who_writes() -> None:
    def free() -> int:
        raise OSError

    with Space(free, KEPT, PER_CLIENT).reserve("one", 100 * MB):
        pass


@given(
    st.integers(0, 1_000),
    st.lists(st.tuples(st.sampled_from("abc"), st.integers(1, 120), st.floats(0, 1)), max_size=30),
)
def test_what_is_promised_can_be_written(free: int, uploads: list[tuple[str, int, float]]) -> None:
    disk = Disk(free * MB)
    space = disk.space
    claims = []
    with ExitStack() as stack:
        for client, size, share in uploads:
            try:
                claim = stack.enter_context(space.reserve(client, size * MB))
            except Refused:
                continue
            claims.append(claim)
            with suppress(Refused):
                disk.write(claim, int(claim.size * share))
        for claim in claims:
            disk.free -= claim.bytes_to_come
        assert not claims or disk.free >= KEPT


def test_a_larger_upload_may_last_longer() -> None:
    config = Config()
    assert config.longest(10_000) < 101
    assert config.longest(config.upload_limit) == 900
    assert config.bytes_per_client == 500 * MB
