"""A joint that needs more torque than its effort limit allows.

The simulated motor stops at its limit: the robot starts slower, does not reach its speed, or drops
its load. The torque is that of servos without limits. A joint whose effort limit specifications.md
explains is not checked.

Fix: give the joint the effort (N·m, or N) of the real motor with its gear, or correct the masses.
Source: the largest torque in the trial after the robot has settled, averaged over 0.1 s and without
the drive at full speed, compared with `<effort>`.
"""

import re

from checker.model.components import Joint
from checker.model.specification.sheet import Specification
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import rover


@rule("TRI009", "effort-limit-exceeded", Severity.WARNING, Concern.ROBOT, judges=("torque",))
def check(
    driven: SettledTrial, specification: Specification | None, *, warning_above: float = 1.0
) -> Findings:
    """Report joints that need more torque or force than their effort limit.

    Options:
        warning_above: Multiple of a joint's effort limit; a joint that needs more torque or force
            is reported.
    """
    limits = {limit.part: limit.value for limit in driven.trial.all("torque_limit")}
    for torque in driven.trial.all("torque"):
        limit = limits.get(torque.part)
        if limit is None or abs(torque.value) <= warning_above * limit:
            continue
        joint = driven.robot.joints_by_name.get(torque.part)
        if joint is None or not _is_explained(joint, specification):
            unit = _unit(driven, torque.part)
            yield finding(
                driven.part(torque.part),
                f"joint {torque.part!r} needs {abs(torque.value):.3g} {unit}, but its effort "
                f"limit is {limit:.3g} {unit}",
                key="torque",
            )


_EFFORT = re.compile(
    r"\b(?:effort|torque)s?\W{1,3}limit|\blimit\w*\b[^.]{0,60}\b(?:effort|torque)", re.I
)
_PLACE_OF_IT = re.compile(r"\blines?\s+\d|\w\.(?:sdf|rb|xacro|urdf)\b", re.I)
_SHORTEST_WORD = 4


def _is_explained(joint: Joint, sheet: Specification | None) -> bool:
    """Return whether the sheet names the effort limit of such joints: then it is meant.

    A passage that only gives the place of the limit explains nothing.
    """
    if sheet is None:
        return False
    words = re.split(r"[\W_\d]+", f"{joint.name.value} {joint.child.value}".casefold())
    parts = {word for word in words if len(word) >= _SHORTEST_WORD} - _ANY_JOINT
    return any(
        _EFFORT.search(passage.text)
        and not _PLACE_OF_IT.search(passage.text)
        and any(part in passage.text.casefold() for part in parts)
        for passage in sheet.markdown.passages
    )


_ANY_JOINT = frozenset({"joint", "link", "front", "rear", "left", "right", "back", "base"})


def _unit(driven: SettledTrial, name: str) -> str:
    joint = driven.robot.joints_by_name.get(name)
    return "N" if joint is not None and joint.type.value == "prismatic" else "N·m"


def _rover(effort: float, mark: str = "") -> str:
    return rover(limit=f"<limit><effort>{effort}</effort></limit>", wheel_mark=mark)


_REFERENCE = "# Acme Rover\n* Torque limit of each wheel: model.sdf, lines 20 and 30\n"
_MARK = "  <!-- ^ TRI009 -->"
_SHEET = """# Acme Rover
The effort limit of the wheels is low, so that they do not slip.
"""

GOOD = [
    _rover(50.0),
    _rover(-1.0),
    {"model.sdf": _rover(0.1), "specifications.md": _SHEET},
]
BAD = [
    _rover(0.1, _MARK),
    {"model.sdf": _rover(0.1, _MARK), "specifications.md": _REFERENCE},
]
