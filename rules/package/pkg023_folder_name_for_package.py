"""The name of a folder where the name of its package is meant.

ROS finds a package by the `<name>` in its package.xml, whatever its folder is called. With the name
of the folder, `$(find …)`, `package://`, a launch file or a node ends with "package not found".
After `git clone`, a folder often has the name of the repository.

Fix: write the name in package.xml, or rename the package.
Source: REP 149, name; ament_index_python, `get_package_share_directory`; rospkg.
"""

from checker.launch.ros2.graph import Ros2Launch
from checker.launch.ros2.used_packages import every_use
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.references import PROVIDED
from checker.package.released import distributions_with
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("PKG023", "folder-name-for-package", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, papers: Paperwork, launch: Ros2Launch | None) -> Findings:
    """Report uses of the folder names of available packages, if no package has that name."""
    if papers.manifest is None:
        return
    for use in every_use(package, launch):
        name = use.package_name
        holder = package.named(name)
        if holder is None or holder.declared_name == name or holder.root.name != name:
            continue
        if name in PROVIDED or name in package.workspace.folders_by_declared_name:
            continue
        if not distributions_with(name):
            yield finding(
                use.place,
                f"there is no package {name!r}: the package in the folder {name} is called "
                f"{holder.declared_name!r}; write {holder.declared_name}",
                key=name,
            )


_MANIFEST = """<package format="3">
  <name>@</name>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""


def _arm(name: str, mark: str = "") -> dict[str, object]:
    return {
        "@name": "arm",
        "@urdf": '<link name="tip"><visual><geometry>\n'
        f'<mesh filename="package://{name}/meshes/tip.stl"/>{mark}\n'
        "</geometry></visual></link>",
        "package.xml": _MANIFEST.replace("@", "acme_arm"),
        "meshes/tip.stl": "",
    }


GOOD = [_arm("acme_arm"), _arm("gripper")]
BAD = [_arm("arm", "  <!-- ^ PKG023 -->")]
