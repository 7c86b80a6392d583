"""Joints that controllers command one by one."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.model.locomotion.commanded_joints import commanded_joints
from tests.model.controlled import controlled

FINGER = """<link name="finger"/>
<joint name="slide" type="prismatic"><parent link="upper_arm"/><child link="finger"/>
<limit lower="0" upper="0.1" effort="5" velocity="1"/></joint>"""


@pytest.mark.parametrize(
    ("parameter", "moves"), [("joint: slide", True), ("joints: [slide]", False)]
)
def test_a_gripper_controller_reads_no_list(tmp_path: Path, parameter: str, *, moves: bool) -> None:
    kind = "position_controllers/GripperActionController"
    robot = controlled(tmp_path, FINGER, kind, f"    {parameter}\n")
    assert ("slide" in commanded_joints(robot)) is moves
