"""Robots in the physics of Gazebo Fortress: Debian's libraries in a small program.

Debian's `libignition-physics-dev`, `libsdformat-dev` and a compiler are needed.
"""

from __future__ import annotations

import hashlib
import os
import shlex
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
        joints: Position (rad or m) and velocity in each sample, by the name of the joint.
    """

    time: tuple[float, ...]
    poses: tuple[Pose, ...]
    joints: Mapping[str, tuple[tuple[float, float], ...]]


def is_installed() -> bool:
    """Return whether the libraries are there."""
    try:
        return subprocess.run(["pkg-config", "--exists", *LIBRARIES], check=False).returncode == 0
    except FileNotFoundError:
        return False


def compiled(folder: Path) -> Path:
    """Compile the program, unless a folder holds it already."""
    program = folder / f"drive-{hashlib.sha256(SOURCE.read_bytes()).hexdigest()[:16]}"
    if not program.exists():
        wanted = ["pkg-config", "--cflags", "--libs", *LIBRARIES]
        flags = shlex.split(subprocess.check_output(wanted, text=True))
        new = program.with_suffix(f".{os.getpid()}")
        subprocess.run(["g++", "-std=c++17", "-O1", SOURCE, "-o", new, *flags], check=True)
        new.replace(program)
    return program


def driven(
    program: Path,
    model: Path,
    height: float,
    seconds: float,
    commands: Mapping[str, Mapping[str, Knots]],
    folders: Sequence[Path] = (),
) -> Drive:
    """Drive a robot.

    Args:
        program: The compiled program.
        model: An SDF or URDF file with one model.
        height: z of the model's frame at the start, metres.
        seconds: The duration.
        commands: By the name of each joint, its `speed` over time (rad/s) or `place` (rad or m).
        folders: Where `model://` and `package://` look.

    Raises:
        Refused: The model is not loaded, or a joint does not exist.
    """
    lines = [
        f"{kind} {joint} {' '.join(f'{number!r}' for knot in knots for number in knot)}\n"
        for kind, of_kind in commands.items()
        for joint, knots in of_kind.items()
    ]
    done = subprocess.run(
        [program, model, str(height), str(seconds), *folders],
        input="".join(lines), capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    if done.returncode:
        raise Refused(done.stderr.strip() or f"it ends with {done.returncode}")
    rows = [tuple(map(float, line.split(","))) for line in done.stdout.splitlines()]
    poses = tuple((x, y, z, qw, qx, qy, qz) for _, x, y, z, qw, qx, qy, qz, *_ in rows)
    names = [name for of_kind in commands.values() for name in of_kind]
    columns = list(zip(*rows, strict=True))[8:]
    joints = zip(names, columns[::2], columns[1::2], strict=True)
    motions = {name: tuple(zip(at, speed, strict=True)) for name, at, speed in joints}
    return Drive(tuple(row[0] for row in rows), poses, motions)
