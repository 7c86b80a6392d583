"""What walks: plugins for legs, or controlled joints and no other drive."""

from __future__ import annotations

import pytest

from checker.model.locomotion.drive import is_legged
from tests.model.robots import sdf


@pytest.mark.parametrize(
    ("classes", "walks"),
    [
        (["AnymalControlPlugin"], True),
        (["ConfigurableJointPositionController"] * 12, True),
        (["JointPositionController"] * 3, False),
        (["DiffDrive", *["JointPositionController"] * 7], False),
        ([], False),
    ],
)
def test_what_walks(classes: list[str], walks: bool) -> None:
    plugins = "".join(f'<plugin filename="p" name="any::{name}"/>' for name in classes)
    assert is_legged(sdf(plugins).plugins) is walks
