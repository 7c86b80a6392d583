"""Two included xacro files set one property to different values.

Properties at the top of xacro files are shared by all files of a robot, and a macro reads them when
it is called: the value of the file that was included last then counts for both. A wheel gets the
radius of another wheel, without a message. A property that the including file sets itself is
intended, and is not reported.

Fix: give the properties different names, such as `caster_radius`; or pass the value to the macro
as a parameter; or include the file with `ns="…"`.
Source: xacro documentation, properties and `ns` of `<xacro:include>`; tried with xacro 2.
"""

from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.shared_properties import shared_properties
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD025", "shared-property", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription, package: Package) -> Findings:
    """Report properties that a macro reads with the value of a file that was included later."""
    if not description.file.endswith(".xacro"):
        return
    for shared in shared_properties(package, description.file):
        own, other = shared.own.value, shared.other.value
        yield finding(
            other,
            f"property {shared.name!r} is {other.value[:80]} here and {own.value[:80]} in "
            f"{own.span.source.file}: its macro {shared.macro!r}, which is called later, gets "
            f"{other.value[:80]}",
            related=[(own, "the value for this macro")],
            key=f"property {shared.name}",
        )


_XMLNS = 'xmlns:xacro="http://ros.org/wiki/xacro"'


def _part(name: str, length: str, prop: str = "size", mark: str = "") -> str:
    return f"""<robot {_XMLNS}>
<xacro:property name="{prop}" value="{length}"/>{mark}
<xacro:macro name="{name}" params="side">
  <link name="${{side}}_{name}">
    <visual><geometry><sphere radius="${{{prop}}}"/></geometry></visual>
  </link>
</xacro:macro>
</robot>
"""


def _robot(first: str, second: str, between: str = "") -> dict[str, object]:
    return {
        "@urdf": True,
        "urdf/wheel.xacro": first,
        "urdf/caster.xacro": second,
        "urdf/cart.urdf.xacro": f"""<robot name="cart" {_XMLNS}>
<xacro:include filename="wheel.xacro"/>
{between}
<xacro:include filename="$(find acme_arm_description)/urdf/caster.xacro"/>
<link name="base_link"/>
<xacro:wheel side="left"/>
<xacro:caster side="rear"/>
</robot>
""",
    }


_WHEEL = _part("wheel", "0.1")
GOOD = [
    _robot(_WHEEL, _part("caster", "0.1")),
    _robot(_WHEEL, _part("caster", "0.03", "caster_size")),
    # The caster file only sets a value: it is there to choose it.
    _robot(_WHEEL, _part("caster", "0.03").replace("${size}", "0.03")),
    _robot(_WHEEL.replace('params="side"', 'params="side size:=1"'), _part("caster", "0.03")),
    # The including file chooses.
    _robot(
        _WHEEL,
        _part("caster", "0.03", "caster_size"),
        '<xacro:property name="size" value="0.2"/>',
    ),
]
BAD = [_robot(_WHEEL, _part("caster", "0.03", mark="  <!-- ^ URD025 -->"))]
