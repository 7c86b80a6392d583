"""Links and joints of robots as a graph of Mermaid."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from checker.base.words import plain
from checker.report.robot_facts import NotRead, PackageFacts, RobotFacts

_SPECIAL = str.maketrans({char: f"#{ord(char)};" for char in '"#<>&`|[]{}()\\;'})


def robots_mermaid(packages: Iterable[PackageFacts]) -> str:
    """Return one graph, with a subgraph for each robot; what was not read is in comments."""
    return "".join(f"{line}\n" for line in _lines(packages))


def _lines(packages: Iterable[PackageFacts]) -> Iterator[str]:
    yield "graph TD"
    number = 0
    for package in packages:
        yield from _comments(package.not_read, package.name)
        for robot in package.robots:
            yield f'  subgraph r{number}["{_text(robot.name)}"]'
            yield from (f"    {line}" for line in _robot(robot, f"r{number}_"))
            yield "  end"
            yield from _comments(robot.not_read, robot.name)
            number += 1


def _comments(items: Iterable[NotRead], of: str) -> Iterator[str]:
    for item in items:
        yield f"  %% not read of {_text(of)}: {_text(item.fact)}: {_text(item.reason)}"


def _robot(robot: RobotFacts, prefix: str) -> Iterator[str]:
    ids: dict[str, str] = {}
    for link in robot.links:
        ids.setdefault(link.name, f"{prefix}{len(ids)}")
        mass = "mass not read" if link.mass_kg is None else f"{link.mass_kg:g} kg"
        yield f'{ids[link.name]}["{_text(link.name)}<br/>{mass}"]'
    yield from _ends(robot, ids, prefix)
    for joint in robot.joints:
        label = f"{_text(joint.name)}<br/>{_text(joint.type)}"
        yield f'{ids[joint.parent]} -->|"{label}"| {ids[joint.child]}'


def _ends(robot: RobotFacts, ids: dict[str, str], prefix: str) -> Iterator[str]:
    """Yield the ends of joints that are no links: the world, and what does not exist."""
    for joint in robot.joints:
        for end in (joint.parent, joint.child):
            if end not in ids:
                ids[end] = f"{prefix}{len(ids)}"
                yield f'{ids[end]}(["{_text(end)}"])'


def _text(text: str) -> str:
    """Return a text that Mermaid shows as it is."""
    return plain(text).translate(_SPECIAL)
