"""A launch file of ROS 1 gives a node a file that its package does not have.

The node starts without it: RViz opens with no display and the frame `map`; a node that needs the
file, such as `map_server`, ends. The path is that with the defaults of all args. Files of packages
that are not available are not checked, nor those of nodes that write files: `map_saver`, `record`.
Descriptions and files of `<rosparam>` are those of CTL008 and LCH020.

Fix: add the file, or correct its path.
Source: roslaunch XML specification, `<node args>`; rviz, `-d`.
"""

from checker.launch.ros1.package_launch import LaunchEntries, LaunchFiles
from checker.launch.ros2.package_launch import is_ros2_only
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

_READ = (".rviz", ".vcg", ".yaml", ".perspective", ".lua", ".csv", ".pgm")
_WRITES = frozenset({"map_saver", "record", "spawn_model"})
"""Programs that write the file, and the one whose files CTL008 checks."""


@rule("LCH029", "missing-file-of-ros-1-node", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, launch: LaunchEntries) -> Findings:
    """Report files in the command lines of nodes that are in no available package."""
    if is_ros2_only(package):
        return
    files = LaunchFiles(package)
    for entry in launch.entries:
        for node in entry.graph.nodes:
            for word in node.words if node.type not in _WRITES else ():
                path = files.absent(word.value) if word.value.endswith(_READ) else None
                if path is not None:
                    message = f"node {node.name!r} is given {path}, which does not exist"
                    yield finding(word, message, key=path)


def _shown(name: str, mark: str = "", program: str = "rviz") -> dict[str, object]:
    path = f"$(find acme_arm_description)/{name}"
    node = f'<node name="show" pkg="rviz" type="{program}" args="-d {path}"/>{mark}'
    return {"@urdf": True, "launch/show.launch": f"<launch>{node}</launch>\n", "arm.rviz": ""}


_MARK = "  <!-- ^ LCH029 -->"
GOOD = [
    _shown("arm.rviz"),
    _shown("$(env VIEW).rviz"),
    _shown("new.yaml", program="map_saver"),
]
BAD = [_shown("urdf.rviz", _MARK)]
