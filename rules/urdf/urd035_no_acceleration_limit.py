"""A joint that MoveIt plans without a limit of its acceleration.

MoveIt finds a path, and then its times with AddTimeOptimalParameterization. Since Iron that needs
the acceleration limit of every joint of the group: "No acceleration limit was defined for joint …!
You have to define acceleration limits in the URDF or joint_limits.yaml", and every plan fails.
Humble takes 1 rad/s² and says so. A `max_acceleration` of 0 is refused in all distributions.

The joint_limits.yaml beside an SRDF that a launch file gives to MoveIt is judged, for the groups to
which kinematics.yaml gives a solver; a missing limit, if the package names its distribution, or
`--distro` does.

Fix: write `has_acceleration_limits: true` and a `max_acceleration` that the drive can do, such as
5.0, for each joint.
Source: moveit/moveit2#1794; agilexrobotics/piper_ros#17; MoveIt 2,
time_optimal_trajectory_generation.cpp.
"""

import posixpath
from collections.abc import Iterator, Mapping

from checker.base.words import count
from checker.package.package import Package
from checker.robots.planned_joints import planned_joints
from checker.robots.semantic import SemanticDescription
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ARM, MOVEIT_LAUNCH
from checker.source.yaml import YamlNode, read_root

_BUILDER = "MoveItConfigsBuilder"
_ADAPTER = "AddTimeOptimalParameterization"
_USED, _VALUE = "has_acceleration_limits", "max_acceleration"
_SINCE_IRON = ("iron", "jazzy", "kilted", "lyrical", "rolling")


@rule("URD035", "no-acceleration-limit", Severity.ERROR, Concern.INTERFACE)
def check(semantic: SemanticDescription, package: Package, context: Context) -> Findings:
    """Report joints of planned groups without an acceleration limit, or with one of 0."""
    folder = posixpath.dirname(semantic.file)
    limits = _mapping(package, f"{folder}/joint_limits.yaml", "joint_limits")
    solvers = _mapping(package, f"{folder}/kinematics.yaml")
    launches = package.workspace.launches_with
    if limits is None or solvers is None or not semantic.is_loaded or launches(_USED):
        return
    if not semantic.robots or not launches(_BUILDER) or not _is_timed(package, folder):
        return
    groups = [str(key.scalar) for key, it in solvers.entries if it.get("kinematics_solver")]
    of_robots = [
        {name for group in groups for name in planned_joints(semantic.root, group, robot)}
        for robot in semantic.robots
    ]
    joints = of_robots[0].intersection(*of_robots)
    stated = {str(key.scalar): (key, it) for key, it in limits.entries}
    if joints.isdisjoint(stated):
        return
    yield from _zeros({name: it[1] for name, it in stated.items() if name in joints})
    sign = package.distribution_sign
    is_known = context.distro_is_known or (sign is not None and sign.distro == context.distro)
    lacking = sorted(it for it in joints if it not in stated or not _is_true(stated[it][1]))
    if lacking and is_known and context.distro in _SINCE_IRON:
        name = next((it for it in lacking if it in stated), lacking[0])
        place = stated[name][0] if name in stated else next(iter(stated.values()))[0]
        others = len(lacking) - 1
        more = f" and {count(others, 'other joint')} have" if others else " has"
        yield finding(
            place,
            f"joint {name!r}{more} no acceleration limit, so in {context.distro.capitalize()} "
            f"every plan fails: write {_USED}: true and {_VALUE}",
        )


def _mapping(package: Package, path: str, key: str = "") -> YamlNode | None:
    root = read_root(package.read(path))
    found = root.get(key) if root is not None and key else root
    return found if found is not None and found.kind == "mapping" else None


def _is_timed(package: Package, folder: str) -> bool:
    """Return whether OMPL's plans get their times from the adapter, as by default."""
    root = read_root(package.read(f"{folder}/ompl_planning.yaml"))
    return root is None or _ADAPTER in root.span.text


def _is_true(limit: YamlNode) -> bool:
    used = limit.get(_USED)
    return used is not None and used.scalar is not False


def _zeros(limits: Mapping[str, YamlNode]) -> Iterator[Finding]:
    for name, limit in limits.items():
        used, value = limit.get(_USED), limit.get(_VALUE)
        if value is not None and used is not None and used.scalar is True and value.scalar == 0:
            yield finding(
                value,
                f"{_VALUE} of joint {name!r} is 0, so MoveIt refuses every plan: expected more "
                "than 0",
                key=_VALUE,
            )


_GROUP = '<group name="arm"><chain base_link="base_link" tip_link="upper_arm"/></group>'


def _limits(lines: str, mark: str = "", distro: str = "Jazzy", **more: str) -> dict[str, object]:
    return {
        "@profile": "ros2",
        "@urdf": True,
        "README.md": f"An arm for ROS 2 {distro}.\n",
        "urdf/arm.urdf": ARM,
        "launch/plan.launch.py": MOVEIT_LAUNCH,
        "config/arm.srdf": f'<robot name="arm">{_GROUP}</robot>\n',
        "config/kinematics.yaml": "arm:\n  kinematics_solver: kdl/KDLKinematicsPlugin\n",
        "config/joint_limits.yaml": f"joint_limits:\n  shoulder:{mark}\n{lines}\n",
        **more,
    }


_OFF = "    has_acceleration_limits: false"
_ON = "    has_acceleration_limits: true\n    max_acceleration: "
_MARK = "  # ^ URD035"
GOOD = [
    _limits(f"{_ON}5.0"),
    _limits(_OFF, distro="Humble"),
    _limits(_OFF, **{"config/ompl_planning.yaml": "response_adapters: []\n"}),
]
BAD = [
    _limits(_OFF, _MARK),
    _limits("    has_velocity_limits: true", _MARK),
    _limits(f"{_ON}0.0{_MARK}", distro="Humble"),
]
