"""An actuator that moves no joint.

A muscle or a tendon turns the joints between the bodies that its sites are in. If all sites are in
one body, for example after a bone was renamed, its length never changes: it costs nothing and does
nothing. The moment arms are computed at the start and after each joint was moved.

Fix: put one of the sites into the body that it is to move.
Source: MuJoCo 4.0.0, mjData.actuator_moment.
"""

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("MJC020", "actuator-moves-nothing", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report actuators without a moment about any joint."""
    for number in model.compiled.idle:
        actuator = model.compiled.actuators[number]
        yield finding(
            model.span(actuator.line),
            f"actuator {actuator.name!r} moves no joint: its force has no moment about any of them",
        )


def _leg(body: str, mark: str = "") -> dict[str, str]:
    sites = {"thigh": "", "shank": ""}
    sites[body] = '<site name="end" pos="0 0.1 -0.1"/>'
    return {
        "@mjcf": f"""<worldbody><body name="thigh"><joint/>
<site name="start" pos="0 0.1 0"/>{sites["thigh"]}<geom size="0.1"/>
<body name="shank" pos="0 0 -0.4"><joint axis="1 0 0"/>{sites["shank"]}<geom size="0.1"/></body>
</body></worldbody>
<tendon><spatial name="cord"><site site="start"/><site site="end"/></spatial></tendon>
<actuator>
<motor name="extensor" tendon="cord"/>{mark}
</actuator>"""
    }


GOOD = [_leg("shank")]
BAD = [_leg("thigh", "<!-- ^ MJC020 -->")]
