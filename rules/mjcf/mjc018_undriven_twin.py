"""A joint without actuator whose twin on the other side has one.

A line was left out, or its joint is another one: one side of the robot hangs.

Fix: add the actuator.
Source: faults that authors of public models mended.
"""

from checker.physics.compiled.model import CompiledModel
from checker.physics.compiled.twins import joint_pairs, twins_of
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("MJC018", "undriven-twin", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report joints that nothing drives while their twins are driven."""
    compiled = model.compiled
    twins = twins_of(compiled)
    if twins is None or compiled.refusals:
        return
    driven = {actuator.joint for actuator in compiled.actuators}
    coupled = {*compiled.held, *compiled.in_tendons}
    pairs = list(joint_pairs(compiled, twins))
    for one, other in (*pairs, *((right, left) for left, right in pairs)):
        if one in driven and other not in driven | coupled:
            left, right = compiled.joints[one], compiled.joints[other]
            yield finding(
                model.span(right.line),
                f"joint {right.name!r} has no actuator, but its twin {left.name!r} has",
                related=[(model.span(left.line), "its twin")],
            )


def _walker(right: str, mark: str = "") -> dict[str, str]:
    def leg(side: str, y: float, mark: str) -> str:
        return (
            f'<body name="{side}_leg" pos="0 {y} 0">\n<joint name="{side}_hip" axis="1 0 0"/>{mark}'
            f'\n<geom size="0.1"/><body name="{side}_foot" pos="0 0 -1">'
            f'<joint name="{side}_ankle" axis="0 1 0"/><geom size="0.1"/></body></body>\n'
        )

    legs = leg("left", 0.2, "") + leg("right", -0.2, mark)
    torso = f'<body name="torso"><freejoint/><geom size="0.2"/>{legs}</body>'
    motors = (
        f'<motor joint="left_hip"/>{right}<motor joint="left_ankle"/><motor joint="right_ankle"/>'
    )
    return {"@mjcf": f"<worldbody>{torso}</worldbody>\n<actuator>{motors}</actuator>"}


GOOD = [_walker('<motor joint="right_hip"/>')]
BAD = [_walker("", "<!-- ^ MJC018 -->")]
