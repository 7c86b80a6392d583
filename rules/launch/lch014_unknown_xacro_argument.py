"""A launch file gives xacro an argument that the description neither declares nor uses.

xacro accepts it without a message, and the default is used: the simulation is not enabled, or the
robot keeps its old prefix. Files that are not available, and files that include such files, are not
checked.

Fix: correct the name, declare `<xacro:arg name="…"/>`, or leave the argument out.
Source: xacro: arguments of the command line are only read by `$(arg …)`.
"""

import re

from checker.base.words import Suggestions
from checker.formats.xacro.files import Gathered
from checker.launch.ros2.descriptions import LoadedDescription, loaded_descriptions
from checker.launch.ros2.graph import Ros2Launch
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

_WORD = re.compile(r"\w+")


@rule("LCH014", "unknown-xacro-argument", Severity.INFO, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report arguments that no file of the description mentions; a warning for a similar one."""
    for graph in launch.entries:
        for described in loaded_descriptions(package, graph):
            gathered = Gathered(package)
            gathered.follow([described.load.path])
            if not gathered.sources or gathered.beyond or gathered.faults:
                continue
            words = {w for it in gathered.sources.values() for w in _WORD.findall(it.text)}
            declared = Suggestions(_declared_arguments(gathered))
            for name in _given_arguments(described):
                if not words.issuperset(_WORD.findall(name)):
                    file = described.load.path.rpartition("/")[2]
                    yield finding(
                        described.span,
                        f"{file} neither declares nor uses argument {name!r}{declared.hint(name)}",
                        severity=Severity.WARNING if declared.closest(name) else None,
                        key=f"{file} {name}",
                    )


def _given_arguments(described: LoadedDescription) -> list[str]:
    return sorted({*described.load.args, *described.unknown})


def _declared_arguments(gathered: Gathered) -> list[str]:
    return [
        element.get("name") or ""
        for document in gathered.documents.values()
        for element in document.elements
        if element.tag == "xacro:arg"
    ]


def _arm(given: str, mark: str = "") -> object:
    return {
        "@ros2": f"""        Node(package='robot_state_publisher', executable='state',
             parameters=[{{'robot_description': Command([{mark}
                 'xacro ', in_package('urdf', 'arm.urdf.xacro'), {given}])}}]),""",
        "urdf/arm.urdf.xacro": """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:arg name="color" default="red"/>
  <xacro:include filename="base.xacro"/>
</robot>
""",
        "urdf/base.xacro": """<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <link name="$(arg prefix)base"/>
</robot>
""",
    }


GOOD = [
    _arm("' color:=blue', ' prefix:=a_'"),
    {"@ros2": True},
]
BAD = [
    _arm("' colour:=blue'", "  # ^ LCH014"),
    _arm("' side:=', LaunchConfiguration('side', default='left')", "  # ^ LCH014"),
]
