"""Types of sensors by release, and what the rules on them say of one robot and another target."""

from __future__ import annotations

import pytest

from checker.finding import Edit, Severity
from checker.model.sensing.kind import sensor_types, stated_frame
from checker.rule import Context, Finding
from checker.rulebook.discovery import all_rules
from tests.model.robots import sdf

RULES = {rule.id: rule for rule in all_rules()}
NO_PACKAGE = NOT_SPAWNED = None
"""A robot of SDF is for one simulator, whatever its package and its launch files."""
LIDAR = '<sensor name="scan" type="{}"><ray><range><max>9</max></range></ray></sensor>'


def said(rule: str, type: str, release: str, version: str = "1.6") -> list[Finding]:
    robot = sdf(f'<link name="body">{LIDAR.format(type)}</link>', version)
    rest = (NO_PACKAGE, NOT_SPAWNED) if rule == "SEN002" else ()
    found = RULES[rule].check(robot, Context(release=release), *rest)
    return [each for each in found if isinstance(each, Finding)]


def mended(text: str, edits: tuple[Edit, ...]) -> str:
    """Make edits of a text of one line."""
    for edit in sorted(edits, key=lambda each: each.place.column, reverse=True):
        start, end = edit.place.column - 1, edit.place.end_column - 1
        text = text[:start] + edit.replacement + text[end:]
    return text


@pytest.mark.parametrize(
    ("type", "release", "reported"),
    [
        ("gps", "dome", True),
        ("navsat", "harmonic", False),
        ("force_torque", "dome", True),
        ("custom", "harmonic", False),
        ("wide_angle_camera", "fortress", True),
        ("sonar", "", False),
        ("sonar", "classic", False),
        ("laser", "", True),
        ("laser", "classic", True),
        ("ray", "dome", False),
    ],
)
def test_what_is_simulated_depends_on_the_release(type: str, release: str, reported: bool) -> None:
    assert bool(said("SEN001", type, release)) is reported


def test_what_is_lost_is_known() -> None:
    for release in ("dome", "fortress", "harmonic", "ionic", "jetty"):
        types = sensor_types(release)
        assert types.lost < types.known
        assert {"gpu_lidar", "camera", "imu"} <= types.known - types.lost
    assert not sensor_types("").lost
    classic = sensor_types("classic")
    assert {"gpu_lidar", "navsat", "rgbd_camera"} <= classic.lost
    assert {"ray", "gpu_ray", "camera", "imu", "gps"} <= classic.known - classic.lost


@pytest.mark.parametrize(
    ("type", "release", "version", "severity"),
    [
        ("gpu_ray", "dome", "1.6", "info"),
        ("lidar", "dome", "1.6", "error"),
        ("gpu_ray", "", "1.6", "info"),
        ("lidar", "", "1.6", ""),
        ("gpu_ray", "", "1.5", ""),
        ("ray", "classic", "1.6", ""),
        ("gpu_ray", "classic", "1.6", ""),
    ],
)
def test_older_spellings(type: str, release: str, version: str, severity: str) -> None:
    grades = [
        str(each.severity or Severity.ERROR) for each in said("SEN002", type, release, version)
    ]
    assert grades == ([severity] if severity else [])


@pytest.mark.parametrize(
    ("type", "release", "after", "safety"),
    [
        ("gpu_ray", "dome", "gpu_lidar", "safe"),
        ("ray", "dome", "gpu_lidar", "unsafe"),
        ("ray", "", "lidar", "safe"),
    ],
)
def test_the_fix_renames_the_type_and_the_element(
    type: str, release: str, after: str, safety: str
) -> None:
    text = LIDAR.format(type)
    (found,) = said("SEN002", type, release)
    assert found.fix is not None
    assert str(found.fix.safety) == safety
    before = '<sdf version="1.6"><model name="robot"><link name="body">'
    whole = mended(f"{before}{text}</link></model></sdf>", found.fix.edits)
    expected = LIDAR.format(after).replace("ray>", "lidar>")
    assert whole == f"{before}{expected}</link></model></sdf>"


@pytest.mark.parametrize(
    ("release", "frame"),
    [("fortress", "body"), ("harmonic", "lens"), ("ionic", "lens"), ("", "lens")],
)
def test_a_camera_is_in_its_optical_frame_from_garden_on(release: str, frame: str) -> None:
    camera = """<sensor name="eye" type="camera">
  <gz_frame_id>body</gz_frame_id>
  <camera><optical_frame_id>lens</optical_frame_id></camera>
</sensor>"""
    stated = stated_frame(sdf(f'<link name="body">{camera}</link>').sensors[0].element, release)
    assert stated is not None
    assert stated.value == frame
