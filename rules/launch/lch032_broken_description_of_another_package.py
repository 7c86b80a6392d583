"""A launch file loads a robot of another package whose file is not well-formed.

xacro and the parser of the URDF stop at the first such error, so that the launch file starts
without a robot, or not at all: nothing of this package works until the other one is repaired.
SDF001 reports the place of the fault in the package of the file.

Fix: correct the file; the message names the line.
Source: Extensible Markup Language 1.0, "well-formed documents"; xacro, `parse`.
"""

from checker.formats.xacro.files import local_path
from checker.launch.ros2.descriptions import loaded_descriptions
from checker.launch.ros2.graph import Ros2Launch
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.xml_positions import XmlFault

_BESIDE = "../"


@rule("LCH032", "broken-description-of-another-package", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report each broken description of another package once for each launch file."""
    for graph in launch.entries:
        for loaded in loaded_descriptions(package, graph):
            path = local_path(package, loaded.load.path) or ""
            document = package.xml(path) if path.startswith(_BESIDE) else None
            if isinstance(document, XmlFault) and loaded.node.starts is not False:
                place, file = document.span, path.removeprefix(_BESIDE)
                yield finding(
                    loaded.span,
                    f"the robot cannot be loaded: {file} is not well-formed at line {place.line}, "
                    f"{document.message}",
                    key=file,
                    related=[(place, "the fault")],
                )


_LOADING = """import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node


def generate_launch_description():
    urdf = os.path.join(get_package_share_directory("acme_lift"), "urdf", "lift.urdf.xacro")
    return LaunchDescription([
        Node(package="robot_state_publisher", executable="robot_state_publisher",
             parameters=[{"robot_description": Command(["xacro ", urdf])}]),@
    ])
"""


def _loading(urdf: str, mark: str = "") -> dict[str, object]:
    return {
        "@ros2": True,
        "launch/lift.launch.py": _LOADING.replace("@", mark),
        "../acme_lift/package.xml": "<package><name>acme_lift</name></package>",
        "../acme_lift/urdf/lift.urdf.xacro": urdf,
    }


GOOD = [_loading('<robot name="lift"><link name="base_link"/></robot>')]
BAD = [
    {
        **_loading('<robot name="lift"><link name="base_link"></robot>'),
        "@reported": ["launch/lift.launch.py:12"],
    }
]
