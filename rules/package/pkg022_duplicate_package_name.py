"""Two packages in one folder that declare the same name.

Neither is built: colcon ends with "Duplicate package names not supported", catkin with "Multiple
packages found with the same name". A copy that is kept as a backup is the usual cause.

Fix: put an empty file COLCON_IGNORE (CATKIN_IGNORE in ROS 1) into the folder that is not
needed, rename its package, or move it out of the workspace.
Source: colcon-core, `colcon_core/package_selection`; catkin_pkg, `catkin_pkg.packages`.
"""

from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("PKG022", "duplicate-package-name", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, papers: Paperwork) -> Findings:
    """Report a folder beside that declares the same name; an info if it was not given, too."""
    space, manifest = package.workspace, papers.manifest
    if manifest is None or not manifest.name.value:
        return
    name = manifest.name.value
    for folder in space.folders_by_declared_name.get(name, []):
        if folder.parent != package.root.parent or folder == package.root:
            continue
        if not space.ignores(folder.name):
            given = space.given is not None and folder.is_relative_to(space.given)
            yield finding(
                manifest.name,
                f"the folder {folder.name} declares the package name {name!r} too, so that a "
                "workspace with both is not built: put an empty file COLCON_IGNORE (CATKIN_IGNORE "
                "in ROS 1) into the folder that is not needed, or rename its package",
                severity=None if given else Severity.INFO,
            )


def _named(name: str, mark: str = "") -> str:
    return f"<package>\n  <name>{name}</name>{mark}\n</package>\n"


_OWN = _named("acme_arm_description")
_MARKED = _named("acme_arm_description", "  <!-- ^ PKG022 -->")
GOOD = [
    {"@urdf": True, "../acme_arm_bringup/package.xml": _named("acme_arm_bringup")},
    {"@urdf": True, "../old/package.xml": _OWN, "../old/COLCON_IGNORE": ""},
]
BAD = [{"@urdf": True, "package.xml": _MARKED, "../old/package.xml": _OWN}]
