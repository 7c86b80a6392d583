"""A battery that lasts longer or shorter than specifications.md says.

Teams plan with specifications.md. With a `power_load` copied from another robot, the model has the
endurance of that robot. The rule computes the endurance from the plugin's charge, voltages and
load; for accepted packages the result is within 17 % of specifications.md.

Fix: set `power_load` so that the battery lasts as long as specifications.md says, or correct
specifications.md.
Source: endurances that SubT reviewers accepted, and the parameters of the battery plugins in the
same packages (`subt_standards.json`).
"""

from checker.model.battery import RELEASE, batteries
from checker.model.robot import Robot
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

SECONDS = 60.0


@rule("BAT003", "endurance-differs-from-specification", Severity.WARNING, Concern.PAPERWORK)
def check(
    robot: Robot, specification: Specification, context: Context, *, tolerance: float = 0.2
) -> Findings:
    """Compare the endurance of specifications.md with how long the model's battery lasts.

    Options:
        tolerance: Share of the endurance in specifications.md by which the model's may differ, in
            addition to the rounding of the figure there; more is reported.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    stated = specification.endurance
    if stated is None or stated.value <= 0.0:
        return
    if context.release != RELEASE:
        yield unchecked(f"how fast a battery drains is known for Gazebo {RELEASE.title()} only")
        return
    for battery in batteries(robot):
        if battery.minutes is None:
            continue
        seconds = battery.minutes * SECONDS
        if abs(seconds - stated.value) > tolerance * stated.value + stated.resolution / 2:
            yield finding(
                stated,
                f"specifications.md says {_minutes(stated.value)}, but the model's battery "
                f"lasts about {_minutes(seconds)}",
                related=[(battery, "the load of the battery")],
            )


def _minutes(seconds: float) -> str:
    return f"{seconds / SECONDS:.3g} minutes"


def _battery(load: str, more: str = "") -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::LinearBatteryPlugin">
  <open_circuit_voltage_constant_coef>12.694</open_circuit_voltage_constant_coef>
  <open_circuit_voltage_linear_coef>-3.1424</open_circuit_voltage_linear_coef>
  <initial_charge>78.4</initial_charge>
  <capacity>78.4</capacity>
  <power_load>{load}</power_load>{more}
</plugin>
"""


_SHEET = "# Rover\n### Endurance Characteristics\n"
_MARK = "<!-- ^ BAT003 -->"

GOOD = [
    {"@fragment": _battery("9.9"), "specifications.md": f"{_SHEET}* Battery life of 1 hour\n"},
    {
        "@fragment": _battery("9.9"),
        "specifications.md": f"{_SHEET}A battery life of 4 hours, but the model has been limited "
        "to have 1 hour endurance.\n",
    },
    {"@fragment": _battery("9.9"), "specifications.md": f"{_SHEET}Runs for the whole day.\n"},
    {
        "@fragment": _battery("2", "<fix_issue_225>true</fix_issue_225>"),
        "specifications.md": f"{_SHEET}* Battery life of 1 hour\n",
    },
]
BAD = [
    {
        "@fragment": _battery("4.95"),
        "specifications.md": f"{_SHEET}* Battery life of 3600 seconds {_MARK}\n",
    },
    {
        "@fragment": _battery("9.9"),
        "specifications.md": f"{_SHEET}The battery lasts 7200 seconds. {_MARK}\n",
    },
]
