"""MuJoCo and Pinocchio weigh each robot alike: mass, centre of mass, joint-space inertia."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from tests.effort import examples
from tests.model.robots import sdf
from tests.trial.weighing import Scales

TOLERANCE = 1e-9
SHAPE = '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'


def assert_agreement(robot: Robot, seed: int = 0) -> None:
    scales = Scales(robot)
    assert not scales.scene.unusable
    assert not scales.scene.repairs
    assert sorted(scales.columns) == list(range(scales.model.nv))
    scales.move(seed)
    (mass, centre), (their_mass, their_centre) = scales.balances()
    assert mass == pytest.approx(their_mass, rel=TOLERANCE)
    if mass > 0.0:
        np.testing.assert_allclose(centre, their_centre, rtol=0, atol=TOLERANCE)
    ours, theirs = scales.by_mujoco(), scales.by_pinocchio()
    # Relative to both degrees: an element between them cannot be larger than √(Mᵢᵢ·Mⱼⱼ).
    scale = np.sqrt(np.outer(np.diag(theirs), np.diag(theirs)))
    np.testing.assert_array_less(np.abs(ours - theirs), TOLERANCE * scale)


def robots_of(folder: Path) -> list[Robot]:
    with open_input(folder) as opened:
        parts = [Subject(package).all(Robot) for package in opened.packages]
        return [robot for part in parts if isinstance(part, tuple) for robot in part]


def test_the_robots_of_the_corpus(corpus: Path) -> None:
    packages = [folder for folder in sorted(corpus.iterdir()) if folder.is_dir()]
    assert packages
    for package in packages:
        for robot in robots_of(package):
            assert_agreement(robot)


@pytest.mark.parametrize("number", [1, 2])
def test_the_samples(samples: Path, number: int) -> None:
    for robot in robots_of(samples / f"husky_migration_sensor_config_{number}"):
        assert_agreement(robot)


lengths = st.floats(-1.0, 1.0).map(lambda value: round(value, 6))
positive = st.floats(0.01, 1.0)
poses = st.tuples(lengths, lengths, lengths, *[lengths.map(lambda value: 3 * value)] * 3)
axes = st.tuples(lengths, lengths, lengths).filter(lambda axis: np.linalg.norm(axis) > 0.01)
TYPES = ("fixed", "revolute", "continuous", "prismatic", "universal", "revolute2", "ball")


def numbers(values: tuple[float, ...]) -> str:
    return " ".join(repr(value) for value in values)


@st.composite
def inertials(draw: st.DrawFn) -> str:
    """A body of three rods, each along an axis: any second moments are possible, no others."""
    a, b, c = draw(st.tuples(positive, positive, positive))
    return (
        f"<inertial><pose>{numbers(draw(poses))}</pose><mass>{draw(positive)!r}</mass><inertia>"
        f"<ixx>{b + c!r}</ixx><iyy>{a + c!r}</iyy><izz>{a + b!r}</izz>"
        "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>"
    )


@st.composite
def joints(draw: st.DrawFn, child: int) -> str:
    parent = draw(st.integers(-1, child - 1))
    frame = draw(st.sampled_from(["0", "1"]))
    both = "".join(
        f"<{tag}><xyz>{numbers(draw(axes))}</xyz>"
        f"<use_parent_model_frame>{frame}</use_parent_model_frame></{tag}>"
        for tag in ("axis", "axis2")
    )
    return (
        f'<joint name="j{child}" type="{draw(st.sampled_from(TYPES))}">'
        f"<pose>{numbers(draw(poses))}</pose>"
        f"<parent>{'world' if parent < 0 else f'l{parent}'}</parent><child>l{child}</child>"
        f"{both}</joint>"
    )


@st.composite
def trees(draw: st.DrawFn) -> str:
    """The content of a model: up to six links, some of which hang on nothing."""
    count = draw(st.integers(1, 6))
    content = []
    for number in range(count):
        content.append(
            f'<link name="l{number}"><pose>{numbers(draw(poses))}</pose>{draw(inertials())}'
            f"{SHAPE}</link>"
        )
        if draw(st.integers(0, 4)) > 0 and number > 0:
            content.append(draw(joints(number)))
    return "".join(content)


@settings(max_examples=examples(60), phases=(Phase.explicit, Phase.generate))
@given(trees(), st.integers(0, 1000))
def test_random_trees(content: str, seed: int) -> None:
    assert_agreement(sdf(content), seed)
