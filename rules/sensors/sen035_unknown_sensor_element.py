"""An element of a sensor in a `gazebo` tag that no version of SDFormat knows at that place.

libsdformat copies it, prints a warning at most, and nothing reads it: the sensor keeps its default.
With `<sample>` instead of `<samples>` a lidar has 640 rays. What belongs to a plugin, such as
`<topicName>`, has no effect beside it. Elements below `<plugin>`, those that name the frame of the
sensor and those with a namespace prefix are ignored. SDF003 reports the same in SDF models.

Fix: write the element that the message names, or move what belongs to a plugin into that plugin.
Source: SDFormat specification 1.4 to 1.12, sensor.
"""

from collections.abc import Iterator
from functools import cache

from checker.base.words import Suggestions
from checker.formats.sdf.schema import VERSIONS, ElementType, sdf_root
from checker.formats.urdf.description import UrdfDescription
from checker.model.sensing.kind import frame_elements
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.xml import Element


@rule("SEN035", "unknown-sensor-element", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription, context: Context) -> Findings:
    """Report unknown elements of the sensors of a description that Gazebo gets."""
    if description.for_rviz:
        return
    frames = frozenset(frame_elements(context.release))
    sensors = (it for tag in description.gazebo for it in tag.element.all("sensor"))
    for sensor in sensors:
        for element, places in _unknown(sensor, _sensor_types()):
            if element.tag not in frames:
                siblings = sorted({name for place in places for name in place.children})
                hint = Suggestions(siblings).hint(element.tag) or _place_of(element.tag)
                holder = places[0].name
                whose = "" if holder == "sensor" else " of a sensor"
                yield finding(
                    element,
                    f"Gazebo does not read <{element.tag}> in <{holder}>{whose}{hint}",
                    key=f"{holder}/{element.tag}",
                )


@cache
def _sensor_types() -> tuple[ElementType, ...]:
    """Return `<sensor>` in each version: an element of a later one is known, too."""
    links = (sdf_root(version).children["model"].children["link"] for version in VERSIONS)
    return tuple(link.children["sensor"] for link in links)


@cache
def _place_of(tag: str) -> str:
    """Return the one element directly in a sensor into which a tag belongs, for a message."""
    inside = (it for kind in _sensor_types() for it in kind.children.values())
    holders = {it.name for it in inside if tag in it.children}
    return f"; it belongs in <{holders.pop()}>" if len(holders) == 1 else ""


def _unknown(
    element: Element, kinds: tuple[ElementType, ...]
) -> Iterator[tuple[Element, tuple[ElementType, ...]]]:
    """Yield what an element contains that none of its types knows, with these types."""
    for child in element.children:
        inside = tuple(it.children[child.tag] for it in kinds if child.tag in it.children)
        if not inside and ":" not in child.tag:
            yield child, kinds
        elif not any(kind.free for kind in inside):
            yield from _unknown(child, inside)


def _lidar(inside: str, beside: str = "") -> dict[str, str]:
    scan = f"<ray><scan><horizontal>{inside}</horizontal></scan></ray>"
    sensor = f'<sensor name="lidar" type="ray">\n{scan}\n{beside}</sensor>'
    return {"@urdf": f'<gazebo reference="upper_arm">\n{sensor}\n</gazebo>'}


_MARK = "  <!-- ^ SEN035 -->"
GOOD = [
    _lidar("<samples>360</samples>", "<gz_frame_id>upper_arm</gz_frame_id>"),
    _lidar("", "<plugin name='p' filename='libray.so'><topicName>scan</topicName></plugin>"),
]
BAD = [
    _lidar(f"<sample>360</sample>{_MARK}"),
    _lidar("", f"<topicName>scan</topicName>{_MARK}"),
    _lidar("", f"<camera_info_topic>info</camera_info_topic>{_MARK}"),
]
