"""A controller of a joint that does not exist.

The controller manager refuses such a controller, the spawner ends with an error, and the joint
moves freely. Names must match exactly. A fixed joint cannot be controlled either.

Fix: write the joint's name as in the URDF file.
Source: ros_control, `hardware_interface::ResourceManager::getHandle`: a joint that no transmission
has registered is not found.
"""

from collections.abc import Iterator, Mapping

from msgspec.structs import replace

from checker.base.words import Suggestions
from checker.model.components import Joint
from checker.package.package import Package
from checker.ros.control.controllers import Controller, ControlSystem
from checker.rule import (
    Concern,
    Finding,
    Findings,
    Severity,
    finding,
    misspelt,
    rule,
    unchecked,
)
from checker.source.text import SourceText

_HARDWARE = "hardware_interface::RobotHW"


@rule("CTL001", "controller-of-unknown-joint", Severity.ERROR, Concern.INTERFACE)
def check(control: ControlSystem, package: Package) -> Findings:
    """Report joints of controllers that no robot of the package has, or that do not move.

    Where the package has a `RobotHW` of its own, which may name joints otherwise, it is an info.
    """
    if control.joints is None:
        yield unchecked(control.unread_robot)
        return
    found = [*_unknown(control, control.joints)]
    if found and _has_own_hardware(package):
        found = [replace(it, severity=Severity.INFO) for it in found]
    yield from found


def _unknown(control: ControlSystem, joints: Mapping[str, Joint]) -> Iterator[Finding]:
    names = Suggestions(joints)
    for controller in control.controllers:
        for joint in controller.joints:
            known = joints.get(joint.value)
            if known is None:
                yield misspelt(
                    joint,
                    f"{_label(controller)} controls joint {joint.value!r}, "
                    "which the robot does not have",
                    names,
                    severity=_severity(controller),
                )
            elif not control.moves(joint.value):
                yield finding(
                    joint,
                    f"{_label(controller)} controls joint {joint.value!r}, which is "
                    f"{known.type.value}: expected a joint that a motor can move",
                    severity=_severity(controller),
                )


def _has_own_hardware(package: Package) -> bool:
    sources = (package.read(it.path) for it in package.index.with_suffix(".h", ".hpp", ".cpp"))
    return any(isinstance(it, SourceText) and _HARDWARE in it.text for it in sources)


def _label(controller: Controller) -> str:
    return f"controller {controller.name!r}"


def _severity(controller: Controller) -> Severity | None:
    """Return the severity; a file that no launch file loads may belong to another robot."""
    return None if controller.loaded_by is not None else Severity.WARNING


_CONFIG = "config/control.yaml"


def _config(joint: str) -> str:
    return f"""arm:
  shoulder_controller:
    type: effort_controllers/JointPositionController
    joint: {joint}
    pid: {{p: 10.0, i: 0.1, d: 0.0}}
"""


_FIXED = '<joint name="mount" type="fixed"><parent link="base_link"/><child link="plate"/></joint>'

GOOD = [
    {"@urdf": True},
    {"@urdf": True, "test/config/control.yaml": _config("elbow")},
    {"@urdf": True, _CONFIG: _config('"shoulder"')},
    {"@urdf": True, _CONFIG: "arm:\n  drive:\n    type: my_controllers/Drive\n    wheels: 4\n"},
]
BAD = [
    {
        "@urdf": True,
        "src/arm.cpp": "class Arm : public hardware_interface::RobotHW {};",
        _CONFIG: _config("elbow  # ^ CTL001"),
    },
    {"@urdf": True, _CONFIG: _config("shoulder_joint  # ^ CTL001")},
    {"@urdf": True, _CONFIG: _config("shuolder  # ^ CTL001")},
    {"@urdf": f'<link name="plate"/>{_FIXED}', _CONFIG: _config("mount  # ^ CTL001")},
    {
        "@urdf": True,
        _CONFIG: """arm:
  arm_controller:
    type: position_controllers/JointTrajectoryController
    joints:
      - shoulder
      - elbow  # ^ CTL001
""",
    },
    {"@urdf": True, "config/other.yaml": _config("elbow  # ^ CTL001")},
]
