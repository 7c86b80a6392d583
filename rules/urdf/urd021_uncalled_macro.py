"""A macro that makes links, and that no file calls.

A package may hold a part for other robots to include: an arm, a gripper, a sensor. Nothing
available includes it, so it is judged as the smallest call makes it: what has a default keeps it, a
prefix is empty, and the parent is the link `world`. What its values would be on a real robot is not
known.

Fix: nothing needs correction. A small xacro file that calls the macro, and is not included
elsewhere, lets the author choose what is judged.
Source: xacro, macros and their default values.
"""

from checker.model.urdf.description import UrdfDescription
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD021", "uncalled-macro", Severity.INFO, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Say by which call a robot came about."""
    call = description.call
    if call is not None:
        yield finding(
            call,
            f"no file calls the macro {call.name!r}: it is judged as {call.shown} makes it",
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
