"""A base_footprint that is not at the height of the ground on which the wheels stand.

base_footprint is the place of the robot on the ground. Odometry and localisation give it the height
0: if the wheels reach below it, the robot is drawn in the ground, all that its sensors see is too
low, and a costmap with `min_obstacle_height: 0.0` drops what is near the ground. If it is below the
wheels, all is too high. Spawned at a height of 0, the wheels start in the ground or fall.

Fix: put the joint between base_footprint and the next link at the height that the message names.
Source: REP 120, base_footprint: the projection of the robot on the ground.
"""

from checker.model.components import Joint
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule

_NAME = "base_footprint"
_LEAST_WHEELS = 2


@rule("GEO019", "footprint-off-the-ground", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, metres: float = 0.02) -> Findings:
    """Report a base_footprint above or below the lowest point of the wheels.

    Options:
        metres: Greatest distance; more is reported.
    """
    link, pose = robot.links_by_name.get(_NAME), robot.pose_of(_NAME)
    if link is None or pose is None or _NAME not in robot.tree.base or robot.locomotion.tracks:
        return
    joints = {joint.child.value: joint for joint in robot.joints}
    wheels = [it for it in robot.wheels if not _is_fixed(joints.get(it.name.value))]
    boxes = [robot.box_of(it, visuals_too=not it.collisions) for it in wheels]
    known = [box for box in boxes if box is not None]
    if len(known) < max(_LEAST_WHEELS, len(boxes)):
        return
    heights = [box.low[2] - pose.translation[2] for box in known]
    height = min(heights)
    off = [it for it in heights if abs(it) > metres]
    if len(off) > len(heights) / 2:  # a single wheel at another height: GEO006 reports it
        # A footprint below another link is moved itself; else all that is on it.
        moved, up = (_NAME, height > 0) if _NAME in joints else ("the links on it", height < 0)
        yield finding(
            link,
            f"the wheels reach {abs(height):.3g} m {'below' if height < 0 else 'above'} "
            f"base_footprint, which is on the ground: move {moved} {'up' if up else 'down'} by "
            f"{abs(height):.3g} m",
        )


def _is_fixed(joint: Joint | None) -> bool:
    """Return whether a joint holds a caster that only slides."""
    return joint is not None and joint.type.value == "fixed"


_CASTER = """<link name="caster_wheel"><collision><geometry><sphere radius="0.02"/></geometry>
</collision></link>
<joint name="caster" type="fixed"><parent link="base_link"/><child link="caster_wheel"/>
<origin xyz="-0.3 0 -0.2"/></joint>"""


def _rover(
    height: float, mark: str = "", caster: str = "", right: float = 0.0
) -> dict[str, object]:
    wheels = "".join(
        f"""<link name="{side}_wheel"><collision>
  <origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry>
</collision></link>
<joint name="{side}_axle" type="continuous">
  <parent link="base_link"/><child link="{side}_wheel"/>
  <origin xyz="0 {y} {z}"/><axis xyz="0 1 0"/>
</joint>"""
        for side, y, z in (("left", 0.2, 0), ("right", -0.2, right))
    )
    return {
        "@urdf": True,
        "urdf/acme_arm.urdf": f"""<robot name="rover">
<link name="base_footprint"/>{mark}
<link name="base_link"/>
<joint name="base_joint" type="fixed">
  <parent link="base_footprint"/><child link="base_link"/><origin xyz="0 0 {height}"/>
</joint>
{wheels}{caster}</robot>
""",
    }


GOOD = [_rover(0.1), _rover(0.11), _rover(0.1, right=-0.05), _rover(0.1, caster=_CASTER)]
BAD = [_rover(0.0, "  <!-- ^ GEO019 -->"), _rover(0.2, "  <!-- ^ GEO019 -->")]
