"""A plugin or a parameter of ROS 1 in a ROS 2 package, or a parameter of ROS 2 in one of ROS 1.

Gazebo Classic finds no library that only ROS 1 has: the drive or sensor is missing. A parameter of
ROS 1 is ignored without a message, and the default counts: `<leftJoint>` leaves the drive without a
wheel, `<robotNamespace>` leaves all topics in the root namespace.

A plugin of ROS 1 ignores `<joint_name>` and `<update_rate>` of ROS 2 in the same way.

Models that are in no package may be for either, so they are not judged.

It is an error for a library, and for a parameter whose joint, link, wheel, topic or namespace no
other parameter of the plugin names; otherwise a warning. So is a parameter in a robot that no
simulator gets, where launch files spawn another file, and the topic of a sensor that is the default
of ROS 2, or that no other file of the package names: all may read the default. If another file
names the topic that ROS 2 publishes, the parameter is to be removed: a remapping would take that
topic from its reader.

Fix: write the library and the parameters that the message names, or remove the parameter where it
says so.
Source: source code of gazebo_ros_pkgs for ROS 1 and ROS 2 (`gazebo_classic_ros2.json`).
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from msgspec.structs import replace

from checker.base.resources import table
from checker.model.components import Plugin
from checker.model.plugin_host import PluginHost
from checker.model.plugin_library import CLASSIC, library_stem, plugin_libraries
from checker.package.dependencies import available_packages
from checker.package.package import Package
from checker.package.target import is_of_catkin, ros_2_package
from checker.ros.spawned_files import SpawnedFiles
from checker.ros.wiring.classic import classic_endpoints
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.text import SourceText
from checker.source.xml import Element

_NAMES_PART = re.compile(r"\w*(?:joint|link_name|body_name|separation|diameter)\w*")
_WORD = re.compile(r"\w+")
_ROS = "<ros>"
_DEFAULT = re.compile(r"<ros><remapping>(?:<camera_name>/)?(?P<topic>[\w/]+):=")
_OUTPUT = re.compile(r"(?:image|camera|depth|point)\w*Topic\w*|topicName")
_RATE, _RATE_OF_SENSOR = "update_rate", "<update_rate> of the <sensor>"


@rule("PLG012", "ros-1-plugin", Severity.ERROR, Concern.INTERFACE)
def check(
    host: PluginHost, package: Package, spawned: SpawnedFiles | None, context: Context
) -> Findings:
    """Report libraries and parameters that only the plugins of the other ROS have."""
    for_ros_1 = context.release == CLASSIC and not context.is_classic and is_of_catkin(package)
    if not for_ros_1 and not (context.is_classic and ros_2_package(package) is not None):
        return
    if host.unread:
        yield unchecked(host.unread)
    if for_ros_1:
        for plugin in host.plugins:
            yield from _parameters_of_ros_2(plugin)
        return
    here, renamed = plugin_libraries(context.release), table("gazebo_classic_ros2")["ros_1"]
    built = available_packages(package).libraries()
    is_shown = host.robot is not None and spawned is not None and spawned.without(host.robot) != ""
    for plugin in host.plugins:
        stem = library_stem(plugin.filename.value)
        known: Mapping[str, Any] | None = renamed["libraries"].get(stem)
        if stem in built:
            continue
        if stem not in here and known is not None:
            yield _library(plugin, known)
        elif stem in here and (read := here[stem].parameters) is not None:
            names = {**renamed["common"], **(known or {}).get("params", {})}
            if _RATE not in read:
                names["updateRate"] = _RATE_OF_SENSOR
            lost = {n: names[n] for n in names if n not in read}
            sent = _sent_topics(host, plugin) if lost else ()
            found = _parameters(plugin, lost, package, sent)
            yield from map(_slight, found) if is_shown else found


def _parameters_of_ros_2(plugin: Plugin) -> Iterator[Finding]:
    """Report parameters that only the plugin for ROS 2 reads, and not the one for ROS 1."""
    library = library_stem(plugin.filename.value)
    of_ros_2 = plugin_libraries(CLASSIC).get(library)
    known = table("gazebo_classic_ros2")["ros_1"]["libraries"].get(library, {}).get("params", {})
    read = (of_ros_2.parameters if of_ros_2 is not None else None) or frozenset()
    names = {new: old for old, new in known.items() if new in read}
    for element in plugin.element.children:
        instead = names.get(element.tag)
        if instead is not None and plugin.element.child(instead) is None:
            yield finding(
                element,
                f"{library} ignores <{element.tag}>, a parameter of ROS 2: ROS 1 reads <{instead}>",
                severity=None if _NAMES_PART.fullmatch(element.tag) else Severity.WARNING,
                key=library,
            )


def _library(plugin: Plugin, known: Mapping[str, Any]) -> Finding:
    instead, how = known["instead"], known.get("how", "")
    advice = f"use {instead}" if instead else "remove it" if how else "it has no replacement"
    return finding(
        plugin.filename,
        f"{plugin.filename.value} is a plugin of ROS 1, which Gazebo does not find with ROS 2: "
        f"{advice}{f' ({how})' if how and instead else f': {how}' if how else ''}",
        # Another part of Gazebo does the work of one without a replacement.
        severity=Severity.WARNING if how and not instead else None,
        key=plugin.filename.value,
        fix=replace_text(plugin.filename, instead, Safety.UNSAFE) if instead else None,
    )


def _slight(found: Finding) -> Finding:
    return replace(found, severity=Severity.WARNING)


def _sent_topics(host: PluginHost, plugin: Plugin) -> tuple[str, ...]:
    """Return the topics that a plugin publishes."""
    ends = classic_endpoints(host.robot) if host.robot is not None else ()
    return tuple(end.topic for end in ends if end.owner is plugin and end.publishes)


def _parameters(
    plugin: Plugin, names: Mapping[str, str | None], package: Package, sent: Sequence[str]
) -> Iterator[Finding]:
    library = library_stem(plugin.filename.value)
    for element in plugin.element.children:
        if element.tag not in names:
            continue
        instead = names[element.tag]
        is_grave = _is_missed(plugin, instead, element.value) and _is_read(element, package)
        advice = f"ROS 2 reads {_replacement(instead)}" if instead else "ROS 2 does not read it"
        if used := _used_topic(instead, sent, package):
            is_grave, advice = False, f"remove it, as {used[1]} reads {used[0]}, which ROS 2 sends"
        yield finding(
            element,
            f"{library} ignores <{element.tag}>, a parameter of ROS 1: {advice}",
            severity=None if is_grave else Severity.WARNING,
            key=library,
        )


def _used_topic(
    instead: str | None, sent: Iterable[str], package: Package
) -> tuple[str, str] | None:
    """Return the topic that the plugin sends by default, and the file that names it."""
    default = _DEFAULT.match(instead or "")
    topics = [it for it in sent if default is not None and it.endswith(f"/{default['topic']}")]
    for source in _sources(package) if topics else ():
        for topic in topics:
            if topic in source.text:
                return topic, source.file
    return None


def _replacement(instead: str) -> str:
    return f"<{instead}>" if _WORD.fullmatch(instead) else instead


def _is_missed(plugin: Plugin, instead: str | None, value: str) -> bool:
    """Return whether the plugin acts on another thing, since it does not state the parameter."""
    if instead is None or value.strip() in ("", "/"):
        return False
    default = _DEFAULT.match(instead)
    if default is not None and value.strip() == default["topic"]:
        return False
    if instead.startswith(_ROS):
        return plugin.element.child("ros") is None
    return bool(_NAMES_PART.fullmatch(instead)) and plugin.element.child(instead) is None


def _is_read(element: Element, package: Package) -> bool:
    """Return whether another file of the package names the text, if it is a topic of a sensor."""
    if not _OUTPUT.fullmatch(element.tag):
        return True
    topic = element.value.strip()
    return any(topic in source.text for source in _sources(package))


def _sources(package: Package) -> Iterator[SourceText]:
    """Yield what may name a topic that the package reads."""
    files = package.index.with_suffix(".py", ".xml", ".yaml", ".yml", ".rviz", ".cpp", ".hpp")
    sources = (package.read(file.path) for file in files)
    yield from (source for source in sources if isinstance(source, SourceText))


_CLASSIC = {"@profile": "gazebo-classic", "@ros2": True, "urdf/arm.urdf.xacro": None}


def _drive(parameters: str) -> dict[str, object]:
    text = f'<plugin filename="libgazebo_ros_diff_drive.so" name="drive">{parameters}</plugin>'
    return {**_CLASSIC, "@fragment": text}


def _of_ros_1(parameters: str) -> dict[str, object]:
    library = "libgazebo_ros_joint_state_publisher.so"
    text = f'<gazebo><plugin filename="{library}" name="p">{parameters}</plugin></gazebo>'
    return {"@profile": "urdf", "@urdf": text}


_MARK = "  <!-- ^ PLG012 -->"
GOOD = [
    {
        "@profile": "gazebo-classic",
        "@fragment": '<plugin filename="libgazebo_ros_laser.so" name="p"/>',
    },
    _drive("<ros><namespace>rover</namespace></ros><left_joint>left</left_joint>"),
    {
        **_CLASSIC,
        "@fragment": '<plugin filename="libgazebo_ros_laser.so" name="laser"/>',
        "CMakeLists.txt": "project(rover)\nadd_library(gazebo_ros_laser SHARED laser.cpp)\n",
    },
    _of_ros_1("<jointName>shoulder</jointName><updateRate>50</updateRate>"),
    _of_ros_1("<jointName>shoulder</jointName><joint_name>shoulder</joint_name>"),
]
BAD = [
    _drive(f"<leftJoint>left</leftJoint>{_MARK}"),
    _drive(f"<robotNamespace>rover</robotNamespace>{_MARK}"),
    _drive(f"<updateRate>50</updateRate>{_MARK}"),
    _of_ros_1(f"<joint_name>shoulder</joint_name>{_MARK}"),
    _of_ros_1(f"<jointName>shoulder</jointName><update_rate>50</update_rate>{_MARK}"),
    _drive(f"\n<ros/><robotNamespace>rover</robotNamespace>{_MARK}\n"),
    {
        **_CLASSIC,
        "@fragment": f'<plugin filename="libgazebo_ros_laser.so" name="laser"/>{_MARK}',
    },
    {
        **_CLASSIC,
        "@fragment": f'<plugin filename="libgazebo_ros_control.so" name="control">{_MARK}\n'
        "<parameters>/opt/ros/control.yaml</parameters></plugin>",
    },
]
