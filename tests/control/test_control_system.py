"""What launch files, YAML files and the robot say about control, put together."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.launch.ros1.graph import LaunchGraph
from checker.package.inputs import open_input
from checker.ros.control.controllers import ControlSystem
from checker.rule_testing import write_example
from checker.rulebook.example_files import URDF_NAME

Part = Callable[..., Any]


@pytest.fixture
def part(tmp_path: Path) -> Part:
    """Return a part of the minimal URDF package with some files changed."""

    def part_of(kind: type, changes: Mapping[str, Any] = {}, urdf: object = True) -> Any:
        package = write_example({"@urdf": urdf, **changes}, tmp_path)
        with open_input(package) as opened:
            return Subject(opened.packages[0]).one(kind)

    return part_of


def test_the_minimal_package(part: Part) -> None:
    control: ControlSystem = part(ControlSystem)
    assert [launch.file for launch in control.launches] == [
        "launch/control.launch",
        "launch/spawn.launch",
    ]
    assert set(control.configured_controllers) == {
        "/arm/state_controller",
        "/arm/shoulder_controller",
    }
    assert [each.full_name for each in control.spawned_controllers] == [
        *control.configured_controllers
    ]
    assert control.interfaces["shoulder"].value == "EffortJointInterface"
    assert not control.unread
    assert not control.faults


def test_an_included_launch_file_is_no_entry_of_its_own(part: Part) -> None:
    both = "".join(
        f'<include file="$(find {URDF_NAME})/launch/{name}.launch"/>'
        for name in ("control", "spawn")
    )
    control = part(ControlSystem, {"launch/all.launch": f"<launch>{both}</launch>"})
    assert [launch.file for launch in control.launches] == ["launch/all.launch"]
    assert len(control.spawned_controllers) == 2


def test_a_file_that_a_condition_leaves_out_stays_an_entry(part: Part) -> None:
    text = f"""<launch><group if="0">
<include file="$(find {URDF_NAME})/launch/control.launch"/></group></launch>"""
    control = part(ControlSystem, {"launch/all.launch": text})
    assert "launch/control.launch" in [launch.file for launch in control.launches]


def test_launch_files_that_include_each_other(part: Part) -> None:
    def include(name: str) -> str:
        return f'<launch><include file="$(find {URDF_NAME})/launch/{name}.launch"/></launch>'

    changes = {"launch/control.launch": include("spawn"), "launch/spawn.launch": include("control")}
    graph: LaunchGraph = part(LaunchGraph, changes)
    assert graph.faults


def test_a_world_of_gazebo_ros_is_harmless_and_other_packages_are_not(part: Part) -> None:
    world = '<include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
    other = '<include file="$(find acme_control)/launch/control.launch"/>'
    control = part(ControlSystem, {"launch/world.launch": f"<launch>{world}</launch>"})
    assert not control.unread
    control = part(ControlSystem, {"launch/world.launch": f"<launch>{other}</launch>"})
    assert "acme_control is not available" in control.unread[0]


def test_parameters_within_a_launch_file_have_their_lines(part: Part) -> None:
    text = """<launch>
  <rosparam ns="arm">
    # a comment
    elbow_controller:
      type: a/B
  </rosparam>
</launch>"""
    control = part(ControlSystem, {"launch/more.launch": text})
    controller = control.configured_controllers["/arm/elbow_controller"]
    place = controller.type.span.place()
    assert (place.file, place.line, place.column) == ("launch/more.launch", 5, 13)
    assert place.snippet.strip() == "type: a/B"


@pytest.mark.parametrize(
    "text", ["\x00", "a: [1", "a: &a [*a, *a]", "!!python/object:os.system x", "- " * 300, "\t: "]
)
def test_hostile_parameters_are_faults_or_nothing(part: Part, text: str) -> None:
    control = part(ControlSystem, {"config/control.yaml": text})
    assert isinstance(control, ControlSystem)
    assert not control.controllers


def test_a_parameter_file_outside_is_not_read(part: Part) -> None:
    files = ("$(find ../../..)/etc/passwd", "/etc/passwd")
    text = "".join(f'<rosparam file="{file}"/>' for file in files)
    control = part(ControlSystem, {"launch/more.launch": f"<launch>{text}</launch>"})
    assert all("not available" in reason for reason in control.unread)
    assert len(control.unread) == 2


def test_a_package_without_control(part: Part) -> None:
    nothing = {"config/control.yaml": None, "launch/control.launch": None}
    nothing["launch/spawn.launch"] = None
    found = part(ControlSystem, nothing, urdf="")
    assert isinstance(found, NotAvailable)
    assert not found.applicable


def test_a_package_that_only_spawns_a_robot(part: Part) -> None:
    nothing = {"config/control.yaml": None, "launch/control.launch": None}
    found = part(ControlSystem, nothing, urdf="")
    assert len(found.models) == 1


def test_parameters_are_loaded_up_to_a_bound(part: Part, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("checker.ros.control.loaded_parameters.MAX_VALUES", 50)
    load = f'<rosparam ns="{{}}" file="$(find {URDF_NAME})/config/control.yaml"/>'
    text = "".join(load.format(f"r{number}") for number in range(20))
    control = part(ControlSystem, {"launch/all.launch": f"<launch>{text}</launch>"})
    assert "more than 50 values" in control.unread[-1]
    assert len(control.controllers) < 10


def test_launch_files_are_followed_up_to_a_bound(
    part: Part, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("checker.launch.ros1.package_launch.MAX_PARTS", 2)
    control = part(ControlSystem)
    assert control.unread == (
        "launch/control.launch and the following files are too large to read",
    )
