"""The name of another submission, left from copying.

A copied package keeps the name of the other robot in titles, descriptions and commands; people then
read about another robot, or start it. Names in `find`, `require`, Fuel URIs and dependencies are
intended, and so are names that words such as "derived from" explain. A `$(find …)` or `package://`
URI of another robot's package is reported if this package has the file under the same path: it was
copied, and the URI still leads to the original.

Fix: write this package's name.
Source: model reviews: the name of another team in model.config. A launch command that starts
another robot is an error, since that one then runs.
"""

from collections.abc import Iterator

from checker.package.dependencies import duplicate_files
from checker.package.inheritance import SHEET, SUBMISSION_NAME, own_sheet
from checker.package.kind import PackageKind
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.references import ReferenceKind
from checker.package.submissions import (
    blank_xml_comments,
    is_same_robot,
    left_from_copying,
    title_of_another,
)
from checker.package.teams import TEAM_OF, teams
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located, SourceText, Span

TEAMS = tuple(team.prefix.partition("_")[0] for team in teams())


@rule("PKG012", "leftover-from-copy", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, *, teams: tuple[str, ...] = TEAMS) -> Findings:
    """Look for other names in package.xml, model.config, specifications.md and the spawner.

    Options:
        teams: Names of teams in lower case; a description in model.config that says "of the … team"
            with one of them is reported unless the package's name contains it.
    """
    if SUBMISSION_NAME.search(package.name) is None:
        return
    if paperwork.manifest is not None:
        yield from _copied_names(package, paperwork.manifest.description)
    if paperwork.config is not None:
        for text in (paperwork.config.name, paperwork.config.description):
            yield from _copied_names(package, text)
        yield from _other_team(package, paperwork.config.description, teams)
    yield from _commands(package, paperwork)
    for use in duplicate_files(package):
        yield finding(
            use.place,
            f"{use.how} is of another robot, but {package.name} has this file",
            key=f"file of {use.package_name}",
        )
    sheet = package.read(own_sheet(package) or SHEET)
    if isinstance(sheet, SourceText):
        yield from _title(package, sheet)
        yield from _copied_names(package, Located("", Span(sheet, 0, len(sheet.text))))


def _copied_names(package: Package, text: Located[str]) -> Iterator[Finding]:
    """Report names of other robots in the text of a span, comments left out."""
    if not text.stated:
        return
    written = blank_xml_comments(text.span.text)
    for match in left_from_copying(written, package.name):
        where = Span(
            text.span.source, text.span.start + match.start(), text.span.start + match.end()
        )
        message = f"{match.group()} is named, but the package is {package.name}"
        yield finding(where, message, key=match.group())


def _other_team(package: Package, text: Located[str], teams: tuple[str, ...]) -> Iterator[Finding]:
    for match in TEAM_OF.finditer(text.value):
        team = match.group(1)
        words = package.name.casefold().split("_")
        if team.casefold() in teams and team.casefold() not in words:
            yield finding(
                text, f"the description names the team {team}, but the package is {package.name}"
            )


def _commands(package: Package, paperwork: Paperwork) -> Iterator[Finding]:
    """Report commands that start another robot, unless it is declared or provides the model."""
    manifest = paperwork.manifest
    for reference in package.references:
        name = reference.package_name
        started = reference.kind is ReferenceKind.ROSLAUNCH and not reference.by_sibling
        if not started or package.kind is not PackageKind.ROBOT:
            continue
        if SUBMISSION_NAME.search(name) is None or is_same_robot(name, package.name):
            continue
        if manifest is None or not manifest.depends_on(name):
            message = (
                f"the command starts {reference.file} of {name}, but the package is {package.name}"
            )
            yield finding(reference.place, message, severity=Severity.ERROR, key=f"starts {name}")


def _title(package: Package, sheet: SourceText) -> Iterator[Finding]:
    """Report a title that shares no word with the robot's name."""
    title = title_of_another(sheet.text, package.name)
    if title is not None:
        where = Span(sheet, *title.span(1))
        message = f"the title is {title.group(1)!r}, but the package is {package.name}"
        yield finding(where, message)


def _example(text: str) -> dict[str, str]:
    return {
        "package.xml": f"""<package format="2">
  <name>acme_rover_sensor_config_1</name>
  <description>{text}
</package>
""",
    }


def _launch(name: str, file: str, mark: str = "") -> str:
    return f'<launch>\n<param name="r" textfile="$(find {name})/{file}"/>{mark}\n</launch>\n'


_TOPICS = "launch/vehicle_topics.launch"
_XML_MARK = "  <!-- ^ PKG012 -->"

GOOD = [
    _example(
        "The acme_rover_sensor_config_1 package, derived from x1_sensor_config_4</description>"
    ),
    {"specifications.md": "# Acme Rover Sensor Config 1\nAs fast as x1_sensor_config_4.\n"},
    {
        "@name": "MARBLE_HD2_sensor_config_1",
        "model.config": "<model><description>The HD2 of the Marble team</description></model>",
        "specifications.md": "# MARBLE HD2 Sensor Config 1\n",
        "launch/spawner.rb": None,
    },
    {
        _TOPICS: _launch("marble_husky_sensor_config_1", "urdf/husky.urdf"),
        "urdf/rover.urdf": "<robot name='r'/>",
    },
    {_TOPICS: _launch("marble_husky_sensor_config_1", _TOPICS)},
    {_TOPICS: _launch("marble_husky_sensor_config_1", "launch")},
]
BAD = [
    _example("The x1_sensor_config_4 package</description>  <!-- ^ PKG012 -->"),
    {"specifications.md": "# MARBLE HD2 Sensor Config 1 <!-- ^ PKG012 -->\n"},
    {"specifications.md": "# Rover\nX1_SENSOR_CONFIG_4 has a lidar. <!-- ^ PKG012 -->\n"},
    {
        "model.config": """<model>
  <description>A rover of the Marble team</description>  <!-- ^ PKG012 -->
</model>
"""
    },
    {
        _TOPICS: _launch("marble_husky_sensor_config_1", "urdf/rover.urdf", _XML_MARK),
        "urdf/rover.urdf": "<robot name='r'/>",
    },
    {
        "urdf/arm.xacro": '<robot><mesh filename="package://marble_spot_sensor_config_1/'
        f'meshes/arm.dae"/></robot>{_XML_MARK}',
        "meshes/arm.dae": "<COLLADA/>",
    },
]
