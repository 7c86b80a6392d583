"""The motion that a trial keeps: whose, where, and as JSON."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.robot import Robot
from checker.physics.trial.mjcf.scene import TRACKED, build_scene, carriers_of
from checker.physics.trial.trial import Replay, Trial
from tests.model.robots import sdf
from tests.trial.machines import four_wheels, trial_in_child
from tests.trial.scenes import joint, link

NUMBERS = st.floats(width=32, allow_nan=False, allow_infinity=False)


def replay_of(robot: Robot) -> Replay | None:
    trial = trial_in_child(robot)
    assert isinstance(trial, Trial)
    return trial.replay


@given(st.lists(st.lists(NUMBERS, min_size=14, max_size=14).map(tuple), max_size=4))
def test_a_replay_is_the_same_after_json(poses: list[tuple[float, ...]]) -> None:
    named = {f"l{number}": each for number, each in enumerate(poses)}
    trial = Trial("drive", replay=Replay((0.0, 0.05), named, {"a": "l0"}))
    assert Trial.from_json(json.loads(json.dumps(trial.as_json()))) == trial


@pytest.mark.parametrize("text", ["AAAA", "?", "A" * 36])
def test_poses_of_another_length_are_no_replay(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        Replay.from_json({"time": [0.0], "poses": {"a": text}, "carriers": {}})


def test_a_replay_holds_the_links_that_move_and_who_carries_the_others() -> None:
    lid = link("mast", pose="0 0 0.5 0 0 0")
    content = link("a") + link("b", pose="0.3 0 0 0 0 0") + lid
    content += joint("b") + joint("mast", parent="b", type="fixed")
    replay = replay_of(sdf(content))
    assert replay is not None
    assert sorted(replay.poses) == ["a", "b"]
    assert replay.carriers == {"mast": "b"}


def test_poses_are_those_of_the_frames_of_links_and_not_of_their_masses() -> None:
    robot = four_wheels()
    replay = replay_of(robot)
    assert replay is not None
    assert len(replay.time) == len(next(iter(replay.poses.values()))) / 7
    assert np.diff(replay.time) == pytest.approx(0.05)
    base = robot.pose_of("base_link")
    assert base is not None
    height = replay.poses["base_link"][2] - base.translation[2]
    for name, flat in replay.poses.items():
        pose = robot.pose_of(name)
        assert pose is not None
        x, y, z = pose.translation
        assert flat[:3] == pytest.approx((x, y, z + height), abs=1e-3)


def test_what_is_fixed_to_the_world_is_carried_by_one_of_its_links() -> None:
    content = link("a") + link("b") + link("arm") + joint("arm", parent="a")
    content += joint("a", parent="world", type="fixed") + joint("b", parent="world", type="fixed")
    assert carriers_of(build_scene(sdf(content))) == {"a": "a", "b": "a", "arm": "arm"}


def test_robots_of_very_many_moving_links_have_no_replay() -> None:
    def star(count: int) -> Robot:
        arms = (link(f"l{i}", pose=f"0 0 {i} 0 0 0") + joint(f"l{i}") for i in range(count - 1))
        return sdf(link("a") + "".join(arms))

    assert len(carriers_of(build_scene(star(TRACKED)))) == TRACKED
    assert not carriers_of(build_scene(star(TRACKED + 1)))
    trial = trial_in_child(star(TRACKED + 1))
    assert isinstance(trial, Trial)
    assert trial.replay is None
    assert f"more than {TRACKED} links move, so there is no replay of the trial" in trial.notes
