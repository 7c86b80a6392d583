"""The child: hostile robots end as results or reasons, never as exceptions."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.background import Background
from checker.base.cache import Cache
from checker.base.parts import WorkerFailed
from checker.model.robot import Robot
from checker.physics.trial.run import start_trial
from checker.physics.trial.trial import Trial
from tests.effort import large
from tests.model.robots import sdf
from tests.trial.machines import chassis, four_wheels, trial_in_child, wheel


def chain(count: int) -> Robot:
    links = "".join(
        f'<link name="l{number}"><pose>0 0 {0.01 * number} 0 0 0</pose><collision name="c">'
        "<geometry><sphere><radius>0.01</radius></sphere></geometry></collision></link>"
        for number in range(count)
    )
    joints = "".join(
        f'<joint name="j{number}" type="revolute"><parent>l{number}</parent>'
        f"<child>l{number + 1}</child><axis><xyz>0 1 0</xyz></axis></joint>"
        for number in range(count - 1)
    )
    return sdf(links + joints)


LOOP = "".join(
    f'<link name="{name}"><collision name="c"><geometry><box><size>1 1 1</size></box></geometry>'
    f'</collision></link><joint name="{name}{to}" type="revolute"><parent>{name}</parent>'
    f"<child>{to}</child><axis><xyz>0 0 1</xyz></axis></joint>"
    for name, to in (("a", "b"), ("b", "c"), ("c", "a"))
)


@pytest.mark.slow
@pytest.mark.parametrize(
    "robot",
    [
        sdf(LOOP),
        four_wheels(mass=1e300),
        four_wheels(mass=1e-300),
        four_wheels(plugin_radius=1e-300),
        four_wheels(plugin_separation=1e300),
        four_wheels(limits="<max_velocity>1e300</max_velocity>"),
        four_wheels(limits="<max_velocity>nan</max_velocity>"),
        four_wheels(radius=1e5),
        sdf(chassis() + wheel("w", 1e300, 0)),
        chain(60),
    ],
    ids=lambda _: "robot",
)
def test_a_hostile_robot_ends_as_a_trial_or_a_reason(robot: Robot) -> None:
    assert isinstance(trial_in_child(robot), Trial | WorkerFailed | str)


@pytest.mark.slow
def test_thousands_of_links_end_within_the_limits() -> None:
    assert isinstance(trial_in_child(chain(large(5000))), Trial | WorkerFailed | str)


def test_a_robot_without_collisions_is_no_trial() -> None:
    outcome = trial_in_child(sdf('<link name="base_link"/>'))
    assert isinstance(outcome, str)


def test_a_trial_is_kept(tmp_path: Path) -> None:
    cache, robot = Cache(tmp_path), four_wheels()
    first = trial_in_child(robot, cache)
    again = start_trial(robot, cache)
    assert isinstance(again, Background)
    assert again.known
    assert again.result() == first
    others = start_trial(robot, cache, thorough=True), start_trial(four_wheels(mass=21), cache)
    for other in others:
        assert isinstance(other, Background)
        assert not other.known
        other.stop()


def test_an_entry_that_is_no_trial_is_driven_again(tmp_path: Path) -> None:
    cache, robot = Cache(tmp_path), four_wheels()
    first = trial_in_child(robot, cache)
    (entry,) = tmp_path.glob("trial/*/*")
    entry.write_text('{"drive": 1}')
    assert trial_in_child(robot, cache) == first
