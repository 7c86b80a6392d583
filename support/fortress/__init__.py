"""Robots in the physics of Gazebo Fortress: Debian's libraries in a small program.

Debian's `libignition-physics-dev`, `libsdformat-dev` and a compiler are needed.
"""

from __future__ import annotations

import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from checker.physics.trial.profile import Knots

SOURCE = Path(__file__).parent / "drive.cpp"
LIBRARIES = (
    "ignition-physics5-sdf", "ignition-physics5-mesh", "ignition-common4-graphics",
    "ignition-plugin1-loader", "ignition-math6-eigen3", "sdformat12",
)  # fmt: skip
Pose = tuple[float, float, float, float, float, float, float]
"""x, y, z in metres, and the quaternion w, x, y, z."""


class Refused(Exception):
    """The simulator does not load a robot; the message is its own."""


@dataclass(frozen=True)
class Drive:
    """The motion of a robot in Gazebo's physics.

    Attributes:
        time: The time of each sample, seconds.
        poses: Pose of the model's frame in each.
    """

    time: tuple[float, ...]
    poses: tuple[Pose, ...]


def driven(
    program: Path,
    model: Path,
    height: float,
    seconds: float,
    commands: Mapping[str, Mapping[str, Knots]],
    folders: Sequence[Path] = (),
    *,
    gravity: tuple[float, float, float] = (0.0, 0.0, -9.8),
) -> Drive:
    """Drive a robot.

    Args:
        program: The compiled program.
        model: An SDF or URDF file with one model.
        height: z of the model's frame at the start, metres.
        seconds: The duration.
        commands: By the name of each joint, its `speed` over time (rad/s) or `place` (rad or m).
        folders: Where `model://` and `package://` look.
        gravity: The acceleration, m/s²; of a slope where it is not vertical.

    Raises:
        Refused: The model is not loaded, or a joint does not exist.
    """
    lines = [
        f"{kind} {joint} {' '.join(f'{number!r}' for knot in knots for number in knot)}\n"
        for kind, of_kind in commands.items()
        for joint, knots in of_kind.items()
    ]
    done = subprocess.run(
        [program, model, str(height), str(seconds), " ".join(map(str, gravity)), *folders],
        input="".join(lines), capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    if done.returncode:
        raise Refused(done.stderr.strip() or f"it ends with {done.returncode}")
    rows = [tuple(map(float, line.split(","))) for line in done.stdout.splitlines()]
    poses = tuple((x, y, z, qw, qx, qy, qz) for _, x, y, z, qw, qx, qy, qz in rows)
    return Drive(tuple(row[0] for row in rows), poses)
