"""An included model that cannot become a part of this one.

libsdformat refuses the whole file: the included file contains no model, includes itself, or is
nested too deep. The links, joints and frames of a merged model become those of the model around it,
so none of them may have a name that this model, or another merged model, has already.

Fix: name a file that contains a model, end the circle, or rename the part.
Source: SDFormat specification, include, and 1.9, include/@merge; what libsdformat 12 refuses.
"""

from checker.model.faults import FaultKind
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("SDF018", "include-not-read", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report includes that are refused."""
    for fault in robot.faults_of(FaultKind.INCLUDE):
        yield finding(fault.span, fault.message)


_ARM = """<sdf version="1.9">
  <model name="arm">
    <link name="upper"/>
  </model>
</sdf>
"""
_EMPTY = """<sdf version="1.9">
  <world name="hall"/>
</sdf>
"""


def _example(file: str, merge: str = "", mark: str = "") -> dict[str, str]:
    fragment = f"""
<include{merge}>{mark if merge else ""}
  <uri>models/arm</uri>{mark if not merge else ""}
</include>
<link name="upper"/>
"""
    return {"@fragment": fragment, "models/arm/model.sdf": file}


_MARK = "  <!-- ^ SDF018 -->"
GOOD = [
    _example(_ARM),
    _example(_ARM.replace("upper", "lower"), ' merge="true"'),
]
BAD = [
    _example(_EMPTY, mark=_MARK),
    _example(_ARM, ' merge="true"', _MARK),
]
