"""Findings in the robots that other values of xacro's arguments make."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from msgspec.structs import replace

from checker.base.parts import NotAvailable, type_name
from checker.engine.run import Outcome
from checker.engine.subject import Subject
from checker.finding import Place, fingerprint
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.expanded import ExpandedText
from checker.formats.xacro.expansion import Expander
from checker.launch.ros2.graph import Ros2Launch
from checker.model.devices.known import KnownDevices
from checker.model.named_files import NamedFiles
from checker.model.plugin_host import PluginHost
from checker.model.robot import Robot
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.physics.mass.link_inertias import LinkInertias
from checker.physics.mesh.process import MeshServer
from checker.report.report import Cause, ReportedFinding
from checker.robots.parts import ModelFile
from checker.robots.urdf_files import UrdfFiles
from checker.ros.ros2_control.robot_control import PluginFiles, RobotControl
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import Context, Rule

_OF_A_ROBOT = frozenset(
    map(
        type_name,
        (
            *(Robot, UrdfDescription, RobotControl, PluginFiles, LinkInertias, PluginHost),
            NamedFiles,
        ),
    )
)
_BESIDE = _OF_A_ROBOT.union(
    map(type_name, (Package, Paperwork, Context, KnownDevices, SpawnedFiles))
)
_SHARED = (Paperwork, Ros2Launch, SpawnedFiles, Expander, MeshServer)
"""Types of the parts that all robots of a package have in common."""


def other_descriptions(subject: Subject) -> tuple[UrdfDescription, ...]:
    """Return the robots that other values make, if files of the package make any robot."""
    model = subject.one(ModelFile)
    if isinstance(model, NotAvailable) or model.document.root.tag != "robot":
        return ()
    files = subject.one(UrdfFiles)
    return () if isinstance(files, NotAvailable) else files.others


def with_only_robot(subject: Subject, description: UrdfDescription) -> Subject:
    """Return the package with one robot, which another value of an argument makes."""
    return subject.with_part(UrdfFiles((description,)), _SHARED)


def rules_of_one_robot(rules: Iterable[Rule]) -> list[Rule]:
    """Return the rules that look at a robot, and at nothing that more robots may belong to."""
    needs = ((rule, set(rule.needs.values())) for rule in rules)
    return [rule for rule, kinds in needs if kinds & _OF_A_ROBOT and kinds <= _BESIDE]


def new_findings(added: Outcome, known: Outcome, description: UrdfDescription) -> Outcome:
    """Return what was found in a robot and in none before it; each message names the values.

    What could not be read is no reason to doubt the robot that the defaults make, and other
    files than those that describe the robot may be meant for that one.

    Args:
        added: What was found.
        known: What was found in the robots before it.
        description: The description of the robot.
    """
    findings = (*known.findings, *(it.finding for it in known.suppressed), *known.covered)
    reported = {_spot(finding, place) for finding in findings for place in finding.places}
    new = partial(_unreported, reported, description)
    aside = ((it, new(it.finding)) for it in added.suppressed)
    return Outcome(
        tuple(filter(None, map(new, added.findings))),
        tuple(it for it in added.not_checked if it.cause is Cause.CRASHED),
        suppressed=tuple(replace(it, finding=own) for it, own in aside if own is not None),
    )


_Spot = tuple[str, str, int, int]


def _spot(finding: ReportedFinding, place: Place) -> _Spot:
    return finding.rule, place.file, place.line, place.column


def _unreported(
    reported: set[_Spot], description: UrdfDescription, finding: ReportedFinding
) -> ReportedFinding | None:
    """Return a finding with the places that are new; None if its rule reports all of them."""
    source = description.document.source
    read = source.read if isinstance(source, ExpandedText) else ()
    files = {document.source.file for document in read}
    places = [it for it in finding.places if it.note or _spot(finding, it) not in reported]
    main = next((place for place in places if not place.note), None)
    if main is None or main.file not in files:
        return None
    values = f"(with {description.values})"
    own = fingerprint(finding.rule, main.file, main.element, f"{finding.fingerprint} {values}")
    message = main.message or finding.message
    if not description.unloaded or description.unloaded not in message:
        message = f"{message} {values}"
    return replace(finding, message=message, fingerprint=own, places=tuple(places))
