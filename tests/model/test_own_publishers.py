"""Bridges of topics that a plugin of unknown source may publish are not judged."""

from __future__ import annotations

from pathlib import Path

import pytest

from checker.engine.judge import Judge
from checker.engine.run import run_rules
from checker.engine.subject import Subject
from checker.package.inputs import open_input
from checker.rule_testing import write_example
from checker.rulebook.discovery import all_rules
from checker.rulebook.profiles import profile
from checker.settings import Settings

OWN = '<plugin filename="libacme.so" name="acme::Publisher"/>'
NOBODYS = '<plugin filename="libnowhere.so" name="acme::Publisher"/>'
GAS = '<plugin filename="libGasEmitterDetectorPlugin.so" name="subt::GasDetector"/>'
MONO = '<plugin filename="mono-camera-system" name="subt::MonoCameraSystem"/>'
LAUNCH = """<launch>
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="b"
        args="/world/w/model/m/link/mast/sensor/eye/odd@sensor_msgs/Imu[ignition.msgs.IMU"/>
</launch>
"""


@pytest.mark.parametrize(
    ("in_model", "in_link", "in_sensor", "judged"),
    [
        ("", "", "", True),
        (GAS, "", "", True),
        (OWN, "", "", False),
        ("", OWN, "", False),
        ("", "", OWN, False),
        ("", "", MONO, False),
        (NOBODYS, "", NOBODYS, True),
    ],
)
def test_who_else_may_publish(
    in_model: str, in_link: str, in_sensor: str, judged: bool, tmp_path: Path
) -> None:
    sensor = f'<sensor name="eye" type="camera">{in_sensor}</sensor>'
    files = {
        "@fragment": f'{in_model}<link name="mast">{in_link}{sensor}</link>',
        "launch/vehicle_topics.launch": LAUNCH,
        "lib/libacme.so": "",
    }
    rules = [rule for rule in all_rules() if rule.id == "ROS002"]
    with open_input(write_example(files, tmp_path)) as opened:
        subject = Subject(opened.packages[0])
        outcome = run_rules(rules, subject, Judge(profile("subt"), Settings()))
    assert bool(outcome.findings) is judged
    assert bool(outcome.not_checked) is not judged
