"""A hardware component that the ROS 2 distribution does not have.

The controller manager loads the class that `<hardware><plugin>` names. Without it, the robot has no
interfaces and none of its controllers starts. `gazebo_ros2_control/GazeboSystem` is of Gazebo
Classic, which ends with Humble; `fake_components/GenericSystem` is `mock_components/GenericSystem`
since Humble.

A class of another package is compared with the plugin descriptions that the package exports, if it
is available; if it is not, the finding is an info unless package.xml depends on the package.

Fix: name a class that exists: `gz_ros2_control/GazeboSimSystem` in Gazebo from Fortress on,
`ign_ros2_control/IgnitionSystem` in Fortress, `mock_components/GenericSystem` without hardware.
Source: hardware descriptions of ros2_control, gz_ros2_control and gazebo_ros2_control, by branch;
docs.ros.org, C++ API of Humble's gz_ros2_control 0.7.
"""

import re
from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.ros.ros2_control.distributions import (
    distribution_of,
    hardware_classes,
    has_every_class,
    is_from,
)
from checker.ros.ros2_control.exported_hardware import exported_hardware, owner_of
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    misspelt,
    respelling,
    rule,
)
from checker.rulebook.example_parts import ros2_control
from checker.source.text import Located, SourceText

_NAMED = re.compile(r"<plugin>\s{0,80}([\w:/]{1,200})\s{0,80}</plugin>")
_IGNITION = "ign_ros2_control"


@rule("R2C004", "unknown-hardware", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl, package: Package, papers: Paperwork, context: Context) -> Findings:
    """Report hardware components that do not exist.

    Where the file names another one as well, an argument of xacro chooses: it is an info.
    """
    distribution = distribution_of(context)
    for plugin in dict.fromkeys(hardware.plugin for hardware in control.hardware):
        yield from _judged(plugin, package, papers, distribution)


def _judged(
    plugin: Located[str], package: Package, papers: Paperwork, distribution: str
) -> Iterator[Finding]:
    name = plugin.value
    owner = owner_of(name)
    if not name:
        return
    known = hardware_classes().get(name)
    if known is not None and known.exists_in(distribution):
        if owner == _IGNITION and is_from(distribution, "jazzy"):
            yield _old(plugin)
    elif owner == _IGNITION and known is not None:
        yield _old(plugin)
    elif has_every_class(owner):
        yield _absent(plugin, package, distribution)
    elif known is not None and not known.distros and not known.package:
        yield finding(
            plugin, f"there is no hardware {name!r}: {known.note}", severity=Severity.WARNING
        )
    elif known is None:
        yield from _foreign(plugin, package, papers, owner)


def _old(plugin: Located[str]) -> Finding:
    return finding(
        plugin,
        f"{plugin.value} is an old name, expected gz_ros2_control/GazeboSimSystem",
        severity=Severity.INFO,
    )


def _absent(plugin: Located[str], package: Package, distribution: str) -> Finding:
    name = plugin.value
    classes = [known for known in hardware_classes().values() if known.exists_in(distribution)]
    suggestions = Suggestions(known.name for known in classes)
    others = _other_names(plugin, package)
    severity, more = None, suggestions.hint(name)
    if others:
        severity = Severity.INFO
        more = f"; the file also names {others[0]}, so an argument chooses"
    return finding(
        plugin,
        f"ROS 2 {distribution.title()} has no hardware {name!r}{more}",
        severity=severity,
        fix=None if others else respelling(plugin, suggestions),
    )


def _other_names(plugin: Located[str], package: Package) -> list[str]:
    """Return the other hardware that the file names: under another argument, it is loaded."""
    source = package.read(plugin.span.place().file)
    if not isinstance(source, SourceText):
        return []
    named = dict.fromkeys(match.group(1) for match in _NAMED.finditer(source.text))
    return [name for name in named if name != plugin.value]


def _foreign(
    plugin: Located[str], package: Package, papers: Paperwork, owner: str
) -> Iterator[Finding]:
    """Look for the class of a package outside of ros2_control."""
    manifest = papers.manifest
    own = manifest is not None and manifest.name.value == owner
    holder = package if own else package.workspace.package(owner)
    if holder is None:
        if manifest is None or not manifest.depends_on(owner):
            yield finding(
                plugin,
                f"hardware {plugin.value!r} is not known: no package {owner!r} is available, and "
                "package.xml does not depend on it",
                severity=Severity.INFO,
            )
        return
    exported = {name for name, _ in exported_hardware(holder)}
    if exported and plugin.value not in exported:
        message = f"package {owner!r} exports no hardware {plugin.value!r}"
        yield misspelt(plugin, message, Suggestions(exported))


def _arm(plugin: str, **files: str) -> object:
    described = ros2_control(hardware=plugin)
    return {"@urdf": described, **{path.replace("__", "."): text for path, text in files.items()}}


_MARK = "  <!-- ^ R2C004 -->"
_EXPORTED = """<library path="acme">
  <class name="acme_arm/Arm" type="acme_arm::Arm" base_class_type="hardware_interface::SystemInterface"/>
</library>
"""  # noqa: E501
_OF_GAZEBO = """<library path="acme">
  <class name="acme_arm/Sim" type="acme_arm::Sim" base_class_type="gz_ros2_control::GazeboSimSystemInterface"/>
</library>
"""  # noqa: E501
_MANIFEST = """<package format="3">
  <name>acme_arm</name>
  <version>1.0.0</version>
  <description>An arm</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>other_driver</exec_depend>
</package>
"""
_OURS = {"package__xml": _MANIFEST, "plugins__xml": _EXPORTED}
GOOD = [
    _arm("<plugin>mock_components/GenericSystem</plugin>"),
    _arm("<plugin>gz_ros2_control/GazeboSimSystem</plugin>"),
    _arm("<plugin>ur_robot_driver/URPositionHardwareInterface</plugin>"),
    _arm("<plugin>acme_arm/Arm</plugin>", **_OURS),
    _arm("<plugin>acme_arm/Sim</plugin>", **_OURS, gazebo__xml=_OF_GAZEBO),
    _arm("<plugin>gz_ros2_control/GazeboSimSystem</plugin>", README__md="An arm for ROS 2 Humble"),
    _arm("<plugin>other_driver/Arm</plugin>", **_OURS),
]
BAD = [
    _arm(f"<plugin>gazebo_ros2_control/GazeboSystem</plugin>{_MARK}"),
    _arm(f"<plugin>fake_components/GenericSystem</plugin>{_MARK}"),
    _arm(f"<plugin>gz_ros2_control/GzSimSystem</plugin>{_MARK}"),
    _arm(f"<plugin>ign_ros2_control/IgnitionSystem</plugin>{_MARK}"),
    _arm(f"<plugin>kortex2_driver/KortexMultiInterfaceHardware</plugin>{_MARK}"),
    _arm(f"<plugin>acme_arm/Amr</plugin>{_MARK}", **_OURS),
    _arm(f"<plugin>unheard_of/Arm</plugin>{_MARK}", **_OURS),
]
