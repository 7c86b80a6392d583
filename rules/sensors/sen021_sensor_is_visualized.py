"""A sensor that the simulator visualizes.

`<visualize>` draws the rays or the view of a sensor in the simulator's window. It helps during
modelling; in a run it costs time and hides the scene.

Fix: write `<visualize>0</visualize>`.
Source: SDFormat specification, sensor/visualize; SubT model reviews (`subt_standards.json`, lidar).
"""

from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule


@rule("SEN021", "sensor-is-visualized", Severity.INFO, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report sensors whose `<visualize>` is true."""
    for sensor in robot.sensors:
        shown = ValueReader().boolean(sensor.element, "visualize", False)
        if shown.value:
            yield finding(
                shown,
                f"sensor {sensor.name.value!r} is visualized; expected <visualize>0",
                key="visualize",
                fix=replace_text(shown, "false" if shown.span.text.isalpha() else "0"),
            )


def _sensor(visualize: str) -> str:
    return f"""
<sensor name="lidar" type="gpu_lidar">
  {visualize}
</sensor>
"""


GOOD = [_sensor("<visualize>0</visualize>"), _sensor("<visualize>perhaps</visualize>"), _sensor("")]
BAD = [
    _sensor("<visualize>1</visualize>  <!-- ^ SEN021 -->"),
    _sensor("<visualize>true</visualize>  <!-- ^ SEN021 -->"),
]
