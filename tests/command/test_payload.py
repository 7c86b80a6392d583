"""The command answers whether an arm can carry a mass."""

from __future__ import annotations

from pathlib import Path

from tests.command.conftest import Run

ARM = """<robot name="arm">
<link name="base"><collision><geometry><box size="1 1 0.2"/></geometry></collision></link>
<link name="boom">
  <inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
</link>
<link name="tool0"/>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="boom"/>
  <origin xyz="0 0 2"/><axis xyz="0 1 0"/>
  <limit lower="-2" upper="2" effort="10" velocity="1"/></joint>
<joint name="flange" type="fixed"><parent link="boom"/><child link="tool0"/>
  <origin xyz="0 0 -1"/></joint>
</robot>
"""


def test_what_is_too_heavy_is_reported(run: Run, tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(ARM)
    # The arm needs 4.9 N·m; 0.5 kg at 1 m as much again.
    assert "INE015" not in run(file, "--select", "INE015", "--payload", "0.5", "--info").stdout
    shown = run(file, "--select", "INE015", "--payload", "1.5", "--info").stdout
    assert "has to hold 19.6 N·m against gravity with 1.5 kg at 'tool0'" in shown


def test_a_mass_is_a_number(run: Run, tmp_path: Path) -> None:
    assert run(tmp_path, "--payload", "-1").returncode == 2
