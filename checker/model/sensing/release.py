"""Which types of sensors a release of Gazebo knows, and which of them it simulates."""

from __future__ import annotations

from functools import cache

from checker.record import record
from checker.resources import table

_ELSEWHERE = frozenset({"lidar", "custom"})
"""Left out of the lost ones: a lidar of the CPU has its twin on the GPU, custom ones a plugin."""


@record()
class SensorTypes:
    """Types of sensors as they are written.

    Attributes:
        known: Those that SDFormat reads.
        lost: Those that it reads and nothing simulates; empty where no release is aimed at.
    """

    known: frozenset[str]
    lost: frozenset[str]


@cache
def sensor_types(release: str) -> SensorTypes:
    """Return the types of a release; for one without a table, whatever any release knows."""
    releases = table("gazebo_sensors")["releases"]
    listed = [releases[release]] if release in releases else list(releases.values())
    entries = [entry for each in listed for entry in each["types"]]
    lost = [each for each in entries if not each["simulated"] and each["type"] not in _ELSEWHERE]
    return SensorTypes(
        _spellings(entries) | {"none"},
        _spellings(lost) | {"none"} if release in releases else frozenset(),
    )


def _spellings(entries: list[dict[str, list[str]]]) -> frozenset[str]:
    return frozenset(spelling for entry in entries for spelling in entry["spellings"])
