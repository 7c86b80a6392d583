"""Faults in the sensors of a model.sdf."""

from __future__ import annotations

from math import cos, sin
from random import Random

from lxml import etree

from bench.planted.edits import Kind, below, kind, removed, with_attribute, with_text
from bench.planted.model import model

CAMERA = "//sensor[contains(@type,'camera')]"
LIDAR = "//sensor[contains(@type,'lidar') or contains(@type,'ray')]"
LIDAR_3D = f"{LIDAR}[number(.//vertical/samples) > 1]"


def plate_in_front(element: etree._Element, _: Random) -> None:
    """Put a plate 5 cm in front of a sensor."""
    words = (element.findtext("pose") or "0 0 0 0 0 0").split()
    x, y, z, roll, pitch, yaw = (float(word) for word in words)
    x, y = x + 0.05 * cos(pitch) * cos(yaw), y + 0.05 * cos(pitch) * sin(yaw)
    pose = f"{x} {y} {z - 0.05 * sin(pitch)} {roll} {pitch} {yaw}"
    parent = element.getparent()
    assert parent is not None
    parent.append(
        etree.fromstring(
            f"<visual name='plate_in_front'><pose>{pose}</pose><geometry><box>"
            "<size>0.005 0.3 0.3</size></box></geometry></visual>"
        )
    )


KINDS: tuple[Kind, ...] = (
    kind("an unknown sensor", "SEN001", model(LIDAR, with_attribute("type", "sonar"))),
    kind(
        "a sensor that Dome does not simulate",
        "SEN001",
        model("//sensor[@type='imu']", with_attribute("type", "force_torque_6d")),
    ),
    kind("an older spelling", "SEN002 SEN001", model(LIDAR, with_attribute("type", "ray"))),
    kind(
        "scan angles the wrong way round",
        "SEN003",
        model(
            f"{LIDAR}//horizontal",
            below("min_angle", with_text("1")),
            below("max_angle", with_text("-1")),
        ),
    ),
    kind(
        "scan angles in degrees",
        "SEN003 SEN007",
        model(
            f"{LIDAR}//horizontal",
            below("min_angle", with_text("-180")),
            below("max_angle", with_text("180")),
        ),
    ),
    kind("no samples", "SEN004", model(f"{LIDAR}//horizontal/samples", with_text("0"))),
    kind(
        "half a sample", "SEN004 SDF006", model(f"{LIDAR}//horizontal/samples", with_text("10.5"))
    ),
    kind(
        "a scan of resolution zero",
        "SEN005",
        model(f"{LIDAR}//horizontal/resolution", with_text("0")),
    ),
    kind(
        "a range the wrong way round",
        "SEN006 SEN007",
        model(f"{LIDAR}//range", below("min", with_text("50")), below("max", with_text("1"))),
    ),
    kind(
        "a lidar that sees too far",
        "SEN006 SEN007",
        model(f"{LIDAR_3D}//range/max", with_text("400")),
    ),
    kind(
        "a lidar with other rings",
        "SEN007",
        model(f"{LIDAR_3D}//vertical/samples", with_text("128")),
    ),
    kind(
        "a lidar that looks too high",
        "SEN007",
        model(f"{LIDAR_3D}//vertical/max_angle", with_text("0.9")),
    ),
    kind(
        "a camera that sees more than all round",
        "SEN010 SEN008 SDF006 SEN011",
        model(f"{CAMERA}//horizontal_fov", with_text("7")),
    ),
    kind(
        "a camera with a view in degrees",
        "SEN010 SEN008 SDF006 SEN011",
        model(f"{CAMERA}//horizontal_fov", with_text("90")),
    ),
    kind(
        "a D435 with more pixels",
        "SEN010 SEN009 SEN025",
        model(
            "//sensor[contains(@type,'rgbd')]//image",
            below("width", with_text("4000")),
            below("height", with_text("3000")),
        ),
    ),
    kind(
        "a D435 with a wide view",
        "SEN010 SEN009",
        model("//sensor[contains(@type,'rgbd')]//horizontal_fov", with_text("2.6")),
    ),
    kind(
        "a D435 that is too fast",
        "SEN010 SEN015",
        model("//sensor[contains(@type,'rgbd')]/update_rate", with_text("400")),
    ),
    kind(
        "a clip the wrong way round",
        "SEN011",
        model(
            f"{CAMERA}//camera/clip", below("near", with_text("10")), below("far", with_text("1"))
        ),
    ),
    kind("a clip from zero", "SEN011", model(f"{CAMERA}//camera/clip/near", with_text("0"))),
    kind(
        "an IMU without noise",
        "SEN013",
        model(
            "//sensor[@type='imu']/imu[angular_velocity]",
            below("angular_velocity", removed),
            below("linear_acceleration", removed),
        ),
    ),
    kind(
        "a sensor of no rate",
        "SEN015",
        model("//sensor[@type='imu' or contains(@type,'camera')]/update_rate", with_text("0")),
    ),
    kind("a sensor of a negative rate", "SEN015", model(f"{CAMERA}/update_rate", with_text("-10"))),
    kind(
        "an IMU too fast for the simulation",
        "SEN015",
        model("//sensor[@type='imu']/update_rate", with_text("5000")),
    ),
    kind("a sensor off the robot", "SEN018", model(f"{CAMERA}/pose", with_text("5 0 0.2 0 0 0"))),
    kind("a plate in front of a camera", "SEN019", model(CAMERA, plate_in_front)),
    kind(
        "a camera that looks up",
        "SEN026",
        model(
            "//sensor[contains(@name,'front') and contains(@type,'camera')]/pose",
            with_text("0.2 0 0.3 0 -1.5707963267948966 0"),
        ),
    ),
    kind(
        "a camera that looks back",
        "SEN026",
        model(
            "//sensor[contains(@name,'front') and contains(@type,'camera')]/pose",
            with_text("0.4 0 0.4 0 0 3.141592653589793"),
        ),
    ),
    kind(
        "an unknown image format",
        "SEN027 SDF006",
        model(f"{CAMERA}//image/format", with_text("RGB8")),
    ),
    kind("rays that are drawn", "SEN021", model("//sensor/visualize", with_text("true"))),
    kind("no IMU", "SEN022 ROS002 DOC003 PKG005", model("//sensor[@type='imu']", removed)),
    kind("a camera too few", "ROS002 DOC003", model(f"{CAMERA}", removed)),
    kind(
        "a sensor with another name",
        "ROS001 ROS002",
        model("//sensor", with_attribute("name", "device")),
    ),
    kind("a light that is black", "SEN023", model("//light/diffuse", with_text("0 0 0 1"))),
    kind("a light off the robot", "SEN018 SEN020", model("//light/pose", with_text("4 0 0 0 0 0"))),
    kind(
        "a magnetometer that wants a plugin of its own",
        "SEN001 SEN002",
        model("//sensor[@type='magnetometer']", with_attribute("type", "compass")),
    ),
    kind(
        "a camera that records too much",
        "SEN025 SEN010 SEN009",
        model(
            CAMERA,
            below(".//image/width", with_text("7680")),
            below(".//image/height", with_text("4320")),
        ),
    ),
)
