"""What Breadcrumbs plugins state."""

from __future__ import annotations

import pytest

from checker.model.breadcrumbs import Breadcrumbs, breadcrumbs
from tests.model.robots import sdf


def read(parameters: str) -> Breadcrumbs:
    (found,) = breadcrumbs(
        sdf(f'<link name="b"/><plugin filename="p" name="a::Breadcrumbs">{parameters}</plugin>')
    )
    return found


def crumb(pose: str) -> str:
    return f'<breadcrumb><sdf version="1.6"><model name="c">{pose}</model></sdf></breadcrumb>'


def test_parameters_are_read_with_their_places():
    found = read(
        "<topic>/model/r/deploy</topic><max_deployments>12</max_deployments>"
        "<disable_physics_time>3.0</disable_physics_time>" + crumb("<pose>-0.4 0 0.1 0 0 1</pose>")
    )
    assert found.topic is not None
    assert found.max_deployments is not None
    assert found.disable_physics_time is not None
    assert found.drop is not None
    assert found.max_deployments.value == 12
    assert found.disable_physics_time.value == 3
    assert found.drop.value == (-0.4, 0, 0.1)
    assert found.drop.span.text == "-0.4 0 0.1 0 0 1"


def test_what_is_not_stated_is_none():
    found = read("")
    assert (found.topic, found.max_deployments, found.disable_physics_time) == (None, None, None)
    assert found.drop is None


def test_a_relay_without_pose_appears_at_the_origin():
    found = read(crumb(""))
    assert found.drop is not None
    assert found.drop.value == (0, 0, 0)
    assert not found.drop.stated


@pytest.mark.parametrize("pose", ["behind", "1 2", "1 x 3 0 0 0"])
def test_a_pose_that_is_none_is_not_known(pose: str):
    assert read(crumb(f"<pose>{pose}</pose>")).drop is None
