"""A package of the ROS bridge with a name that the release does not have.

The bridge's packages had three names: ros1_ign_bridge, ros_ign_bridge and ros_gz_bridge. roslaunch
finds no node under a wrong name, and the topics of that node never reach ROS.

Fix: write the name for the release, in launch files and in package.xml.
Source: names of the packages of ros_ign and ros_gz (`renamed_packages.json`); early SubT packages
name ros1_ign_bridge, none of the accepted ones that we checked does.
"""

import re
from collections.abc import Iterator, Mapping

from checker.base.resources import table
from checker.package.package import Package
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument

_FIND = re.compile(r"\$\(find\s{1,20}([\w-]{1,100})\s{0,20}\)")


@rule("ROS011", "renamed-package", Severity.WARNING, Concern.PORTABILITY)
def check(package: Package, context: Context) -> Findings:
    """Report old and later names in the launch files and in package.xml."""
    renamed: Mapping[str, str] = table("renamed_packages")["releases"].get(context.release, {})
    if not renamed:
        return
    for name in _names(package):
        fitting = renamed.get(name.value)
        if fitting is None:
            continue
        exact = name.span.text == name.value
        yield finding(
            name,
            f"package {name.value!r} is called {fitting!r} on {context.release.capitalize()}",
            key=name.value,
            fix=replace_text(name, fitting, Safety.UNSAFE) if exact else None,
        )


def _names(package: Package) -> Iterator[Located[str]]:
    """Yield the packages that launch files start or look up, and those of package.xml."""
    for file in package.index.with_suffix(".launch"):
        document = package.xml(file.path)
        if isinstance(document, XmlDocument):
            for element in document.elements:
                yield from _names_in(element)
    manifest = package.xml("package.xml")
    if isinstance(manifest, XmlDocument):
        for element in manifest.root.children:
            if element.tag.endswith("depend"):
                yield element.text


def _names_in(element: Element) -> Iterator[Located[str]]:
    if element.tag in ("node", "test") and (named := element.attribute("pkg")) is not None:
        yield named
    for attribute, value in element.attributes.items():
        if "$(find" not in value or (written := element.attribute(attribute)) is None:
            continue
        for match in _FIND.finditer(value):
            span = written.span
            if span.text == value:
                start, end = match.span(1)
                span = Span(span.source, span.start + start, span.start + end, span.holder)
            yield Located(match.group(1), span)


_TOPICS = "launch/vehicle_topics.launch"
_MARK = "  <!-- ^ ROS011 -->"


def _launch(line: str) -> dict[str, str]:
    return {_TOPICS: f"<launch>\n{line}\n</launch>\n"}


GOOD = [
    _launch('<node pkg="ros_ign_bridge" type="parameter_bridge" name="ros1_ign_bridge_imu"/>'),
]
BAD = [
    _launch(f'<node pkg="ros1_ign_bridge" type="parameter_bridge" name="imu"/>{_MARK}'),
    _launch(f'<include file="$(find ros1_ign_image)/launch/image.launch"/>{_MARK}'),
    _launch(f'<node pkg="ros_gz_image" type="image_bridge" name="front"/>{_MARK}'),
    {
        "package.xml": "<package>\n<name>acme_rover_sensor_config_1</name>\n"
        f"<exec_depend>ros1_ign_bridge</exec_depend>{_MARK}\n</package>\n"
    },
]
