"""Scenes of small robots, and where MuJoCo puts their parts."""

from __future__ import annotations

import mujoco
import numpy as np

from checker.model.robot import Robot
from checker.physics.trial.mjcf.scene import Scene, build_scene
from tests.model.robots import sdf

INERTIAL = "<inertial><mass>2</mass></inertial>"


def collision(shape: str, pose: str = "0 0 0 0 0 0", rest: str = "", name: str = "c") -> str:
    return (
        f'<collision name="{name}"><pose>{pose}</pose><geometry>{shape}</geometry>{rest}'
        "</collision>"
    )


def box(x: float, y: float, z: float) -> str:
    return f"<box><size>{x} {y} {z}</size></box>"


BALL = collision("<sphere><radius>0.1</radius></sphere>")


def link(name: str, content: str = BALL, pose: str = "0 0 0 0 0 0") -> str:
    return f'<link name="{name}"><pose>{pose}</pose>{content}</link>'


def joint(
    child: str, *, parent: str = "a", type: str = "revolute", rest: str = "", name: str = ""
) -> str:
    rest = rest or "<axis><xyz>0 0 1</xyz></axis>"
    return (
        f'<joint name="{name or child + "_joint"}" type="{type}"><parent>{parent}</parent>'
        f"<child>{child}</child>{rest}</joint>"
    )


def scene_of(content: str, version: str = "1.6", **options: object) -> Scene:
    return build_scene(sdf(content, version), **options)  # type: ignore[arg-type]


def compiled(scene: Scene) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Compile a scene and place its parts."""
    assert not scene.unusable
    model = mujoco.MjModel.from_xml_string(scene.mjcf)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def assert_placed_as(robot: Robot, scene: Scene) -> None:
    """Check that each body stands where the robot says that its link is."""
    model, data = compiled(scene)
    for name, body in scene.bodies.items():
        pose = robot.pose_of(name)
        assert pose is not None
        at = np.add(pose.translation, (0.0, 0.0, scene.spawn_height))
        np.testing.assert_allclose(data.body(body).xpos, at, rtol=0, atol=1e-12)
        turn = data.body(body).xmat.reshape(3, 3)
        np.testing.assert_allclose(turn, pose.rotation, rtol=0, atol=1e-12)
    assert model.nbody == len(scene.bodies) + 1
