"""A link that Gazebo drops, or a link with mass but without collision or visual.

Gazebo drops a link without `<inertial>`, or with a mass of zero, with its sensors and all links
below it, unless a fixed joint merges it into a link that has a mass. Frames of sensors are merged,
so they need no inertial. URD012 reports an `<inertial>` without `<mass>`. In a URDF without a
`<gazebo>` element this is a warning: other tools keep such links. It is an info if no launch file
of the workspace gives the URDF to a simulator, and an error if a launch file spawns a robot whose
first link is dropped: nothing of it remains.

Fix: give each link that moves an `<inertial>`, a `<collision>` and a `<visual>`.
Source: sdformat 6, parser_urdf.cc: "urdf2sdf: link has no inertia, … children links ignored".
"""

from collections.abc import Iterator

from msgspec.structs import replace

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.fixed_joints import Lumping
from checker.model.components import Link
from checker.model.robot import Robot
from checker.model.values import parse_number
from checker.package.package import Package
from checker.physics.mass.even_inertia import inertial_fix
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_NO_LINK = "world"


@rule("URD007", "link-dropped-by-gazebo", Severity.ERROR, Concern.ROBOT)
def check(
    description: UrdfDescription,
    package: Package,
    context: Context,
    spawned: SpawnedFiles,
    *,
    share: float = 0.01,
) -> Findings:
    """Report links without inertia, and links with mass that lack shapes.

    Options:
        share: Share of the robot's mass from which a link, with the links merged into it, must have
            collisions and visuals.
    """
    if description.for_rviz:
        return
    robot = description.robot
    in_gazebo = package.workspace.may_start_gazebo and not robot.shown_only
    in_gazebo = context.is_gazebo_alone or in_gazebo
    severity = Severity.WARNING if in_gazebo else Severity.INFO
    grave = None if context.is_gazebo_alone or not robot.shown_only else severity
    for name, links in Lumping(description).groups.items():
        if name == _NO_LINK or name not in robot.links_by_name:
            continue
        if any(map(_has_unread_mass, links)) or _has_second_parents(robot, links):
            continue  # URD012 or KIN002 says what is wrong with it.
        if not any(link.mass for link in links):
            found = _left_out(description, robot.links_by_name[name], links, severity, grave)
            is_lost = not robot.shown_only and _is_first(robot, name)
            is_lost = is_lost and spawned.is_certainly_spawned(robot)
            yield _with_nothing_left(found) if is_lost else found
        elif robot.mass > 0 and sum(link.mass for link in links) >= share * robot.mass:
            yield from _without_shapes(robot.links_by_name[name], links)


def _is_first(robot: Robot, link: str) -> bool:
    """Return whether no joint is above a link, and all other links are below it."""
    below = {joint.child.value for joint in robot.joints}
    return [it for it in robot.links_by_name if it not in below] == [link]


def _with_nothing_left(found: Finding) -> Finding:
    message = f"{found.message}: nothing remains of the robot that a launch file spawns"
    return replace(found, message=message, severity=Severity.ERROR)


def _has_unread_mass(link: Link) -> bool:
    masses = [mass.get("value") for mass in link.element.descendants("mass")]
    is_left_out = link.element.child("inertial") is not None and not masses
    return is_left_out or any(text is None or parse_number(text) is None for text in masses)


def _has_second_parents(robot: Robot, links: list[Link]) -> bool:
    """Return whether a link below has two joints above it, so that it may be merged elsewhere."""
    names = {link.name.value for link in links}
    above = robot.tree.ties_above.values()
    return any(len(ties) > 1 and any(tie.parent in names for tie in ties) for ties in above)


def _left_out(
    description: UrdfDescription,
    link: Link,
    links: list[Link],
    severity: Severity,
    grave: Severity | None,
) -> Finding:
    sensors = [sensor.name.value for link in links for sensor in link.sensors]
    merged = {link.name.value for link in links}
    below = [
        joint.child.value
        for joint in description.robot.joints
        if joint.parent.value in merged and joint.child.value not in merged
    ]
    lost = [f"sensor {sensors[0]!r}"] if sensors else []
    lost += [f"link {below[0]!r} below it"] if below else []
    with_it = f", with {' and '.join(lost)}" if lost else ""
    missed = lost or any(link.collisions or link.visuals for link in links)
    is_grave = missed and description.robot.is_for_gazebo
    bare = link.inertial is None
    return finding(
        link,
        f"link {link.name.value!r} has no {'<inertial>' if bare else 'mass'}, so Gazebo drops "
        f"it{with_it}",
        severity=grave if is_grave else severity,
        fix=inertial_fix(description.robot, link) if bare else None,
    )


def _without_shapes(link: Link, links: list[Link]) -> Iterator[Finding]:
    mass = sum(link.mass for link in links)
    collides = any(link.collisions for link in links)
    is_seen = any(link.visuals for link in links)
    missing = [*(() if collides else ("collision",)), *(() if is_seen else ("visual",))]
    if missing:
        yield finding(
            link,
            f"link {link.name.value!r} of {mass:g} kg has no <{'> and no <'.join(missing)}>",
            severity=Severity.INFO,
            key=" ".join(missing),
            covered_by=("GEO002",) if not collides else (),
        )


_MOMENTS = 'ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"'
_BODY = f'<inertial><mass value="1"/><inertia {_MOMENTS}/></inertial>'
_BOX = '<geometry><box size="1 1 1"/></geometry>'
_SHAPES = f"<collision>{_BOX}</collision><visual>{_BOX}</visual>"
_FULL = _BODY + _SHAPES
_FILE = "urdf/arm.urdf"


def _robot(base: str, arm: str, kind: str = "revolute", more: str = "") -> dict[str, object]:
    mark = "  <!-- ^ URD007 -->"
    text = f"""<robot name="arm">
<link name="base_link">{base.replace("MARK", mark)}
</link>
<link name="arm">{arm.replace("MARK", mark)}
</link>
<joint name="j" type="{kind}"><parent link="base_link"/><child link="arm"/></joint>
{more}
</robot>
"""
    return {"@urdf": True, _FILE: text}


_KEPT = '<gazebo reference="j"><preserveFixedJoint>true</preserveFixedJoint></gazebo>'
_SENSOR = '<gazebo reference="arm"><sensor name="camera" type="camera"/></gazebo>'
_SECOND_PARENT = f"""<link name="hand">{_FULL}</link>
<joint name="k" type="fixed"><parent link="base_link"/><child link="hand"/></joint>
<joint name="l" type="fixed"><parent link="arm"/><child link="hand"/></joint>"""
GOOD = [
    _robot(_FULL, _FULL),
    _robot(_FULL, _FULL.replace('mass value="1"', 'mass value="2*0.5"')),
    _robot(_FULL, "", "fixed", _SENSOR),
    _robot("", _FULL, "fixed"),
    _robot(_FULL, _SHAPES + "<inertial/>"),
    _robot(_FULL, "", more=_SECOND_PARENT),
    {"urdf/robot_from_sdf.xacro": '<robot name="r"><link name="a"/></robot>'},
]
BAD = [
    _robot(_FULL, "MARK", "revolute", _SENSOR),
    _robot("MARK", _FULL),
    _robot(_FULL, "MARK", "fixed", _KEPT),
    _robot(_FULL, "MARK" + _BODY),
]
