"""A launch file that rewrites the tag of Gazebo's plugin gives it another file."""

from __future__ import annotations

from pathlib import Path

from checker.pipeline import check_package
from checker.rule_testing import write_example
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control
from checker.settings import Settings

REWRITES = "text = re.sub('<parameters>.*</parameters>', f'<parameters>{path}</parameters>', text)"


def test_a_file_in_a_rewritten_tag_is_not_checked(tmp_path: Path) -> None:
    plugin = gazebo_control("<parameters>config/arm.yaml</parameters>")
    example = {"@urdf": ros2_control(hardware=GAZEBO) + plugin, "launch/sim.launch.py": REWRITES}
    folder = write_example(example, tmp_path)
    settings = Settings(profile="ros2", profile_chosen=True, select=("R2C006",), trial=False)
    (report,) = check_package(folder, settings).packages
    assert report.findings == ()
    (unseen,) = (each for each in report.not_checked if each.rule == "R2C006")
    assert unseen.reason == "a launch file rewrites <parameters> of the description"
