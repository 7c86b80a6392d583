"""A description for RViz that differs from the simulated robot.

Teams plan with the frames that RViz knows. The frame of a link that only the simulation has is
missing there. If a mass differs, one of the two files is out of date; only RViz reads that of the
description, so this is an info.

Fix: generate the URDF file again from model.sdf.
Source: Model Migration Guide: the URDF file is converted from the SDF model, so that both agree.
"""

from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_SHOWN = 5
_SCOPES = str.maketrans({":": "_", "/": "_"})


@rule("URD005", "urdf-differs-from-sdf", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, description: UrdfDescription, *, share: float = 0.05) -> Findings:
    """Report links that one of the two lacks, and masses that differ.

    Options:
        share: Share of the larger mass by which the two masses of a link may differ; more is
            reported, unless the masses of its rigid body agree.
    """
    if not description.for_rviz:
        return
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    simulated = _Bodies(robot)
    shown = _Bodies(description.robot)
    yield from _missing_links(simulated, shown, description)
    common = [name for name in simulated.links if name in shown.links]
    # Without a single name in common, the names are what differs.
    if common:
        yield from _extra(simulated, shown)
    for name in common:
        ours, theirs = simulated.links[name], shown.links[name]
        if theirs.inertial is None or ours.inertial is None:
            continue
        if ours.scoped_name in robot.unknown_masses:
            continue  # A rule on the model says so.
        if _differ(ours.mass, theirs.mass, share) and _differ(
            simulated.mass_with(name), shown.mass_with(name), share
        ):
            yield finding(
                theirs.inertial.mass,
                f"link {name!r} has a mass of {theirs.mass:g} kg, but {ours.mass:g} kg in "
                f"{robot.document.source.file}",
                severity=Severity.INFO,
                key="mass",
                related=[(ours.inertial.mass, "in the simulation")],
            )


def _differ(one: float, other: float, share: float) -> bool:
    return abs(one - other) > share * max(one, other)


class _Bodies:
    """The links of a robot by their plain names, and their fixed joints."""

    def __init__(self, robot: Robot) -> None:
        bodies = robot.tree.rigid_bodies
        self.links = {_plain(link.scoped_name): link for link in robot.links}
        self._body = {_plain(name): body for name, body in bodies.of_link.items()}
        self._mass: dict[str, float] = {}
        for name, link in self.links.items():
            self._mass[self._body[name]] = self._mass.get(self._body[name], 0.0) + link.mass

    def mass_with(self, name: str) -> float:
        """Return the mass of a link with all links fixed to it, kilograms."""
        return self._mass[self._body[name]]

    def body_of(self, name: str) -> str:
        """Return the name of the rigid body that a link is a part of."""
        return self._body[name]


def _plain(name: str) -> str:
    """Return a link's name without the robot's name as a prefix, nested or not."""
    return name.rpartition("/")[2].translate(_SCOPES)


def _missing_links(
    simulated: _Bodies, shown: _Bodies, description: UrdfDescription
) -> Iterator[Finding]:
    lacking = [name for name in simulated.links if name not in shown.links]
    if lacking:
        message = f"{len(lacking)} of {len(simulated.links)} links of the model are missing: "
        if len(lacking) == len(simulated.links) and shown.links:
            other = next(iter(shown.links))
            message = f"no link name matches the model, for example {other!r}; expected "
        yield finding(
            description.document.root,
            message + ", ".join(lacking[:_SHOWN]) + (" …" if len(lacking) > _SHOWN else ""),
            key="missing",
            related=[(simulated.links[name], f"link {name!r}") for name in lacking[:_SHOWN]],
        )


def _extra(simulated: _Bodies, shown: _Bodies) -> Iterator[Finding]:
    """Yield links with mass that the model lacks, unless it has merged them with others."""
    merging = {shown.body_of(name) for name in shown.links if name in simulated.links}
    for name, link in shown.links.items():
        if name not in simulated.links and link.mass > 0 and shown.body_of(name) not in merging:
            yield finding(
                link.name,
                f"link {name!r} has a mass of {link.mass:g} kg, but the model lacks it",
                key="extra",
            )


_FILE = "urdf/robot_from_sdf.xacro"
_MODEL = '<link name="wheel"><inertial><mass>2</mass></inertial></link>'
_BASE = '<link name="robot_name/base_link"/>\n'


def _example(*links: str) -> dict[str, str]:
    body = "\n".join(links)
    return {"@fragment": _MODEL, _FILE: f'<robot name="rover">\n{_BASE}{body}\n</robot>\n'}


def _link(name: str, mass: str) -> str:
    return f'<link name="robot_name/{name}"><inertial>\n<mass value="{mass}"/>'


_END = "\n</inertial></link>"
_HUB = """<joint name="robot_name/hub_joint" type="fixed">
<parent link="robot_name/wheel"/><child link="robot_name/hub"/></joint>"""
_MARK = "  <!-- ^ URD005 -->"
GOOD = [
    _example(_link("wheel", "2.01") + _END),
    _example(_link("wheel", "2") + _END, '<link name="robot_name/camera_frame"/>'),
    _example(_link("wheel", "1.5") + _END, _link("hub", "0.5") + _END, _HUB),
    {"@urdf": True},
]
BAD = [
    _example(_link("wheel", "3") + _MARK + _END),
    {
        "@fragment": _MODEL,
        _FILE: f'<robot name="rover">{_MARK}\n{_BASE}</robot>\n',
    },
    _example(
        _link("wheel", "2") + _END,
        f'<link name="robot_name/mast">{_MARK}<inertial>\n<mass value="1"/>{_END}',
    ),
]
