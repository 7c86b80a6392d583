"""PID gains that are missing or cannot hold a joint.

A position controller without `pid` does not load: this is an error. One without a proportional gain
does not follow its command. A negative gain drives the joint away from its target. A derivative or
integral gain of zero is common.

Fix: give `pid: {p: …, i: …, d: …}` with p > 0 and the others 0 or more.
Source: ros_controllers (effort_controllers, velocity_controllers); control_toolbox, `Pid::init`.
"""

from collections.abc import Iterator, Mapping

from checker.ros.control.controllers import Controller, ControlSystem, Gain
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

NEED_GAINS: Mapping[str, tuple[str, ...]] = {
    "effort_controllers": (
        "JointPositionController",
        "JointVelocityController",
        "JointTrajectoryController",
        "JointGroupPositionController",
    ),
    "velocity_controllers": ("JointPositionController",),
}
"""Controllers that do not load without the gains of each joint."""

WHERE: Mapping[str, str] = {
    "JointTrajectoryController": "'gains/{joint}'",
    "JointGroupPositionController": "'{joint}/pid'",
}
"""The key under which a controller looks for its gains; 'pid' for controllers not listed here."""


@rule("CTL005", "pid-gains", Severity.WARNING, Concern.INTERFACE)
def check(control: ControlSystem, *, least_p: float = 0.0) -> Findings:
    """Report missing gains, proportional gains of `least_p` or less, and negative gains.

    Options:
        least_p: Proportional gain `p` of a controller, in its own unit; a gain from 0 up to this
            value is reported.
    """
    for controller in control.configured_controllers.values():
        yield from _missing(controller)
        for gains in {id(gain): gain for gain in controller.gains.values()}.values():
            yield from _proportional(controller, gains, least_p)
            yield from _negative(f"controller {controller.name!r}", gains)
    for simulated in control.simulator_gains:
        yield from _negative(f"gazebo_ros_control, joint {simulated.joint!r},", simulated.gains)


def _missing(controller: Controller) -> Findings:
    if controller.kind not in NEED_GAINS.get(controller.family, ()):
        return
    for joint in controller.joints:
        if joint.value not in controller.gains:
            key = WHERE.get(controller.kind, "'pid'").format(joint=joint.value)
            yield finding(
                controller,
                f"controller {controller.name!r} has no gains for joint {joint.value!r}, "
                f"expected p, i and d below {key}",
                severity=Severity.ERROR,
                key=f"missing {controller.full_name}",
            )


def _proportional(controller: Controller, gains: Mapping[str, Gain], least: float) -> Findings:
    gain = gains.get("p")
    who = f"controller {controller.name!r}"
    if gain is None:
        yield finding(controller, f"{who} has no gain p, expected more than {least:g}")
    elif gain.value is None:
        yield finding(gain, f"{who} has gain p = {gain.text}, which YAML does not read as a number")
    elif 0.0 <= gain.value <= least:
        yield finding(gain, f"{who} has gain p = {gain.value:g}, expected more than {least:g}")


def _negative(who: str, gains: Mapping[str, Gain]) -> Iterator[Finding]:
    for name, gain in gains.items():
        if gain.value is not None and gain.value < 0.0:
            yield finding(gain, f"{who} has gain {name} = {gain.value:g}, expected 0 or more")


def _config(
    rest: str, kind: str = "effort_controllers/JointPositionController"
) -> dict[str, object]:
    return {
        "@urdf": True,
        "config/control.yaml": f"""arm:
  shoulder_controller:  {rest.partition("|")[2]}
    joint: shoulder
    type: {kind}
{rest.partition("|")[0]}
""",
    }


_TRAJECTORY = "effort_controllers/JointTrajectoryController"

GOOD = [
    {"@urdf": True},
    _config("    pid: {p: 100, d: 0.0}"),
    _config("    pid: {p: $(arg p)}"),
    _config("", "effort_controllers/JointEffortController"),
    _config("", "position_controllers/JointPositionController"),
    _config("    gains:\n      shoulder: {p: 3.0, i: 0.0, d: 0.1}", _TRAJECTORY),
    _config("    shoulder: {pid: {p: 3.0}}", "effort_controllers/JointGroupPositionController"),
]
BAD = [
    _config("|# ^ CTL005"),
    _config("    pid: {i: 1.0}|# ^ CTL005"),
    _config("    gains:\n      elbow: {p: 3.0}|# ^ CTL005", _TRAJECTORY),
    _config("    pid: {p: 0.0, i: 1.0}  # ^ CTL005"),
    _config("    pid: {p: -3.0}  # ^ CTL005"),
    _config("    pid:\n      p: 3.0\n      d: -0.1  # ^ CTL005"),
    _config("    pid: {p: 1e2}  # ^ CTL005"),
    _config("  gazebo_ros_control:\n    pid_gains:\n      shoulder: {p: -1}  # ^ CTL005", "a/B"),
]
