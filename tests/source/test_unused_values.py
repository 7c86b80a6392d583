"""Values in Python that are computed and not used."""

from __future__ import annotations

import pytest

from checker.source.unused_values import without_unused_values

_LAUNCH = """def generate_launch_description():
    world = join('worlds',
                 'hall.sdf')
    return LaunchDescription([@])
"""


@pytest.mark.parametrize(
    ("used", "stays"),
    [("gazebo", False), ("gazebo(world)", True), ("gazebo(**locals())", True), ("gazebo(", True)],
)
def test_a_path_that_nothing_reads(used: str, stays: bool) -> None:
    text = _LAUNCH.replace("@", used)
    kept = without_unused_values(text)
    assert ("hall.sdf" in kept) is stays
    assert kept.count("\n") == text.count("\n")


def test_other_texts_stay() -> None:
    page = "# Hall\n\nThe def is in `hall.sdf`: start it.\n"
    assert without_unused_values(page) == page
