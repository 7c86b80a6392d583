"""Parts of a robot inside each other, at the start and somewhere in a joint's range."""

from __future__ import annotations

import pytest

from checker.physics.trial.simulation.contacts import ContactQuery, overlaps
from checker.physics.trial.trial import Measurement
from tests.trial.scenes import box, collision, joint, link, scene_of

CUBE = collision(box(1, 1, 1))


def found(content: str) -> dict[tuple[str, str, str], float]:
    figures = overlaps(ContactQuery(scene_of(content)))
    assert all(isinstance(each, Measurement) for each in figures)
    return {(each.name, each.part, each.other): each.value for each in figures}


def test_links_apart_do_not_overlap() -> None:
    assert found(link("a", CUBE) + link("b", CUBE, "0 0 1.01 0 0 0")) == {}


@pytest.mark.parametrize(("height", "depth"), [(0.9, 0.1), (0.998, 0.002)])
def test_how_deep_links_are_inside_each_other(height: float, depth: float) -> None:
    figures = found(link("a", CUBE) + link("b", CUBE, f"0 0 {height} 0 0 0"))
    assert figures == {("start_overlap", "a", "b"): pytest.approx(depth, abs=1e-6)}


def test_a_touch_is_no_overlap() -> None:
    assert found(link("a", CUBE) + link("b", CUBE, "0 0 0.9995 0 0 0")) == {}


@pytest.mark.parametrize("type", ["fixed", "revolute", "prismatic", "ball", "screw"])
def test_links_that_a_joint_ties_may_overlap(type: str) -> None:
    content = link("a", CUBE) + link("b", CUBE, "0 0 0.9 0 0 0") + joint("b", type=type)
    assert found(content) == {}


def test_links_that_are_fixed_to_each_other_count_as_one() -> None:
    """The wheel is tied to the hub, which is fixed to the body that it overlaps."""
    body, hub = link("a", CUBE), link("hub", "<visual/>")
    wheel = link("w", CUBE, "0 0.9 0 0 0 0")
    ties = joint("hub", type="fixed") + joint("w", parent="hub")
    assert found(body + hub + wheel + ties) == {}


def test_links_two_joints_apart_may_not_overlap() -> None:
    content = link("a", CUBE) + link("b") + link("c", CUBE, "0 0.9 0 0 0 0")
    figures = found(content + joint("b") + joint("c", parent="b"))
    assert ("start_overlap", "a", "c") in figures


def test_links_tied_by_a_joint_that_closes_a_loop_may_overlap() -> None:
    content = link("a", CUBE) + link("b", pose="5 0 0 0 0 0") + link("c", CUBE, "0 0.9 0 0 0 0")
    ties = joint("b") + joint("c", parent="b") + joint("c", parent="a", name="closes")
    assert found(content + ties) == {}


def test_what_is_hinged_on_the_world_may_overlap_what_is_fixed_to_it() -> None:
    content = link("a", CUBE) + joint("a", parent="world", type="fixed")
    assert found(content + link("b", CUBE, "0 0 0.9 0 0 0") + joint("b")) == {}


ARM = collision(box(0.1, 2, 0.1), "0 1 0 0 0 0")
POST = link("post", collision(box(0.2, 0.2, 2)), "1.5 0 0 0 0 0") + joint("post", type="fixed")
BASE = link("a", collision(box(0.2, 0.2, 0.2)))


def swinging(lower: float, upper: float, name: str = "arm") -> str:
    """A base, a shoulder on it, and an arm of 2 m that starts along y, away from the post."""
    limits = f"<limit><lower>{lower}</lower><upper>{upper}</upper></limit>"
    axis = f"<axis><xyz>0 0 1</xyz>{limits}</axis>"
    shoulder = link("shoulder") + joint("shoulder", rest="<axis><xyz>0 1 0</xyz></axis>")
    return (
        BASE + POST + shoulder + link(name, ARM, "0 0 0.3 0 0 0")
        + joint(name, parent="shoulder", rest=axis)
    )  # fmt: skip


def test_a_range_that_drives_an_arm_through_a_post() -> None:
    figures = found(swinging(-2.0, 0.0))
    assert figures["sweep_overlap", "arm", "post"] > 0.05


def test_a_range_that_keeps_clear() -> None:
    figures = found(swinging(0.0, 1.0))
    assert ("sweep_overlap", "arm", "post") not in figures


def test_an_endless_range_is_a_full_turn() -> None:
    assert ("sweep_overlap", "arm", "post") in found(swinging(-1e16, 1e16))


def test_wheels_and_the_joints_above_the_ground_say_nothing() -> None:
    assert ("sweep_overlap", "post", "wheel") not in found(swinging(-2.0, 0.0, name="wheel"))


def test_what_overlaps_at_the_start_is_not_said_again() -> None:
    inside = link("b", CUBE, "0 3 0 0 0 0") + joint("b", type="fixed", parent="shoulder")
    thing = link("c", CUBE, "0 3.2 0 0 0 0") + joint("c", parent="arm")
    figures = found(swinging(-2.0, 0.0) + inside + thing)
    assert ("start_overlap", "b", "c") in figures
    assert ("sweep_overlap", "b", "c") not in figures


def test_the_ground_counts_where_the_robot_is_put_into_it() -> None:
    query = ContactQuery(scene_of(link("a", CUBE)))
    assert query.depths() == {}
    sunk = query.model.qpos0.copy()
    sunk[2] -= 0.06
    assert query.depths(sunk) == {("a", "ground"): pytest.approx(0.05)}


@pytest.mark.slow
def test_many_parts_are_looked_at_within_bounds() -> None:
    links = "".join(link(f"l{i}", CUBE, f"{i * 0.9} 0 0 0 0 0") for i in range(300))
    ties = "".join(joint(f"l{i}", parent="l0") for i in range(1, 300))
    figures = overlaps(ContactQuery(scene_of(links + ties)))
    assert 0 < len(figures) <= 60


def test_what_is_too_much_to_move_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.physics.trial.simulation.contacts._EFFORT", 8)
    arms = "".join(link(f"arm{n}", CUBE, f"{3 * n} 0 3 0 0 0") + joint(f"arm{n}") for n in range(3))
    figures = overlaps(ContactQuery(scene_of(link("a", CUBE) + arms)))
    assert [each.value for each in figures if each.name == "unswept_joints"] == [3.0]
