"""Libraries that a package ships or builds, or that another package lends it."""

from __future__ import annotations

from checker.package.dependencies import available_packages, libraries_of
from checker.package.package import Package
from checker.package.workspace import Workspace
from tests.package.conftest import Write

MANIFEST = "<package><name>{}</name>{}</package>"


def package(write: Write, files: dict[str, str]) -> Package:
    space = write({"rover/package.xml": MANIFEST.format("rover", ""), **files})
    found = Workspace((space,)).package("rover")
    assert found is not None
    return found


def test_shipped_libraries(write: Write) -> None:
    rover = package(write, {"rover/plugins/libArm.so": "", "rover/plugins/Leg.so": ""})
    assert sorted(libraries_of(rover)) == ["Arm", "Leg"]


def test_built_libraries_by_target_and_by_file_name(write: Write) -> None:
    build = """project(rover)
add_library(${PROJECT_NAME}_arm SHARED arm.cc)
set_target_properties(${PROJECT_NAME}_arm PROPERTIES OUTPUT_NAME Arm)
"""
    rover = package(write, {"rover/CMakeLists.txt": "", "rover/plugins/CMakeLists.txt": build})
    assert "Arm" in libraries_of(rover)
    build = build.replace("${PROJECT_NAME}", "rover")
    rover = package(write, {"rover/CMakeLists.txt": build})
    assert {"rover_arm", "Arm"} <= set(libraries_of(rover))


def test_dependencies_lend_theirs_in_turn(write: Write) -> None:
    depends = "<exec_depend>{}</exec_depend>"
    files = {
        "rover/package.xml": MANIFEST.format("rover", depends.format("arm")),
        "arm/package.xml": MANIFEST.format("arm", depends.format("hand") + depends.format("far")),
        "hand/package.xml": MANIFEST.format("hand", depends.format("rover")),
        "hand/libHand.so": "",
    }
    lenders = available_packages(package(write, files))
    assert [each.name for each in lenders.at_hand] == ["rover", "arm", "hand"]
    assert lenders.missing == ("far",)
    assert lenders.libraries() == {"Hand"}
