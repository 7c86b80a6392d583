"""The title or commands of specifications.md are about another robot or configuration.

A copied specification sheet that keeps the other number or command starts the other robot. Mentions
of other configurations are fine; only what specifications.md says about itself counts. Another team
is reported in the title, in the text below it, in the first paragraph of the description and in the
description of model.config, unless the sentence names the own team too, or says with words such as
"based on" where the robot comes from. PKG012 reports names of other packages.

Fix: write this package's name and number.
Source: SubT reviews of sheets copied from another configuration.
"""

import re
from collections.abc import Iterator

from checker.model.specification.sheet import Specification
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.submissions import (
    NAME,
    NUMBERED,
    blank_xml_comments,
    configuration_number,
    is_same_robot,
    stated_number,
    title_of_another,
)
from checker.package.teams import TEAM_OF, other_teams
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.markdown import Passage, PassageKind
from checker.source.text import Located, Span

_ITSELF = re.compile(
    rf"\b(?:this|the)\s+(?:[\w-]+\s+){{1,4}}with\s+{NUMBERED}(?=[\s,]+(?:includes|carries|has|is)\b)"
    rf"|\b(?:description|proof)\b[^.]{{0,160}}?\bwith\s+{NUMBERED}"
    rf"|\bvalidation\s+for\b[^.]{{0,120}}?\bwith\s+{NUMBERED}"
    rf"|\bthis\s+{NUMBERED}",
    re.IGNORECASE,
)
_INTRODUCTION = 4
"""Passages: the title, and what is below it."""
_COMMAND = re.compile(
    r"\b(?:roslaunch|ign\s+launch|rosrun|robotConfig\d*:=|modelName:=)[^\n]{0,500}", re.IGNORECASE
)
_VARIABLE = re.compile(r"\bvariable\s+name\s+`{0,2}(\w{1,200})", re.IGNORECASE)


@rule("DOC006", "specification-of-another-robot", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, specification: Specification | None) -> Findings:
    """Compare the title, the commands and statements about the robot with the package's name."""
    if paperwork.config is not None and configuration_number(package.name) is not None:
        yield from _description_findings(paperwork.config.description, package.name)
    if specification is None:
        return
    source = specification.source
    # An inherited sheet speaks of the package that it is in.
    owner = source.file.split("/")[1] if source.file.startswith("../") else package.name
    number = configuration_number(owner)
    if number is None:
        return
    yield from _title(specification, owner, number)
    yield from _introduction_findings(specification, owner)
    yield from _commands(specification, owner)
    yield from _of_itself(specification, owner, number)


def _title(sheet: Specification, owner: str, number: int) -> Iterator[Finding]:
    """Report another number in the title; a title of several numbers describes them all."""
    title = sheet.sections[0].span if sheet.sections else sheet.source.whole()
    stated = stated_number(title.text)
    if stated is not None and stated != number:
        message = f"the title says configuration {stated}, but the package is {owner}"
        yield finding(title, message)


def _introduction_findings(sheet: Specification, owner: str) -> Iterator[Finding]:
    """Report another team where the sheet states what it is about."""
    is_reported = title_of_another(sheet.source.text, owner) is not None
    for passage in _introduction(sheet):
        if not (passage.kind is PassageKind.HEADING and is_reported):
            for match in other_teams(passage.text, owner):
                yield _of_team(passage.part(*match.span()), match.group(), owner)


def _introduction(sheet: Specification) -> Iterator[Passage]:
    """Yield the title, what is below it, and the first passage of the description."""
    headings = 0
    for passage in sheet.markdown.passages[:_INTRODUCTION]:
        headings += passage.kind is PassageKind.HEADING
        if headings <= 1:
            yield passage
    section = sheet.section("description")
    if section is not None and section.level > 1:
        yield from section.passages[:1]


def _description_findings(description: Located[str], package: str) -> Iterator[Finding]:
    """Report another team in the text of model.config."""
    span = description.span
    text = blank_xml_comments(span.text) if description.stated else ""
    outright = [match.span(1) for match in TEAM_OF.finditer(text)]
    for match in other_teams(text, package):
        if match.span() not in outright:  # PKG012 reports these
            where = Span(span.source, span.start + match.start(), span.start + match.end())
            yield _of_team(where, match.group(), package)


def _of_team(where: Span, team: str, package: str) -> Finding:
    message = f"it is about a robot of {team}, but the package is {package}"
    return finding(where, message, key=f"team {team.casefold()}")


def _commands(sheet: Specification, owner: str) -> Iterator[Finding]:
    """Report names of other robots in commands and in the variable of the sheet."""
    text = sheet.source.text[: len(sheet.markdown.text)]
    stretches = [match.span() for match in _COMMAND.finditer(text)]
    stretches += [match.span(1) for match in _VARIABLE.finditer(sheet.markdown.text)]
    commands = [
        (start, list(NAME.finditer(_split_paths(text[start:end])))) for start, end in stretches
    ]
    own = [any(_is(name, owner) for name in names) for _, names in commands]
    reported: set[int] = set()
    for (start, names), names_itself in zip(commands, own, strict=True):
        for name in names:
            at = start + name.start()
            other = not is_same_robot(name.group(), owner)
            # A command may start a team, and a sheet may show how each configuration starts.
            if names_itself or at in reported or (any(own) and not other):
                continue
            reported.add(at)
            yield finding(
                Span(sheet.source, at, start + name.end()),
                f"the command starts {name.group()}, but the package is {owner}",
                key=f"starts {name.group().casefold()}",
            )


def _is(name: re.Match[str], owner: str) -> bool:
    return name.group().casefold() == owner.casefold()


def _split_paths(command: str) -> str:
    """Return a command with its paths split, so that names in them are found too."""
    return command.replace("/", " ")


def _of_itself(sheet: Specification, owner: str, number: int) -> Iterator[Finding]:
    """Report statements that the sheet describes another configuration."""
    for passage in sheet.markdown.passages:
        for match in _ITSELF.finditer(passage.text):
            group = next(i for i, text in enumerate(match.groups(), 1) if text)
            if int(match.group(group)) != number:
                yield finding(
                    passage.part(*match.span()),
                    "specifications.md says that it describes configuration "
                    f"{match.group(group)}, but the package is {owner}",
                    key="about another configuration",
                )


_MARK = " <!-- ^ DOC006 -->"


def _sheet(*lines: str) -> dict[str, str]:
    return {"specifications.md": "\n".join(lines) + "\n"}


def _config(description: str, mark: str = "") -> dict[str, str]:
    return {"model.config": f"<model><description>{description}</description></model>{mark}\n"}


_XML_MARK = "  <!-- ^ DOC006 -->"

GOOD = [
    _sheet(
        "# Acme Rover Sensor Config 1",
        "Validation for the Rover with Sensor Configuration 1. It is launched using an",
        "`ign launch` command with the variable name `ACME_ROVER_SENSOR_CONFIG_1`.",
        "```",
        "ign launch competition.ign robotConfig1:=ACME_ROVER_SENSOR_CONFIG_1",
        "```",
        "This rover with sensor configuration 1 includes an IMU.",
        "Sensor configuration 2 adds 12 breadcrumbs. Based on x1_sensor_config_4.",
    ),
    _sheet("# Acme Rover Sensor Config 1 to 4", "Acme Rover with sensor configuration 3 flies."),
    _sheet(
        "# Acme Rover Sensor Config 1",
        "This sheet describes the Acme Rover. It is based on the MARBLE Husky.",
        "## Usage",
        "It is used in the same manner as the MARBLE Husky.",
    ),
    {
        "@name": "barcs_qav500_sensor_config_1",
        "launch/spawner.rb": None,
        **_sheet("# BARCS QAV500", "Validation for the BARCS MARBLE QAV500."),
    },
    _config("An explorer of caves by Acme Robotics. Derived from CTU-CRAS-Norlab's Absolem."),
]
BAD = [
    _sheet(f"# Acme Rover Sensor Config 2{_MARK}"),
    _sheet("# R", f"ign launch c.ign robotConfig1:=X1_SENSOR_CONFIG_4{_MARK}"),
    _sheet("# R", f"Use the variable name `acme_rover_sensor_config_3`.{_MARK}"),
    _sheet("# R", f"This rover with sensor configuration 2 includes an IMU.{_MARK}"),
    _sheet(
        "# Rover", f"Proof of the Coordinated Robotics Rover with Sensor Configuration 1.{_MARK}"
    ),
    _sheet(f"# Rover of CTU-CRAS-Norlab{_MARK}"),
    _sheet(f"# Explorer - Rover{_MARK}"),
    _sheet("# Rover", "A rover.", "## Description", f"The MARBLE Rover has six wheels.{_MARK}"),
    _config("CTU-CRAS-NORLAB Rover for SubT.", _XML_MARK),
    _config("Team Explorer's rover for SubT.", _XML_MARK),
]
