"""What was weighed once is not weighed again, and it comes back as it was."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.cache import NO_CACHE, Cache
from checker.model.geometry.transform import Transform, rotation_from_rpy
from checker.physics.mass.robot_mass import Body, Rows, Weights, weights_of
from tests.conftest import SAMPLES

numbers = st.floats(-1e3, 1e3) | st.sampled_from((0.0, math.inf, -math.inf, math.nan, 1e-320))
vectors = st.tuples(numbers, numbers, numbers)
poses = st.builds(
    lambda at, turn: Transform(rotation_from_rpy(*turn), at),
    vectors,
    st.tuples(*[st.floats(-4.0, 4.0)] * 3),
)


def symmetric(numbers: tuple[float, ...]) -> Rows:
    xx, xy, xz, yy, yz, zz = numbers
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)


bodies = st.builds(Body, numbers, st.tuples(*[numbers] * 6).map(symmetric), st.none() | poses)


@given(st.lists(bodies, max_size=4))
def test_known_weights_are_those_that_were_found(
    tmp_path_factory: pytest.TempPathFactory, weighed: list[Body]
) -> None:
    cache = Cache(tmp_path_factory.mktemp("cache"))
    fresh = weights_of(weighed, NO_CACHE)
    assert repr(weights_of(weighed, cache)) == repr(fresh)
    assert len(list((cache.folder or Path()).rglob("*.json"))) == 1
    assert repr(weights_of(weighed, cache)) == repr(fresh)


def entry(tmp_path: Path) -> tuple[Cache, list[Body], Path, Weights]:
    cache = Cache(tmp_path)
    rows = ((0.1, 0.0, 0.0), (0.0, 0.2, 0.0), (0.0, 0.0, 0.25))
    weighed = [Body(2.0, rows, Transform(), "a")]
    weights = weights_of(weighed, cache)
    (file,) = tmp_path.rglob("*.json")
    return cache, weighed, file, weights


@pytest.mark.parametrize("said", ["null", "[]", '{"each": []}', '{"each": 1}', "{"])
def test_a_damaged_entry_is_worked_out_again(tmp_path: Path, said: str) -> None:
    cache, weighed, file, weights = entry(tmp_path)
    file.write_text(said)
    assert weights_of(weighed, cache) == weights


def test_it_is_the_entry_that_is_read(tmp_path: Path) -> None:
    cache, weighed, file, weights = entry(tmp_path)
    said = json.loads(file.read_text())
    said["centre"] = [1.0, 2.0, 3.0]
    file.write_text(json.dumps(said))
    assert weights.centre == (0.0, 0.0, 0.0)
    assert weights_of(weighed, cache).centre == (1.0, 2.0, 3.0)


def test_other_numbers_are_another_entry(tmp_path: Path) -> None:
    cache, (body,), _, weights = entry(tmp_path)
    moved = Body(body.mass, body.moments, Transform(translation=(1.0, 0.0, 0.0)), "a")
    assert weights_of([moved], cache) != weights
    two = weights_of([body, Body(1.0, body.moments, moved.pose, "a")], cache)
    assert two.centre == pytest.approx((1.0 / 3.0, 0.0, 0.0))


@pytest.mark.slow
def test_a_known_robot_is_checked_without_pinocchio_and_numpy(tmp_path: Path) -> None:
    cache = Cache(tmp_path)
    check = (
        "import sys; from pathlib import Path; from checker.pipeline import check_package;"
        "from checker.settings import Settings;"
        f"check_package(Path({str(SAMPLES / 'husky_migration_sensor_config_1')!r}),"
        " Settings(trial=False, fail_on=sys.argv[1]));"
        "print(*({'pinocchio', 'numpy'} & set(sys.modules)))"
    )
    environment = {"PATH": "/usr/bin:/bin", "SUBT_CHECK_CACHE": str(cache.folder)}
    loaded = []
    # The settings differ, so that no whole report is recalled.
    for fail_on in ("error", "warning"):
        command = [sys.executable, "-c", check, fail_on]
        done = subprocess.run(
            command, capture_output=True, text=True, check=True, env=environment, cwd=SAMPLES.parent
        )
        loaded.append(set(done.stdout.split()))
    assert loaded == [{"pinocchio", "numpy"}, set()]
