"""Parts are found by their types, made once, and missing for the reason of what they need."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module

import pytest

from checker.base.cache import Cache
from checker.base.parts import Ask, NotAvailable, Provider, part, providers_in, type_name
from checker.base.record import Record
from checker.engine.subject import PROVIDERS, Subject
from checker.launch.spawner.reader import Spawner
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.rule import Context
from checker.rulebook.discovery import all_rules
from checker.rulebook.suppression.parts import BaselineUse, Suppressions
from tests.conftest import SAMPLES

OF_THE_ENGINE = {type_name(kind) for kind in (Ask, Context, Suppressions, BaselineUse)}


class Seat(Record):
    number: int


class Bench(Record):
    seats: tuple[Seat, ...]
    spawner: str


class Ride(Record):
    """Needs what a package of URDF has not."""


@part
def seats(package: Package) -> tuple[Seat, ...]:
    assert package.name
    return Seat(1), Seat(2)


@part
def bench(seats: tuple[Seat, ...], first: Seat, spawner: Spawner | NotAvailable) -> Bench:
    assert first is seats[0]
    return Bench(seats, spawner.reason if isinstance(spawner, NotAvailable) else "")


@part
def ride(spawner: Spawner, bench: Bench) -> Ride:
    raise AssertionError(spawner, bench)


@pytest.fixture
def subject() -> Iterator[Subject]:
    with open_input(SAMPLES / "my_gurdy_description") as opened:
        subject = Subject(opened.packages[0])
        yield subject
        subject.close()


def providers(kind: str) -> list[Provider]:
    modules = {kind.partition(":")[0], *(f"checker.{name}" for name in PROVIDERS)}
    found = [providers_in(import_module(module)).get(kind) for module in modules]
    return [provider for provider in found if provider is not None]


def test_what_a_rule_or_a_part_needs_is_given_or_made_by_one_function(subject: Subject) -> None:
    wanted = {kind for rule in all_rules() for kind in rule.needs.values()}
    assert len(wanted) > 25
    seen = OF_THE_ENGINE | set(subject._made)
    while left := wanted - seen:
        for kind in left:
            (provider,) = providers(kind)
            wanted |= {need.kind for need in provider.needs.values()}
        seen |= left


def test_a_part_is_made_once_of_the_parts_that_it_needs(subject: Subject) -> None:
    made = subject.one(Bench)
    assert made == Bench((Seat(1), Seat(2)), "the package needs no spawner")
    assert subject.one(Bench) is made
    assert subject.all(Seat) is made.seats
    assert subject.cached_parts(Seat) is made.seats


def test_a_part_is_missing_for_the_reason_of_what_it_needs(subject: Subject) -> None:
    assert subject.one(Ride) is subject.one(Spawner)
    assert subject.cached_parts(Ride) == ()
    assert subject.cached_parts(Bench) == ()


def test_a_type_that_nothing_makes_is_no_part(subject: Subject) -> None:
    with pytest.raises(LookupError, match="TestNothing is not a part"):
        subject.part(f"{__name__}:TestNothing")


def test_another_part_takes_the_place_of_one_and_of_what_depends_on_it(subject: Subject) -> None:
    assert subject.one(Bench) is not None
    other = subject.with_part(Seat(3), kept=[])
    assert other.one(Bench).seats == (Seat(3),)
    assert subject.one(Bench).seats == (Seat(1), Seat(2))
    assert subject.with_part(Seat(3)).one(Bench) is subject.one(Bench)


def test_modules_that_make_parts_load_no_heavy_library() -> None:
    run = f"import sys; from importlib import import_module\nfor name in {PROVIDERS}:\n"
    run += "    import_module(f'checker.{name}')\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", run], capture_output=True, text=True, check=True)
    assert not {"numpy", "pinocchio", "mujoco", "ruamel.yaml", "yaml"} & set(done.stdout.split())


def test_what_is_given_is_found_by_the_type_that_the_subject_declares() -> None:
    class Kept(Cache):
        """As the editor has it."""

    with open_input(SAMPLES / "my_gurdy_description") as opened:
        subject = Subject(opened.packages[0], Kept(None))
        assert subject.one(Cache) is subject.cache
        subject.close()
