"""What cameras and IMUs are set to: pinholes, ranges and noise."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.sensing.camera import DEFAULT_PINHOLE, Camera, read_camera
from checker.model.sensing.imu import read_imu
from checker.source.text import SourceText
from checker.source.xml import Element, XmlDocument, parse_xml


def element(text: str) -> Element:
    document = parse_xml(SourceText("model.sdf", text))
    assert isinstance(document, XmlDocument)
    return document.root


def camera(inside: str) -> Camera:
    read = read_camera(element(f"<sensor><camera>{inside}</camera></sensor>"))
    assert read is not None
    return read


def picture(width: object, height: object, angle: object) -> Camera:
    image = f"<image><width>{width}</width><height>{height}</height></image>"
    return camera(f"<horizontal_fov>{angle}</horizontal_fov>{image}")


@given(st.integers(1, 10_000), st.integers(1, 10_000), st.floats(0.01, 3.1))
def test_the_edge_of_a_picture_is_half_its_view_away_from_the_middle(
    width: int, height: int, angle: float
) -> None:
    pinhole = picture(width, height, repr(angle)).pinhole
    assert pinhole is not None
    assert 2.0 * math.atan2(width / 2.0, pinhole.fx) == pytest.approx(angle)
    assert pinhole.fx == pinhole.fy
    assert (pinhole.cx, pinhole.cy) == ((width - 1) / 2, (height - 1) / 2)


@given(st.floats(allow_nan=False), st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_no_figure_makes_a_pinhole_that_is_infinite(x: float, y: float, angle: float) -> None:
    pinhole = picture(repr(x), repr(y), repr(angle)).pinhole
    assert pinhole is None or (math.isfinite(pinhole.cx) and pinhole.fx > 0.0)


def test_the_defaults_fit_the_picture_that_they_are_made_for() -> None:
    pinhole = camera("").pinhole
    assert pinhole is not None
    assert DEFAULT_PINHOLE.agrees(pinhole, 0.01, 1.0)
    wider = picture(640, 480, 1.047).pinhole
    assert wider is not None
    assert not DEFAULT_PINHOLE.agrees(wider, 0.01, 1.0)


@pytest.mark.parametrize("cx", ["319.5", "320", "320.5"])
def test_a_centre_on_half_a_pixel_is_worked_out(cx: str) -> None:
    given = camera(f"<lens><intrinsics><cx>{cx}</cx><cy>240</cy></intrinsics></lens>").intrinsics
    assert given is not None
    assert not given.are_measured


def test_any_other_centre_is_measured() -> None:
    given = camera("<lens><intrinsics><cx>729.53</cx></intrinsics></lens>").intrinsics
    assert given is not None
    assert given.are_measured


def test_depth_reaches_as_far_as_the_picture_unless_stated_apart() -> None:
    clip = "<clip><near>0.2</near><far>300</far></clip>"
    assert camera(clip).depth_far.value == 300.0
    apart = camera(f"{clip}<depth_camera><clip><far>10</far></clip></depth_camera>")
    assert (apart.depth_near.value, apart.depth_far.value) == (0.2, 10.0)


def test_noise_knows_its_figures_by_their_tags() -> None:
    imu = read_imu(
        element(
            '<sensor><imu><angular_velocity><y><noise type="gaussian"><stddev>0.009</stddev>'
            "<precision>0.1</precision></noise></y></angular_velocity></imu></sensor>"
        )
    )
    assert imu is not None
    ((where, noise),) = imu.noises.items()
    assert where == ("angular_velocity", "y")
    assert {tag for tag, figure in noise.figures.items() if figure.stated} == {
        "stddev",
        "precision",
    }
    assert noise.figures["stddev"].value == 0.009
    assert imu.enable_orientation.value
