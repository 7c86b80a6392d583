"""One random robot, written as SDF, as nested SDF and as URDF, is read as one robot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from checker.model.robot import Robot
from tests.model.robots import Matrix, as_matrix, assert_pose, messages, pose, sdf, urdf

Numbers = tuple[float, float, float, float, float, float]
LENGTHS, ANGLES = st.floats(-2, 2), st.floats(-3.2, 3.2)
POSES: st.SearchStrategy[Numbers] = st.tuples(LENGTHS, LENGTHS, LENGTHS, ANGLES, ANGLES, ANGLES)


@dataclass(frozen=True)
class Body:
    """One link, posed in its parent's; the first one has no parent."""

    parent: int
    pose: Numbers
    mass: float
    inertial: Numbers
    axis: tuple[float, float, float]


@st.composite
def trees(draw: st.DrawFn) -> list[Body]:
    count = draw(st.integers(1, 6))
    return [
        Body(
            draw(st.integers(0, i - 1)) if i else -1,
            draw(POSES) if i else (0, 0, 0, 0, 0, 0),
            draw(st.floats(0.01, 100)),
            draw(POSES),
            draw(st.sampled_from([(1, 0, 0), (0, 1, 0), (0, 0, -1), (0.6, 0, 0.8)])),
        )
        for i in range(count)
    ]


def text(numbers: tuple[float, ...]) -> str:
    return " ".join(repr(float(number)) for number in numbers)


def placed(tree: list[Body]) -> list[Matrix]:
    matrices: list[Matrix] = []
    for body in tree:
        base = matrices[body.parent] if body.parent >= 0 else np.eye(4)
        matrices.append(base @ pose(*body.pose))
    return matrices


def as_sdf(tree: list[Body], names: list[str]) -> str:
    parts = []
    for i, body in enumerate(tree):
        frame = f' frame="l{body.parent}"' if i else ""
        parts.append(
            f"""<link name="l{i}"><pose{frame}>{text(body.pose)}</pose><inertial>
            <mass>{body.mass!r}</mass><pose>{text(body.inertial)}</pose></inertial></link>"""
        )
    return "".join(parts) + as_sdf_joints(tree, names)


def as_sdf_joints(tree: list[Body], names: list[str]) -> str:
    return "".join(
        f"""<joint name="j{i}" type="revolute"><parent>{names[body.parent]}</parent>
        <child>{names[i]}</child><axis><xyz>{text(body.axis)}</xyz></axis></joint>"""
        for i, body in enumerate(tree)
        if i
    )


def as_nested_sdf(tree: list[Body]) -> tuple[str, list[str]]:
    """Each body in a model of its own, inside its parent's model."""
    names: list[str] = []
    insides: list[str] = []
    for i, body in enumerate(tree):
        prefix = names[body.parent].removesuffix("link") if i else ""
        names.append(f"{prefix}m{i}::link")
        insides.append(
            f"""<link name="link"><inertial><mass>{body.mass!r}</mass>
            <pose>{text(body.inertial)}</pose></inertial></link>"""
        )
    for i in reversed(range(len(tree))):
        whole = f'<model name="m{i}"><pose>{text(tree[i].pose)}</pose>{insides[i]}</model>'
        if i == 0:
            return whole + as_sdf_joints(tree, names), names
        insides[tree[i].parent] += whole
    raise AssertionError


def as_urdf(tree: list[Body]) -> str:
    parts = []
    for i, body in enumerate(tree):
        xyz, rpy = text(body.inertial[:3]), text(body.inertial[3:])
        parts.append(
            f"""<link name="l{i}"><inertial><mass value="{body.mass!r}"/>
            <origin xyz="{xyz}" rpy="{rpy}"/></inertial></link>"""
        )
        if i:
            parts.append(
                f"""<joint name="j{i}" type="revolute"><parent link="l{body.parent}"/>
                <child link="l{i}"/><axis xyz="{text(body.axis)}"/>
                <origin xyz="{text(body.pose[:3])}" rpy="{text(body.pose[3:])}"/></joint>"""
            )
    return "".join(parts)


def check(robot: Robot, tree: list[Body], names: list[str]) -> None:
    assert messages(robot) == []
    assert set(robot.links_by_name) == set(names)
    for name, body, matrix in zip(names, tree, placed(tree), strict=True):
        link = robot.links_by_name[name]
        assert link.mass == body.mass
        assert_pose(robot.pose_of(name), matrix, 1e-9)
        assert link.inertial is not None
        centre = robot.pose_of_part(link, link.inertial.pose)
        assert_pose(centre, matrix @ pose(*body.inertial), 1e-9)
    for i, body in list(enumerate(tree))[1:]:
        joint = robot.joints_by_name[f"j{i}"]
        assert_pose(robot.pose_of_joint(joint), as_matrix(robot.pose_of(names[i])), 1e-9)
        direction = robot.axis_in_model(joint, joint.axes[0])
        np.testing.assert_allclose(direction, placed(tree)[i][:3, :3] @ body.axis, atol=1e-9)


@given(trees())
def test_one_robot(tree: list[Body]) -> None:
    flat = [f"l{i}" for i in range(len(tree))]
    check(sdf(as_sdf(tree, flat)), tree, flat)
    check(sdf(as_sdf(tree, flat).replace("frame=", "relative_to="), "1.7"), tree, flat)
    check(urdf(as_urdf(tree)), tree, flat)
    content, names = as_nested_sdf(tree)
    check(sdf(content, "1.8"), tree, names)
