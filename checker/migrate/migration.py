"""The migration from end to end: from a description to a whole package."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree

from checker.base.cache import NO_CACHE
from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.convert.conversion import Conversion
from checker.convert.sdf_to_urdf import xacro_of
from checker.convert.urdf_to_sdf import sdf_of
from checker.convert.xml_writer import document_text
from checker.engine.review import findings_of
from checker.engine.subject import Subject
from checker.finding import Safety
from checker.fix.rounds import fix_package
from checker.migrate.assets import Assets
from checker.migrate.bridges import sensor_bridges
from checker.migrate.drive import Drive, drive_of, turn_forward
from checker.migrate.measured_facts import facts_of
from checker.migrate.names import (
    BASE,
    NO_ORGANIZATION,
    Names,
    call_base_link,
    check_names,
    names_for,
)
from checker.migrate.new_package import Known, Staging, stage_package, texts
from checker.migrate.options import MigrationOptions, NotMigrated
from checker.migrate.plugins import Judged, Servo, judge_plugins, servos_of
from checker.migrate.sensors import rewrite_sensors
from checker.migrate.source import Source, opened_source, original_text, papers_of
from checker.migrate.thumbnails import thumbnails_of
from checker.migrate.wheels import find_drive_wheels
from checker.migrate.xml_parts import sharpen_angles
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.package.inputs import open_input
from checker.report.report import ReportedFinding
from checker.settings import Settings

# What the rules can mend by themselves in the new model: colours, misplaced elements, nesting.


MODEL = "model.sdf"
_SETTINGS = Settings(select=("SDF", "SEN", "REF", "GEO", "KIN"), trial=False, cache=False)
"""Groups of rules on the model alone; of the rest of the package nothing is there yet."""


def mend_model(staging: Staging) -> list[str]:
    """Apply every fix of the rules to the model that was written; return what was mended."""
    with open_input(staging.folder) as opened:
        package = opened.packages[0]
        fixed = fix_package(
            package, lambda subject: findings_of(subject, _SETTINGS, NO_CACHE), list(Safety)
        )
    for file in fixed.files:
        staging.write(file.path, file.after.encode())
    return list(_notes(fixed.findings))


def _notes(findings: tuple[ReportedFinding, ...]) -> Iterator[str]:
    for finding in findings:
        more = f" (and {len(finding.places) - 1} more)" if len(finding.places) > 1 else ""
        yield f"{finding.rule} is fixed: {finding.message}{more}"


_TO_DO = re.compile(r"\bTODO\b:?[ \t]*|\btodo@")
_TEXTS = (".md", ".rb", ".xml", ".config")


class Migrated(Record):
    """A package that was made.

    Attributes:
        folder: The folder of the package.
        notes: What was decided, as sentences.
        open_points: What only the author can decide.
        to_do: Places that state TODO, each with what must be filled in.
    """

    folder: Path
    notes: tuple[str, ...]
    open_points: tuple[str, ...]
    to_do: tuple[str, ...] = ()


@dataclass
class _Log:
    notes: list[str] = field(default_factory=list)
    points: list[str] = field(default_factory=list)


def migrate(path: Path, destination: Path, wishes: MigrationOptions) -> Migrated:
    """Make a package for SubT of a description for Gazebo 9.

    Args:
        path: The description: a package folder, an archive, or a URDF file.
        destination: Folder of the package: empty, or not there yet.
        wishes: The author's options.

    Raises:
        NotMigrated: It cannot be done; no package was made.
        UnreadableInput: The description cannot be opened.
    """
    log = _Log()
    with opened_source(path, wishes.urdf, wishes.args) as source:
        _check_apart(source, destination)
        names = names_for(wishes, source)
        holder = "" if source.package.only else f" of {source.package.name}"
        log.notes.append(f"robot: {source.description.file}{holder}")
        with stage_package(destination, names.package) as staging:
            _fill(staging, source, names, wishes, log)
    if not wishes.organization:
        log.points.insert(0, f"the organization's name, here {NO_ORGANIZATION!r} (--organization)")
    notes, points = (tuple(dict.fromkeys(lines)) for lines in (log.notes, log.points))
    return Migrated(staging.final, notes, points, tuple(_left_to_do(staging.final)))


def _left_to_do(folder: Path) -> Iterator[str]:
    """Yield the lines of the package's texts that state TODO."""
    for path in sorted(folder.rglob("*")):
        if not path.name.endswith(_TEXTS) or not path.is_file():
            continue
        for number, line in enumerate(path.read_text("utf-8").splitlines(), 1):
            if _TO_DO.search(line):
                yield f"{path.relative_to(folder).as_posix()}:{number}: {line.strip()}"


def _check_apart(source: Source, destination: Path) -> None:
    """Refuse to put a package into the one that it is made from: catkin finds no nested ones."""
    package = source.package
    if not package.only and destination.resolve().is_relative_to(package.root.resolve()):
        raise NotMigrated(
            f"{destination} is inside package {package.name}, and ROS finds no package inside "
            "another; give a folder outside it"
        )


def _fill(
    staging: Staging, source: Source, names: Names, wishes: MigrationOptions, log: _Log
) -> None:
    """Write all files of the package."""
    assets = Assets(source)
    conversion, judged = _converted(source, names, assets, log)
    _write_tree(staging, MODEL, conversion.tree)
    for file, content in assets.files():
        staging.write(file, content)
    log.points += assets.notes
    log.notes += mend_model(staging)
    tree = _model_of(staging)
    check_names(tree)
    with _robot_in(staging) as robot:
        drive = _drive(robot, source, wishes, judged)
    if drive is not None:
        turned = turn_forward(tree, drive.wheels)
        log.notes += [*drive.notes, *turned]
        log.points += drive.open_points
        if turned:
            _write_tree(staging, MODEL, tree)
    with _robot_in(staging) as robot:
        _surround(staging, source, names, robot, drive, log)
    original = original_text(source, assets.package_uri(names.package))
    staging.write(f"urdf/{names.short}.orig.urdf", original)


def _converted(
    source: Source, names: Names, assets: Assets, log: _Log
) -> tuple[Conversion, Judged]:
    """Return the new model, its plugins and sensors replaced."""
    description = source.description
    robot = description.robot
    conversion = sdf_of(robot, description, name=names.package, mesh_uri=assets.uri)
    links = [link.get("name") or "" for link in conversion.tree.iter("link")]
    if not links:
        raise NotMigrated(
            f"{description.file} has no link that Gazebo keeps, so the model is empty"
        )
    judged = judge_plugins(conversion, BASE if BASE in links else links[0])
    log.points += judged.open_points
    log.notes += [*conversion.notes, *judged.notes, *rewrite_sensors(conversion.tree)]
    log.notes += [*call_base_link(conversion), *sharpen_angles(conversion.tree)]
    return conversion, judged


def _drive(robot: Robot, source: Source, wishes: MigrationOptions, judged: Judged) -> Drive | None:
    """Return the drive of a robot with wheels; None for one without."""
    driven = frozenset(
        end.name.value.rpartition("/")[2]
        for transmission in source.description.transmissions
        for end in transmission.joints
    )
    wheels = find_drive_wheels(robot, wishes, judged.drives, driven)
    return drive_of(robot, wheels, wishes) if wheels.all else None


def _surround(
    staging: Staging, source: Source, names: Names, robot: Robot, drive: Drive | None, log: _Log
) -> None:
    """Write the other files of a package: launch files, paperwork, pictures."""
    papers = papers_of(source)
    servos = servos_of(source, robot)
    log.points += [*_what_moves_it(drive, servos), *papers.open_points]
    if not any(sensor.kind is SensorType.IMU for sensor in robot.sensors):
        log.points.append("an IMU: the description has none, but every SubT robot has one")
    pictures = thumbnails_of(robot)
    for name, picture in pictures.files.items():
        staging.write(f"thumbnails/{name}.png", picture)
    log.points += [pictures.trouble] if pictures.trouble else []
    folders = sorted(
        {entry.name for entry in staging.folder.iterdir() if entry.is_dir()}
        | {"launch", "urdf", "worlds"}
    )
    sensors = sensor_bridges(robot)
    known = Known(names, papers, facts_of(robot), drive, servos, sensors, folders)
    for file, text in texts(known):
        staging.write(file, text.encode())
    uri = f"package://{names.package}/"
    xacro = xacro_of(robot, name=names.package, mesh_uri=lambda written: uri + written)
    _write_tree(staging, "urdf/robot_from_sdf.xacro", xacro)


def _what_moves_it(drive: Drive | None, servos: list[Servo]) -> Iterator[str]:
    if drive is None and servos:
        yield (
            f"a program that commands the {len(servos)} joints of JointPositionController; the "
            "gains are those of the description's controllers (launch/spawner.rb)"
        )
    elif drive is None:
        yield (
            "the drive: no wheels are found (round parts on continuous joints about their own "
            "axis, in pairs left and right); name their joints with --left-wheels and "
            "--right-wheels, or add another drive plugin to launch/spawner.rb"
        )


def _model_of(staging: Staging) -> etree._Element:
    """Return the model as it was written."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_blank_text=True)
    return etree.parse(staging.folder / MODEL, parser).getroot()


def _write_tree(staging: Staging, path: str, tree: etree._Element) -> None:
    staging.write(path, document_text(tree).encode())


@contextmanager
def _robot_in(staging: Staging) -> Iterator[Robot]:
    """Read the robot as it was written, with its meshes."""
    with open_input(staging.folder) as opened:
        subject = Subject(opened.packages[0], NO_CACHE)
        try:
            robot = subject.one(Robot)
            if isinstance(robot, NotAvailable):
                raise NotMigrated(f"the new model cannot be read: {robot.reason}")
            yield robot
        finally:
            subject.close()
