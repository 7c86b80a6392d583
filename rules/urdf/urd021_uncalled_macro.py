"""A macro with links that no file calls.

A package may contain a part for other robots to include: an arm, a gripper, a sensor. No available
file includes it, so it is checked as expanded by the shortest call: parameters keep their defaults,
a prefix is empty, and the parent is the link `world`. The values on a real robot are not known.

Fix: no correction is needed. To choose what is checked, add a small xacro file that calls the macro
and that no other file includes.
Source: xacro, macros and their default values.
"""

from checker.formats.urdf.description import UrdfDescription
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD021", "uncalled-macro", Severity.INFO, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report a macro that no file calls, with the call that was checked."""
    call = description.call
    if call is not None:
        yield finding(
            call,
            f"macro {call.name!r} is not called by any file; checked with {call.start_tag}",
        )


_XMLNS = 'xmlns:xacro="http://ros.org/wiki/xacro"'


def _arm(params: str, more: str = "") -> str:
    return f"""<robot {_XMLNS}>
  <xacro:macro name="arm" params="{params}">  <!-- ^ URD021 -->
    <link name="${{prefix}}base"/>
    <joint name="${{prefix}}mount" type="fixed">
      <xacro:insert_block name="origin"/>
      <parent link="${{parent}}"/><child link="${{prefix}}base"/>
    </joint>
  </xacro:macro>{more}
</robot>
"""


def _unmarked(text: str) -> str:
    return text.replace("  <!-- ^ URD021 -->", "")


_PARAMS = "parent prefix *origin"
_CALL = '<xacro:arm parent="a" prefix=""><origin/></xacro:arm>'
GOOD = [
    {"@urdf": True},
    {"@urdf": True, "urdf/grip.xacro": _unmarked(_arm(f"serial_number {_PARAMS}"))},
    {"@urdf": True, "urdf/grip.xacro": _unmarked(_arm("parent prefix **limits *origin"))},
    {
        "@urdf": True,
        "urdf/grip.xacro": _unmarked(_arm(_PARAMS)),
        "urdf/cell.xacro": f'<robot name="cell" {_XMLNS}><xacro:include filename="grip.xacro"/>'
        f'<link name="a"/>{_CALL}</robot>',
    },
]
BAD = [
    {"@urdf": True, "urdf/grip.xacro": _arm(_PARAMS)},
    {
        "@urdf": True,
        "urdf/grip.xacro": _arm("parent prefix:='' color:='0 1 0' side:=^|left *origin"),
    },
]
