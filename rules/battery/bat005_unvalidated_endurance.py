"""A battery that lasts long, without a measurement that proves it.

Above one hour on the ground and ten minutes in the air, the organisers require proof from the real
robot: a video or a log of an endurance test, linked in specifications.md. Without proof they ask
for the standard endurance. A section on validation that refers to that of another configuration
counts as proof.

A link proves endurance in that section or in the one about endurance, unless its line is about a
device. It does not where specifications.md says that the test was not made or is planned.

Fix: link the video or the data in the section "Validation and Specification Links". Without a
measurement, raise `power_load`.
Source: SubT Model Preparation Guide; reviews limit robots to one hour "until endurance validation
data can be provided" (`subt_standards.json`).
"""

from checker.model.battery import RELEASE, Battery, batteries
from checker.model.robot import Robot
from checker.model.specification.proof import Proven
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Context, Findings, HasSpan, Severity, finding, rule, unchecked


@rule("BAT005", "unvalidated-endurance", Severity.WARNING, Concern.PAPERWORK)
def check(
    robot: Robot,
    specification: Specification,
    context: Context,
    *,
    ground: float = 60.0,
    air: float = 10.0,
    tolerance: float = 0.1,
) -> Findings:
    """Report batteries that last longer than `ground` or `air` without links to measurements.

    Options:
        ground: Minutes that the battery of a ground robot may last without links to measurements.
        air: Minutes that the battery of a robot with a MulticopterVelocityControl may last without
            links to measurements.
        tolerance: Share by which the minutes of the model may be above `ground` or `air` before
            they are reported.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    if specification.proves(Proven.ENDURANCE):
        return
    if context.release != RELEASE:
        yield unchecked(f"how fast a battery drains is known for Gazebo {RELEASE.title()} only")
        return
    allowed = air if robot.locomotion.copters else ground
    known = [(plugin.minutes, plugin) for plugin in batteries(robot) if plugin.minutes is not None]
    for minutes, battery in known:
        if minutes > allowed * (1 + tolerance):
            yield finding(
                _place(specification, battery),
                f"the battery lasts about {minutes:.3g} minutes, above {allowed:g} minutes: "
                "link a video or data that proves it in specifications.md",
                related=[(battery, "the load of the battery")],
            )


def _place(sheet: Specification, battery: Battery) -> HasSpan:
    """Return where the sheet states endurance, else the battery."""
    return sheet.endurance or sheet.section("endurance") or battery


def _battery(load: str, charge: str = "78.4", mark: str = "") -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::LinearBatteryPlugin">
  <open_circuit_voltage_constant_coef>12.694</open_circuit_voltage_constant_coef>
  <open_circuit_voltage_linear_coef>-3.1424</open_circuit_voltage_linear_coef>
  <initial_charge>{charge}</initial_charge>
  <power_load>{load}</power_load>{mark}
</plugin>
"""


_COPTER = '<plugin filename="libm.so" name="gz::sim::systems::MulticopterVelocityControl"/>'
_LINK = "## Validation and Specification Links\n* Endurance test: https://youtu.be/H15Kpvpepv4\n"
_PLAIN = "# Rover\n## Validation\n* https://acme.com/rover/endurance.csv\n"
_REFERS = "# Rover\n## Validation\nSee [there](../acme_rover_sensor_config_2/specifications.md).\n"
_MARK = "<!-- ^ BAT005 -->"


def _sheet(endurance: str, validation: str = "", more: str = "") -> dict[str, str]:
    return {
        "@fragment": _battery("4.95"),
        "specifications.md": f"# Rover\n{more}\n## Endurance Characteristics {endurance}\n"
        f"## Validation\n{validation}\n",
    }


_VIDEO = "https://youtu.be/H15Kpvpepv4"

GOOD = [
    _battery("9.9"),
    {"@fragment": _battery("4.95"), "specifications.md": f"# Rover\n{_LINK}"},
    _battery("13.2", "18") + _COPTER,
    {"@fragment": _battery("4.95"), "specifications.md": _PLAIN},
    {"@fragment": _battery("4.95"), "specifications.md": _REFERS},
    _sheet(f"\nIt ran for two hours: {_VIDEO}"),
    _sheet("\nTwo hours until the battery was empty.", f"* Drive with the camera on: {_VIDEO}"),
    _sheet("\nTwo hours.", f"* Endurance test: {_VIDEO}\n* Mass measurement: TBD"),
]
BAD = [
    _battery("4.95", mark=f" {_MARK}"),
    {
        "@fragment": _battery("4.95"),
        "specifications.md": f"# Rover\n## Endurance Characteristics {_MARK}\nTwo hours or so.\n",
    },
    {
        "@fragment": _battery("6.6", "18") + _COPTER,
        "specifications.md": f"# R\n## Endurance\n* Battery life of 1200 seconds {_MARK}\n",
    },
    _sheet(f"{_MARK}\nTwo hours.", f"* Lidar in dust: {_VIDEO}"),
    _sheet(f"{_MARK}\nTwo hours.", more=f"## Sensors\n* Ouster OS1: {_VIDEO}"),
    _sheet(f"{_MARK}\nTwo hours; the test is still to be done.", f"* {_VIDEO}"),
    _sheet(f"{_MARK}\nTwo hours.", f"* {_VIDEO}\n* Endurance test: TBD"),
]
