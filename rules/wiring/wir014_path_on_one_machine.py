"""A parameter of a node is a path on the machine of its author.

On every other machine the node does not find the file: the map server has no map, the navigator no
behaviour tree. A path in a home, such as `/home/me/maps/hall.yaml`, on a drive of Windows, or in
the folders of a workspace is reported in a parameter file, if it is that of a file. The name of a
parameter such as `output_file` says that the node writes it. Where a launch file names the
parameter, it may replace the value: this is an info.

Fix: install the file with the package, and give its path in the launch file; or write
`$(find-pkg-share PACKAGE)/maps/hall.yaml`, and load the file with `allow_substs=True`.
Source: ROS 2, launch_ros `ParameterFile`; ros-navigation/navigation2@b978cff5.
"""

import re

from checker.launch.ros2.named_paths import is_written
from checker.package.package import Package
from checker.package.uris import is_on_one_machine, own_path_on_machine
from checker.ros.wiring.parameters import blocks_in
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located

_FILE = re.compile(r"[^/\\]\.[A-Za-z]\w{1,9}\Z")
_BY_LAUNCH = {"yaml_filename": "map"}
"""Arguments of Nav2's own launch files that replace parameters of another name."""


@rule("WIR014", "path-on-one-machine", Severity.WARNING, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report the files of one machine that parameter files name."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        for block in blocks_in(package, file.path, "ros__parameters"):
            for name, parameter in block.parameters.items():
                for text in () if is_written(name) else parameter.texts:
                    if is_on_one_machine(text.value) and _FILE.search(text.value):
                        yield _finding(package, f"{name} of {block.node}", name, text)


def _finding(package: Package, label: str, name: str, text: Located[str]) -> Finding:
    own = own_path_on_machine(package, text.value)
    here = f"$(find-pkg-share {package.declared_name})/{own}" if own else ""
    names = (name, _BY_LAUNCH.get(name, name))
    launch = package.workspace.launch_texts.values()
    replaced = any(f"{mark}{it}{mark}" in code for code in launch for it in names for mark in "'\"")
    return finding(
        text,
        f"{label} is {text.value}, on its author's machine, and is found on no other: "
        + (f"give {here} in the launch file" if here else "install the file with a package"),
        severity=Severity.INFO if replaced else None,
        key=text.value,
    )


def _example(value: str, mark: str = "", name: str = "yaml_filename") -> dict[str, object]:
    return {
        "@bridge": True,
        "config/nav2.yaml": f"map_server:\n  ros__parameters:\n    {name}: {value}{mark}\n",
    }


_MARK = "  # ^ WIR014"
GOOD = [
    _example("$(find-pkg-share acme_rover_bringup)/maps/hall.yaml"),
    _example("/home/ann/logs/run.csv", name="output_file"),
    _example("/opt/ros/jazzy/share/nav2_bringup/maps/depot.yaml"),
    _example("/home/ann/maps"),
    _example("/map/image.raw", name="topic"),
]
BAD = [
    _example("/home/ann/maps/hall.yaml", _MARK),
    {**_example("/home/ann/ws/src/rover/maps/hall.yaml", _MARK), "maps/hall.yaml": "image: a\n"},
    _example('"/rover_ws/install/rover/share/rover/tree.xml"', _MARK, "default_bt_xml"),
]
