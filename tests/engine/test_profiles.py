"""A profile knows its target: the ROS 2 distribution decides about the Gazebo release."""

from __future__ import annotations

import pytest

from checker.rulebook.profiles import distro_names, profile, profile_names


@pytest.mark.parametrize(
    ("distro", "release", "reads"),
    [("", "harmonic", "1.11"), ("humble", "fortress", "1.9"), ("rolling", "jetty", "1.12")],
)
def test_a_distribution_brings_its_gazebo(distro: str, release: str, reads: str) -> None:
    context = profile("ros2", distro).context
    assert (context.distro or "jazzy", context.release, context.reads) == (
        distro or "jazzy",
        release,
        reads,
    )


def test_other_profiles_are_about_no_distribution() -> None:
    names = [name for name in profile_names() if name != "ros2" and "classic" not in name]
    assert {profile(name, "humble").context.distro for name in names} == {""}


def test_profiles_of_releases_share_their_rules() -> None:
    releases = [profile(f"gazebo-{name}") for name in ("fortress", "harmonic", "ionic", "jetty")]
    assert len({judge.rules for judge in releases}) == 1
    assert len({judge.context.release for judge in releases}) == 4


def test_every_distribution_has_a_profile() -> None:
    assert [profile("ros2", name).context.distro for name in distro_names()] == [*distro_names()]


def test_gazebo_classic_stays_whatever_the_distribution() -> None:
    context = profile("ros2-classic", "iron").context
    assert (context.release, context.distro, context.is_classic) == ("classic", "iron", True)
    assert not profile("urdf").context.is_classic
