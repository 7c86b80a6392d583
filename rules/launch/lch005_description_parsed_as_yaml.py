"""A robot description that launch parses as YAML, although it is not valid YAML.

The value of a substitution, such as `Command(['xacro …'])`, is parsed as YAML unless its type is
stated. A colon before a blank anywhere in the expanded text, usually in a comment, is not valid in
a plain YAML text: the launch ends with "Unable to parse the value of parameter robot_description as
yaml".

Fix: write `ParameterValue(Command(…), value_type=str)`; in XML, `type="str"`.
Source: launch_ros, `evaluate_parameter_dict`;
UniversalRobots/Universal_Robots_ROS2_Driver#1103, intrinsic-dev/aic#43.
"""

from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.files import local_path
from checker.launch.ros2.descriptions import LoadedDescription, loaded_descriptions
from checker.launch.ros2.graph import Ros2Launch
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.yaml import MAX_LENGTH, is_yaml

_DECLARATION = '<?xml version="1.0" ?>\n'
"""Start of xacro's output: a text of one line could be a mapping, a longer one cannot."""


@rule("LCH005", "description-parsed-as-yaml", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package, description: UrdfDescription) -> Findings:
    """Report parameters without a type that have text which is not valid YAML."""
    text = _DECLARATION + description.document.source.text
    if len(text) > MAX_LENGTH or is_yaml(text):
        return
    for loaded in _unquoted_descriptions(launch, package):
        if local_path(package, loaded.load.path) == description.document.source.file:
            yield finding(
                loaded,
                "ros2 launch stops: it parses the robot description as YAML, which it is not, "
                "usually for a colon and a blank in a comment; write "
                "ParameterValue(…, value_type=str) around it",
                key="without type",
            )


def _unquoted_descriptions(launch: Ros2Launch, package: Package) -> Iterator[LoadedDescription]:
    for graph in launch.entries:
        for loaded in loaded_descriptions(package, graph):
            parameter = loaded.parameter
            if parameter is not None and parameter.substituted and not parameter.as_text:
                yield loaded


_NODE = """        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': robot}]),"""
_ARM = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <!-- Note: the plate is missing -->
  <link name="base_link"/>
</robot>
"""

GOOD = [
    {"@ros2": _NODE},
    {"@ros2": True, "urdf/arm.urdf.xacro": _ARM},
    {"@ros2": _NODE, "urdf/arm.urdf.xacro": _ARM.replace("Note:", "Note")},
]
BAD = [
    {
        "@ros2": _NODE,
        "urdf/arm.urdf.xacro": _ARM,
        "@reported": ["launch/arm.launch.py:18"],
    },
]
