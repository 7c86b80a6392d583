"""Which figures of a trial the rules object to, how gravely, and in which words."""

from __future__ import annotations

from typing import Any

import pytest
from msgspec.structs import replace

from checker.physics.trial.measures.figures import MEASURES
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial
from checker.physics.trial.trial import Leg, Measurement, Repair
from checker.rule import Severity, Unchecked
from checker.rulebook.discovery import all_rules
from checker.rulebook.example_parts import rover as example_rover
from tests.model.robots import sdf
from tests.trial.driven import rover, said_by, trial_of

RULES = {rule.id: rule for rule in all_rules() if rule.group == "TRI"}
ERROR, WARNING = Severity.ERROR, Severity.WARNING

JUDGED: list[tuple[str, dict[str, float], Severity | None]] = [
    ("TRI002", {"settle_drop": 0.012, "settle_tilt": 0.01, "rest_penetration": 3e-4}, None),
    ("TRI002", {"settle_drop": 0.4}, ERROR),
    ("TRI002", {"settle_tilt": 0.5}, ERROR),
    ("TRI002", {"settle_speed": 0.2}, ERROR),
    ("TRI003", {"speed_ratio": 0.98}, None),
    ("TRI003", {"speed_ratio": 1.07}, WARNING),
    ("TRI003", {"speed_ratio": 0.5}, ERROR),
    ("TRI003", {"speed_ratio": 0.0}, ERROR),
    ("TRI003", {"speed_ratio": -1.0}, None),  # TRI005
    ("TRI004", {"speed_ratio": 1.0, "path_sideways": 1e-4, "path_heading": 0.001}, None),
    ("TRI004", {"speed_ratio": 1.0, "path_sideways": -0.05}, WARNING),
    ("TRI004", {"speed_ratio": 1.0, "path_sideways": 0.05, "path_heading": 0.2}, ERROR),
    ("TRI004", {"speed_ratio": 0.01, "path_sideways": 3.0}, None),  # it has gone nowhere
    ("TRI005", {"speed_ratio": 1.0, "yaw_ratio": 0.2}, None),
    ("TRI005", {"speed_ratio": -0.01, "yaw_ratio": -0.01}, None),
    ("TRI005", {"speed_ratio": -0.9}, ERROR),
    ("TRI005", {"yaw_ratio": -0.3}, ERROR),
    ("TRI006", {"yaw_rate": 0.15, "yaw_ratio": 0.15, "yaw_of_predicted": 0.9}, None),
    (
        "TRI006",
        {"yaw_rate": 0.15, "yaw_ratio": 0.15, "yaw_of_predicted": 0.4, "yaw_predicted": 0.4},
        WARNING,
    ),
    ("TRI006", {"yaw_rate": 0.0, "yaw_ratio": 0.0}, ERROR),
    ("TRI006", {"yaw_rate": -0.5, "yaw_ratio": -0.5}, None),  # TRI005
    ("TRI008", {"stop_speed": 0.001}, None),
    ("TRI008", {"stop_speed": 0.3}, ERROR),
    ("TRI010", {"hover_effort": 0.4, "hover_sink": 0.01, "climbed": 1.0}, None),
    ("TRI010", {"hover_effort": 1.3}, ERROR),
    ("TRI010", {"hover_effort": 0.4, "climbed": 0.1}, ERROR),
    ("TRI011", {"hold_sink": 0.01, "hold_tilt": 0.02}, None),
    ("TRI011", {"hold_tilt": 0.6}, WARNING),
    ("TRI013", {"rest_penetration": 0.004}, None),
    ("TRI013", {"rest_penetration": 0.02}, WARNING),
    ("TRI013", {"rest_penetration": 0.2}, None),  # TRI002
    ("TRI014", {"full_speed": 1.0, "full_speed_limit": 1.0}, None),
    ("TRI014", {"full_speed": 1.2, "full_speed_limit": 1.0}, WARNING),
    ("TRI014", {"full_acceleration": 4.0, "full_acceleration_limit": 2.0}, WARNING),
    ("TRI014", {"full_speed": 3.0}, None),  # no limit stated
    ("TRI017", {"energy_gain": 0.001}, None),
    ("TRI017", {"energy_gain": 0.5}, WARNING),
    ("TRI018", {"turn_drift": 0.3}, None),
    ("TRI018", {"turn_drift": 1.2}, WARNING),
]


@pytest.mark.parametrize(("id", "figures", "severity"), JUDGED)
def test_figure_is_judged(id: str, figures: dict[str, float], severity: Severity | None) -> None:
    rule = RULES[id]
    found = said_by(rule, trial_of(**figures))
    assert [each.severity or rule.severity for each in found] == ([severity] if severity else [])
    for each in found:
        assert set(each.key.split()) <= MEASURES.keys()


PARTS: list[tuple[str, list[Measurement], list[Severity]]] = [
    ("TRI007", [Measurement("load_share", 1.02, "left_front")], []),
    ("TRI007", [Measurement("load_share", 0.03, "left_front")], [WARNING]),
    ("TRI007", [Measurement("load_share", 0.0, "left_front")], [ERROR]),
    ("TRI009", [Measurement("torque", 9.0, "left_front_joint")], []),
    (
        "TRI009",
        [
            Measurement("torque", 9.0, "left_front_joint"),
            Measurement("torque_limit", 5.0, "left_front_joint"),
        ],
        [WARNING],
    ),
    ("TRI011", [Measurement("hold_sag", 0.3, "left_front_joint")], [WARNING]),
    ("TRI015", [Measurement("sweep_overlap", 0.004, "left_front", "base_link")], []),
    ("TRI015", [Measurement("sweep_overlap", 0.03, "left_front", "base_link")], [WARNING]),
]


@pytest.mark.parametrize(("id", "figures", "severities"), PARTS)
def test_figure_of_a_part_is_judged_there(
    id: str, figures: list[Measurement], severities: list[Severity]
) -> None:
    robot, rule = rover(), RULES[id]
    found = said_by(rule, trial_of(*figures), robot)
    assert [each.severity or rule.severity for each in found] == severities
    for each in found:
        part = RobotTrial(robot, trial_of()).part(figures[0].part)
        assert each.places[0] == part.span.place()
        assert repr(figures[0].part) in each.message


def message(id: str, **said: Any) -> str:
    robot = said.pop("robot", None)
    (found,) = said_by(RULES[id], trial_of(**said), robot)
    return found.message


@pytest.mark.parametrize(
    ("lift", "heading", "severity", "words"),
    [
        (
            3e-3,
            0.001,
            WARNING,
            "; wheel 'rr_wheel' is 3 mm above the level of the others: correct ",
        ),
        (3e-3, 0.1, ERROR, "the height of 'rr_joint'"),
        (9e-3, 0.001, ERROR, "; wheel 'rr_wheel' is 9 mm above"),
        (0.0, 0.001, ERROR, "expected at least 5% of an equal share"),
    ],
)
def test_a_wheel_that_hangs_names_the_one_that_is_off_the_level(
    lift: float, heading: float, severity: Severity, words: str
) -> None:
    text = example_rover().replace(
        "<pose>-0.2 -0.2 0.1 0 0 0</pose>", f"<pose>-0.2 -0.2 {0.1 + lift} 0 0 0</pose>"
    )
    robot = sdf(text[text.index("<link") : text.index("</model>")])
    hanging = Measurement("load_share", 0.0, "fl_joint")
    trial = trial_of(hanging, path_sideways=0.0, path_heading=heading)
    (found,) = said_by(RULES["TRI007"], trial, robot)
    assert found.severity is severity
    assert words in found.message


def test_speed_that_the_wheel_radius_explains() -> None:
    said = message("TRI003", speed_ratio=0.5)
    assert said.startswith(
        "the robot drives at 0.25 m/s when commanded to drive at 0.5 m/s: a difference of 50%"
    )
    assert "wheel_radius" not in said
    said = message("TRI003", speed_ratio=0.5, robot=rover(wheel_radius=0.2))
    assert said.endswith("; wheel_radius is 0.2 m, but the wheels have a radius of 0.1 m")


def test_a_difference_does_not_round_to_what_is_allowed() -> None:
    said = message("TRI003", speed_ratio=0.949)
    assert said.endswith("a difference of 5.1%, expected at most 5%")


def test_a_robot_whose_axles_lie_along_x_drives_along_y() -> None:
    sideways = rover(axis="1 0 0")
    (found,) = said_by(RULES["TRI003"], trial_of(speed_ratio=0.004, path_sideways=20.0), sideways)
    assert found.message.startswith("the robot drives along y, not along x (REP 103)")
    assert found.message.endswith("turn the joints of the wheels, or the base, by 90°")
    assert found.key == "speed_ratio path_sideways"
    said = message("TRI003", speed_ratio=0.5, robot=sideways)
    assert "REP 103" not in said


def test_what_slides_is_named_where_a_robot_is_slow() -> None:
    slow = trial_of(Measurement("drag", 0.3, "base_link"), speed_ratio=0.5)
    (found,) = said_by(RULES["TRI003"], slow)
    assert found.severity is WARNING
    assert found.message.endswith(
        "; link 'base_link' slides on the ground, and its friction is 30% of the robot's weight: "
        "give it <mu> and <mu2> of 0.001"
    )
    slow = trial_of(Measurement("drag", 0.01, "base_link"), speed_ratio=0.5)
    assert [found.severity for found in said_by(RULES["TRI003"], slow)] == [ERROR]


@pytest.mark.parametrize(
    ("robot", "figures", "words"),
    [
        (
            rover(axis="0 -1 0"),
            {"speed_ratio": -1.0, "yaw_ratio": -0.3},
            "the wheels' axes are reversed",
        ),
        (
            rover(left="right", right="left"),
            {"speed_ratio": 1.0, "yaw_ratio": -0.3},
            "left and right are swapped",
        ),
        (rover(), {"speed_ratio": -1.0, "yaw_ratio": 0.3}, "it faces backward"),
    ],
)
def test_the_wrong_way_names_its_cause(robot: Any, figures: dict[str, float], words: str) -> None:
    (found,) = said_by(RULES["TRI005"], trial_of(**figures), robot)
    assert words in found.message
    suspects = [place.note for place in found.places[1:]]
    assert bool(suspects) is ("faces" not in words)


@pytest.mark.parametrize(
    ("explained", "side", "front", "words"),
    [
        (
            1.1,
            0.055,
            0.0,
            "the centre of mass 55 mm left of the middle of the wheels explains 1.1 m",
        ),
        (1.0, -0.03, 0.02, "30 mm right of and 20 mm before the middle of the wheels"),
        (0.1, 0.01, 0.0, "its centre of mass explains 0.1 m of it; the rest has another cause"),
    ],
)
def test_drift_says_what_the_centre_of_mass_explains(
    explained: float, side: float, front: float, words: str
) -> None:
    said = message(
        "TRI018",
        turn_drift=1.2,
        turn_drift_explained=explained,
        com_offset_side=side,
        com_offset_front=front,
    )
    assert said.startswith(
        "the robot drifts 1.2 m while turning in place, expected at most 0.5 m: "
    )
    assert words in said


REPAIRS = (
    Repair("left_front_joint", "has an axis of length 0 and is held fixed", serious=True),
    Repair("left_front", "has a collision 'c' that has a size that is not above 0", serious=True),
    Repair("right_front", "has a collision 'c' that uses a mesh without volume", serious=True),
    Repair("left_front", "has a zero principal moment; 1e-7 kg·m² is used", serious=True),
    Repair("left_rear", "has a negative mass; 0.001 kg is used", serious=True),
    Repair("right_rear", "has an unknown pose; the origin is used"),
)


def test_repairs_are_said_where_no_other_rule_says_them() -> None:
    (said,) = said_by(RULES["TRI001"], trial_of(repairs=REPAIRS))
    assert "'right_front' has a collision 'c' that uses a mesh without volume" in said.message


def test_a_model_that_is_refused_is_said_to_be_and_nothing_else() -> None:
    trial = trial_of(refused="'left_front' is no body", refused_part="left_front", legs=())
    said = {id: said_by(rule, trial) for id, rule in RULES.items() if id != "TRI016"}
    assert [id for id, found in said.items() if found] == ["TRI001"]
    assert "'left_front' is no body" in said["TRI001"][0].message


def test_trouble_of_the_solver_is_an_error() -> None:
    assert "grows without bound" in message("TRI012", trouble=("grows without bound",))


def test_a_drive_that_may_stand_in_an_unread_spawner_is_not_passed() -> None:
    robot = replace(sdf("<link name='base_link'/>"), unread_plugins="the spawner calls system")
    trial = trial_of(drive="no drive detected", legs=(Leg("settle", 0.0, 2.0),))
    (said,) = RULES["TRI003"].check(RobotTrial(robot, trial))
    assert said == Unchecked("the spawner calls system")


def test_a_figure_that_moves_with_the_time_step_is_named() -> None:
    once, again = trial_of(speed_ratio=1.0, turn_drift=0.1), trial_of(speed_ratio=0.8)
    (found,) = RULES["TRI016"].check(RepeatedTrial(rover(), once, again=again))
    assert not isinstance(found, Unchecked)
    assert "speed reached / commanded changes from 1 to 0.8" in found.message
    assert not list(RULES["TRI016"].check(RepeatedTrial(rover(), once, again=once)))


@pytest.mark.parametrize(
    ("library", "named"), [("libgazebo_ros_diff_drive.so", False), ("diff-drive.so", True)]
)
def test_a_limit_is_the_cause_where_the_simulator_enforces_it(library: str, named: bool) -> None:
    joint = """<link name="{0}"><pose>0 {1} 0.1 0 0 0</pose><collision name="c"><geometry><sphere>
      <radius>0.1</radius></sphere></geometry></collision></link>
      <joint name="{0}_joint" type="revolute"><parent>base_link</parent><child>{0}</child>
      <axis><xyz>0 1 0</xyz><limit><velocity>1</velocity></limit></axis></joint>"""
    robot = sdf(
        f'''<link name="base_link"/>{joint.format("left", 0.2)}{joint.format("right", -0.2)}
        <plugin filename="{library}" name="ignition::gazebo::systems::DiffDrive">
        <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
        <wheel_radius>0.1</wheel_radius><wheel_diameter>0.2</wheel_diameter></plugin>'''
    )
    assert robot.locomotion.drives
    (found,) = said_by(RULES["TRI003"], trial_of(speed_ratio=0.5), robot)
    assert ("at most and needs 5 rad/s" in found.message) is named
