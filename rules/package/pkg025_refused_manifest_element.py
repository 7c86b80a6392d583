"""An element of package.xml that the parser of manifests refuses.

catkin_pkg refuses the whole file if it has an element or attribute that its format does not know,
such as `<depends>`, or `<run_depend>` in format 2 and later; and if `<depend>` names a package that
`<build_depend>`, `<build_export_depend>` or `<exec_depend>` names as well. catkin then builds
nothing of the workspace; colcon reports that it failed to parse the manifest, and CMake stops at
the same file.

Fix: write the element as the message names it; of two dependencies on one package keep `<depend>`.
Source: catkin_pkg 1.1, `parse_package_string`; REP 127, 140 and 149.
"""

from collections.abc import Iterator, Mapping, Sequence

from checker.base.words import Suggestions, and_list
from checker.finding import Fix
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, rule
from checker.source.xml import Element, XmlDocument
from checker.source.xml_insertion import removal

_VERSIONS = ("version_lt", "version_lte", "version_eq", "version_gte", "version_gt")
_ALWAYS: Mapping[str, tuple[str, ...]] = {
    "name": (),
    "version": ("compatibility",),
    "description": (),
    "maintainer": ("email",),
    "license": (),
    "url": ("type",),
    "author": ("email",),
    "export": (),
    **dict.fromkeys(
        ("build_depend", "buildtool_depend", "test_depend", "conflict", "replace"), _VERSIONS
    ),
}
"""Elements of each format, and their attributes."""
_FROM_FORMAT_2 = (
    *("build_export_depend", "buildtool_export_depend", "depend", "exec_depend", "doc_depend"),
)
_INCLUDED = ("build_depend", "build_export_depend", "exec_depend")
"""What `<depend>` states at once."""


@rule("PKG025", "refused-manifest-element", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Report unknown elements and attributes, and dependencies that are stated twice."""
    document, manifest = package.xml("package.xml"), paperwork.manifest
    if manifest is None or not isinstance(document, XmlDocument):
        return
    version = manifest.format.value or 1
    known = _known(version)
    suggestions = Suggestions(known)
    for element in document.root.children:
        if element.tag not in known:
            yield _unknown(element, version, suggestions)
        elif unknown := [name for name in element.attributes if name not in known[element.tag]]:
            names = and_list([repr(name) for name in unknown])
            yield finding(element, f"<{element.tag}> has no attribute {names} in format {version}")
    yield from _stated_twice(document.root)


def _known(version: int) -> Mapping[str, Sequence[str]]:
    """Return the elements of a format, each with its attributes."""
    if version == 1:
        return {**_ALWAYS, "run_depend": _VERSIONS}
    known = {**_ALWAYS, **dict.fromkeys(_FROM_FORMAT_2, _VERSIONS)}
    if version == 2:
        return known
    conditional = {tag: (*own, "condition") for tag, own in known.items() if own == _VERSIONS}
    groups = dict.fromkeys(("group_depend", "member_of_group"), ("condition",))
    return {**known, **conditional, **groups, "license": ("file",)}


def _unknown(element: Element, version: int, suggestions: Suggestions) -> Finding:
    tag = element.tag
    meant = "exec_depend" if tag == "run_depend" else suggestions.correction(tag)
    hint = f", expected <{meant}>" if meant else ""
    if tag in _FROM_FORMAT_2:
        hint = ', expected <package format="3">'
    return finding(element, f"format {version} of package.xml has no <{tag}>{hint}", key=tag)


def _stated_twice(root: Element) -> Iterator[Finding]:
    """Report dependencies that `<depend>` states already, under the same condition."""
    stated = {_identity(element): element for element in root.all("depend")}
    for tag in _INCLUDED:
        for element in root.all(tag):
            if (first := stated.get(_identity(element))) is not None:
                yield finding(
                    element,
                    f"<{tag}> names {element.text.value}, which <depend> names already",
                    key=f"{tag} {element.text.value}",
                    related=[(first, "here")],
                    fix=Fix(Safety.SAFE, (removal(element),)),
                )


def _identity(element: Element) -> tuple[object, ...]:
    return element.text.value, frozenset(element.attributes.items())


def _manifest(version: int, lines: str) -> dict[str, str]:
    return {
        "package.xml": f"""<package format="{version}">
  <name>acme_arm</name>
  <version>1.0.0</version>
  <description>An arm</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  {lines}
</package>
"""
    }


_MARK = "  <!-- ^ PKG025 -->"
_DEPEND = "<depend>rclcpp</depend>"
GOOD = [
    _manifest(1, "<build_depend>roscpp</build_depend><run_depend>roscpp</run_depend>"),
    _manifest(2, f"{_DEPEND}<exec_depend>rviz2</exec_depend>"),
    _manifest(3, f"{_DEPEND}<test_depend>rclcpp</test_depend><member_of_group>a</member_of_group>"),
    _manifest(3, f'{_DEPEND}<exec_depend condition="$ROS_VERSION == 1">rclcpp</exec_depend>'),
]
BAD = [
    _manifest(3, f"<depends>rclcpp</depends>{_MARK}"),
    _manifest(3, f"<run_depend>rclcpp</run_depend>{_MARK}"),
    _manifest(1, f"{_DEPEND}{_MARK}"),
    _manifest(2, f'<depend condition="$ROS_VERSION == 2">rclcpp</depend>{_MARK}'),
    _manifest(3, f"{_DEPEND}\n<exec_depend>rclcpp</exec_depend>{_MARK}"),
]
