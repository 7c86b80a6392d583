"""A link for RViz without the robot's name as a prefix.

Teams run several robots at once, and all robots share one tree of frames. Links with the same name
in two robots jump between them; the frames that Gazebo publishes start with the name.

Fix: write `${name}/base_link`, in links and in the parents and children of joints.
Source: Model Migration Guide: "Prefix each link in the xacro file with the robot's namespace".
"""

from checker.formats.urdf.description import UrdfDescription
from checker.launch.ros1.package_launch import SAMPLE_ARGUMENTS
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD003", "link-without-name-prefix", Severity.WARNING, Concern.INTERFACE)
def check(description: UrdfDescription) -> Findings:
    """Report links of a description for RViz that do not start with the robot's name."""
    if not description.for_rviz:
        return
    prefix = f"{SAMPLE_ARGUMENTS['name']}/"
    bare = [link for link in description.robot.links if not link.name.value.startswith(prefix)]
    for link in bare:
        others = f" ({len(bare)} links)" if len(bare) > 1 else ""
        yield finding(
            link.name,
            f"link {link.name.value!r} does not start with ${{name}}/{others}",
            key="prefix",
        )


_FILE = "urdf/robot_from_sdf.xacro"
_HEAD = '<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">\n'
_ARGUMENT = '<xacro:arg name="name" default="x"/><xacro:property name="ns" value="$(arg name)"/>\n'
_MARK = "  <!-- ^ URD003 -->"
GOOD = [
    {_FILE: f'{_HEAD}{_ARGUMENT}<link name="${{ns}}/base_link"/></robot>'},
    {"@urdf": True},
]
BAD = [
    {_FILE: f'{_HEAD}<link name="base_link"/>{_MARK}\n<link name="wheel"/>{_MARK}\n</robot>'},
    {_FILE: f'{_HEAD}{_ARGUMENT}<link name="${{ns}}_base_link"/>{_MARK}\n</robot>'},
]
