"""A URDF does not state how a robot stands on its legs; on wheels it stands as it is."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

from checker.pipeline import check_package
from checker.report.report import PackageReport
from checker.rule_testing import write_example
from checker.settings import Settings


def on_legs(hinges: int) -> dict[str, str]:
    """Return a URDF robot that leans far out over four wheels, each on a chain of hinges."""
    parts = "".join(
        leg(f"{end}_{side}", f"{x} {y} 0", hinges)
        for end, x in (("front", 0.2), ("rear", -0.2))
        for side, y in (("left", 0.2), ("right", -0.2))
    )
    return {
        "@urdf": f"""
<link name="trunk">
<inertial>
<origin xyz="0.35 0 0"/>
<mass value="30"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
</inertial>
<collision><geometry><box size="1 0.3 0.1"/></geometry></collision>
</link>
<joint name="torso" type="fixed"><parent link="base_link"/><child link="trunk"/></joint>
{parts}
"""
    }


def leg(name: str, at: str, hinges: int) -> str:
    links = ["trunk", *(f"{name}_{number}" for number in range(hinges))]
    bends = "".join(
        f"""<link name="{child}"/>
<joint name="{child}_joint" type="revolute">
<origin xyz="{at if parent == "trunk" else "0 0 0"}"/>
<parent link="{parent}"/><child link="{child}"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="90" velocity="9"/>
</joint>
"""
        for parent, child in pairwise(links)
    )
    return f"""{bends}<link name="{name}_wheel">
<inertial><mass value="0.5"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
</inertial>
<collision>
<origin xyz="0 0 -0.2" rpy="1.5707963267948966 0 0"/>
<geometry><cylinder radius="0.1" length="0.05"/></geometry>
</collision>
</link>
<joint name="{name}_wheel_joint" type="continuous">
<parent link="{links[-1]}"/><child link="{name}_wheel"/><axis xyz="0 1 0"/>
</joint>
"""


def checked(hinges: int, folder: Path) -> PackageReport:
    package = write_example(on_legs(hinges), folder)
    (report,) = check_package(package, Settings(select=("INE009",))).packages
    return report


def test_a_suspension_of_two_hinges_stands_as_it_is_written(tmp_path: Path) -> None:
    (finding,) = checked(2, tmp_path).findings
    assert "tips over" in finding.message


def test_robots_on_legs_are_not_judged(tmp_path: Path) -> None:
    report = checked(3, tmp_path)
    assert not report.findings
    assert not report.not_checked
