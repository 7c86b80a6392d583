"""Small robots that drive, and their trials, in this process."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from checker.base.background import Background
from checker.base.cache import NO_CACHE, Cache
from checker.base.parts import WorkerFailed
from checker.model.robot import Robot
from checker.physics.trial.drivers.plans import plan_of
from checker.physics.trial.mjcf.scene import build_scene
from checker.physics.trial.run import start_trial
from checker.physics.trial.trial import Trial
from checker.physics.trial.worker import run_trial
from tests.model.robots import sdf

STEP = 0.002


def trial_in_child(robot: Robot, cache: Cache = NO_CACHE) -> Trial | WorkerFailed | str:
    """Return the trial of a robot as a check has it made, or why it has none."""
    started = start_trial(robot, cache)
    return started.result() if isinstance(started, Background) else started


def box_inertia(mass: float, x: float, y: float, z: float) -> str:
    moments = [mass * (a * a + b * b) / 12 for a, b in ((y, z), (x, z), (x, y))]
    return _inertia(moments)


def wheel_inertia(mass: float, radius: float, width: float) -> str:
    """Of a cylinder about y."""
    across = mass * (3 * radius**2 + width**2) / 12
    return _inertia((across, mass * radius**2 / 2, across))


def _inertia(moments: Sequence[float]) -> str:
    xx, yy, zz = moments
    return (
        f"<inertia><ixx>{xx}</ixx><iyy>{yy}</iyy><izz>{zz}</izz>"
        "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
    )


def plugin(name: str, content: str) -> str:
    return f'<plugin filename="d" name="ignition::gazebo::systems::{name}">{content}</plugin>'


def elements(values: Mapping[str, object]) -> str:
    return "".join(f"<{tag}>{value}</{tag}>" for tag, value in values.items())


def friction(mu: float) -> str:
    return f"<surface><friction><ode><mu>{mu}</mu><mu2>{mu}</mu2></ode></friction></surface>"


def wheel(
    name: str,
    x: float,
    y: float,
    *,
    radius: float = 0.1,
    axis: str = "0 1 0",
    mu: float = 1.0,
    parent: str = "base_link",
    effort: float = 50.0,
    width: float = 0.06,
    damping: float = 0.0,
) -> str:
    return f"""
<link name="{name}"><pose>{x} {y} {radius} 0 0 0</pose>
  <inertial><mass>1</mass>{wheel_inertia(1, radius, width)}</inertial>
  <collision name="c"><pose>0 0 0 1.5707963267948966 0 0</pose><geometry><cylinder>
    <radius>{radius}</radius><length>{width}</length></cylinder></geometry>{friction(mu)}</collision>
</link>
<joint name="{name}_joint" type="revolute"><parent>{parent}</parent><child>{name}</child>
  <axis><xyz>{axis}</xyz><limit><lower>-1e16</lower><upper>1e16</upper><effort>{effort}</effort>
  </limit><dynamics><damping>{damping}</damping></dynamics></axis></joint>"""


def chassis(mass: float = 20.0, com: str = "0 0 0", height: float = 0.15) -> str:
    return f"""
<link name="base_link"><pose>0 0 {height} 0 0 0</pose>
  <inertial><pose>{com} 0 0 0</pose><mass>{mass}</mass>{box_inertia(mass, 0.5, 0.3, 0.1)}</inertial>
</link>"""


def diff_drive(
    left: Sequence[str],
    right: Sequence[str],
    *,
    separation: float = 0.5,
    radius: float = 0.1,
    limits: str = "<max_velocity>1</max_velocity><min_velocity>-1</min_velocity>"
    "<max_acceleration>3</max_acceleration><min_acceleration>-3</min_acceleration>",
) -> str:
    joints = "".join(f"<left_joint>{name}_joint</left_joint>" for name in left)
    joints += "".join(f"<right_joint>{name}_joint</right_joint>" for name in right)
    sizes = elements({"wheel_separation": separation, "wheel_radius": radius})
    return plugin("DiffDrive", joints + sizes + limits)


LEFT, RIGHT = ("fl", "rl"), ("fr", "rr")


def four_wheels(
    *,
    mass: float = 20.0,
    com: str = "0 0 0",
    separation: float = 0.5,
    base: float = 0.4,
    radius: float = 0.1,
    mu: float = 1.0,
    axis: str = "0 1 0",
    plugin_separation: float | None = None,
    plugin_radius: float = 0.1,
    damping: float = 0.0,
    **options: str,
) -> Robot:
    places = {name: (base / 2 * (1 if name[0] == "f" else -1)) for name in (*LEFT, *RIGHT)}
    wheels = "".join(
        wheel(
            name, x, separation / 2 * (1 if name[1] == "l" else -1),
            radius=radius, axis=axis, mu=mu, damping=damping,
        )
        for name, x in places.items()
    )  # fmt: skip
    drive = diff_drive(
        LEFT,
        RIGHT,
        separation=plugin_separation if plugin_separation is not None else separation,
        radius=plugin_radius,
        **options,
    )
    return sdf(chassis(mass, com) + wheels + drive)


def tracks(
    *, com: str = "0 0 0", efficiency: float = 1.0, y_axis: str = "0 0 0", mu: float = 1.0
) -> Robot:
    """A robot on two belts; `y_axis` turns the right one's link (roll, pitch, yaw)."""
    belts = "".join(
        f"""
<link name="{name}"><pose>0 {y} 0.1 {turn}</pose>
  <inertial><mass>4</mass>{box_inertia(4, 0.6, 0.1, 0.2)}</inertial>
  <collision name="c"><geometry><box><size>0.6 0.1 0.2</size></box></geometry>{friction(mu)}
  </collision></link>
<joint name="{name}_joint" type="fixed"><parent>base_link</parent><child>{name}</child></joint>"""
        for name, y, turn in (("left", 0.25, "0 0 0"), ("right", -0.25, y_axis))
    )
    controllers = "".join(
        plugin("TrackController", f"<link>{name}</link>") for name in ("left", "right")
    )
    vehicle = plugin(
        "TrackedVehicle",
        "<left_track><link>left</link></left_track><right_track><link>right</link></right_track>"
        + elements({"tracks_separation": 0.5, "steering_efficiency": efficiency})
        + "<linear_velocity><max_velocity>1</max_velocity><min_velocity>-1</min_velocity>"
        "<max_acceleration>2</max_acceleration><min_acceleration>-2</min_acceleration>"
        "</linear_velocity>",
    )
    return sdf(chassis(20.0, com, 0.2) + belts + vehicle + controllers)


def trial_of(robot: Robot, timestep: float = STEP) -> Trial:
    """Drive a robot in this process."""
    plan = plan_of(robot)
    belts = [belt.link for belt in plan.belts]
    scene = build_scene(robot, servos=(*plan.speeds, *plan.places), belts=belts)
    assert not scene.unusable
    trial = run_trial(scene, plan, timestep)
    assert not trial.refused
    return trial


def sound(robot: Robot) -> Trial:
    """Drive a robot that must come through."""
    trial = trial_of(robot)
    assert trial.trouble == ()
    return trial


def value(trial: Trial, name: str, part: str = "") -> float:
    found = trial.value(name, part)
    assert found is not None, f"{name} was not measured"
    return found
