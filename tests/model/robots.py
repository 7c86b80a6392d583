"""Robots out of texts, and a second way to work out poses: numpy and scipy."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from checker.formats.sdf.reader import read_sdf
from checker.formats.urdf.reader import read_urdf
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.source.text import SourceText
from checker.source.xml import XmlDocument, parse_xml

Matrix = NDArray[np.float64]


def document(text: str, file: str = "model.sdf") -> XmlDocument:
    parsed = parse_xml(SourceText(file, text))
    assert isinstance(parsed, XmlDocument), f"{parsed.message}: {parsed.hint}"
    return parsed


def sdf(content: str, version: str = "1.6", files: Mapping[str, str] = {}) -> Robot:
    """Read a model's content; `files` are what includes find by their URI."""
    documents = {uri: document(text, uri) for uri, text in files.items()}
    text = f'<sdf version="{version}"><model name="robot">{content}</model></sdf>'
    (robot,) = read_sdf(document(text), lambda uri: documents.get(uri.value, "is not available"))
    return robot


def urdf(content: str) -> Robot:
    return read_urdf(document(f'<robot name="robot">{content}</robot>', "robot.urdf"))


def messages(robot: Robot) -> list[str]:
    return [fault.message for fault in robot.faults]


def pose(x: float, y: float, z: float, roll: float, pitch: float, yaw: float) -> Matrix:
    """The 4×4 matrix of a pose as SDF and URDF write it; metres, radians."""
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_euler("xyz", [roll, pitch, yaw]).as_matrix()
    matrix[:3, 3] = x, y, z
    return matrix


def as_matrix(transform: Transform | None) -> Matrix:
    assert transform is not None
    matrix = np.eye(4)
    matrix[:3, :3] = transform.rotation
    matrix[:3, 3] = transform.translation
    return matrix


def assert_pose(transform: Transform | None, expected: Matrix, tolerance: float = 1e-12) -> None:
    np.testing.assert_allclose(as_matrix(transform), expected, rtol=0, atol=tolerance)
