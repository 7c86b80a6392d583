"""An SDF element below a parent that does not allow it.

Simulators read an element only in its own place and ignore it elsewhere: `<enable_orientation>`
directly below `<sensor>` has no effect on the IMU. The finding is a warning if the element is also
set in the right place, if its value is the default there, if it only affects the appearance, or if
the target does not read it in the right place either. Outside of submissions it is a warning unless
it changes how the robot moves, and an info if its value is the default. SDF003 reports elements
that SDF does not have anywhere.

Fix: move the element to the place that the message names.
Source: SDFormat specification, the version that the file states.
"""

from collections.abc import Mapping, Sequence

from checker.finding import Fix
from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.schema import ElementType, all_tags, holders_of, parents_of
from checker.formats.sdf.unread import GRAVE_PARENTS, is_appearance, is_unread
from checker.model.values import numbers_of_words
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, rule
from checker.source.xml import Element
from checker.source.xml_insertion import append_to, indentation_of, newline_of, removal

HARMLESS: Mapping[tuple[str, ...], bool] = {
    ("air_pressure", "noise"): True,
    ("camera", "aspect_ratio"): False,
}
"""Parents and elements that accepted robots have: nothing is lost.

Whether the place that SDF has for the element is meant: width and height of a camera's image state
what its aspect ratio is, and no other place does.
"""
SETTINGS = frozenset(
    {
        *("air_pressure", "air_speed", "altimeter", "camera", "contact", "force_torque", "gps"),
        *("imu", "lidar", "logical_camera", "magnetometer", "navsat", "ray", "rfid", "rfidtag"),
        *("sonar", "transceiver"),
    }
)
"""Elements of a sensor that contain what one type of sensors reads."""
OLDER_SPELLINGS = {
    "gpu_lidar": ("lidar", "ray"),
    "gpu_ray": ("lidar", "ray"),
    "lidar": ("ray",),
    "ray": ("lidar",),
    "gps": ("navsat",),
    "navsat": ("gps",),
    "wireless_receiver": ("transceiver",),
    "wireless_transmitter": ("transceiver",),
}
"""Blocks of types that are called otherwise."""
_LISTED = 3

_Kinds = Mapping[Element, ElementType | None]


@rule("SDF008", "misplaced-element", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report elements that this SDF version knows, but not below this parent."""
    belonging: dict[tuple[str, ...], Sequence[str]] = {}
    kinds = dict(sdf.typed_as(context.reads))
    for element, kind in kinds.items():
        parent = element.parent
        if kind is not None or parent is None or element.tag not in all_tags(sdf.version):
            continue
        if context.release and _is_recorded(element):
            continue
        around = parent.parent.tag if parent.parent is not None else ""
        path = (around, parent.tag, element.tag)
        if path not in belonging:
            belonging[path] = _places(*path, parents_of(sdf.version))
        places = belonging[path] if HARMLESS.get(path[1:], True) else ()
        listed = [place for place in places if _fits(parent, kinds[parent], place)]
        named = (_place_label(sdf.version, tag, *path) for tag in listed)
        belongs = "; it belongs in " + " or ".join(named) if listed else ""
        is_set = len(listed) == 1 and _is_set(element, listed[0])
        usual = len(listed) == 1 and not is_set and _is_usual(element, listed[0], kinds)
        belongs += ", where it is set" if is_set else ""
        belongs += f", where {element.text.value} is the default" if usual else ""
        of_others = bool(places) and not listed
        harmless = is_set or usual or of_others or path[1:] in HARMLESS
        idle = is_unread(element.tag, context.release) or is_appearance(element)
        meant = listed if len(listed) == 1 else ()  # of several places none is certain
        grave = not {*meant, parent.tag}.isdisjoint(GRAVE_PARENTS) or element.tag == "gravity"
        least = Severity.INFO if usual and not context.is_subt else Severity.WARNING
        yield finding(
            element,
            f"<{element.tag}> is not allowed in <{parent.tag}>{belongs}",
            severity=None if (grave or context.is_subt) and not (harmless or idle) else least,
            key=f"{parent.tag}/{element.tag}",
            fix=_moved(element, listed[0], kinds) if len(listed) == 1 and not harmless else None,
        )


def _place_label(version: str, place: str, around: str, parent: str, tag: str) -> str:
    """Name a place; of another element of the same tag, say which one: `contact/ode`."""
    if place != parent:
        return f"<{place}>"
    holders = [holder for holder in holders_of(version, place, tag) if holder != around]
    return " or ".join(f"<{holder}/{place}>" for holder in holders) or f"another <{place}>"


def _is_set(element: Element, place: str) -> bool:
    """Return whether the right place, next to or around the wrong one, has such an element."""
    parent = element.parent
    if parent is None:
        return False
    around = [parent.parent] if parent.parent is not None and parent.parent.tag == place else []
    return any(holder.child(element.tag) is not None for holder in (*around, *parent.all(place)))


def _is_recorded(element: Element) -> bool:
    """Return whether it is in the `<state>` of a world, a recording that Gazebo does not read."""
    above = element.parent
    while above is not None and above.tag != "state":
        above = above.parent
    return above is not None


def _is_usual(element: Element, place: str, kinds: _Kinds) -> bool:
    """Return whether the element states the value that the right place has anyway."""
    around = element.parent.parent if element.parent is not None else None
    holder = kinds.get(around) if around is not None else None
    if holder is None or around is None:
        return False
    right = holder if around.tag == place else holder.children.get(place)
    meant = right.children.get(element.tag) if right is not None else None
    if meant is None or meant.default is None:
        return False
    said, default = map(numbers_of_words, (element.text.value, meant.default))
    return said == default if None not in said else element.text.value == meant.default


def _places(
    around: str, parent: str, tag: str, parents: Mapping[str, tuple[str, ...]]
) -> Sequence[str]:
    """Return where an element is allowed, near its place or around it; nothing for too many."""
    places = parents.get(tag, ())
    near = [place for place in places if place == around or parent in parents.get(place, ())]
    listed = near or places
    return listed if len(listed) <= _LISTED else ()


def _fits(parent: Element, kind: ElementType | None, place: str) -> bool:
    """Return whether settings below a sensor may be for its type: no `<imu>` in a camera.

    All types of cameras share `<camera>`, so it fits if no other block does.
    """
    blocks = set(kind.children) & SETTINGS if kind is not None and parent.tag == "sensor" else set()
    if place not in blocks:
        return True
    type = parent.get("type") or ""
    own = {block for block in blocks if block == type or block in OLDER_SPELLINGS.get(type, ())}
    return place in (own or {"camera"})


def _moved(element: Element, place: str, kinds: _Kinds) -> Fix | None:
    """Return the fix that puts an element where it belongs, next to or around its place."""
    parent, text = element.parent, element.written.whole_span.text
    if parent is None or "\n" in text or len(parent.all(element.tag)) > 1:
        return None
    beside, around = parent.all(place), parent.parent
    holder = around if around is not None and around.tag == place else next(iter(beside), None)
    if holder is None:
        kind = kinds.get(parent)
        return _wrapping_fix(element, kind.children.get(place) if kind is not None else None)
    if len(beside) > 1 or holder.child(element.tag) is not None or holder.text.stated:
        return None
    return Fix(Safety.SAFE, (removal(element), append_to(holder, [text])))


def _wrapping_fix(element: Element, kind: ElementType | None) -> Fix | None:
    """Return the fix that puts an element around another one, if it needs only that."""
    if kind is None or any(needed == "1" for _, _, needed in kind.attributes.values()):
        return None
    element = element.written
    source, start = element.source, element.position.start
    indentation = indentation_of(source, start)
    outer = "" if indentation is None else newline_of(source, start) + indentation
    inner = f"{outer}  " if outer else ""
    text = f"<{kind.name}>{inner}{element.whole_span.text}{outer}</{kind.name}>"
    return Fix(Safety.SAFE, (element.whole_span.replacement(text),))


GOOD = [
    """
<sensor name="imu" type="imu">
  <imu>
    <enable_orientation>0</enable_orientation>
  </imu>
</sensor>
"""
    """
<sensor name="load" type="force_torque">
  <force_torque>
    <frame>child</frame>
  </force_torque>
</sensor>
""",
]
BAD = [
    """
<sensor name="imu" type="imu">
  <enable_orientation>0</enable_orientation>  <!-- ^ SDF008 -->
</sensor>
""",
    """
<sensor name="imu" type="imu">
  <enable_orientation>0</enable_orientation>  <!-- ^ SDF008 -->
  <imu><enable_orientation>0</enable_orientation></imu>
</sensor>
""",
    """
<sensor name="scan" type="gpu_lidar">
  <measure_direction>parent_to_child</measure_direction>  <!-- ^ SDF008 -->
</sensor>
""",
    """
<link name="arm">
  <mass>3</mass>  <!-- ^ SDF008 -->
</link>
""",
    """
<collision name="foot">
  <geometry><sphere><radius>0.1</radius></sphere></geometry>
  <surface><friction><ode>
    <kp>1e6</kp>  <!-- ^ SDF008 -->
  </ode></friction></surface>
</collision>
""",
    """
<sensor name="barometer" type="air_pressure">
  <air_pressure>
    <noise type="gaussian"/>  <!-- ^ SDF008 -->
  </air_pressure>
</sensor>
""",
]
