"""The trials of a package with several robots: one that cannot be driven hinders no other."""

from __future__ import annotations

from pathlib import Path

from checker.base.cache import Cache
from checker.base.parts import NotAvailable
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.physics.trial.robot_trial import RobotTrial, SettledTrial
from checker.rule_testing import write_example

ROBOT = """<robot name="{name}">
  <link name="base_link">
    <inertial>
      <mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    {collision}
  </link>
  <gazebo reference="base_link"/>
  {plugin}
</robot>
"""
DRIVE = """<gazebo>
    <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive"/>
  </gazebo>"""
BOX = '<collision><geometry><box size="0.4 0.4 0.2"/></geometry></collision>'


def driven(folder: Path, *collisions: str, last: str = "") -> tuple[object, object]:
    """Return the trials of robots with these collisions, those settled as the second.

    Args:
        folder: For the package.
        collisions: Of each robot.
        last: What the last robot has besides.
    """
    plugins = ["" for _ in collisions[1:]] + [last]
    texts = {
        f"urdf/r{number}.urdf": ROBOT.format(name=f"r{number}", collision=shape, plugin=plugin)
        for number, (shape, plugin) in enumerate(zip(collisions, plugins, strict=True))
    }
    package = write_example({"@urdf": True, "urdf/arm.urdf": None, **texts}, folder)
    (package / "launch/spawn.launch").unlink()
    with open_input(package) as opened:
        subject = Subject(opened.packages[0], Cache(folder / "cache"))
        had = subject.all(RobotTrial), subject.all(SettledTrial)
        subject.close()
    return had


def test_one_without_a_shape_is_named_and_the_others_are_driven(tmp_path: Path) -> None:
    trials, settled = driven(tmp_path, "", BOX)

    assert isinstance(trials, tuple)
    assert isinstance(settled, tuple)
    assert [each.robot.name.value for each in trials] == ["r1"]
    assert trials[0].others.startswith("'r0' is not driven: ")
    assert [each.robot.name.value for each in settled] == ["r1"]


def test_without_any_that_can_be_driven_there_is_none(tmp_path: Path) -> None:
    trials, settled = driven(tmp_path, "", "")

    assert isinstance(trials, NotAvailable)
    assert trials.reason.startswith("'r0' is not driven: ")
    assert isinstance(settled, NotAvailable)


def test_of_many_those_with_a_drive_are_driven_before_the_others(tmp_path: Path) -> None:
    trials, _ = driven(tmp_path, *([BOX] * 9), last=DRIVE)

    assert isinstance(trials, tuple)
    assert [each.robot.name.value for each in trials] == [*(f"r{n}" for n in range(7)), "r8"]
    assert trials[0].others == "only 8 of 9 robots are driven"
