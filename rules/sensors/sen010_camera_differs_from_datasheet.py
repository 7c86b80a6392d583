"""A camera whose settings differ from those of its device.

Teams plan with the camera in specifications.md. More pixels, a higher rate or a wider view make the
simulated robot better than the real one, and fewer pixels make it worse; reviewers ask about both.
In the SubT challenge, images with depth have at most 640 × 480 pixels, to limit the time of the
simulation.

A device that specifications.md names anywhere, in a link or a line of the costs, counts if it is
the only one of its class. A device of a family is compared if specifications.md names its model.
The type codes of machine vision cameras contain the size, rounded: a BFLY-U3-23S6C has 2.3
megapixels, a Basler acA1300-60gm about 1300 columns. Such figures, others from memory, and
differences that the sheet mentions under diversions are infos.

Fix: set size, rate and horizontal_fov to the figures of the device's datasheet, or name the
modelled device in specifications.md.
Source: `devices.json`, which names the source of each figure. SubT review findings for
640 × 480 and 640 × 360.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

from checker.model.components import Sensor
from checker.model.devices.devices import Device, SensorDevice, SensorDevices
from checker.model.robot import Robot
from checker.model.sensing.camera import Camera
from checker.model.sensing.kind import SensorType
from checker.rule import Concern, Context, Finding, Findings, HasSpan, Severity, finding, rule

_SIZE = r"resolution|pixel|image size"
_RATE = r"\brates?\b|\bHz\b|\bfps\b"
_VIEW = r"\bh?fov\b|field of view|\blens"


class _Gap(NamedTuple):
    """A setting of a camera that its device does not have.

    `field` is the device's figure, `words` an expression for the words that name it.
    """

    where: HasSpan
    field: str
    words: str
    has: str
    expected: str


@rule("SEN010", "camera-differs-from-datasheet", Severity.WARNING, Concern.INTERFACE)
def check(
    robot: Robot,
    devices: SensorDevices,
    context: Context,
    *,
    rgbd_pixels: int = 640 * 480,
    rate_tolerance: float = 0.01,
    view_tolerance: float = 0.02,
    code_tolerance: float = 0.1,
) -> Findings:
    """Compare cameras with their devices, and the size of RGBD cameras with SubT's.

    Options:
        rgbd_pixels: Greatest number of pixels, width times height, of an RGBD camera in the SubT
            profile.
        rate_tolerance: Share by which the rate may exceed the device's highest rate; lower rates
            are never reported.
        view_tolerance: Share by which `<horizontal_fov>` may differ from the device's, in both
            directions.
        code_tolerance: Share by which the number of pixels may differ from that of a type code;
            half of it for a width.
    """
    for sensor in robot.sensors:
        camera = sensor.camera
        if camera is None or not sensor.kind.takes_pictures:
            continue
        is_limited = context.profile == "subt" and sensor.kind is SensorType.RGBD_CAMERA
        if is_limited and camera.pixels > rgbd_pixels:
            yield finding(
                camera.width,
                f"RGBD camera {sensor.name.value!r} has {_size(camera)}; expected at "
                f"most {rgbd_pixels} pixels: the SubT standard is 640 × 480 or 640 × 360 px",
                key=f"rgbd {_size(camera)}",
            )
            continue
        known = devices.device_of(sensor)
        if known is not None and known.names_the_model:
            gaps = [
                *_size_gap(camera, known.device),
                *_code_gap(camera, known.device, code_tolerance),
                *_rate_gap(sensor, known.device, rate_tolerance),
                *_view_gap(camera, known.device, view_tolerance),
            ]
            for gap in gaps:
                explained = devices.are_diverted(known.device, gap.words)
                yield _finding(sensor, known, gap, explained)


def _finding(sensor: Sensor, known: SensorDevice, gap: _Gap, explained: bool) -> Finding:
    device = known.device
    slight = explained or device.is_from_memory(gap.field)
    return finding(
        gap.where,
        f"camera {sensor.name.value!r} has {gap.has}, but {device.name} has {gap.expected}",
        severity=Severity.INFO if slight else None,
        key=f"{device.id} {gap.has}",
        related=[(known.words, "names the device")],
    )


def _size(camera: Camera) -> str:
    return f"{camera.width.value:g} × {camera.height.value:g} px"


def _size_gap(camera: Camera, device: Device) -> Iterator[_Gap]:
    """Yield the size if the device does not have it; a camera may be mounted on its side."""
    sizes = [tuple(size) for size in device.values.get("image_sizes", ())]
    stated = (camera.width.value, camera.height.value)
    if sizes and stated not in sizes and stated[::-1] not in sizes:
        expected = " or ".join(f"{width:g} × {height:g}" for width, height in sizes)
        yield _Gap(camera.width, "image_sizes", _SIZE, _size(camera), f"{expected} px")


def _code_gap(camera: Camera, device: Device, tolerance: float) -> Iterator[_Gap]:
    """Yield the size if it is far from that of the device's type code."""
    values = device.values
    stated = (camera.width.value, camera.height.value)
    megapixels, width = values.get("megapixels"), values.get("width")
    if megapixels and not math.isclose(camera.pixels / 1e6, megapixels, rel_tol=tolerance):
        yield _Gap(camera.width, "megapixels", _SIZE, _size(camera), f"{megapixels:g} megapixels")
    half = tolerance / 2.0
    if width and not any(math.isclose(side, width, rel_tol=half) for side in stated):
        yield _Gap(camera.width, "width", _SIZE, _size(camera), f"about {width:g} columns")


def _rate_gap(sensor: Sensor, device: Device, tolerance: float) -> Iterator[_Gap]:
    """Yield the rate if it is above all rates of the device; slower ones save time."""
    values, rate = device.values, sensor.update_rate
    field = "rate_max" if "rate_max" in values else "rates"
    rates = [*values.get("rates", ()), *([values["rate_max"]] if "rate_max" in values else ())]
    if rates and rate.value > max(rates) * (1.0 + tolerance):
        yield _Gap(rate, field, _RATE, f"a rate of {rate.value:g} Hz", f"up to {max(rates):g} Hz")


def _view_gap(camera: Camera, device: Device, tolerance: float) -> Iterator[_Gap]:
    """Yield the field of view if the device does not have it, unless the lens is a fisheye."""
    values, view = device.values, camera.horizontal_fov
    degrees = dict(values.get("hfov_deg_by_size", {}))
    angles = [math.radians(degree) for degree in degrees.values()]
    fields = [field for field in ("hfov_rad", "hfov_deg", "hfov_deg_by_size") if field in values]
    if "hfov_deg" in values:
        angles.append(math.radians(values["hfov_deg"]))
    if "hfov_rad" in values:
        angles.append(values["hfov_rad"])
    if not angles or values.get("fisheye"):
        return
    accepted = [*angles, *values.get("hfov_rad_seen", ())]
    if not any(math.isclose(view.value, width, rel_tol=tolerance) for width in accepted):
        expected = " or ".join(dict.fromkeys(f"{angle:.4g}" for angle in sorted(angles)))
        stated = f"a horizontal_fov of {view.value:.4g} rad"
        stated = stated if view.stated else f"no <horizontal_fov> (default {view.value:.4g} rad)"
        yield _Gap(view, fields[0], _VIEW, stated, f"{expected} rad")


def _model(width: int, height: int, rate: float = 25, fov: float = 1.658, mark: int = 0) -> str:
    marks = ["  <!-- ^ SEN010 -->" if mark == number else "" for number in (1, 2, 3)]
    return f"""
<sensor name="camera_front" type="camera">
  <update_rate>{rate}</update_rate>{marks[1]}
  <camera>
    <horizontal_fov>{fov}</horizontal_fov>{marks[2]}
    <image>
      <width>{width}</width>{marks[0]}
      <height>{height}</height>
    </image>
  </camera>
</sensor>
"""


def _example(model: str, device: str = "Arducam B0203 with LN008 lens", links: str = "") -> object:
    sheet = f"# Rover\n## Sensors\n* Color camera - {device}, modeled by camera plugin\n{links}"
    return {"@fragment": model, "specifications.md": sheet}


def _rgbd(width: int, height: int, mark: str = "") -> str:
    return f"""
<sensor name="rgbd_front" type="rgbd_camera">
  <camera>
    <image>
      <width>{width}</width>{mark}
      <height>{height}</height>
    </image>
  </camera>
</sensor>
"""


_FAMILY = "FLIR Blackfly S"
_MODEL_LINK = "\n## Links\n* [camera](https://www.flir.com/?model=BFS-U3-16S2C-CS)\n"

_PLAIN = "# Rover\n## Sensors\n* Color camera, modeled by camera plugin\n"
_BLACKFLY = "FLIR Blackfly BFLY-U3-23S6C-C"
_OF_FAMILY = "\n## Links\n* [FLIR BFS-U3-88S6C](https://www.flir.com/products/blackfly-s-usb3)\n"
_COSTS = "## Cost\n$900 - Basler acA1300-60gm\n"

GOOD = [
    _example(_model(1920, 1200), _BLACKFLY),
    _example(_model(4096, 2160), _FAMILY, _OF_FAMILY),
    _example(_model(1282, 1026), "Basler acA1300-60gm"),
    _example(_model(1280, 1024), "IDS uEye UI-3240CP"),
    _example(_model(1292, 964), "Allied Vision Mako G-125C"),
    _example(_model(1280, 1024), "XIMEA MQ013CG-E2"),
    {"@fragment": _model(1282, 1026), "specifications.md": _PLAIN + _COSTS},
    {"@fragment": _model(640, 480), "specifications.md": _PLAIN},
    _example(_model(720, 1080)),
    _example(_model(1080, 720, 20)),
    _example(_model(4096, 2160), _FAMILY),
    _example(_model(1440, 1080), _FAMILY, _MODEL_LINK),
    _example(_model(848, 800, 30, 2.8), "Intel RealSense T265"),
    _model(1280, 960),
    _rgbd(640, 360),
]
BAD = [
    _example(_model(1280, 960, mark=1), _BLACKFLY),
    _example(_model(1280, 960, mark=1), _FAMILY, _OF_FAMILY),
    _example(_model(1920, 1080, mark=1), "Basler acA1300-60gm"),
    _example(_model(1920, 1080, mark=1), "IDS uEye UI-3240CP"),
    _example(_model(640, 480, mark=1), "Allied Vision Mako G-125C"),
    _example(_model(1920, 1080, mark=1), "XIMEA MQ013CG-E2"),
    {"@fragment": _model(640, 480, mark=1), "specifications.md": _PLAIN + _COSTS},
    _example(_model(480, 640, mark=1)),
    _example(_model(720, 1080, 30, mark=2)),
    _example(_model(720, 1080, 25, 1.2, mark=3)),
    _example(_model(1280, 960, mark=1), _FAMILY, _MODEL_LINK),
    _example(
        _model(480, 640, mark=1),
        links="\n## Diversions from Physical Hardware\n* The B0203 runs at half its resolution.\n",
    ),
    _example(
        _model(720, 1080)
        .replace("<horizontal_fov>1.658", "<horizondal_fov>1.658")
        .replace("1.658</horizontal_fov>", "1.658</horizondal_fov>")
        .replace("<camera>", "<camera>  <!-- ^ SEN010 -->")
    ),
    _rgbd(1280, 720, "  <!-- ^ SEN010 -->"),
]
