"""A group in `kinematics.yaml` that the SRDF does not have.

MoveIt looks for the solver under the name of the group, so that the group meant has none: poses
cannot be planned ("No kinematics solver instantiated for group"), and the marker in RViz does not
move the arm. Often the group was renamed in the SRDF alone.

kinematics.yaml is that in the folder of the SRDF; a group of any SRDF of the folder is known. Where
xacro computes the name of a group, nothing is reported.

Fix: write the name of the group as in the SRDF.
Source: MoveIt, kinematics_plugin_loader: the parameters `robot_description_kinematics.GROUP`.
"""

import posixpath
from collections.abc import Iterator

from checker.package.package import Package
from checker.robots.semantic import SemanticDescription
from checker.rule import Concern, Findings, Severity, finding, rename, rule
from checker.rulebook.example_parts import ARM, MOVEIT_LAUNCH
from checker.source.text import Located
from checker.source.xml import XmlDocument
from checker.source.yaml import read_root

_FILE = "kinematics.yaml"
_SOLVER = "kinematics_solver"
_TOP = "robot_description_kinematics"


@rule("URD038", "kinematics-of-unknown-group", Severity.WARNING, Concern.INTERFACE)
def check(semantic: SemanticDescription, package: Package) -> Findings:
    """Report groups of kinematics.yaml that no SRDF beside it has."""
    groups = semantic.names["group"]
    folder = posixpath.dirname(semantic.file)
    path = posixpath.join(folder, _FILE)
    root = read_root(package.read(path)) if groups and package.exists(path) else None
    beside = set(_groups_beside(package, folder))
    if root is None or any("$" in name for name in beside):
        return
    entries = (root.get(_TOP) or root).entries
    without = sorted(groups - {str(key.scalar) for key, _ in entries})
    for key, settings in entries:
        name = str(key.scalar)
        if settings.get(_SOLVER) is None or name in groups | beside:
            continue
        hint = f": write {' or '.join(map(repr, without))}" if without else ""
        yield finding(
            key,
            f"the SRDF has no group {name!r}, so MoveIt does not use this solver{hint}",
            fix=rename(Located(name, key.span), without[0]) if len(without) == 1 else None,
        )


def _groups_beside(package: Package, folder: str) -> Iterator[str]:
    """Yield the groups that the SRDF files of a folder define as they are written."""
    for file in package.index.files:
        if posixpath.dirname(file.path) == folder and ".srdf" in file.path:
            document = package.xml(file.path)
            for element in document.elements if isinstance(document, XmlDocument) else ():
                if element.tag == "group":
                    yield (element.get("name") or "").strip()


def _moveit(name: str, mark: str = "", group: str = "arm", more: str = "") -> dict[str, object]:
    solver = "kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin"
    joint = '<joint name="shoulder"/>'
    return {
        "@urdf": True,
        "urdf/arm.urdf": ARM,
        "config/arm.srdf": f'<robot name="arm"><group name="{group}">{joint}</group></robot>\n',
        "config/kinematics.yaml": f"{name}:{mark}\n  {solver}\n",
        "launch/plan.launch.py": MOVEIT_LAUNCH,
        **({"config/other.srdf": f'<robot name="arm">{more}</robot>\n'} if more else {}),
    }


_MARK = "  # ^ URD038"
GOOD = [
    _moveit("arm"),
    _moveit("hand", more='<group name="hand"><joint name="shoulder"/></group>'),
]
BAD = [_moveit("group1", _MARK), _moveit("arm", _MARK, group="arm_group")]
