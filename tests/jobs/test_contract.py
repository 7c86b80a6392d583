"""What an engine promises, with real workers that die, on each database that it can use."""

from __future__ import annotations

import ctypes
import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from statistics import median
from time import sleep, time

import pytest
from msgspec.structs import astuple, replace

from checker.service.jobs.check import result_key
from checker.service.jobs.durable.receipts import key_of_check
from checker.service.jobs.durable.tasks import TRIES
from checker.service.jobs.port import Stage, State
from support.postgres import DATABASES, fresh_database
from tests.jobs.quick_worker import DEATH, FULL, PACKAGE, REFUSAL, WORDS
from tests.jobs.site import Site, site_in

READ, END = 2 * TRIES + 1, 4 * TRIES + 1
WHOLE = [(1, "queued"), (2, "static"), (READ, "trial"), (READ + 1, "trial"), (END, "done")]
"""Events of a check with no mishap."""


@pytest.fixture(params=DATABASES)
def site(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Site]:
    if request.param == "sqlite":
        url = f"sqlite:///{tmp_path}/new/jobs.sqlite"
    else:
        url = fresh_database(request.getfixturevalue("postgres_url"))
    site = site_in(tmp_path, url)
    yield site
    site.close()


class TestACheck:
    def test_comes_to_static_findings_and_then_to_its_report(self, site: Site) -> None:
        order = site.order("trial:0.5")
        receipt = site.jobs.submit(order)
        id = receipt.id
        queued = site.state(id)
        assert (queued.stage, queued.order, queued.result) == (Stage.QUEUED, order, "")
        assert queued.expires - queued.created == pytest.approx(30 * 86400)
        site.worker()
        read = site.until(id, lambda state: state.stage is Stage.TRIAL)
        assert (read.result, read.packages) == (result_key(order, Stage.STATIC), (PACKAGE,))
        done = site.end(id)
        assert (done.stage, done.words, done.packages) == (Stage.DONE, WORDS, (PACKAGE,))
        assert done.result == result_key(order, Stage.TRIAL)
        assert site.stages(id) == WHOLE
        events = site.events(id)
        assert [event.time for event in events] == sorted(event.time for event in events)
        assert site.events(id, after=READ) == events[3:]
        assert site.jobs.cancel(id, receipt.secret)
        assert site.state(id) == done

    def test_that_is_refused_or_dies_says_whose_fault_it_is(self, site: Site) -> None:
        site.worker()
        refused, died, raised = (site.submit(what) for what in ("refused", "died", "raises"))
        assert site.end(refused).stage is Stage.REFUSED
        assert site.state(refused).words == REFUSAL
        assert site.end(died).stage is Stage.FAILED
        assert site.state(died).words == DEATH
        assert site.end(raised).words.startswith(
            "the checker could not finish: it failed with an internal error"
        )
        assert site.begun()[f"trial {site.state(died).order.name}"] == 0
        assert site.stages(died) == [(1, "queued"), (2, "static"), (END, "failed")]

    def test_of_the_same_upload_is_a_new_one_with_the_same_report(self, site: Site) -> None:
        order = site.order()
        site.worker()
        first = site.end(site.jobs.submit(order).id)
        again = site.jobs.submit(order).id
        state = site.state(again)
        assert again != first.id
        assert (state.stage, state.result) == (Stage.DONE, first.result)
        assert (state.words, state.packages) == (first.words, first.packages)
        assert site.stages(again) == [(END, "done")]
        other = site.end(site.jobs.submit(replace(order, name="other.zip")).id)
        assert other.result != first.result

    def test_of_the_same_upload_and_key_is_the_same_one(self, site: Site) -> None:
        order, key = site.order("static:1"), "k" * 22
        first = site.jobs.submit(order, key)
        with ThreadPoolExecutor(4) as pool:
            again = list(pool.map(lambda _: site.jobs.submit(order, key), range(8)))
        assert again == [first] * 8
        assert site.jobs.alive().waiting == {"static": 1, "trial": 0}
        others = [
            site.jobs.submit(replace(order, name="other.zip"), key),
            site.jobs.submit(order, "l" * 22),
            site.jobs.submit(order),
        ]
        assert len({first.id, *(other.id for other in others)}) == 4
        site.worker()
        assert site.end(first.id).stage is Stage.DONE
        assert site.jobs.submit(order, key) == first
        assert site.stages(first.id) == WHOLE
        assert site.begun()[f"static {order.name}"] >= 1

    def test_that_nobody_knows_is_none(self, site: Site) -> None:
        for id in ("", "x" * 22, "' or 1=1 --", "\N{ROBOT FACE}", "\ud800", "x.trial"):
            assert site.jobs.status(id) is None
            assert site.events(id) == ()
            assert site.jobs.cancel(id, "") is site.jobs.delete(id, "") is False


class TestManyChecks:
    def test_are_done_once_each_by_two_workers(self, site: Site) -> None:
        ids = [site.submit("trial:0.2") for _ in range(12)]
        assert [site.state(id).ahead for id in ids] == list(range(12))
        assert site.jobs.alive().waiting == {"static": 12, "trial": 0}
        site.worker("left")
        site.worker("right")
        assert {site.end(id).stage for id in ids} == {Stage.DONE}
        assert [site.stages(id) for id in ids] == [WHOLE] * 12
        begun = site.begun()
        assert len(begun) == 24
        assert set(begun.values()) == {1}
        alive = site.jobs.alive()
        assert {name.partition("-")[0] for name in alive.workers} == {"left", "right"}
        assert max(alive.workers.values()) < 30
        assert (alive.waiting, alive.running) == ({"static": 0, "trial": 0}, 0)

    def test_tell_how_long_they_take(self, site: Site) -> None:
        site.worker()
        assert site.jobs.stage_seconds() == {}
        ids = [site.submit(f"static:2 trial:{seconds}") for seconds in (2, 2, 6)]
        assert {site.end(id).stage for id in ids} == {Stage.DONE}
        seconds = site.jobs.stage_seconds()
        times = [[event.time for event in site.events(id)] for id in ids]
        static = median(done - begun for _, begun, done, *_ in times)
        trial = median(done - begun for *_, begun, done in times)
        # With SQLite, the engine's times are whole seconds.
        assert seconds["static"] == pytest.approx(static, abs=1.0)
        assert seconds["trial"] == pytest.approx(trial, abs=1.0)
        state = site.state(ids[0])
        for _ in range(3):  # what was in the store takes no time, and says nothing of others
            site.jobs.submit(state.order)
        assert site.jobs.stage_seconds() == seconds

    def test_show_static_findings_before_trials_of_older_ones(self, site: Site) -> None:
        site.worker()
        old = [site.submit("trial:3") for _ in range(3)]
        site.until(old[0], lambda _: any(each.startswith("trial") for each in site.begun()))
        new = site.submit()
        assert site.until(new, lambda state: state.result != "").stage is Stage.TRIAL
        assert any(site.state(id).stage is Stage.TRIAL for id in old)
        assert site.state(new).ahead >= 1
        assert site.jobs.alive().running == 1

    def test_are_tried_as_many_at_once_as_the_worker_is_told(self, site: Site) -> None:
        site.worker(trials=2)
        ids = [site.submit("trial:3") for _ in range(3)]

        def two_at_once(_: State) -> bool:
            alive = site.jobs.alive()
            return alive.waiting == {"static": 0, "trial": 1} and alive.running == 2

        site.until(ids[0], two_at_once)
        assert {site.end(id).stage for id in ids} == {Stage.DONE}


class TestAKilledWorker:
    @pytest.mark.parametrize("stage", [Stage.STATIC, Stage.TRIAL])
    def test_takes_up_what_it_had_in_hand_when_it_is_back(self, site: Site, stage: Stage) -> None:
        worker = site.worker("slot-1")
        id = site.submit(f"hangs:{stage}:1")
        site.in_hand(id, stage)
        worker.kill()
        worker.wait()
        assert not site.state(id).stage.is_final
        site.worker("slot-1")
        assert site.end(id).stage is Stage.DONE
        name = site.state(id).order.name
        assert site.begun()[f"{stage} {name}"] == 2
        other = Stage.TRIAL if stage is Stage.STATIC else Stage.STATIC
        assert site.begun()[f"{other} {name}"] == 1
        again = [event.words for event in site.events(id) if "starts again" in event.words]
        assert len(again) == 1
        told = [event for event in site.events(id) if event.words not in again]
        # Of a try that came to nothing it is forgotten that it was begun.
        assert [event.stage.value for event in told] == [stage for _, stage in WHOLE]
        numbers = [event.number for event in site.events(id)]
        assert numbers == sorted(set(numbers))

    def test_leaves_what_waits_in_the_queue(self, site: Site) -> None:
        worker = site.worker("slot-1")
        first = site.receipt("static:30")
        site.in_hand(first.id, Stage.STATIC)
        second = site.submit()
        worker.kill()
        assert site.jobs.cancel(first.id, first.secret)
        site.worker("slot-2")
        assert site.end(second).stage is Stage.DONE
        assert site.stages(second) == WHOLE

    def test_that_never_comes_back_is_replaced(self, site: Site) -> None:
        worker = site.worker("lost", silence_seconds=3)
        id = site.submit("hangs:trial:1")
        site.in_hand(id, Stage.TRIAL)
        worker.kill()
        site.worker("found", silence_seconds=3)
        site.worker("also-found", silence_seconds=3)
        assert site.end(id).stage is Stage.DONE
        assert site.begun()[f"trial {site.state(id).order.name}"] == 2

    def test_that_was_only_asleep_finds_its_check_with_another(self, site: Site) -> None:
        asleep = site.worker("asleep", silence_seconds=3)
        id = site.submit("static:1 trial:2")
        site.in_hand(id, Stage.STATIC)
        asleep.send_signal(signal.SIGSTOP)
        site.worker("awake", silence_seconds=3)
        again = site.until(id, lambda state: state.result != "")
        asleep.send_signal(signal.SIGCONT)
        assert site.end(id).stage is Stage.DONE
        assert again.stage is Stage.TRIAL
        told = [event for event in site.events(id) if "starts again" not in event.words]
        assert [event.stage.value for event in told] == [stage for _, stage in WHOLE]
        assert site.end(site.submit()).stage is Stage.DONE

    def test_is_not_replaced_for_ever(self, site: Site) -> None:
        id = site.submit("kill:trial")
        for _ in range(TRIES):
            assert not site.state(id).stage.is_final
            site.worker("slot-1").wait()
        site.worker("slot-1")
        state = site.end(id)
        assert state.stage is Stage.FAILED
        assert state.words == (
            f"the checker could not finish: its worker process ended; it was tried {TRIES} times"
        )
        read = next(event for event in site.events(id) if event.stage is Stage.TRIAL)
        assert (read.stage, read.data["result"]) == (Stage.TRIAL, state.result)
        assert site.begun()[f"trial {state.order.name}"] == TRIES


class TestWhatTheServiceSuffers:
    @pytest.mark.parametrize("stage", [Stage.STATIC, Stage.TRIAL])
    def test_is_tried_again_until_it_goes_well(self, site: Site, stage: Stage) -> None:
        site.worker()
        id = site.submit(f"full:{stage}:{TRIES - 1}")
        state = site.end(id)
        assert (state.stage, state.words) == (Stage.DONE, WORDS)
        assert site.begun()[f"{stage} {state.order.name}"] == TRIES
        told = [event.words for event in site.events(id) if "again" in event.words]
        assert told == [
            f"starts again: {FULL} (try {number} of {TRIES})" for number in range(2, TRIES + 1)
        ]

    def test_ends_in_an_honest_sentence_and_is_nobodys_result(self, site: Site) -> None:
        site.worker()
        order = site.order(f"full:static:{TRIES}")
        state = site.end(site.jobs.submit(order).id)
        assert state.stage is Stage.FAILED
        assert state.words.startswith("the checker could not finish: the system of the service")
        assert state.words.endswith(f"No space left on device; it was tried {TRIES} times")
        again = site.end(site.jobs.submit(order).id)
        assert (again.stage, again.words) == (Stage.DONE, WORDS)


class TestSenders:
    def sent(self, site: Site, sender: str, profile: str) -> str:
        return site.jobs.submit(replace(site.order(profile), sender=sender)).id

    def test_of_one_check_do_not_wait_for_those_of_many(self, site: Site) -> None:
        many = [self.sent(site, "many", "static:1 trial:1") for _ in range(8)]
        one = self.sent(site, "one", "static:0.1")
        assert site.state(one).ahead == 1
        site.worker()
        site.end(one)
        assert sum(site.state(id).stage is Stage.DONE for id in many) <= 2

    def test_find_a_place_though_long_checks_are_in_hand(self, site: Site) -> None:
        site.worker()
        long = [self.sent(site, "many", "static:4") for _ in range(2)]
        site.until(long[0], lambda _: bool(site.begun()))
        short = self.sent(site, "one", "")
        state = site.end(short)
        assert state.stage is Stage.DONE
        # SQLite may know the second alone in which they were sent.
        assert {site.state(id).stage for id in long} == {Stage.STATIC, Stage.QUEUED}

    def test_are_not_written_down(self, site: Site) -> None:
        id = self.sent(site, "somebody", "")
        assert site.state(id).order.sender == ""
        [row] = site.jobs.checks.rows([key_of_check(id)])[key_of_check(id)]
        same, other = (self.sent(site, sender, "") for sender in ("somebody", "other"))
        senders = [
            site.jobs.checks.rows([key_of_check(id)])[key_of_check(id)][0].task.sender
            for id in (id, same, other)
        ]
        assert senders[0] == senders[1] != senders[2]
        assert row.task.sender != "somebody"


class TestCancelling:
    def test_in_the_queue(self, site: Site) -> None:
        id, secret = astuple(site.receipt())
        assert site.jobs.cancel(id, "s" * 22) is False
        assert site.state(id).stage is Stage.QUEUED
        assert site.jobs.cancel(id, secret)
        assert site.jobs.cancel(id, secret)
        site.worker()
        assert site.end(site.submit()).stage is Stage.DONE
        assert site.state(id).stage is Stage.CANCELLED
        assert site.stages(id) == [(1, "queued"), (END, "cancelled")]
        assert site.begun()[f"static {site.state(id).order.name}"] == 0

    @pytest.mark.parametrize("stage", [Stage.STATIC, Stage.TRIAL])
    def test_while_it_is_worked_on(self, site: Site, stage: Stage) -> None:
        site.worker()
        id, secret = astuple(site.receipt(f"{stage}:300"))
        site.in_hand(id, stage)
        assert site.jobs.cancel(id, secret)
        stopped = f"stopped-{stage} {site.state(id).order.name}"
        site.until(id, lambda _: site.begun()[stopped] == 1)
        assert site.end(site.submit()).stage is Stage.DONE
        assert site.state(id).stage is Stage.CANCELLED
        assert site.stages(id)[-1][1] == "cancelled"


class TestDeleting:
    def test_in_the_queue(self, site: Site) -> None:
        id, secret = astuple(site.receipt())
        name = site.state(id).order.name
        assert site.jobs.delete(id, "s" * 22) is False
        assert site.state(id).stage is Stage.QUEUED
        assert site.jobs.delete(id, secret)
        assert (site.jobs.status(id), site.events(id)) == (None, ())
        assert site.jobs.delete(id, secret) is site.jobs.cancel(id, secret) is False
        site.worker()
        assert site.end(site.submit()).stage is Stage.DONE
        assert site.begun()[f"static {name}"] == 0

    @pytest.mark.parametrize("stage", [Stage.STATIC, Stage.TRIAL])
    def test_while_it_is_worked_on(self, site: Site, stage: Stage) -> None:
        site.worker()
        id, secret = astuple(site.receipt(f"{stage}:300"))
        name = site.in_hand(id, stage).order.name
        other = site.submit()
        assert site.jobs.delete(id, secret)
        site.until(other, lambda _: site.begun()[f"stopped-{stage} {name}"] == 1)
        assert site.end(other).stage is Stage.DONE
        assert (site.jobs.status(id), site.events(id)) == (None, ())

    def test_leaves_what_others_share_and_has_the_rest_deleted(self, site: Site) -> None:
        site.worker(cleaning_seconds=0.3, unused_seconds=3.0)
        order = site.order()
        kept, gone, shared = site.jobs.submit(order), site.receipt(), site.jobs.submit(order)
        over = site.end(gone.id)
        stays = site.end(kept.id)
        for receipt in (gone, shared):
            assert site.jobs.delete(receipt.id, receipt.secret)
        for _ in range(600):
            if not (site.store.upload(over.order.upload) or site.store.names(over.result)):
                break
            sleep(0.1)
        assert site.store.upload(over.order.upload) is None
        assert site.store.names(over.result) == ()
        assert site.state(kept.id) == stays
        assert site.store.names(stays.result)
        assert site.store.upload(order.upload)


class TestAGracefulStop:
    def test_finishes_what_is_in_hand(self, site: Site) -> None:
        worker = site.worker()
        id = site.submit("trial:1")
        site.in_hand(id, Stage.TRIAL)
        worker.send_signal(signal.SIGTERM)
        assert worker.wait(30) == 0
        assert site.state(id).stage is Stage.DONE
        assert site.jobs.alive().workers == {}

    def test_hands_back_what_takes_too_long(self, site: Site) -> None:
        id = site.submit("static:1.5")
        worker = site.worker(grace_seconds=0.2)
        site.in_hand(id, Stage.STATIC)
        worker.send_signal(signal.SIGTERM)
        assert worker.wait(30) == 0
        assert (site.state(id).stage, site.state(id).words) == (
            Stage.QUEUED,
            "waiting in the queue",
        )
        assert site.jobs.alive().waiting == {"static": 1, "trial": 0}
        site.worker()
        assert site.end(id).stage is Stage.DONE
        assert site.stages(id) == WHOLE

    def test_whichever_thread_the_signal_reaches(self, site: Site) -> None:
        worker = site.worker()
        assert site.end(site.submit()).stage is Stage.DONE
        threads = [int(each.name) for each in Path(f"/proc/{worker.pid}/task").iterdir()]
        other = next(each for each in threads if each != worker.pid)
        assert ctypes.CDLL(None).tgkill(worker.pid, other, signal.SIGTERM) == 0
        assert worker.wait(30) == 0

    def test_is_no_death(self, site: Site) -> None:
        id = site.submit("trial:1.5")
        for _ in range(3):
            worker = site.worker(grace_seconds=0.1)
            site.until(id, lambda state: state.words == "the trial is running")
            worker.send_signal(signal.SIGINT)
            assert worker.wait(30) == 0
            assert site.state(id).stage is Stage.TRIAL
        site.worker()
        assert site.end(id).stage is Stage.DONE
        assert site.stages(id) == WHOLE


class TestRetention:
    def test_deletes_all_of_a_check(self, site: Site) -> None:
        keeps, goes = site.submit(), site.submit()
        [row] = site.jobs.checks.rows([key := key_of_check(goes)])[key]
        site.jobs.checks.forget([key])
        site.jobs.checks.enter(replace(row.task, expires=time() + 8))
        site.worker(cleaning_seconds=0.3, unused_seconds=3.0)
        kept, gone = site.end(keeps), site.end(goes)
        for _ in range(600):
            if not (site.store.upload(gone.order.upload) or site.store.names(gone.result)):
                break
            sleep(0.1)
        assert site.store.upload(gone.order.upload) is None
        assert site.store.names(gone.result) == ()
        assert site.jobs.status(goes) is None
        assert site.events(goes) == ()
        assert site.state(keeps) == kept
        assert site.store.names(kept.result)
        assert site.store.upload(kept.order.upload)
