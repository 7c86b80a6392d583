"""The text files of the new package, from the templates that come with the checker."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields
from functools import cache
from typing import TYPE_CHECKING, Any

from checker.convert.writing import exact
from checker.migrate.bridges import SensorBridges
from checker.migrate.drive import LATERAL_COMPLIANCE, Drive
from checker.migrate.measured_facts import Facts, sensor_lines
from checker.migrate.naming import Names
from checker.migrate.papers import Papers
from checker.migrate.servos import Servo
from checker.record import record
from checker.resources import templates

if TYPE_CHECKING:
    from jinja2 import Environment

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
"""Where each template's text goes."""
_PLAIN = (".rb.j2", ".md.j2", ".txt.j2")
_LIMITS = ("min_velocity", "max_velocity", "min_acceleration", "max_acceleration", "power_load")


@record(eq=False)
class Known:
    """What the files are written from.

    Attributes:
        names: Of the package and robot.
        papers: Who made it.
        facts: What was measured.
        drive: None for a robot without wheels.
        servos: Joints that are held at a position.
        sensors: What is bridged.
        folders: Of the package, to be installed.
    """

    names: Names
    papers: Papers
    facts: Facts
    drive: Drive | None
    servos: Sequence[Servo]
    sensors: Sequence[SensorBridges]
    folders: Sequence[str]

    @property
    def words(self) -> dict[str, Any]:
        """Everything by the names that templates use."""
        drive, facts = self.drive, self.facts
        said = f"{self.names.robot.replace('_', ' ').capitalize()}, moved from Gazebo 9 to Ignition"
        return {
            **_by_name(facts),
            **_by_name(self),
            "description": f"{said}: {facts.description}" if facts.description else said,
            "turning_radius": f"{drive.turning_radius:.2f}" if drive else "",
            "lateral_compliance": exact(LATERAL_COMPLIANCE),
            "sensor_lines": list(sensor_lines(facts)),
            "lines": {},
        }


def texts(known: Known) -> Iterator[tuple[str, str]]:
    """Yield the path and text of each file."""
    words = known.words
    spawner = _rendered("spawner.rb", words)
    for name, target in _TARGETS.items():
        # The sheet says on which lines of the spawner the limits stand.
        filled = {**words, "lines": _lines_of(spawner)}
        yield target, spawner if name == "spawner.rb" else _rendered(name, filled)


def _by_name(holder: Facts | Known) -> dict[str, Any]:
    return {each.name: getattr(holder, each.name) for each in fields(holder)}


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

    made = Environment(
        loader=FunctionLoader(lambda name: templates("migrate").joinpath(name).read_text("utf-8")),
        # What becomes XML is escaped; names in Ruby were looked at before (`check_names`).
        autoescape=_becomes_xml,  # noqa: S701
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    made.filters["number"] = exact
    return made
