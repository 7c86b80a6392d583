"""Links as text, and solid bodies of which the inertia is known."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

angles = st.floats(-3.1, 3.1)
lengths = st.floats(-5.0, 5.0)
sizes = st.floats(0.01, 2.0)
masses = st.floats(0.01, 100.0)
poses = st.tuples(lengths, lengths, lengths, angles, angles, angles)

Pose = tuple[float, ...]
HOME: Pose = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def words(numbers: object) -> str:
    return " ".join(repr(float(number)) for number in numbers)  # type: ignore[attr-defined]


def inertial(mass: float, moments: Matrix, pose: Pose = HOME) -> str:
    """An inertial whose moments stand along the axes of its own pose."""
    pairs = ((i, j) for i in range(3) for j in range(i, 3))
    names = ((f"i{'xyz'[i]}{'xyz'[j]}", float(moments[i, j])) for i, j in pairs)
    inside = "".join(f"<{name}>{moment!r}</{name}>" for name, moment in names)
    return (
        f"<inertial><pose>{words(pose)}</pose><mass>{mass!r}</mass>"
        f"<inertia>{inside}</inertia></inertial>"
    )


def link(name: str, inside: str = "", pose: Pose = HOME) -> str:
    return f'<link name="{name}"><pose>{words(pose)}</pose>{inside}</link>'


def collision(shape: str, size: str, pose: Pose = HOME, name: str = "c") -> str:
    size = f"<size>{size}</size>" if shape == "box" else size
    return (
        f'<collision name="{name}"><pose>{words(pose)}</pose>'
        f"<geometry><{shape}>{size}</{shape}></geometry></collision>"
    )


def joint(
    name: str, kind: str, parent: str, child: str, axis: str = "0 0 1", pose: Pose = HOME
) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><pose>{words(pose)}</pose><parent>{parent}</parent>'
        f"<child>{child}</child><axis><xyz>{axis}</xyz></axis></joint>"
    )


def box(mass: float, x: float, y: float, z: float) -> Matrix:
    return np.diag([y * y + z * z, x * x + z * z, x * x + y * y]) * mass / 12


def cylinder(mass: float, radius: float, length: float) -> Matrix:
    across = mass * (3 * radius * radius + length * length) / 12
    return np.diag([across, across, mass * radius * radius / 2])


def sphere(mass: float, radius: float) -> Matrix:
    return np.eye(3) * 0.4 * mass * radius * radius
