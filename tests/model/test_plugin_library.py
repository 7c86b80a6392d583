"""Which plugin libraries a release has, and which classes are in them."""

from __future__ import annotations

import pytest

from checker.model.plugin_library import (
    classic_plugin,
    library_of_class,
    library_stem,
    newer_name,
    plugin_libraries,
    release_label,
    release_major,
)

DRIVE = "ignition-gazebo-diff-drive-system"
SYSTEMS = "ignition::gazebo::systems"


@pytest.mark.parametrize("name", [DRIVE, f"lib{DRIVE}.so", f"/usr/lib/lib{DRIVE}.so"])
def test_every_spelling_of_a_library_has_one_stem(name: str) -> None:
    assert library_stem(name) == DRIVE


@pytest.mark.parametrize("release", ["dome", "fortress", "harmonic"])
def test_a_class_is_found_in_its_library_under_its_old_name_too(release: str) -> None:
    library = plugin_libraries(release)[DRIVE]
    assert library.has_class(f"{SYSTEMS}::DiffDrive")
    assert not library.has_class(f"{SYSTEMS}::WheelSlip")
    assert not library.has_class("DiffDrive")


@pytest.mark.parametrize("release", ["ionic", "jetty"])
def test_later_releases_know_no_name_of_ignition(release: str) -> None:
    libraries = plugin_libraries(release)
    assert DRIVE not in libraries
    library = libraries[newer_name(DRIVE)]
    assert library.has_class("gz::sim::systems::DiffDrive")
    assert not library.has_class(f"{SYSTEMS}::DiffDrive")


def test_fortress_reads_the_newer_name_of_a_library() -> None:
    assert "gz-sim-diff-drive-system" in plugin_libraries("fortress")


def test_the_new_name_came_after_dome() -> None:
    name = "gz::sim::systems::DiffDrive"
    assert not plugin_libraries("dome")[DRIVE].has_class(name)
    assert plugin_libraries("harmonic")[DRIVE].has_class(name)


def test_an_inline_namespace_does_not_matter() -> None:
    assert plugin_libraries("dome")[DRIVE].has_class(f"{SYSTEMS}::v4::DiffDrive")


def test_parameters_are_known_for_systems_of_gazebo_only() -> None:
    libraries = plugin_libraries("dome")
    assert "odom_topic" in (libraries[DRIVE].parameters or ())
    assert libraries["GasEmitterDetectorPlugin"].parameters is None


def test_the_plugins_of_subt_were_built_for_dome() -> None:
    assert "GasEmitterDetectorPlugin" not in plugin_libraries("harmonic")


def test_an_unknown_release_has_no_libraries() -> None:
    assert not plugin_libraries("moonbase")
    assert release_major("classic") is None


def test_a_class_leads_to_its_library() -> None:
    library = library_of_class("dome", f"{SYSTEMS}::WheelSlip")
    assert library is not None
    assert library.filename == "libignition-gazebo-wheel-slip-system.so"
    assert library_of_class("dome", "somebody::Else") is None


@pytest.mark.parametrize(
    ("release", "major"), [("dome", 4), ("fortress", 6), ("harmonic", 8), ("jetty", 10)]
)
def test_major_versions(release: str, major: int) -> None:
    assert release_major(release) == major


def test_a_release_is_called_by_its_name() -> None:
    assert release_label("dome") == "Ignition Gazebo 4 (Dome) and SubT"
    assert release_label("harmonic") == "Gazebo Sim 8 (Harmonic)"


def test_plugins_of_gazebo_classic() -> None:
    known = classic_plugin("libgazebo_ros_control.so")
    assert known is not None
    assert known["replacement"]["name"] == f"{SYSTEMS}::DiffDrive"
    assert classic_plugin("libgazebo_ros_of_the_future.so") == {}
    assert classic_plugin(f"lib{DRIVE}.so") is None
