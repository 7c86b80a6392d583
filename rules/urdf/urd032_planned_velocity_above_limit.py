"""MoveIt may plan a joint faster than its URDF allows.

The `max_velocity` of joint_limits.yaml replaces the velocity limit of the URDF: at full speed
(scaling factor 1) MoveIt plans with it. A controller or the simulation then lags behind the plan,
or stops with a path tolerance error; a real drive may refuse the trajectory. With
`has_velocity_limits: false` the value is not read; that is an info.

The file beside an SRDF is judged, with the robots of this SRDF (see URD031).

Fix: write the limit of the URDF, or a smaller one. If the drive is faster, correct the URDF.
Source: MoveIt 2, RobotModelLoader (`has_velocity_limits`, `max_velocity`).
"""

import posixpath

from checker.model.components import Joint
from checker.package.package import Package
from checker.robots.semantic import SemanticDescription
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.yaml import YamlNode, read_root

_FILE = "joint_limits.yaml"


@rule("URD032", "planned-velocity-above-limit", Severity.WARNING, Concern.INTERFACE)
def check(semantic: SemanticDescription, package: Package, *, tolerance: float = 0.01) -> Findings:
    """Report velocities above the URDF's.

    Options:
        tolerance: Share of the URDF's limit by which the value may be above it.
    """
    root = read_root(package.read(posixpath.join(posixpath.dirname(semantic.file), _FILE)))
    limits = root.get("joint_limits") if root is not None else None
    for name, limit in limits.entries if limits is not None else ():
        joint = _fastest(semantic, name)
        planned = limit.get("max_velocity")
        if joint is None or planned is None or not isinstance(planned.scalar, int | float):
            continue
        highest = joint.axes[0].velocity.value
        if not 0 < highest < planned.scalar / (1 + tolerance):
            continue
        used, stated = limit.get("has_velocity_limits"), f"{highest:g} {_unit(joint)}"
        is_read = used is not None and used.scalar is True
        effect = (
            f"MoveIt plans faster than the {stated} of the URDF"
            if is_read
            else f"above the {stated} of the URDF; not read, as has_velocity_limits is not true"
        )
        yield finding(
            planned,
            f"max_velocity {planned.scalar:g} of joint {name.scalar!r}: {effect}; "
            f"write {float(highest)}",
            severity=None if is_read else Severity.INFO,
            related=[(joint.axes[0].velocity, "the limit of the URDF")],
            fix=replace_text(planned, str(float(highest)), Safety.UNSAFE),
        )


def _fastest(semantic: SemanticDescription, name: YamlNode) -> Joint | None:
    """Return the joint of a name that has the highest limit, of all robots that it may be."""
    found = (robot.joints_by_name.get(str(name.scalar)) for robot in semantic.robots)
    joints = [joint for joint in found if joint is not None and len(joint.axes) == 1]
    return max(joints, key=lambda joint: joint.axes[0].velocity.value, default=None)


def _unit(joint: Joint) -> str:
    return "m/s" if joint.type.value == "prismatic" else "rad/s"


_URDF = """<robot name="arm">
  <link name="base_link"/>
  <link name="upper_arm"/>
  <joint name="shoulder" type="revolute">
    <parent link="base_link"/>
    <child link="upper_arm"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="@"/>
  </joint>
</robot>
"""


def _limits(planned: str, used: str = "true", urdf: str = "1.57") -> dict[str, object]:
    return {
        "@urdf": True,
        "urdf/arm.urdf": _URDF.replace("@", urdf),
        "config/arm.srdf": '<robot name="arm"><group name="arm"/></robot>\n',
        "config/joint_limits.yaml": (
            "joint_limits:\n  shoulder:\n"
            f"    has_velocity_limits: {used}\n    max_velocity: {planned}\n"
        ),
    }


_MARK = "  # ^ URD032"
GOOD = [
    _limits("1.571"),
    _limits("0.5"),
    _limits("2.0", urdf="0"),
    _limits("fast"),
    {**_limits("2.0"), "config/arm.srdf": '<robot name="hand"><group name="arm"/></robot>\n'},
]
BAD = [
    _limits(f"2.0{_MARK}"),
    _limits(f"3{_MARK}"),
    _limits(f"2.0{_MARK}", used="false"),
]
