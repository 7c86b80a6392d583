"""Masses, endurance, motion limits and lines that a sheet claims."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.specification.motion import MotionQuantity as Motion
from checker.model.specification.quantities import QuantityKind
from checker.model.specification.sheet import read_specification
from checker.source.text import SourceText
from tests.effort import large, limited


@pytest.mark.parametrize(
    ("text", "value", "marked", "approximate"),
    [
        ("Its weight is approximately 38 kg (heavy).", 38, "38 kg", True),
        ("The total robot weight is approximately 150Kg.", 150, "150Kg", True),
        ("It weighs 3557 grams.", 3.557, "3557 grams", False),
        ("Its weight is 85 lbs (two-person heft).", 85 * 0.45359237, "85 lbs", False),
        ("vehicle weight: 40kg (37kg base mass + 3kg sensor payload)", 40, "40kg", False),
        ("Mass: 1,250.5 kg", 1250.5, "1,250.5 kg", False),
    ],
)
def test_the_mass_of_the_robot(sheet, text, value, marked, approximate):
    mass = sheet(text).total_mass
    assert mass.value == pytest.approx(value)
    assert (mass.span.text, mass.approximate) == (marked, approximate)


@pytest.mark.parametrize(
    "text",
    [
        "The 4 kg sensory backpack is not expected to matter",
        "under the maximum declared payload weight (11 kg)",
        "With weight under 30 kg it can be carried",
        "The battery weighs 2 kg.",
        "It costs 300 USD",
        "It weighs ~~30 kg~~ much",
        "Sensor config 2 weighs 31 kg.",
    ],
)
def test_other_masses_are_not_the_robots(sheet, text):
    assert sheet(text).total_mass is None


def test_an_exact_mass_counts_more_than_an_approximate_one(sheet):
    assert sheet("It weighs ~45 kg. It weighs 46.6 kg.").total_mass.value == 46.6


def test_a_rounded_mass_gives_way_to_one_with_more_digits(sheet):
    assert sheet("It weighs 3.6 kg. It weighs 3557 grams.").total_mass.value == 3.557


def test_two_different_masses_are_no_claim(sheet):
    stated = sheet("It weighs 30 kg. It weighs 35 kg.")
    assert stated.total_mass is None
    assert [mass.kind for mass in stated.masses] == [QuantityKind.TOTAL_MASS] * 2


@pytest.mark.parametrize(
    ("text", "seconds", "marked"),
    [
        ("Battery life of 4269 seconds", 4269, "4269 seconds"),
        ("Endurance of the platform is approximately 312 minutes", 18720, "312 minutes"),
        ("Endurance is calculated as 64.7 minutes.", 3882, "64.7 minutes"),
        ("Battery limited to 1 hour until validation is completed.", 3600, "1 hour"),
        ("Limited to default 10 minutes as tests are not completed.", 600, "10 minutes"),
        ("The endurance is 2 hours and 6 minutes.", 7560, "2 hours and 6 minutes"),
        ("Battery life of ~~5400 seconds~~, currently modeled as 1 hour until", 3600, "1 hour"),
        (
            "A battery life of 14400 seconds, but the model has been limited to have 1 hour",
            3600,
            "1 hour",
        ),
        ("The endurance has been set at one hour.", 3600, "one hour"),
        ("An endurance of 2 hours. A run time of 2 hours and 6 minutes.", 7200, "2 hours"),
        ("endurance of approximately 12 minutes or 720 seconds", 720, "12 minutes"),
    ],
)
def test_endurance(sheet, text, seconds, marked):
    endurance = sheet(text, "Endurance Characteristics").endurance
    assert endurance.value == pytest.approx(seconds)
    assert endurance.span.text == marked


@pytest.mark.parametrize(
    "text",
    [
        "The battery started at 16.57V after driving in a circle for 20 minutes.",
        "10482 seconds = 1200 seconds * 3",
        "It can fly for over 25 minutes.",
        "Battery life of 10 minutes. Endurance of 30 minutes.",
        "",
    ],
)
def test_unclear_endurance_is_no_claim(sheet, text):
    assert sheet(text, "Endurance").endurance is None


@pytest.mark.parametrize(
    "case",
    [
        (
            "* _x_ velocity range from -0.709 m/s to 0.704 m/s",
            *(Motion.LINEAR_VELOCITY, "x", -0.709, 0.704, "-0.709 m/s to 0.704 m/s"),
        ),
        (
            "* angular(z) velocity range from -2.6 to 2.6 rad/s",
            *(Motion.ANGULAR_VELOCITY, "z", -2.6, 2.6, "-2.6 to 2.6 rad/s"),
        ),
        (
            "* _x_ acceleration from -5.3 m/s<sup>2</sup> to 5.2 m/s<sup>2</sup>",
            Motion.LINEAR_ACCELERATION,
            *("x", -5.3, 5.2, "-5.3 m/s<sup>2</sup> to 5.2 m/s<sup>2</sup>"),
        ),
        (
            "* y acceleration range from -0.7 m/(s*s) to 0.9 m/(s*s)",
            *(Motion.LINEAR_ACCELERATION, "y", -0.7, 0.9, "-0.7 m/(s*s) to 0.9 m/(s*s)"),
        ),
        ("X velocity is +-3m/s", Motion.LINEAR_VELOCITY, "x", -3.0, 3.0, "+-3m/s"),
        ("Z turn rate is ±90 deg/s", Motion.ANGULAR_VELOCITY, "z", -math.pi / 2, math.pi / 2,
         "±90 deg/s"),
        ("Maximum forward speed is `0.4 m/s` with", Motion.LINEAR_VELOCITY, "x", None, 0.4,
         "0.4 m/s"),
        ("Top speed: 6 km/hour", Motion.LINEAR_VELOCITY, "", None, 6 / 3.6, "6 km/hour"),
        ("Velocity limited to 1.0m/S until", Motion.LINEAR_VELOCITY, "", None, 1.0, "1.0m/S"),
        ("_x_, _y_, and _z_ velocity from -4 m/s to 4 m/s.", Motion.LINEAR_VELOCITY, "xyz",
         -4.0, 4.0, "-4 m/s to 4 m/s"),
        ("Angular velocity ranges from -0.95 rad/s to 0.99 rad/s.", Motion.ANGULAR_VELOCITY, "",
         -0.95, 0.99, "-0.95 rad/s to 0.99 rad/s"),
    ],
)  # fmt: skip
def test_motion_limits(sheet, case):
    text, quantity, axes, minimum, maximum, marked = case
    (limit,) = sheet(text, "Motion Characteristics").limits
    assert (limit.quantity, limit.axes, limit.span.text) == (quantity, axes, marked)
    assert limit.maximum == pytest.approx(maximum)
    assert limit.minimum == (None if minimum is None else pytest.approx(minimum))


@pytest.mark.parametrize(
    "text",
    [
        "Flippers can rotate at a rate of approximately `0.8 rad/s`.",
        "There is also a maximum forward speed of each track, which is 0.4 m/s.",
        "An almost instant acceleration (`3 m/s^2` from IMU).",
        "X acceleration is +-4m/s",
        "Linear velocity - 5 5 2.8",
        "Sensor config 3 is limited to 0.6 m/s.",
    ],
)
def test_what_is_no_limit_of_the_robot(sheet, text):
    assert sheet(text, "Motion").limits == ()


def test_limits_are_read_in_the_motion_section_only(sheet):
    assert sheet("x velocity range from -1 m/s to 1 m/s", "Usage").limits == ()


def test_the_modeled_limit_counts_more_than_the_measured_one(sheet):
    stated = sheet(
        "* _x_ acceleration range from -3.60 m/s<sup>2</sup> to 6.61 m/s<sup>2</sup>"
        " (modeled as +- 4m/s/s)",
        "Motion",
    )
    limit = stated.limit(Motion.LINEAR_ACCELERATION, "x")
    assert (limit.minimum, limit.maximum, limit.span.text) == (-4.0, 4.0, "+- 4m/s/s")
    assert stated.limit(Motion.LINEAR_ACCELERATION, "y") is None


def test_two_different_limits_are_no_claim(sheet):
    stated = sheet("x velocity is ±1 m/s. x velocity is ±2 m/s.", "Motion")
    assert stated.limit(Motion.LINEAR_VELOCITY, "x") is None


@pytest.mark.parametrize(
    ("text", "metres", "marked"),
    [
        ("Turning radius of 1.60 m", 1.6, "1.60 m"),
        ("Turning radius of 0m, can turn on the spot", 0, "0m"),
        ("Minimum turning radius is 0, as the robot can turn in place.", 0, "0"),
        ("The turning radius is about 51 cm", 0.51, "51 cm"),
    ],
)
def test_turning_radius(sheet, text, metres, marked):
    (radius,) = sheet(text, "Motion").turning_radii
    assert radius.value == pytest.approx(metres)
    assert radius.span.text == marked


@pytest.mark.parametrize(
    "text", ["Turning radius is modeled by the plugin, line 24", "A turning radius of 5 things"]
)
def test_what_is_no_turning_radius(sheet, text):
    assert sheet(text, "Motion").turning_radii == ()


@pytest.mark.parametrize(
    ("text", "file", "ranges"),
    [
        (
            "torque &mdash; model.sdf, lines 1415 and 1417",
            "model.sdf",
            ((1415, 1415), (1417, 1417)),
        ),
        ("in the `spawner.rb` file, lines 23–26", "spawner.rb", ((23, 26),)),
        ("`launch/spawner.rb`, lines 22-25 and 36-39", "launch/spawner.rb", ((22, 25), (36, 39))),
        ("limit: model.sdf, line 553 to 556", "model.sdf", ((553, 556),)),
        ("`model.sdf` from line 390-394", "model.sdf", ((390, 394),)),
    ],
)
def test_line_references(sheet, text, file, ranges):
    (reference,) = sheet(text).line_references
    assert (reference.file.value, reference.file.span.text) == (file, file)
    assert reference.ranges == ranges


@pytest.mark.parametrize("text", ["see spawner.rb", "lines 3-4", "model.sdf. The lines 3"])
def test_what_is_no_line_reference(sheet, text):
    assert sheet(text).line_references == ()


@given(
    st.lists(
        st.sampled_from(
            ["# Motion\n", "# Endurance\n", "# Sensors\n", "* ", "1", "1.5", "-", "+-", " to ",
             " kg", " m/s", "<sup>2</sup>", " rad/s", " hours", " weighs ", "4 x camera ",
             "config 2 ", "modeled by ", "model.sdf, lines ", ".", "\n"]
        ),
        max_size=40,
    ).map("".join)
)  # fmt: skip
def test_no_text_makes_a_sheet_raise(text):
    sheet = read_specification(SourceText("s.md", text))
    claims = (*sheet.masses, *sheet.durations, *sheet.limits, *sheet.turning_radii, *sheet.sensors)
    assert all(claim.span.text for claim in (*claims, *sheet.line_references))
    assert sheet.total_mass in (None, *sheet.masses)


@pytest.mark.slow
@pytest.mark.parametrize(
    "piece",
    ["1 kg ", "weighs 1 kg ", "1 m/s to ", "max 1 m/s ", "1 hour and ", "limited to 1 hour ",
     "1,111", "model.sdf, lines 1, ", "turning radius of 0 ", "config 1 and ", "+-",
     "approx. ", "a.", " "]
)  # fmt: skip
def test_long_monotonous_sheets_take_little_time(piece):
    with limited(20):
        text = "# Motion endurance sensors\n* x" + piece * (large(200_000) // len(piece))
        sheet = read_specification(SourceText("s.md", text))
        assert sheet.total_mass is None
        assert len(sheet.limits) + len(sheet.sensors) < 20_000
        assert len(sheet.durations) + len(sheet.turning_radii) + len(sheet.line_references) < 20_000
