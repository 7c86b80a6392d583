"""Lines before places: whoever has much to do keeps nobody else waiting."""

from __future__ import annotations

import asyncio

from hypothesis import given
from hypothesis import strategies as st

from checker.service.web.limits.lines import Lines


async def settled() -> None:
    """Let all tasks go on that can."""
    for _ in range(5):
        await asyncio.sleep(0)


def test_one_sender_waits_in_its_own_line_and_another_goes_past_it() -> None:
    inside: list[str] = []

    async def work(lines: Lines, sender: str, over: asyncio.Event) -> None:
        async with lines.place(sender):
            inside.append(sender)
            await over.wait()

    async def look() -> None:
        lines, over = Lines(4, 2), asyncio.Event()
        tasks = [asyncio.create_task(work(lines, "many", over)) for _ in range(20)]
        await settled()
        assert inside == ["many"] * 2
        tasks += [asyncio.create_task(work(lines, each, over)) for each in ("one", "two", "three")]
        await settled()
        assert inside == ["many"] * 2 + ["one", "two"]
        over.set()
        await asyncio.gather(*tasks)
        assert inside[4:6] in (["many", "three"], ["three", "many"])
        assert len(inside) == 23

    asyncio.run(look())


def test_who_goes_away_while_waiting_holds_no_place() -> None:
    async def look() -> None:
        lines, over = Lines(1, 1), asyncio.Event()

        async def work() -> None:
            async with lines.place("one"):
                await over.wait()

        tasks = [asyncio.create_task(work()) for _ in range(5)]
        await settled()
        tasks[2].cancel()
        tasks[0].cancel()  # which lets in the next one at the same moment
        await settled()
        tasks[1].cancel()
        over.set()
        await asyncio.gather(*tasks, return_exceptions=True)
        async with asyncio.timeout(5), lines.place("two"):
            pass

    asyncio.run(look())


@given(st.lists(st.sampled_from("abcde"), max_size=40), st.integers(1, 6), st.integers(1, 4))
def test_never_more_than_there_are_places_and_all_come_in(
    senders: list[str], places: int, per_sender: int
) -> None:
    inside: list[str] = []

    async def work(lines: Lines, sender: str) -> None:
        async with lines.place(sender):
            inside.append(sender)
            assert len(inside) <= places
            assert inside.count(sender) <= per_sender
            await asyncio.sleep(0)
            inside.remove(sender)

    async def look() -> None:
        lines = Lines(places, per_sender)
        await asyncio.gather(*(work(lines, sender) for sender in senders))

    asyncio.run(look())
    assert inside == []
