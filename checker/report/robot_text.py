"""The facts of robots for a person at a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from checker.base.words import count, plain, shortened
from checker.model.tree import WORLD
from checker.report.figures import facts_in_words
from checker.report.launched import Launched
from checker.report.robot_facts import (
    AxisFacts,
    DriveFacts,
    JointFacts,
    NotRead,
    PackageFacts,
    RobotFacts,
    SensorFacts,
)

_WORDS_LIMIT = 300


def robots_text(packages: Iterable[PackageFacts]) -> str:
    """Return the facts of all packages."""
    return "\n".join(
        "".join(f"{plain(line)}\n" for line in _package(package)) for package in packages
    )


def _package(package: PackageFacts) -> Iterator[str]:
    yield f"{package.name}  ({package.path}, for {package.target})"
    for robot in package.robots:
        yield ""
        yield from _robot(robot)
    for launched in package.launched:
        yield ""
        yield from _launched(launched)
    yield from _not_read(package.not_read, "")


def _robot(robot: RobotFacts) -> Iterator[str]:
    known = ", ".join(fact.phrase for fact in facts_in_words(robot.overview))
    yield f"robot {robot.name}  {robot.file}"
    yield f"  {known}"
    yield from _block("driven by", map(_drive, robot.drives))
    yield "  links and joints"
    yield from (f"    {line}" for line in tree_lines(robot))
    yield from _block("sensors", map(_sensor, robot.sensors))
    yield from _block("controllers", (f"{it.name}  {it.type}" for it in robot.controllers))
    of_sensors = {topic for sensor in robot.sensors for topic in sensor.topics}
    others = (it for it in robot.topics if it.name not in of_sensors)
    yield from _block(
        "topics of plugins",
        (f"{it.name}  {' or '.join(it.types)}, {it.by} {it.direction}" for it in others),
    )
    yield from _block(
        "frames beside the links",
        (f"{it.name}, attached to {it.attached_to or 'the model'}" for it in robot.frames),
    )
    yield from _not_read(robot.not_read, "  ")


def _block(title: str, lines: Iterable[str]) -> Iterator[str]:
    shown = [f"    {line}" for line in lines]
    if shown:
        yield f"  {title}"
        yield from shown


def _not_read(items: Sequence[NotRead], indent: str) -> Iterator[str]:
    for item in items:
        yield f"{indent}not read: {item.fact}: {shortened(item.reason, _WORDS_LIMIT)}"


def tree_lines(robot: RobotFacts) -> Iterator[str]:
    """Yield the tree of links as lines; a link with several parents has its children once."""
    masses = {link.name: link.mass_kg for link in robot.links}
    below: dict[str, list[JointFacts]] = {}
    for joint in robot.joints:
        below.setdefault(joint.parent, []).append(joint)
    above = {joint.child for joint in robot.joints}
    no_links = (name for name in below if name not in masses)
    shown: set[str] = set()
    # Links in a loop have no top: the first that no top leads to is taken for one.
    for top in (*no_links, *(name for name in masses if name not in above), *masses):
        if top not in shown:
            shown.add(top)
            yield _link(top, masses)
            yield from _branches(top, below, masses, shown)


def _branches(
    top: str,
    below: dict[str, list[JointFacts]],
    masses: dict[str, float | None],
    shown: set[str],
) -> Iterator[str]:
    """Yield what is below a link; without recursion, since chains may be long."""
    waiting = _children(below.get(top, ()), "")
    while waiting:
        joint, indent, is_last = waiting.pop()
        again = joint.child in shown
        shown.add(joint.child)
        end = _link(joint.child, masses) + (", shown above" if again else "")
        yield f"{indent}{'└─' if is_last else '├─'} {_joint(joint)} → {end}"
        if not again:
            deeper = indent + ("   " if is_last else "│  ")
            waiting += _children(below.get(joint.child, ()), deeper)


def _children(joints: Sequence[JointFacts], indent: str) -> list[tuple[JointFacts, str, bool]]:
    """Return joints, the first one last, each with whether it is the last of its link."""
    return [(joint, indent, joint is joints[-1]) for joint in reversed(joints)]


def _link(name: str, masses: dict[str, float | None]) -> str:
    if name not in masses:
        return name if name == WORLD else f"{name}, which does not exist"
    mass = masses[name]
    return f"{name} {'mass not read' if mass is None else f'{mass:g} kg'}"


def _joint(joint: JointFacts) -> str:
    words = [joint.type, *map(_axis, joint.axes)]
    words += [f"mimics {name}" for name in joint.mimics]
    words += [f"moved by {joint.moved_by}"] if joint.moved_by else []
    words += [f"commands {', '.join(joint.commands)}"] if joint.commands else []
    return f"{joint.name} ({'; '.join(word for word in words if word)})"


def _axis(axis: AxisFacts) -> str:
    words = []
    if axis.lower is not None or axis.upper is not None:
        low, high = ("…" if end is None else f"{end:g}" for end in (axis.lower, axis.upper))
        words.append(f"{low} to {high} {axis.unit}")
    words += [f"{axis.velocity:g} {axis.unit}/s"] if axis.velocity is not None else []
    force = "N" if axis.unit == "m" else "N·m"
    words += [f"{axis.effort:g} {force}"] if axis.effort is not None else []
    return ", ".join(words)


def _sensor(sensor: SensorFacts) -> str:
    rate = "each step" if sensor.rate_hz is None else f"{sensor.rate_hz:g} Hz"
    topics = _topics(sensor.topics) or "no topic known"
    default = "" if sensor.topic_is_stated or not sensor.topics else " by default"
    frame = f"frame {sensor.frame}" if sensor.frame else "frame by default"
    return f"{sensor.name}  {sensor.type} on {sensor.on}, {rate}, {topics}{default}, {frame}"


def _topics(topics: Sequence[str]) -> str:
    """Return topics, those with one beginning as `/camera/{image, points}`."""
    below, *others = {topic.rpartition("/")[0] for topic in topics} or {""}
    if others or len(topics) < 2:
        return ", ".join(topics)
    return f"{below}/{{{', '.join(topic.rpartition('/')[2] for topic in topics)}}}"


def _drive(drive: DriveFacts) -> str:
    figures = {
        "wheel separation": (drive.wheel_separation_m, "m"),
        "wheel radius": (drive.wheel_radius_m, "m"),
        "up to": (drive.max_velocity_m_s, "m/s"),
        "and": (drive.max_turn_rate_rad_s, "rad/s"),
    }
    known = [f"{name} {it:g} {unit}" for name, (it, unit) in figures.items() if it is not None]
    return f"{drive.by}: {', '.join([*drive.moves, *known])}"


def _launched(launched: Launched) -> Iterator[str]:
    yield f"{launched.file} starts {count(len(launched.nodes), 'node')}"
    by_topic: dict[str, list[str]] = {}
    for node in launched.nodes:
        for topic in node.publishes:
            by_topic.setdefault(topic, []).append(f"{node.name} publishes")
        for topic in node.reads:
            by_topic.setdefault(topic, []).append(f"{node.name} reads")
    lines = (
        f"{topic.name}  {' or '.join(topic.types)}, {', '.join(by_topic.get(topic.name, ()))}"
        for topic in launched.topics
    )
    yield from _block("topics", lines)
    frames = (f"{it.parent} → {it.child}, {it.by}" for it in launched.transforms)
    yield from _block("transforms", frames)
