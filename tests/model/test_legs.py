"""What walks: plugins for legs, or controlled joints that form legs and no other drive."""

from __future__ import annotations

import pytest

from checker.model.locomotion.legs import is_legged
from tests.model.robots import sdf

LEGS = ("fl", "fr", "rl", "rr")


def link(name: str, z: float) -> str:
    box = "<geometry><box><size>0.1 0.1 0.2</size></box></geometry>"
    collision = f'<collision name="c">{box}</collision>'
    return f'<link name="{name}"><pose>0 0 {z} 0 0 0</pose>{collision}</link>'


def joint(parent: str, child: str) -> str:
    return f"""<joint name="to_{child}" type="revolute">
  <parent>{parent}</parent><child>{child}</child><axis><xyz>0 1 0</xyz></axis></joint>
<plugin filename="p" name="any::JointPositionController">
  <joint_name>to_{child}</joint_name></plugin>"""


def limbs(down: float, joints: int = 2, names: tuple[str, ...] = LEGS) -> str:
    """A body with limbs whose links each are `down` metres lower than the one before."""
    parts = link("body", 1.0)
    for name in names:
        parent = "body"
        for number in range(joints):
            child = f"{name}{number}"
            parts += link(child, 1.0 - down * (number + 1)) + joint(parent, child)
            parent = child
    return parts


@pytest.mark.parametrize(
    ("content", "walks"),
    [
        (limbs(0.2), True),
        (limbs(0.2, joints=3, names=("left", "right")), True),
        ('<plugin filename="p" name="any::AnymalControlPlugin"/>', True),
        ("", False),
    ],
)
def test_what_walks(content: str, walks: bool) -> None:
    assert is_legged(sdf(content)) is walks


@pytest.mark.parametrize(
    "content",
    [
        pytest.param(limbs(-0.2), id="arms above the body"),
        pytest.param(limbs(0.2, joints=1, names=(*LEGS, "tail", "rudder")), id="flaps"),
        pytest.param(limbs(0.2, joints=6, names=("gimbal",)), id="one limb"),
        pytest.param(limbs(0.2, joints=2, names=("left", "right")), id="too few joints"),
        pytest.param(
            limbs(0.2) + '<plugin filename="p" name="any::DiffDrive"/>', id="another drive"
        ),
    ],
)
def test_what_does_not_walk(content: str) -> None:
    assert not is_legged(sdf(content))
