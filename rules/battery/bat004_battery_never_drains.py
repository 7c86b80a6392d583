"""A battery that never drains, or that is empty from the start.

A full battery lasts forever unless the plugin has a condition to start draining: `start_on_motion`,
or a `power_draining_topic` whose first message starts it. Gazebo Dome starts with the first command
to a joint. Tracks command no joint, so a tracked robot needs the topic.

A load of 0 W drains nothing, and with no charge the robot does not move at all.

Fix: write `<start_on_motion>true</start_on_motion>`; for tracks, `<power_draining_topic>` with the
command topic of each track.
Source: SubT reviews of tracked robots; the parameters that Dome's battery plugin reads
(`subt_plugins.json`).
"""

from collections.abc import Iterator

from checker.model.battery import Battery, batteries
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked


@rule("BAT004", "battery-never-drains", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report batteries that nothing starts, that have no load, or no charge.

    A tracked robot needs a topic.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    moved = robot.locomotion
    on_tracks_alone = bool(moved.tracked_drives) and not (moved.wheel_drives or moved.copters)
    for battery in batteries(robot):
        yield from _zeros(battery)
        if battery.draining_topics:
            continue
        if on_tracks_alone:
            yield finding(
                battery.plugin,
                "LinearBatteryPlugin has no <power_draining_topic>: tracks command no joint, so "
                "driving does not start the draining; add the tracks' command topics",
            )
        elif not battery.starts_on_motion:
            yield finding(
                battery.plugin,
                "LinearBatteryPlugin has neither <start_on_motion> nor <power_draining_topic>, so "
                "it never drains: add <start_on_motion>true</start_on_motion>",
            )


def _zeros(battery: Battery) -> Iterator[Finding]:
    """Report a battery without a load or a charge."""
    load, charge = battery.power_load, battery.plugin.number("initial_charge")
    if load is not None and load.value <= 0.0:
        yield finding(load, f"<power_load> is {load.value:g} W, so the battery never drains")
    if charge is not None and charge.value <= 0.0:
        yield finding(charge, "<initial_charge> is 0: the battery is empty from the start")


def _battery(parameter: str, mark: str = "") -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::LinearBatteryPlugin">{mark}
  {parameter}
</plugin>
"""


_MARK = " <!-- ^ BAT004 -->"
_MOTION = "<start_on_motion>true</start_on_motion>"
_TRACKS = """
<plugin filename="libt.so" name="ignition::gazebo::systems::TrackedVehicle">
  <left_track><link>base_link</link></left_track>
</plugin>
"""

GOOD = [
    _battery(_MOTION),
    _battery(f"{_MOTION}<power_load>9.9</power_load><initial_charge>78.4</initial_charge>"),
    _battery("<power_draining_topic>/model/r/cmd_vel</power_draining_topic>") + _TRACKS,
]
BAD = [
    _battery("", _MARK),
    _battery("<start_on_motion>false</start_on_motion>", _MARK),
    _battery(_MOTION, _MARK) + _TRACKS,
    _battery(f"{_MOTION}<power_load>0</power_load>{_MARK}"),
    _battery(f"{_MOTION}<initial_charge>0</initial_charge>{_MARK}"),
]
