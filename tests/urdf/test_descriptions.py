"""What URDF says beside links and joints, and which profile judges it."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.base.cache import NO_CACHE
from checker.base.output import say_nothing
from checker.engine.review import judge_package
from checker.formats.urdf.fixed_joints import Lumping
from checker.formats.xacro.fault import XacroFaultKind
from checker.package.inputs import open_input
from checker.robots.urdf_files import UrdfFiles
from checker.settings import Settings
from tests.urdf.conftest import NAME, Describe, robot

FILE = f"{NAME}/urdf/acme.urdf"
BODY = """
<link name="base"/><link name="arm"/><link name="hand"/><link name="tool"/>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="arm"/></joint>
<joint name="wrist" type="fixed"><parent link="arm"/><child link="hand"/></joint>
<joint name="grip" type="fixed"><parent link="hand"/><child link="tool"/></joint>
<transmission name="t">
  <type>transmission_interface/SimpleTransmission</type>
  <joint name="shoulder"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
  <actuator name="m"/>
</transmission>
<gazebo reference="grip"><preserveFixedJoint>true</preserveFixedJoint></gazebo>
<gazebo><static>true</static></gazebo>
"""


def test_transmissions_and_gazebo_tags(describe: Describe) -> None:
    (description,) = describe({FILE: robot(BODY)}).one(UrdfFiles).descriptions
    (transmission,) = description.transmissions
    assert transmission.type.value == "transmission_interface/SimpleTransmission"
    assert [end.name.value for end in transmission.joints] == ["shoulder"]
    assert [each.value for each in transmission.joints[0].interfaces] == ["EffortJointInterface"]
    assert transmission.actuators[0].interfaces == ()
    assert [tag.reference.value for tag in description.gazebo] == ["grip", ""]
    assert not description.for_rviz


def test_fixed_joints_merge_links_unless_they_are_kept(describe: Describe) -> None:
    (description,) = describe({FILE: robot(BODY)}).one(UrdfFiles).descriptions
    groups = Lumping(description).groups
    names = {name: [link.name.value for link in links] for name, links in groups.items()}
    assert names == {"base": ["base"], "arm": ["arm", "hand"], "tool": ["tool"]}


def test_a_loop_of_fixed_joints_ends(describe: Describe) -> None:
    back = '<joint name="back" type="fixed"><parent link="hand"/><child link="arm"/></joint>'
    (description,) = describe({FILE: robot(BODY + back)}).one(UrdfFiles).descriptions
    assert sum(len(links) for links in Lumping(description).groups.values()) == 4


def profile_of(path: Path, settings: Settings) -> str:
    with open_input(path) as opened:
        return judge_package(opened.packages[0], "", settings, NO_CACHE, say_nothing).profile


def test_a_urdf_robot_gets_its_own_profile(describe: Describe, tmp_path: Path) -> None:
    describe({FILE: robot(BODY)})
    quick = Settings(select=("URD003",), trial=False)
    for path in (tmp_path / NAME, tmp_path / FILE):
        assert profile_of(path, quick) == "urdf"
        assert profile_of(path, quick.with_overrides(profile="sdf")) == "sdf"
        assert profile_of(path, quick.with_overrides(profile="subt")) == "subt"


_MACROS = """<xacro:macro name="box_mass" params="mass">
<inertial><mass value="${mass}"/></inertial></xacro:macro>"""
_CAMERA = """<link name="eye"><xacro:box_mass mass="0.1"/></link>
<joint name="mount" type="fixed"><parent link="base"/><child link="eye"/></joint>"""


def with_camera(camera: str) -> dict[str, str]:
    """Return a robot that includes macros, and leaves out a file with a camera."""
    include = '<xacro:include filename="macros.xacro"/>'
    return {
        f"{NAME}/urdf/acme.urdf.xacro": robot(f'{include}<link name="base"/><!-- camera.xacro -->'),
        f"{NAME}/urdf/macros.xacro": robot(_MACROS),
        f"{NAME}/urdf/camera.xacro": robot(camera),
    }


_DRIVE = "<gazebo><plugin name='p' filename='f'><radius>${wheel_radius}</radius></plugin></gazebo>"


@pytest.mark.parametrize("part", [_CAMERA, _DRIVE])
def test_a_part_that_no_robot_includes_is_no_robot(part: str, describe: Describe) -> None:
    (fault,) = describe(with_camera(part)).one(UrdfFiles).faults
    assert (fault.file, fault.kind) == ("urdf/camera.xacro", XacroFaultKind.PART)


@pytest.mark.parametrize(
    "camera",
    [
        _CAMERA.replace("box_mass", "bxo_mass"),
        '<link name="camera"><xacro:box_mass mass="1"/></link>',
        _CAMERA + '<link name="base"/>',
    ],
    ids=["no such macro", "no joint", "a root of its own"],
)
def test_a_robot_without_its_macros_is_a_fault(describe: Describe, camera: str) -> None:
    (fault,) = describe(with_camera(camera)).one(UrdfFiles).faults
    assert (fault.file, fault.kind) == ("urdf/camera.xacro", XacroFaultKind.EXPANSION)
