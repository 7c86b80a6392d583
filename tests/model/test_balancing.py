"""A robot on two wheels of one axle balances, unless something else of it is near the ground."""

from __future__ import annotations

import pytest

from tests.model.robots import urdf

_TYRE = '<geometry><cylinder radius="0.1" length="0.04"/></geometry>'


_DRIVE = """<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">
<left_joint>left_axle</left_joint><right_joint>right_axle</right_joint></plugin></gazebo>"""


def _on_wheels(low: str, *, behind: float = 0.0, high: float = 0.2, drive: str = _DRIVE) -> bool:
    """Return whether a body on two wheels balances.

    Args:
        low: What else is at its lower end, in a link of its own.
        behind: Metres from the left wheel's axle to the right one's.
        high: Height of the body's middle above the axles, metres.
        drive: What turns the wheels.
    """
    wheels = "".join(
        f"""<link name="{side}_wheel">
<collision><origin rpy="1.5708 0 0"/>{_TYRE}</collision></link>
<joint name="{side}_axle" type="continuous"><parent link="base_link"/><child link="{side}_wheel"/>
<origin xyz="{x} {y} 0"/><axis xyz="0 1 0"/></joint>"""
        for side, x, y in (("left", 0.0, 0.15), ("right", -behind, -0.15))
    )
    return urdf(f"""<link name="base_link">
<collision><origin xyz="0 0 {high}"/><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
</link>{wheels}<link name="low">{low}</link>
<joint name="low_joint" type="fixed"><parent link="base_link"/><child link="low"/>
<origin xyz="0.2 0 -0.08"/></joint>
{drive}""").balances


_BALL = '<geometry><sphere radius="{}"/></geometry>'


@pytest.mark.parametrize(
    ("low", "balances"),
    [
        pytest.param("", True, id="nothing"),
        pytest.param(f"<collision>{_BALL.format(0.02)}</collision>", False, id="a caster"),
        pytest.param(f"<visual>{_BALL.format(0.02)}</visual>", False, id="a drawn caster"),
        pytest.param(
            f'<collision><origin xyz="0 0 0.025"/>{_BALL.format(0.02)}</collision>',
            False,
            id="a caster that is too high",
        ),
        pytest.param(
            f'<collision><origin xyz="0 0 0.3"/>{_BALL.format(0.02)}</collision>',
            True,
            id="a part far above the ground",
        ),
        pytest.param(
            '<collision><geometry><mesh filename="gone.stl"/></geometry></collision>',
            False,
            id="a part of unknown size",
        ),
    ],
)
def test_a_robot_balances_on_one_axle_alone(low: str, balances: bool) -> None:
    assert _on_wheels(low) is balances


def test_a_robot_balances_on_wheels_that_no_plugin_of_a_drive_turns() -> None:
    """A controller may set the torque of each wheel by itself."""
    assert _on_wheels("", drive="")


def test_wheels_behind_one_another_do_not_make_an_axle() -> None:
    assert not _on_wheels("", behind=0.1)


def test_a_body_that_hangs_to_the_ground_rests_on_it() -> None:
    assert not _on_wheels("", high=0.055)
