"""An actuator that has the name of one joint and moves another one.

It is what copying a line leaves behind: the joint of its name has no actuator, and the other one
has two, or one of the wrong side.

Fix: state the joint of that name.
Source: faults that authors of public models mended.
"""

import re
from collections import Counter

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rename, rule

_AFFIX = re.compile(
    r"^(?:motor|act(?:uator)?|servo|m)_|_(?:motor|act(?:uator)?|servo|joint|ctrl|m)$"
)

_COPIES = 2
"""Actuators of the joint; with one, its name may be that of what it drives over a gear."""


@rule("MJC010", "actuator-on-other-joint", Severity.ERROR, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report actuators named after a joint that has none."""
    compiled = model.compiled
    joints = {_bare(it.name): number for number, it in enumerate(compiled.joints) if it.name}
    driven = Counter(actuator.joint for actuator in compiled.actuators)
    for actuator in compiled.actuators:
        meant = joints.get(_bare(actuator.name), -1)
        if actuator.joint < 0 or meant < 0 or driven[meant] or driven[actuator.joint] < _COPIES:
            continue
        moved, named = compiled.joints[actuator.joint], compiled.joints[meant]
        element = model.element(actuator.line)
        where = element.attribute("joint") if element is not None else None
        yield finding(
            where or model.span(actuator.line),
            f"actuator {actuator.name!r} moves joint {moved.name!r}, but joint {named.name!r} has "
            f'no actuator: write joint="{named.name}"',
            fix=rename(where, named.name) if where is not None else None,
        )


def _bare(name: str) -> str:
    return _AFFIX.sub("", name.lower())


def _arm(joint: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<worldbody><body><joint name="pan"/><geom size="0.1"/>
<body><joint name="tilt"/><geom size="0.1"/></body></body></worldbody>
<actuator>
<motor name="pan_motor" joint="pan"/>
<motor name="tilt_motor" joint="{joint}"/>{mark}
</actuator>"""
    }


GOOD = [_arm("tilt")]
BAD = [_arm("pan", "<!-- ^ MJC010 -->")]
