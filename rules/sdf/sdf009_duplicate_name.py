"""A name that two siblings share, or a reserved name.

Plugins, bridges and joints find a part by its name. libsdformat refuses a file in which two parts
of one kind share a name, or in which two children of a world do. Links, joints, frames and nested
models of a model have one set of names: in files before SDF 1.7 libsdformat renames the second
(joint `arm` next to a link `arm` becomes `arm_joint`), so that it cannot be found by its written
name; from 1.7 on it refuses the file. Gazebo Classic renames nothing: there it is an info. That
other siblings share a name, such as a visual and a collision, is against the specification since
SDF 1.7, and works: an info. Names of the form `__x__`, the name `world`, and names with `::` have a
special meaning for the parser; before SDF 1.8 `::` was part of a valid name, and is reported in
submissions only. Plugins may share a name, and names inside a plugin are not compared.

No accepted package that we checked has this fault.

Fix: give each sibling its own name.
Source: SDFormat specification 1.7, "unique sibling names" and "reserved names"; libsdformat 12 and
15: what they load, rename and refuse.
"""

import re
from collections.abc import Iterator

from checker.base.words import free_number
from checker.finding import Fix
from checker.formats.sdf.document import SdfDocument, sdf_version
from checker.formats.sdf.names import KINDS, UNIQUE_SINCE, renames_of
from checker.formats.sdf.schema import ElementType
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rename, rule
from checker.source.text import Located
from checker.source.xml import Element

_RESERVED = re.compile(r"world|__.*__")
_FRAMES = frozenset(KINDS)
"""Elements that are also frames, and so share one set of names in every version."""
_PARTS = _FRAMES | {"world", "visual", "collision", "sensor", "light", "physics"}
"""Elements that may not have a reserved name."""

NAME_OF_PHYSICS = "default_physics"
"""The only name that the schema gives by default."""

Version = tuple[int, int]


@rule("SDF009", "duplicate-name", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report siblings with the same name, and reserved names."""
    version = sdf_version(sdf.document)
    classic = context.release == "classic"
    # Until 1.8 such a name was valid: newer parsers make nested models of it.
    divides = version >= (1, 8) or context.is_subt
    for element, kind in sdf.typed_as(context.reads):
        if kind is None or kind.free:
            continue
        yield from _twins(element, kind, version, classic=classic)
        name = _name(element) if element.tag == "include" else element.attribute("name")
        if name is None or (element.tag != "include" and "name" not in kind.attributes):
            continue
        if element.tag in _PARTS and _RESERVED.fullmatch(name.value):
            yield finding(name, f"<{element.tag}> has the reserved name {name.value!r}")
        elif "::" in name.value and divides and (version >= (1, 8) or element.tag in _FRAMES):
            yield finding(
                name,
                f"name {name.value!r} contains '::', which separates the names of nested models",
            )


def _twins(
    parent: Element, kind: ElementType, version: Version, *, classic: bool
) -> Iterator[Finding]:
    renames = parent.tag == "model" and not classic
    new_names = renames_of(parent, version) if renames else {}
    weaker = Severity.INFO if classic else Severity.WARNING
    alike: dict[tuple[str, str], Element] = {}
    sharing: dict[str, Element] = {}
    for child in parent.children:
        name = _name(child)
        if name is None or child.tag == "plugin" or child.tag not in kind.children:
            continue
        first = alike.setdefault((child.tag, name.value), child)
        shares = version >= UNIQUE_SINCE or child.tag in _FRAMES or parent.tag == "world"
        other = sharing.setdefault(name.value, child) if shares else child
        if first is child and other is child:
            continue
        twin = first if first is not child else other
        whose = f"another <{twin.tag}>" if twin.tag == child.tag else f"a <{twin.tag}>"
        message = f"<{child.tag}> {name.value!r} has the same name as {whose}"
        # A visual and a collision of one name, say, are loaded, and both are found.
        level = weaker if {child.tag, twin.tag} <= _FRAMES else Severity.INFO
        changed = child if child in new_names else twin
        if changed in new_names:
            message += f": the simulator calls the {changed.tag} {new_names[changed]!r}"
        yield finding(
            name,
            message,
            severity=None if _is_refused(parent, child, twin, version) else level,
            related=[(_name(twin) or twin, "the first with this name")],
            fix=_numbered(parent, name) if child.tag == twin.tag == "visual" else None,
        )


def _numbered(parent: Element, name: Located[str]) -> Fix | None:
    """Return the fix that puts a number behind the name of a visual, to which nothing refers."""
    taken = {child.get("name") or "" for child in parent.children}
    return rename(name, f"{name.value}_{free_number(name.value, taken)}")


def _is_refused(parent: Element, child: Element, twin: Element, version: Version) -> bool:
    if child.tag == twin.tag or parent.tag == "world":
        return True
    return version >= UNIQUE_SINCE and {child.tag, twin.tag} <= _FRAMES


def _name(element: Element) -> Located[str] | None:
    """Return the name; an include may give one to what it includes."""
    if element.tag == "include":
        name = element.child("name")
        return name.text if name is not None and name.text.stated else None
    written = element.attribute("name")
    above = element.parent.tag if element.parent is not None else ""
    if written is None and (above, element.tag) == ("world", "physics"):
        return Located(NAME_OF_PHYSICS, element.span, stated=False)
    return written


_DIVIDED = """
<sdf version="@">
  <model name="rover"><link name="base_link"/><link name="arm::wrist"/></model>
</sdf>
"""
GOOD = [
    {"@fragment": _DIVIDED.replace("@", "1.7"), "@profile": "gazebo-harmonic"},
    """
<link name="left_wheel"/>
<link name="right_wheel"/>
<plugin name="p" filename="liba.so"/>
<plugin name="p" filename="liba.so"/>
""",
    '<link name="arm"><visual name="body"/><collision name="body"/></link>',
    """
<plugin name="p" filename="libp.so">
  <light name="red"/>
  <light name="red"/>
</plugin>
""",
]
BAD = [
    """
<link name="wheel"/>
<link name="wheel"/>  <!-- ^ SDF009 -->
""",
    """
<link name="hinge"/>
<joint name="hinge" type="fixed"><parent>base_link</parent><child>hinge</child></joint>  <!-- ^ SDF009 -->
""",  # noqa: E501
    """
<link name="arm">
  <visual name="body"><geometry><sphere><radius>0.1</radius></sphere></geometry></visual>
  <visual name="body">  <!-- ^ SDF009 -->
    <geometry><sphere><radius>0.2</radius></sphere></geometry>
  </visual>
</link>
""",
    '<link name="__model__"/>  <!-- ^ SDF009 -->',
    '<link name="arm::wrist"/>  <!-- ^ SDF009 -->',
    {
        "@fragment": _DIVIDED.replace("@", "1.8").replace("</model>", "</model> <!-- ^ SDF009 -->"),
        "@profile": "gazebo-harmonic",
    },
    """
<sdf version="1.7">
  <model name="rover">
    <link name="arm">
      <collision name="body"><geometry><box><size>1 1 1</size></box></geometry></collision>
      <sensor name="body" type="contact"/>  <!-- ^ SDF009 -->
    </link>
  </model>
</sdf>
""",
    """
<sdf version="1.6">
  <world name="hall">
    <model name="lamp"><link name="base_link"/></model>
    <light name="lamp" type="point"/>  <!-- ^ SDF009 -->
  </world>
</sdf>
""",
]
