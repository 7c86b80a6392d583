"""The exported MJCF is the trial: from its keyframe, with the same commands, the same poses."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from checker.cli import main
from checker.cli.export import exported
from checker.convert.mjcf_files import scene_of_trial
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.physics.trial.plan import Plan
from checker.physics.trial.run import TIMESTEP
from checker.physics.trial.trial import Replay
from checker.physics.trial.worker import run_trial
from checker.pipeline import Task
from support.real_packages import CORPUS, named_folder, needs

ROOM = 1e-9
"""What `surfacevel` states of a belt that runs at 1 m/s."""
ON_WHEELS = 5e-6
"""Metres. A keyframe leaves out what MuJoCo's solver starts from, and a replay has float32."""
IN_THE_AIR = 2e-3
"""Metres: nothing steers the copter back, so that a difference grows with the time squared."""


class Exported:
    """An exported robot, as a user has it: the MJCF, and the commands beside it."""

    def __init__(self, package: Path, folder: Path) -> None:
        name = f"{folder}/made/"
        assert main(["export", str(package), "--format", "mjcf-replay", "--output", name]) == 0
        self.model: Any = mujoco.MjModel.from_xml_path(str(next(Path(name).glob("*.xml"))))
        self.data: Any = mujoco.MjData(self.model)
        with next(Path(name).glob("*.controls.csv")).open() as stream:
            self.head, *rows = csv.reader(stream)
        self.times = np.array([float(row[0]) for row in rows])
        self.values = np.array([list(map(float, row[1:])) for row in rows])
        belts = [word.removeprefix("belt:") for word in self.head if word.startswith("belt:")]
        self.belts = [self.model.geom(name).id for name in belts]
        self.ways = self.model.geom_surfacevel[self.belts, :3] / ROOM

    def replayed(self, state: str, seconds: float) -> dict[float, dict[str, Any]]:
        """Return where bodies are at each sample of the trial, by time and name."""
        model, data = self.model, self.data
        mujoco.mj_resetDataKeyframe(model, data, model.key(state).id)
        step, every = model.opt.timestep, round(0.05 / model.opt.timestep)
        places = {}
        for number in range(round(data.time / step), round(seconds / step)):
            row = self.values[np.searchsorted(self.times, number * step + step / 4) - 1]
            data.ctrl[:] = row[: model.nu]
            model.geom_surfacevel[self.belts, :3] = row[model.nu :, None] * self.ways
            mujoco.mj_step(model, data)
            if number % every == 0:
                places[number // every] = {
                    model.body(body).name: data.xpos[body].copy() for body in range(1, model.nbody)
                }
        return places


def trial_of(package: Path) -> tuple[Plan, Replay]:
    with open_input(package) as opened:
        subject = Subject(opened.packages[0])
        assert isinstance(subject.all(Robot), tuple)
        scene, plan = scene_of_trial(subject.all(Robot)[0])
        subject.close()
    replay = run_trial(scene, plan, TIMESTEP).replay
    assert replay is not None
    return plan, replay


def assert_same(package: Path, folder: Path) -> Exported:
    made, (plan, replay) = Exported(package, folder), trial_of(package)
    state = "hovering" if plan.rotors else "settled"
    places = made.replayed(state, plan.seconds)
    near = IN_THE_AIR if plan.rotors else ON_WHEELS
    poses = {link: np.array(flat).reshape(-1, 7) for link, flat in replay.poses.items()}
    assert len(places) > 50
    # Wheels with friction directions, which MJCF does not have, slide elsewhere in a turn.
    turn = plan.leg("turn") if any(wheel.friction for wheel in plan.wheels) else None
    last = replay.time.index(turn.start) if turn else max(places)
    for sample, bodies in places.items():
        if sample > last:
            break
        for link, pose in poses.items():
            assert bodies[link] == pytest.approx(pose[sample, :3], abs=near), (sample, link)
    return made


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "subtcheck_buggy_sensor_config_1",
        "subtcheck_crawler_sensor_config_1",
        "subtcheck_quadro_sensor_config_1",
        "husky_migration_sensor_config_1",
        "my_gurdy_description",
    ],
)
def test_samples(samples: Path, name: str, tmp_path: Path) -> None:
    made = assert_same(samples / name, tmp_path)
    model = made.model
    looks = (model.geom_contype == 0) & (model.geom_conaffinity == 0)
    # A robot that is held touches no ground.
    looks[model.geom("ground").id] = False
    assert looks.any()
    assert set(model.geom_group[looks]) == {2}
    assert set(model.geom_group[~looks]) <= {0, 3}


@pytest.mark.parametrize("robot", ["x1_sensor_config_6", "ctu_cras_norlab_absolem_sensor_config_1"])
@pytest.mark.parametrize("variable", [pytest.param(CORPUS, marks=needs(CORPUS))])
def test_real_robots(variable: str, robot: str, tmp_path: Path) -> None:
    folder = named_folder(variable)
    assert folder is not None
    assert_same(folder / robot, tmp_path)


def test_its_sensors_can_be_read(samples: Path, tmp_path: Path) -> None:
    made = Exported(samples / "husky_migration_sensor_config_1", tmp_path)
    mujoco.mj_resetDataKeyframe(made.model, made.data, 0)
    mujoco.mj_forward(made.model, made.data)
    felt = made.data.sensor("imu_sensor/accelerometer").data
    assert felt == pytest.approx((0.0, 0.0, 9.81), abs=0.05)
    assert made.data.sensor("front_left_wheel_joint/vel").data == pytest.approx(0.0, abs=1e-3)
    camera = made.model.camera("camera_front")
    wide, high, angle = 640, 480, made.data.cam_xmat[camera.id].reshape(3, 3)
    assert -angle[:, 2] == pytest.approx((1, 0, 0), abs=0.01)
    assert angle[:, 1] == pytest.approx((0, 0, 1), abs=0.01)
    assert 0.0 < camera.fovy[0] < 90.0 * wide / high


def test_one_file_holds_everything(samples: Path, tmp_path: Path) -> None:
    package = samples / "subtcheck_buggy_sensor_config_1"
    text = exported(Task(package), "mjcf-replay").text
    assert "file=" not in text
    model = mujoco.MjModel.from_xml_string(text)
    assert [model.key(number).name for number in range(model.nkey)] == ["settled"]
    apart = Exported(package, tmp_path).model
    assert (model.ngeom, model.nmesh, model.nu) == (apart.ngeom, apart.nmesh, apart.nu)
    np.testing.assert_array_equal(model.key_qpos, apart.key_qpos)


def test_a_folder_is_made_with_those_above_it(samples: Path, tmp_path: Path) -> None:
    package = samples / "subtcheck_buggy_sensor_config_1"
    target = f"{tmp_path}/a/b/"
    assert main(["export", str(package), "--format", "urdf", "--output", target]) == 0
    assert [path.name for path in (tmp_path / "a/b").iterdir()] == [f"{package.name}.urdf"]
