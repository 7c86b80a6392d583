"""Creation of the new package: a whole package under its final name, or none."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec.structs import asdict

from checker.base.record import Record
from checker.base.resources import templates
from checker.convert.xml_writer import exact
from checker.migrate.bridges import SensorBridges
from checker.migrate.drive import LATERAL_COMPLIANCE, Drive
from checker.migrate.measured_facts import Facts, sensor_lines
from checker.migrate.names import Names
from checker.migrate.options import NotMigrated
from checker.migrate.plugins import Servo
from checker.migrate.source import Papers
from checker.package.kind import looks_like_package

if TYPE_CHECKING:
    from jinja2 import Environment


# The text files of the new package, from the templates that come with the checker.


_TARGETS = {
    "CMakeLists.txt": "CMakeLists.txt",
    "model.config": "model.config",
    "package.xml": "package.xml",
    "specifications.md": "specifications.md",
    "description.launch": "launch/description.launch",
    "example.ign": "launch/example.ign",
    "spawner.rb": "launch/spawner.rb",
    "vehicle_topics.launch": "launch/vehicle_topics.launch",
    "example.sdf": "worlds/example.sdf",
}
"""Path of the file that each template makes."""
_PLAIN = (".rb.j2", ".md.j2", ".txt.j2")
_LIMITS = (
    *("min_velocity", "max_velocity", "min_acceleration", "max_acceleration"),
    *("voltage", "power_load"),
)


class Known(Record, eq=False):
    """Facts from which the files are written.

    Attributes:
        names: The names of the package and robot.
        papers: The authors and the licence.
        facts: The measured facts.
        drive: None for a robot without wheels.
        servos: Joints that are held at a position.
        sensors: The sensors that are bridged.
        folders: The folders of the package, to be installed.
    """

    names: Names
    papers: Papers
    facts: Facts
    drive: Drive | None
    servos: Sequence[Servo]
    sensors: Sequence[SensorBridges]
    folders: Sequence[str]

    @property
    def template_values(self) -> dict[str, Any]:
        """Everything by the names that templates use."""
        drive, facts = self.drive, self.facts
        description = (
            f"{self.names.robot.replace('_', ' ').capitalize()}, moved from Gazebo 9 to Ignition"
        )
        return {
            **_by_name(facts),
            **_by_name(self),
            "description": f"{description}: {facts.description}"
            if facts.description
            else description,
            "turning_radius": f"{drive.turning_radius:.2f}" if drive else "",
            "lateral_compliance": exact(LATERAL_COMPLIANCE),
            "sensor_lines": list(sensor_lines(facts)),
            "lines": {},
        }


def texts(known: Known) -> Iterator[tuple[str, str]]:
    """Yield the path and text of each file."""
    words = known.template_values
    spawner = _rendered("spawner.rb", words)
    for name, target in _TARGETS.items():
        # The sheet says on which lines of the spawner the limits stand.
        filled = {**words, "lines": _lines_of(spawner)}
        yield target, spawner if name == "spawner.rb" else _rendered(name, filled)


def _by_name(holder: Facts | Known) -> dict[str, Any]:
    return asdict(holder)


def _lines_of(spawner: str) -> Mapping[str, int]:
    lines = spawner.splitlines()
    return {
        tag: number
        for tag in _LIMITS
        for number, line in enumerate(lines, 1)
        if re.search(rf"<{tag}>", line)
    }


def _rendered(name: str, known: Mapping[str, Any]) -> str:
    return _environment().get_template(f"{name}.j2").render(known)


def _becomes_xml(template: str | None) -> bool:
    return template is not None and not template.endswith(_PLAIN)


@cache
def _environment() -> Environment:
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    environment = Environment(
        loader=FunctionLoader(lambda name: templates("migrate").joinpath(name).read_text("utf-8")),
        # What becomes XML is escaped; names in Ruby were looked at before (`check_names`).
        autoescape=_becomes_xml,  # noqa: S701
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["number"] = exact
    return environment


_PREFIX = ".subt-check-migrate-"


class Staging(Record):
    """A package that is being written.

    Attributes:
        folder: The folder of the package, for now within a hidden folder.
        final: Its final folder.
    """

    folder: Path
    final: Path

    def write(self, path: str, content: bytes) -> None:
        """Write a file of the package and have it reach the disk."""
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        with target.open("wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())


@contextmanager
def stage_package(destination: Path, package: str) -> Iterator[Staging]:
    """Write a package next to its final place; it is moved there after success.

    The destination may contain other packages: nothing that is there is changed.

    A folder that an interrupted run left behind stays hidden and does not count as content.

    Args:
        destination: Folder of the package; created if needed.
        package: Name of the package's folder.

    Raises:
        NotMigrated: The package is there already, or the destination is a package itself, is no
            folder or cannot be written to.
    """
    folders = _created_folders(destination, package)
    hidden: Path | None = None
    try:
        hidden = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=destination))
        staging = Staging(hidden / package, destination / package)
        staging.folder.mkdir()
        yield staging
        staging.folder.rename(staging.final)
    except OSError as error:
        raise _not_written(destination, error) from None
    finally:
        if hidden is not None:
            shutil.rmtree(hidden, ignore_errors=True)
        for folder in folders:
            # Only what is empty goes: after a failure, what was made for nothing.
            with suppress(OSError):
                folder.rmdir()


def _created_folders(destination: Path, package: str) -> list[Path]:
    """Make the destination; return the folders that were not there, innermost first."""
    try:
        if destination.is_dir():
            _check_free(destination, package)
            return []
        if os.path.lexists(destination):
            raise NotMigrated(
                f"{destination} is not a folder; give a workspace, or a folder that does not exist"
            )
        missing = [folder for folder in (destination, *destination.parents) if not folder.exists()]
        destination.mkdir(parents=True)
    except OSError as error:
        raise _not_written(destination, error) from None
    return missing


def _check_free(destination: Path, package: str) -> None:
    """Refuse a folder that is a package, or has one of this name."""
    if looks_like_package(destination):
        raise NotMigrated(
            f"{destination} is a package, and ROS finds no package inside another; give the folder "
            "that contains the packages"
        )
    if os.path.lexists(destination / package):
        raise NotMigrated(
            f"{destination / package} exists; move it away, or give another --config or --robot"
        )


def _not_written(destination: Path, error: OSError) -> NotMigrated:
    return NotMigrated(
        f"{error.filename or destination} cannot be written: {error.strerror or error}; "
        "no package was made"
    )
