"""A robot has the same plugin twice: same name, library and parameters.

Gazebo loads both. Two drives or controller managers command the same joints, two sensors publish on
the same topic, and a service is refused to the second ("service already advertised"). The usual
cause is a xacro file of `<gazebo>` elements that two files include: xacro expands a file as often
as it is included. It is then reported once, at the second include.

Plugins of one library that differ in their name or in a parameter are silent, such as one for each
rotor.

Fix: remove the second `<xacro:include>`, or the second plugin.
Source: gazebo-classic 11, `Model::LoadPlugins`, and gz-sim, `SystemManager`: each `<plugin>` is
loaded; xacro documentation, `<xacro:include>`.
"""

import posixpath
from collections.abc import Hashable, Iterator

from checker.base.words import and_list
from checker.formats.xacro.repeated_includes import repeated_include
from checker.model.components import Plugin
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.xml import Element

_SHOWN = 3
Pair = tuple[Plugin, Plugin]


@rule("PLG015", "plugin-twice", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report plugins that are the same as an earlier one, those of one include together."""
    by_include: dict[Element, tuple[Element, list[Pair]]] = {}
    for first, second in _pairs(robot):
        file = second.element.written.source.file
        includes = repeated_include(robot.document, file)
        if includes is None or first.element.written is not second.element.written:
            yield _of_plugins(first, second)
        else:
            by_include.setdefault(includes[1], (includes[0], []))[1].append((first, second))
    for again, (before, pairs) in by_include.items():
        yield _of_include(before, again, pairs)


def _pairs(robot: Robot) -> Iterator[Pair]:
    """Yield each plugin with an earlier one that is the same."""
    owned = [("", plugin) for plugin in robot.plugins]
    owned += [(it.link, plugin) for it in robot.sensors for plugin in it.plugins]
    known: dict[Hashable, Plugin] = {}
    for link, plugin in owned:
        place = (link, plugin.owner, plugin.nested_in)
        first = known.setdefault((place, _content(plugin.element)), plugin)
        if first is not plugin:
            yield first, plugin


def _content(element: Element) -> Hashable:
    """Return what an element states: names, values and order."""
    attributes = tuple(sorted(element.attributes.items()))
    below = tuple(map(_content, element.children))
    return element.tag, attributes, element.value.strip(), below


def _of_plugins(first: Plugin, second: Plugin) -> Finding:
    return finding(
        second,
        f"plugin {second.name.value!r} ({second.filename.value}) is there twice with the same "
        "parameters, and Gazebo loads both: remove one",
        related=[(first, "the first one")],
        key=f"{second.name.value} {second.filename.value}",
    )


def _of_include(before: Element, again: Element, pairs: list[Pair]) -> Finding:
    file = posixpath.basename(again.get("filename") or "")
    names = [*dict.fromkeys(repr(second.name.value) for _, second in pairs)]
    shown = names[:_SHOWN] + ([f"{len(names) - _SHOWN} more"] if len(names) > _SHOWN else [])
    plugins = f"plugin{'s' if names[1:] else ''} {and_list(shown)}"
    return finding(
        again.span,
        f"{file} is included a second time, and xacro expands it again: Gazebo loads its "
        f"{plugins} twice; remove this include",
        related=[
            (before.span, "the first include"),
            *((first, f"plugin {first.name.value!r}") for first, _ in pairs),
        ],
    )


def _camera(name: str, topic: str, mark: str = "") -> str:
    return f'<plugin filename="libcam.so" name="{name}"><topic>{topic}</topic></plugin>{mark}\n'


_XMLNS = 'xmlns:xacro="http://ros.org/wiki/xacro"'
_GAZEBO = f"""<robot {_XMLNS}>
  <xacro:property name="track" value="0.4"/>
  <gazebo><plugin filename="libdrive.so" name="drive"><track>${{track}}</track></plugin></gazebo>
  <gazebo reference="base_link">
    <sensor name="lidar" type="ray"><plugin filename="liblidar.so" name="scan"/></sensor>
  </gazebo>
</robot>
"""
_INCLUDE = '<xacro:include filename="cart.gazebo.xacro"/>'


def _robot(sensors: str, mark: str = "") -> dict[str, object]:
    """Return a robot that includes its Gazebo file itself, and its sensors."""
    return {
        "@urdf": True,
        "@profile": "ros2",
        "urdf/cart.gazebo.xacro": _GAZEBO,
        "urdf/sensors.xacro": f"<robot {_XMLNS}>\n{sensors}{mark}\n</robot>\n",
        "urdf/cart.urdf.xacro": f"""<robot name="cart" {_XMLNS}>
<link name="base_link"/>
{_INCLUDE}
<xacro:include filename="sensors.xacro"/>
</robot>
""",
    }


_MARK = "  <!-- ^ PLG015 -->"
_INNER = {
    "urdf/cart.gazebo.xacro": f'<robot {_XMLNS}><xacro:include filename="inner.xacro"/></robot>',
    "urdf/inner.xacro": _GAZEBO,
}
GOOD = [
    _robot('<xacro:property name="rate" value="10"/>'),
    {"@fragment": _camera("front", "a") + _camera("rear", "a")},
    {"@fragment": _camera("front", "a") + _camera("front", "b")},
]
BAD = [
    _robot(_INCLUDE, _MARK),
    {**_robot(_INCLUDE, _MARK), **_INNER},
    {"@fragment": _camera("front", "a") + _camera("front", "a", _MARK)},
]
