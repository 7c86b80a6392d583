"""A package.xml without an entry that its format requires.

The parser of package.xml, catkin_pkg, rejects such a file, and the robot cannot be built. catkin
refuses the whole workspace. In ROS 2, colcon only warns that it failed to parse the manifest, and
ament_cmake then stops at the same file; a Python package is built, but ROS does not find it. Users
need the license to use the model, and the maintainer's address for questions. In accepted packages,
only maintainers without a name occur. An entry that is left from the template of another package,
such as "The acme_rover_sensor_config_2 package" or a link to that package's page on ros.org, is
incomplete as well; the link is an info as long as it is a comment.

A Python package of ROS 2 that names no build type is taken for one of CMake.

Fix: write the entry that the finding names: a version such as `1.0.0`, a maintainer with an email
address, a license such as `Apache-2.0`, or the build tool, `catkin` in ROS 1 and `ament_cmake` in
ROS 2.
Source: REP 127, 140 and 149, "Required tags"; what catkin_pkg 1.1 refuses, tested tag by tag. The
warnings are this rule's own: catkin_pkg accepts a maintainer without a name (an info outside SubT),
and a package without catkin.
"""

import re
from collections.abc import Iterator

from checker.package.manifests import PackageManifest, Paperwork
from checker.package.package import Package
from checker.package.submissions import described_package
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located, Span

_VERSION = re.compile(r"[0-9]+\.[0-9]+\.[0-9]+")
_WIKI = r"https?://(?:www\.)?(?:wiki\.)?ros\.org/(?:wiki/)?"
_PAGE = re.compile(
    rf"{_WIKI}(?:Robots/\w{{1,100}}|\w{{1,100}}_(?:bringup|control|description|gazebo|robot|sim"
    r"|simulation|sensor_config_\d{1,4}))/?",
    re.IGNORECASE,
)
"""The page of a robot's package, as templates of package.xml name it."""
_TEMPLATE_LINK = re.compile(rf"<!--\s{{0,80}}<url[^<>]{{0,80}}>({_WIKI}\w{{1,100}})</url>", re.I)
"""Comment that `catkin_create_pkg` writes, with the page of the package."""
_TO_DO = re.compile(r"\s*(?:(?:TODO|TBD|FIXME)\b|todo@)")
_COMMON = {
    "bringup",
    "config",
    "control",
    "description",
    "gazebo",
    "model",
    "robot",
    "sensor",
    "sim",
}
_EMAIL = re.compile(r"[^@\s]+@[^@\s]+")


@rule("PKG006", "incomplete-package-xml", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, context: Context) -> Findings:
    """Check the entries that package.xml must have."""
    if reason := paperwork.unread("package.xml"):
        yield unchecked(reason)
    manifest = paperwork.manifest
    if manifest is None:
        return
    yield from _required(manifest, None if context.is_subt else Severity.INFO)
    yield from _people(manifest, Severity.WARNING if context.is_subt else Severity.INFO)
    yield from _left_from_copying(package, manifest)
    if not manifest.build_type.value and not manifest.depends_on("catkin"):
        yield from _without_build_tool(package, manifest, context)


def _without_build_tool(
    package: Package, manifest: PackageManifest, context: Context
) -> Iterator[Finding]:
    """Report that colcon takes a Python package for one of CMake, or catkin none at all."""
    if not context.distro:
        message = "package.xml does not declare <buildtool_depend>catkin</buildtool_depend>"
        yield finding(manifest, message, severity=Severity.WARNING)
    elif package.exists("setup.py") and not package.exists("CMakeLists.txt"):
        yield finding(
            manifest,
            "package.xml names no build type, so colcon looks for a CMakeLists.txt and stops: add "
            "<export><build_type>ament_python</build_type></export>",
            key="build_type",
        )


def _left_from_copying(package: Package, manifest: PackageManifest) -> Iterator[Finding]:
    """Report another package in the description, and the page of another robot's package."""
    description = manifest.description
    named = described_package(description.value, package.name, manifest.name.value)
    if named:
        yield finding(
            description,
            f"the description is about {named}, but the package is {package.name}",
            severity=Severity.WARNING,
        )
    own = f"{package.name} {manifest.name.value} {description.value}".casefold()
    for link, severity in _links(manifest):
        page = link.span.text.strip().rstrip("/").rpartition("/")[2]
        words = set(page.casefold().split("_")) - _COMMON
        if words and not any(word in own for word in words):
            yield finding(
                link,
                f"the link leads to the page of {page}, but the package is {package.name}",
                severity=severity,
            )


def _links(manifest: PackageManifest) -> Iterator[tuple[Located[str], Severity]]:
    """Yield links to pages of robots' packages; one that is still a comment is an info."""
    for url in manifest.urls:
        if _PAGE.fullmatch(url.value.strip()):
            yield url, Severity.WARNING
    source = manifest.span.source
    for match in _TEMPLATE_LINK.finditer(source.text):
        yield Located(match[1], Span(source, *match.span(1))), Severity.INFO


def _required(manifest: PackageManifest, of_template: Severity | None) -> Iterator[Finding]:
    texts = {
        "name": manifest.name,
        "version": manifest.version,
        "description": manifest.description,
    }
    for tag, text in texts.items():
        if not text.value:
            yield _missing(tag, text)
    version = manifest.version
    if version.value and _VERSION.fullmatch(version.value) is None:
        yield finding(
            version, f"the version is {version.value!r}, expected three numbers such as '1.0.0'"
        )
    if manifest.format.value is None:
        yield finding(manifest.format, "the format of package.xml is not 1, 2 or 3")
    if not manifest.licenses:
        yield _missing("license", Located("", manifest.span, stated=False))
    yield from (_missing("license", text) for text in manifest.licenses if not text.value)
    people = [text for each in manifest.maintainers for text in (each.name, each.email)]
    for text in (manifest.description, *manifest.licenses, *people):
        if _TO_DO.match(text.value):
            yield finding(
                text,
                f"{text.value[:60]!r} is left from a template",
                severity=of_template,
                key="template",
            )


def _people(manifest: PackageManifest, nameless: Severity) -> Iterator[Finding]:
    if not manifest.maintainers:
        yield _missing("maintainer", Located("", manifest.span, stated=False))
    for person in manifest.maintainers:
        if not person.name.value:
            yield finding(person, "<maintainer> has no name", severity=nameless)
        if not person.email.value:
            name = person.name.value or "maintainer"
            yield finding(person, f"{name} has no email: write <maintainer email=…>")
        elif _EMAIL.fullmatch(person.email.value) is None:
            yield finding(person.email, f"{person.email.value!r} is not an email address")


def _missing(tag: str, text: Located[str]) -> Finding:
    is_root = text.span.element.count("/") == 0
    return finding(text, f"<{tag}> is {'missing' if is_root else 'empty'}", key=tag)


def _manifest(description: str, maintainer: str, license: str) -> str:
    return f"""<package format="2">
  <name>acme_rover_sensor_config_1</name>
  <version>1.0.0</version>
  <description>{description}
  <maintainer{maintainer}
  <license>{license}
  <buildtool_depend>catkin</buildtool_depend>
</package>
"""


_DESCRIPTION = "The acme_rover_sensor_config_1 package</description>"
_MAINTAINER = ' email="a@example.org">A</maintainer>'
_PAGES = "<url>http://wiki.ros.org"
_LICENSE = "Apache-2.0</license>"
_MARK = "  <!-- ^ PKG006 -->"

_PYTHON = """<package format="3">
  <name>acme_arm</name>
  <version>1.0.0</version>
  <description>An arm.</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>rclpy</exec_depend>{}
</package>
"""
_EXPORT = "<export><build_type>ament_python</build_type></export>"


def _python(export: str) -> dict[str, object]:
    return {
        "package.xml": _PYTHON.format(export),
        "setup.py": "from setuptools import setup\n",
        "CMakeLists.txt": None,
        "@profile": "ros2",
    }


GOOD = [
    _python(_EXPORT),
    {"package.xml": _manifest(_DESCRIPTION, _MAINTAINER, _LICENSE)},
    {
        "package.xml": _manifest(
            f"The acme_rover_sensor_config_1 tracked vehicle package</description>\n"
            f"  {_PAGES}/rover_description</url> {_PAGES}/xacro</url>\n"
            f"  <!-- {_PAGES}/acme_rover_sensor_config_1</url> -->",
            _MAINTAINER,
            _LICENSE,
        )
    },
]
BAD = [
    {**_python(""), "@reported": ["package.xml:1"]},
    {"package.xml": _manifest(_DESCRIPTION, f">A</maintainer>{_MARK}", _LICENSE)},
    {"package.xml": _manifest(_DESCRIPTION, _MAINTAINER, f"</license>{_MARK}")},
    {"package.xml": _manifest(_DESCRIPTION, _MAINTAINER, f"TODO</license>{_MARK}")},
    {
        "package.xml": _manifest(
            f"The x1_sensor_config_6 package</description>{_MARK}", _MAINTAINER, _LICENSE
        )
    },
    {"package.xml": f"<package><name>rover</name></package>{_MARK}"},
    {
        "package.xml": _manifest(
            f"The acme_rover_sensor_config_2 package</description>{_MARK}", _MAINTAINER, _LICENSE
        )
    },
    {
        "package.xml": _manifest(
            f"{_DESCRIPTION}\n  {_PAGES}/quadrotor_description</url>{_MARK}", _MAINTAINER, _LICENSE
        )
    },
    {
        "package.xml": _manifest(
            f"{_DESCRIPTION}\n  <!-- {_PAGES}/x1_sensor_config_6</url> -->{_MARK}",
            _MAINTAINER,
            _LICENSE,
        )
    },
]
