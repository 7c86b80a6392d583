"""An element that SDFormat does not know.

libsdformat copies unknown elements with a warning, and nothing reads them, so their content has no
effect: a misspelt `<horizontal_fov>` leaves the camera at its default. It is an error if the name
resembles one that is allowed there, or if it would change how the part moves; an element that only
changes the look of a part, and one that resembles an element that the target does not read (such as
`<always_on>`), is a warning, and so is a parameter of a plugin of Gazebo Classic. Of a name that is
allowed elsewhere, the message names the place, if there is one alone. A file of an
older version is read as one of the newest version: elements of that version are known, too.
Elements below `<plugin>` and elements with a namespace prefix are ignored. SDF008 reports a known
element in the wrong place, SEN028 those that name the frame of a sensor.

Fix: spell it as the specification does, or move what belongs to a plugin into that plugin.
Source: SDFormat specification, the version that the file states.
"""

from collections.abc import Iterator
from functools import cache

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.finding import Fix
from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.schema import all_tags, holders_of, parents_of
from checker.formats.sdf.unread import GRAVE_PARENTS, is_appearance, is_unread
from checker.model.sensing.kind import frame_ids
from checker.rule import Concern, Context, Finding, Findings, Safety, Severity, finding, rule
from checker.source.xml import Element


@rule("SDF003", "unknown-element", Severity.WARNING, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report elements that no place of this SDF version knows."""
    known = frame_ids(context.release)
    frames = {*known.read, *known.others} if known is not None else set()
    unknown = [
        element
        for element, kind in sdf.typed_as(context.reads)
        if kind is None and element.tag not in all_tags(sdf.version) and element.tag not in frames
    ]
    anywhere = Suggestions(all_tags(sdf.version))
    parents = {element.parent or sdf.root for element in unknown}
    there = {parent: {child.tag for child in parent.children} for parent in parents}
    for element, siblings in _with_known_siblings(sdf, unknown):
        sure = siblings.correction(element.tag)
        if element.tag in _plugin_parameters() and not sure:
            yield _of_plugin(element, element.parent or sdf.root)
            continue
        near = siblings.closest(element.tag)
        parent = element.parent or sdf.root
        meant = near is not None and not is_unread(near, context.release)
        grave = (meant or parent.tag in GRAVE_PARENTS) and not is_appearance(element)
        hint = f"; did you mean <{near}>?" if near else _elsewhere(element, anywhere, sdf.version)
        yield finding(
            element,
            f"<{element.tag}> in <{parent.tag}> is not an element of SDF "
            f"{sdf.version or '1.6'}{hint}",
            severity=Severity.ERROR if grave else None,
            key=f"{parent.tag}/{element.tag}",
            fix=_renaming_fix(element, sure) if sure and sure not in there[parent] else None,
        )


def _elsewhere(element: Element, anywhere: Suggestions, version: str) -> str:
    """Return where the one element that may be meant belongs; nothing if that is not certain."""
    tag = anywhere.correction(element.tag)
    places = parents_of(version).get(tag, ()) if tag else ()
    if len(places) != 1:
        return ""
    holders = holders_of(version, places[0], tag or "")
    place = f"{holders[0]}/{places[0]}" if len(holders) == 1 else places[0]
    return f"; if <{tag}> is meant, it belongs in <{place}>"


@cache
def _plugin_parameters() -> frozenset[str]:
    """Return the parameters of the plugins of Gazebo Classic for ROS 1."""
    libraries = table("gazebo_classic_ros2")["ros_1"]["libraries"].values()
    return frozenset(name for library in libraries for name in library.get("params", ()))


def _of_plugin(element: Element, parent: Element) -> Finding:
    return finding(
        element,
        f"<{element.tag}> in <{parent.tag}> is a parameter of plugins of Gazebo Classic, and "
        "nothing reads it there: remove it",
        key=f"{parent.tag} parameters",
    )


def _with_known_siblings(
    sdf: SdfDocument, unknown: list[Element]
) -> Iterator[tuple[Element, Suggestions]]:
    """Pair each unknown element with the tags that are allowed in its place."""
    parents = {element.parent for element in unknown}
    known: dict[Element | None, Suggestions] = {
        element: Suggestions(kind.children)
        for element, kind in sdf.typed_elements
        if kind is not None and element in parents
    }
    for element in unknown:
        yield element, known.get(element.parent, Suggestions(()))


def _renaming_fix(element: Element, tag: str) -> Fix:
    names = (element.name_span, element.end_name_span)
    return Fix(Safety.SAFE, tuple(name.replacement(tag) for name in names if name is not None))


GOOD = [
    '<sensor name="eye" type="camera"><camera><horizontal_fov>1</horizontal_fov></camera></sensor>',
    '<plugin name="p" filename="libp.so"><anything_goes>1</anything_goes></plugin>',
]
BAD = [
    """
<sensor name="eye" type="camera">
  <camera>
    <horizondal_fov>1.05</horizondal_fov>  <!-- ^ SDF003 -->
  </camera>
</sensor>
""",
    """
<link name="arm">
  <inertial>
    <weight>3</weight>  <!-- ^ SDF003 -->
  </inertial>
</link>
""",
    """
<sensor name="eye" type="camera">
  <distortionK1>0</distortionK1>  <!-- ^ SDF003 -->
</sensor>
""",
    # A warning: what it resembles is not allowed there either.
    '<link name="arm"><m2>0.5</m2>  <!-- ^ SDF003 --></link>',
]
