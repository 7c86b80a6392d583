"""Two sensors of a URDF that Gazebo puts into one link under one name.

Gazebo merges links that fixed joints connect, with all their sensors. A link cannot have two
sensors of one name: Gazebo Sim prints "sensor with name[…] already exists" and does not spawn the
robot. It happens where a macro is called twice and does not put its prefix into the name of the
sensor. Gazebo Classic loads both, with topics of one name: a warning.

Fix: give each sensor its own name, such as `${prefix}_range`; or keep the links apart with
`<preserveFixedJoint>true</preserveFixedJoint>` below `<gazebo reference="joint">`.
Source: sdformat, parser_urdf.cc, ReduceFixedJoints; libsdformat 12: what it loads and refuses.
"""

from collections.abc import Mapping

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.fixed_joints import Lumping
from checker.model.components import Sensor
from checker.rule import Concern, Context, Findings, Severity, finding, rule


@rule("SEN034", "sensor-name-twice", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription, context: Context) -> Findings:
    """Report each sensor whose name another one has before it in the merged link."""
    if description.for_rviz:
        return
    severity = None if context.is_gazebo_sim else Severity.WARNING
    for (link, name), (first, *others) in _by_place(description).items():
        for sensor in others:
            refused = "" if severity else ": Gazebo does not spawn the robot"
            yield finding(
                sensor.name,
                f"link {link!r} has two sensors {name!r}, as Gazebo merges links with fixed "
                f"joints{refused}; give each its own name",
                severity=severity,
                key=name,
                related=[(first.name, "the other one")],
            )


def _by_place(description: UrdfDescription) -> Mapping[tuple[str, str], list[Sensor]]:
    """Return the sensors by the link that holds them in Gazebo, and by their names."""
    lumping = Lumping(description)
    found: dict[tuple[str, str], list[Sensor]] = {}
    for sensor in description.robot.sensors:
        if sensor.name.value:
            found.setdefault((lumping.holder(sensor.link), sensor.name.value), []).append(sensor)
    return found


def _robot(name: str, joint: str = "fixed", more: str = "", mark: str = "") -> dict[str, object]:
    """Return an arm with two range finders, on links of their own."""
    links = "".join(
        f"""<link name="{side}"/>
<joint name="{side}_mount" type="{joint}">
  <parent link="upper_arm"/><child link="{side}"/>
</joint>
<gazebo reference="{side}">
  <sensor name="{title}" type="gpu_lidar"/>{own}
</gazebo>
"""
        for side, title, own in (("left", "range", ""), ("right", name, mark))
    )
    return {"@urdf": f"{links}{more}", "@profile": "gazebo-harmonic"}


_KEPT = """<gazebo reference="left_mount">
  <preserveFixedJoint>true</preserveFixedJoint>
</gazebo>
"""
_MARK = "  <!-- ^ SEN034 -->"
GOOD = [
    _robot("right_range"),
    _robot("range", joint="continuous"),
    _robot("range", more=_KEPT),
]
BAD = [
    _robot("range", mark=_MARK),
    {**_robot("range", mark=_MARK), "@profile": "urdf"},
]
