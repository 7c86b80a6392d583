"""What yourdfpy makes of the same URDF: a check of our own reader.

yourdfpy brings an XML reader and imports of its own, so it is asked about files that are trusted
(samples, tests), or inside a limited child process.
"""

from __future__ import annotations

import math
from pathlib import Path

from checker.model.robot import Robot


def disagreements(robot: Robot, path: Path, tolerance: float = 1e-9) -> list[str]:
    """Return what differs between a robot and what yourdfpy reads from the same file.

    Args:
        robot: As this package read it.
        path: The URDF file.
        tolerance: Of masses (kg), positions (m) and entries of rotation matrices.
    """
    import yourdfpy

    other = yourdfpy.URDF.load(
        str(path), load_meshes=False, build_collision_scene_graph=False, load_collision_meshes=False
    )
    differences = []
    if set(other.link_map) != set(robot.links_by_name):
        differences.append(f"links {sorted(set(other.link_map) ^ set(robot.links_by_name))}")
    if set(other.joint_map) != set(robot.joints_by_name):
        differences.append(f"joints {sorted(set(other.joint_map) ^ set(robot.joints_by_name))}")
    for name, link in robot.links_by_name.items():
        if name not in other.link_map:
            continue
        theirs = getattr(other.link_map[name].inertial, "mass", None)
        ours = link.inertial.mass.value if link.inertial is not None else None
        if (ours is None) != (theirs is None) or not math.isclose(ours or 0, theirs or 0):
            differences.append(f"mass of {name}: {ours} against {theirs}")
        matrix = other.get_transform(name)
        pose = robot.pose_of(name)
        if pose is None:
            differences.append(f"pose of {name} is unknown")
            continue
        rows = [(*row, x) for row, x in zip(pose.rotation, pose.translation, strict=True)]
        worst = max(abs(rows[i][j] - float(matrix[i][j])) for i in range(3) for j in range(4))
        if worst > tolerance:
            differences.append(f"pose of {name} is off by {worst:.1e}")
    return differences
