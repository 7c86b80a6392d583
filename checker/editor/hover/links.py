"""Hover text of a link: mass, inertia, its place in the robot, its joints, visuals and sensors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from checker.base.words import count
from checker.editor.card import card, code, escaped_words, names
from checker.editor.figures import number, numbers, pose
from checker.model.components import Inertial, Link
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie

_NEGLIGIBLE = 1e-12
"""Share of the moments below which products of inertia are neglected."""


def link_card(robot: Robot, link: Link, note: str = "") -> str:
    """Return what is known of a link of a robot, as Markdown."""
    rows = [*_weight(robot, link), *_place(robot, link), ("holds", _contents(link))]
    return card(f"**link** {code(link.scoped_name)}", rows, note)


def _weight(robot: Robot, link: Link) -> Iterator[tuple[str, str]]:
    if link.inertial is None:
        default = f"{number(link.default_mass)} kg, the default: the file states no inertial"
        yield "mass", default
        return
    share = f" of {number(robot.mass)} kg" if robot.mass > link.mass else ""
    yield "mass", f"{number(link.mass)} kg{share}"
    centre = link.inertial.pose.transform
    yield "centre of mass", numbers(centre.translation, "m")
    yield "inertia", _inertia(link.inertial)


def _inertia(inertial: Inertial) -> str:
    """Return the principal moments, and the moments as written where they are not the same."""
    written = [moment.value for moment in inertial.moments]
    ixx, ixy, ixz, iyy, iyz, izz = written
    if not all(map(math.isfinite, written)):
        return ""
    slight = _NEGLIGIBLE * max(map(abs, written))
    if all(abs(product) <= slight for product in (ixy, ixz, iyz)):
        return f"principal moments {numbers(sorted((ixx, iyy, izz)), 'kg·m²')}"
    principal = numbers(principal_moments(ixx, ixy, ixz, iyy, iyz, izz), "kg·m²")
    return f"principal moments {principal}; xx yy zz {numbers((ixx, iyy, izz), 'kg·m²')}"


def principal_moments(
    ixx: float, ixy: float, ixz: float, iyy: float, iyz: float, izz: float
) -> tuple[float, ...]:
    """Return the eigenvalues of an inertia, ascending, kg·m².

    In closed form, so that no numpy is loaded (Smith, "Eigenvalues of a symmetric 3 × 3 matrix",
    1961).
    """
    scale = max(map(abs, (ixx, ixy, ixz, iyy, iyz, izz))) or 1.0
    ixx, ixy, ixz, iyy, iyz, izz = (it / scale for it in (ixx, ixy, ixz, iyy, iyz, izz))
    mean = (ixx + iyy + izz) / 3.0
    a, b, c = ixx - mean, iyy - mean, izz - mean
    spread = math.sqrt((a * a + b * b + c * c + 2.0 * (ixy**2 + ixz**2 + iyz**2)) / 6.0)
    if spread <= _NEGLIGIBLE:
        return (mean * scale,) * 3
    determinant = a * (b * c - iyz**2) - ixy * (ixy * c - iyz * ixz) + ixz * (ixy * iyz - b * ixz)
    half = min(max(determinant / (2.0 * spread**3), -1.0), 1.0)
    turn = math.acos(half) / 3.0
    roots = (mean + 2.0 * spread * math.cos(turn + k * 2.0 * math.pi / 3.0) for k in range(3))
    return tuple(sorted(root * scale for root in roots))


def _place(robot: Robot, link: Link) -> Iterator[tuple[str, str]]:
    chain = _chain(robot, link)
    root = chain[0].parent if chain else link.scoped_name
    base = robot.pose_of(root) if root != WORLD else None
    frame = robot.pose_of(link.scoped_name)
    where = f"in {code(root)}"
    if root == WORLD or not chain:
        base, where = robot.pose_of("__model__"), "in the model"
    if base is not None and frame is not None:
        yield "place", f"{pose(base.inverse @ frame)} {where}"
    else:
        yield "place", "not known"
    yield "from the root", _in_words(chain) if chain else "it is the root"
    below = [tie for tie in robot.tree.ties if tie.parent == link.scoped_name != tie.child]
    if chain:
        yield "parent", f"{code(chain[-1].parent)} by {_joint(chain[-1])}"
    yield "children", names([tie.child for tie in below])


def _chain(robot: Robot, link: Link) -> list[Tie]:
    """Return the joints from the root to a link; in a circle, those of one round."""
    chain: list[Tie] = []
    at = link.scoped_name
    seen = {at}
    while at in robot.tree.ties_above:
        tie = robot.tree.ties_above[at][0]
        chain.insert(0, tie)
        at = tie.parent
        if at in seen:
            break
        seen.add(at)
    return chain


def _in_words(chain: Sequence[Tie]) -> str:
    """Return a chain by its ends: long ones are cut in the middle."""
    steps = [code(chain[0].parent), *(f"{_joint(tie)} → {code(tie.child)}" for tie in chain)]
    steps = [*steps[:3], "…", *steps[-3:]] if len(steps) > 8 else steps
    return " → ".join(steps)


def _joint(tie: Tie) -> str:
    return f"{code(tie.joint.name.value)} ({escaped_words(tie.joint.type.value) or 'no type'})"


def _contents(link: Link) -> str:
    parts = [count(len(link.collisions), "collision"), count(len(link.visuals), "visual")]
    parts += [count(len(link.sensors), "sensor")]
    return ", ".join([*parts, *([count(len(link.lights), "light")] if link.lights else [])])
