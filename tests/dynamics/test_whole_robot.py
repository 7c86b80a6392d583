"""Whole robots on the scales: mass, centre, inertia, and what joints hold against gravity."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.model.robot import EARTH_GRAVITY, Robot
from checker.package.inputs import open_input
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.pinocchio_model import pin_model
from checker.physics.mass.robot_mass import weigh
from tests.dynamics.bodies import (
    Matrix,
    box,
    collision,
    inertial,
    joint,
    link,
    masses,
    poses,
    sizes,
)
from tests.effort import examples, large
from tests.model.robots import as_matrix, sdf

TYPES = ("fixed", "revolute", "continuous", "prismatic", "universal", "ball", "screw")
AXES = ("1 0 0", "0 1 0", "0 0 -1", "1 2 3")


@st.composite
def trees(draw: st.DrawFn) -> Robot:
    """Robots of up to eight links, each on one before it."""
    content = []
    for number in range(draw(st.integers(1, 8))):
        mass, size = draw(masses), draw(st.tuples(sizes, sizes, sizes))
        inside = inertial(mass, box(mass, *size), draw(poses))
        content.append(link(f"link{number}", inside, draw(poses)))
        if number:
            above = draw(st.integers(0, number - 1))
            kind, axis = draw(st.sampled_from(TYPES)), draw(st.sampled_from(AXES))
            content.append(
                joint(f"j{number}", kind, f"link{above}", f"link{number}", axis, draw(poses))
            )
    return sdf("".join(content))


def summed(robot: Robot) -> tuple[float, Matrix, Matrix]:
    """Mass, centre and inertia about it, by numpy alone."""
    total, moment, about_origin = 0.0, np.zeros(3), np.zeros((3, 3))
    for each in robot.links:
        assert each.inertial is not None
        pose = as_matrix(robot.pose_of_part(each, each.inertial.pose))
        rotation, centre = pose[:3, :3], pose[:3, 3]
        xx, xy, xz, yy, yz, zz = (moment.value for moment in each.inertial.moments)
        own = rotation @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ rotation.T
        total += each.mass
        moment += each.mass * centre
        about_origin += own + each.mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    centre = moment / total
    shift = total * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    return total, centre, about_origin - shift


@settings(max_examples=examples(60))
@given(trees())
def test_the_whole_weighs_what_its_parts_weigh(robot: Robot) -> None:
    mass, centre, inertia = summed(robot)
    properties = weigh(robot)
    assert properties.mass == pytest.approx(mass)
    np.testing.assert_allclose(properties.centre, centre, atol=1e-9)
    np.testing.assert_allclose(
        properties.inertia, inertia, rtol=0, atol=1e-9 * np.abs(inertia).max()
    )
    assert sum(map(properties.share, properties.links)) == pytest.approx(1.0)


@settings(max_examples=examples(60))
@given(trees())
def test_the_model_of_pinocchio_holds_what_the_scales_say(robot: Robot) -> None:
    properties, built = weigh(robot), pin_model(robot)
    data, neutral = built.model.createData(), pin.neutral(built.model)
    assert pin.computeTotalMass(built.model) == pytest.approx(properties.mass)
    centre = pin.centerOfMass(built.model, data, neutral)
    np.testing.assert_allclose(centre, properties.centre, atol=1e-9)
    torques = pin.computeGeneralizedGravity(built.model, data, neutral)
    scale = properties.mass * EARTH_GRAVITY * 50
    for torque, degree in zip(torques, built.degrees, strict=True):
        named = robot.joints_by_name.get(degree.part)
        if named in properties.gravity_torques and degree.number == 0:
            assert torque == pytest.approx(properties.gravity_torques[named], abs=1e-9 * scale)


@settings(max_examples=examples(60))
@given(trees())
def test_the_joint_space_inertia_of_a_free_robot_begins_with_its_mass(robot: Robot) -> None:
    inertia = pin_model(robot).joint_space_inertia()
    np.testing.assert_allclose(inertia, inertia.T, atol=1e-9 * np.abs(inertia).max())
    # Pushed along the robot's axes, all of it moves as one mass.
    np.testing.assert_allclose(inertia[:3, :3], robot.mass * np.eye(3), atol=1e-9 * robot.mass)
    eigenvalues = np.linalg.eigvalsh(inertia)
    assert eigenvalues[0] > -1e-9 * eigenvalues[-1]


def arm(
    angle: float, mass: float, length: float, kind: str = "revolute", axis: str = "0 -1 0"
) -> str:
    base = link("base", inertial(50, np.eye(3)) + collision("box", "1 1 0.2"))
    upper = link("arm", inertial(mass, np.eye(3), (length, 0, 0, 0, 0, 0)), (0, 0, 1, 0, -angle, 0))
    return base + upper + joint("shoulder", kind, "base", "arm", axis)


def held(content: str, name: str = "shoulder") -> float | None:
    robot = sdf(content)
    return weigh(robot).gravity_torques.get(robot.joints_by_name[name])


@given(st.floats(-3, 3), masses, sizes)
def test_an_arm_holds_its_weight_at_its_reach(angle: float, mass: float, length: float) -> None:
    expected = mass * EARTH_GRAVITY * length * math.cos(angle)
    assert held(arm(angle, mass, length)) == pytest.approx(expected, abs=1e-9)


def test_a_lift_holds_the_weight_and_a_drawer_nothing() -> None:
    assert held(arm(0, 3, 0.5, "prismatic", "0 0 1")) == pytest.approx(3 * EARTH_GRAVITY)
    assert held(arm(0, 3, 0.5, "prismatic", "1 0 0")) == pytest.approx(0.0)


def test_a_shoulder_holds_what_hangs_on_the_elbow_too() -> None:
    fore = link("fore", inertial(2, np.eye(3), (0.3, 0, 0, 0, 0, 0)), (1, 0, 1, 0, 0, 0))
    content = arm(0, 3, 0.5) + fore + joint("elbow", "revolute", "arm", "fore", "0 -1 0")
    assert held(content, "elbow") == pytest.approx(2 * 0.3 * EARTH_GRAVITY)
    assert held(content) == pytest.approx((3 * 0.5 + 2 * 1.3) * EARTH_GRAVITY)


def test_the_ground_carries_what_stands_on_it() -> None:
    foot = link(
        "foot", inertial(2, np.eye(3)) + collision("box", "0.1 0.1 0.2"), (2, 0, 0, 0, 0, 0)
    )
    content = arm(0, 3, 0.5) + foot + joint("ankle", "revolute", "arm", "foot", "0 1 0")
    assert held(content) is None
    assert held(content, "ankle") is None


def test_what_has_no_weight_needs_not_be_held() -> None:
    content = arm(0, 3, 0.5).replace('<link name="arm">', '<link name="arm"><gravity>0</gravity>')
    assert held(content) == pytest.approx(0.0)


@pytest.mark.parametrize("kind", ["fixed", "screw", "ball", "none such"])
def test_joints_without_an_axis_of_their_own_hold_nothing(kind: str) -> None:
    assert held(arm(0, 3, 0.5, kind)) is None


def test_of_a_loop_one_tie_is_left_out_and_named() -> None:
    parts = "".join(link(name, inertial(1, np.eye(3))) for name in "abc")
    ring = joint("ab", "revolute", "a", "b") + joint("bc", "revolute", "b", "c")
    circle = sdf(parts + ring + joint("ca", "revolute", "c", "a"))
    built = pin_model(circle)
    assert [each.part for each in built.degrees if not each.free] == ["ab", "bc"]
    assert built.notes == ("Joint ca is left out: a already has a parent.",)
    assert weigh(circle).mass == 3.0


def test_a_link_with_two_parents_hangs_on_the_first() -> None:
    parts = "".join(link(name, inertial(1, np.eye(3))) for name in "abc")
    robot = sdf(parts + joint("ac", "revolute", "a", "c") + joint("bc", "revolute", "b", "c"))
    built = pin_model(robot)
    assert {each.part for each in built.degrees} == {"a", "b", "ac"}
    assert built.notes == ("Joint bc is left out: c already has a parent.",)


def test_a_joint_to_nothing_is_left_out_and_named() -> None:
    built = pin_model(sdf(link("a") + joint("j", "revolute", "a", "nobody")))
    assert built.notes == ("Joint j is left out: nobody is not a link.",)


def test_a_robot_that_hangs_on_the_world_is_not_free() -> None:
    built = pin_model(sdf(link("a") + joint("j", "revolute", "world", "a")))
    assert [(each.part, each.free) for each in built.degrees] == [("j", False)]


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["chain", "star", "loose"])
def test_thousands_of_links(shape: str) -> None:
    content = []
    count = large(5000)
    for number in range(count):
        content.append(link(f"l{number}", collision("box", "0.1 0.1 0.1")))
        if number and shape != "loose":
            above = number - 1 if shape == "chain" else 0
            content.append(joint(f"j{number}", "revolute", f"l{above}", f"l{number}"))
    properties = weigh(sdf("".join(content)))
    assert properties.mass == count
    assert properties.centre == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("number", ["nan", "inf", "1e300", "-1e300"])
@pytest.mark.parametrize("place", ["base", "arm", "shoulder"])
def test_poses_that_are_no_places(number: str, place: str) -> None:
    pose = f"<pose>{number} 0 0 {number} 0 0</pose>"
    at = rf'(name="{place}"[^>]*>)<pose>[^<]*</pose>'
    content, count = re.subn(at, rf"\1{pose}", arm(0, 3, 1))
    assert count == 1
    properties = weigh(sdf(content))
    assert properties.mass == pytest.approx(53.0)


def weighed(corpus: Path) -> Iterator[MassProperties]:
    with open_input(corpus) as opened:
        for package in opened.packages:
            masses = Subject(package).all(MassProperties)
            assert not isinstance(masses, NotAvailable), masses
            yield from masses


def test_real_robots_are_sound(corpus: Path) -> None:
    for properties in weighed(corpus):
        robot = properties.robot
        name = robot.name.value
        assert properties.mass == pytest.approx(robot.mass), name
        assert properties.centre is not None
        for low, value, high in zip(*_box(robot, properties), strict=True):
            assert low < value < high, name
        assert properties.tip_angle is not None
        assert properties.tip_angle > math.radians(25), name
        assert all(each.pseudo_eigenvalue > -1e-12 for each in properties.links.values()), name


def _box(robot: Robot, properties: MassProperties) -> tuple[Matrix, Matrix, Matrix]:
    boxes = [box for each in robot.links if (box := robot.box_of(each)) is not None]
    low = np.min([box.low for box in boxes], axis=0)
    high = np.max([box.high for box in boxes], axis=0)
    return low, np.array(properties.centre), high
