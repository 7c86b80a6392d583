"""The first configuration of a robot that is available."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from checker.package.configuration import first_configuration
from checker.package.workspace import Workspace

Write = Callable[[Mapping[str, str]], Path]

ROVER = "acme_rover_sensor_config_"


@pytest.mark.parametrize(
    ("own", "others", "first"),
    [
        ("3", ["1", "2"], "1"),
        ("10", ["9", "11"], "9"),
        ("1", ["2"], None),
        ("2", [], None),
    ],
)
def test_it_has_the_lowest_number(
    write: Write, own: str, others: list[str], first: str | None
) -> None:
    names = [ROVER + number for number in (own, *others)]
    names += ["other_rover_sensor_config_1", f"{ROVER}0", f"{ROVER}1_plugin"]
    space = Workspace((write({f"{name}/package.xml": "<package/>" for name in names}),))
    package = space.package(ROVER + own)
    assert package is not None
    found = first_configuration(package)
    assert (found.name if found else None) == (ROVER + first if first else None)
