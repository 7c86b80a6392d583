"""A xacro file that only xacro of ROS Melodic can process.

The robot loads on Melodic, which the challenge uses. xacro of ROS Noetic and later, and of ROS 2,
runs on Python 3, and ends with an error or leaves tags as they are: `map`, `filter` and `range` do
not return lists, fewer Python functions are available, a macro defined inside a macro exists only
there, and tags need the prefix `xacro:`. Where the package is made for an older release of ROS 1,
as its README, its CI or `xacro --inorder` in a launch file shows, this is a warning.

Fix: use what both versions accept: `list(map(…))`, a comprehension instead of `filter`, macro files
included outside of macros, and `xacro:` before each tag.
Source: xacro 1.13 and 1.14 and later; "unknown macro name".
"""

from checker.formats.xacro.fault import XacroFaultKind
from checker.package.distribution_sign import before_noetic
from checker.package.package import Package
from checker.robots.urdf_files import UrdfFiles
from checker.rule import Concern, Context, Findings, Severity, finding, rule


@rule("URD014", "only-old-xacro", Severity.ERROR, Concern.PORTABILITY)
def check(files: UrdfFiles, package: Package, context: Context) -> Findings:
    """Report what newer releases of xacro refuse in files that Melodic's expands."""
    sign = before_noetic(package) if files.old and not context.distro else ""
    made_for = f" (made for an older one: {sign})" if sign else ""
    for refused in files.old:
        hint = f": {refused.hint}" if refused.hint else ""
        if refused.kind is XacroFaultKind.PREFIX:
            message = f"xacro of ROS Noetic and later ignores {refused.message}{hint}{made_for}"
        else:
            message = (
                f"{refused.file} expands with xacro of ROS Melodic only; later versions fail with: "
                f"{refused.message}{hint}{made_for}"
            )
        yield finding(refused, message, severity=Severity.WARNING if sign else None)


_LAUNCH = "launch/description.launch"
_DESCRIPTION = "urdf/robot.xacro"
_LOADING = """<launch>
  <arg name="name"/>
  <arg name="world_name"/>
  <param name="$(arg name)/robot_description"
         command="$(find xacro)/xacro $(find acme_rover_sensor_config_1)/urdf/robot.xacro"/>
</launch>
"""
_HEAD = '<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">\n'


def _loaded(body: str) -> dict[str, str]:
    return {_LAUNCH: _LOADING, _DESCRIPTION: f"{_HEAD}{body}\n</robot>\n"}


_MARK = "  <!-- ^ URD014 -->"
_PARTS = (
    f'{_HEAD}<xacro:macro name="wheel" params="side"><link name="${{side}}"/></xacro:macro></robot>'
)
_INCLUDED = """<xacro:macro name="body" params="">
<xacro:include filename="parts.xacro"/><link name="b"/>
</xacro:macro>
<xacro:body/>
"""
GOOD = [
    _loaded('<link name="${list(map(str, [1]))[0]}"/>'),
    _loaded('<xacro:wheel side="left"/>'),
]
BAD = [
    _loaded(f'<link name="l${{map(str, [1])[0]}}"/>{_MARK}'),
    _loaded(f'<link name="l${{filter(lambda n: n > 1, [1, 2])[0]}}"/>{_MARK}'),
    _loaded(f'<link name="l${{(range(2) + [5])[2]}}"/>{_MARK}'),
    {**_loaded(f'{_INCLUDED}<xacro:wheel side="left"/>{_MARK}'), "urdf/parts.xacro": _PARTS},
    _loaded(f'<property name="radius" value="1"/>{_MARK}\n<link name="l"/>'),
    _loaded(
        '<xacro:macro name="eye" params="side"><link name="${side}"/></xacro:macro>\n'
        f'<eye side="left"/>{_MARK}'
    ),
    {
        **_loaded('<xacro:include filename="parts.xacro"/><xacro:wheel side="left"/>'),
        "urdf/parts.xacro": f"""{_HEAD}<property name="track" value="1"/>{_MARK}
<property name="half" value="${{track / 2}}"/>{_PARTS.removeprefix(_HEAD)}""",
    },
    {
        **_loaded(f'<property name="radius" value="1"/>{_MARK}\n<link name="l"/>'),
        "README.md": "For ROS Kinetic.",
    },
]
