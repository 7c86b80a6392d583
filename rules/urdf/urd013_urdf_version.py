"""A version of URDF that most readers refuse, or an element that the stated version lacks.

urdfdom refuses a robot whose version it does not know. ROS 1 and ROS 2 up to Kilted support only
1.0. At version 1.0, newer readers ignore later elements: a `quat_xyzw` has no effect, and a capsule
is dropped. A limit of acceleration or jerk is an info: only planners use one.

Fix: write `rpy` in place of `quat_xyzw` and a cylinder in place of a capsule. Or state the version
that has them, if all your readers know it.
Source: urdfdom, changelog of 5.1 and 6.0.
"""

from checker.base.resources import table
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.specification import newer_parts, version_of
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD013", "urdf-version", Severity.ERROR, Concern.PORTABILITY)
def check(description: UrdfDescription) -> Findings:
    """Report versions that are unknown or new, and parts that the version does not have."""
    spec = table("urdf_spec")
    versions, older = spec["versions"], ", ".join(spec["older_readers"])
    stated = version_of(description.document)
    if stated.value not in versions:
        known = ", ".join(versions)
        yield finding(stated, f"URDF has no version {stated.value[:40]!r}, expected one of {known}")
        return
    if stated.value != "1.0":
        message = (
            f"version {stated.value} is read by urdfdom {versions[stated.value]} or newer; {older} "
            "refuse the robot"
        )
        yield finding(stated, message, severity=Severity.WARNING)
    for part in newer_parts(description.document):
        message = f"{part.name} needs version {part.since}, but the file is read as {stated.value}"
        level = Severity.INFO if part.name in spec["limits_of_planners"] else None
        yield finding(part.span, f"{message}: it is ignored", severity=level, key=part.name)


def _robot(version: str, inside: str = "", mark: str = "") -> dict[str, str]:
    own = f' version="{version}"' if version else ""
    link = f'<link name="a">{inside}</link>'
    return {
        "urdf/arm.urdf": f'<robot name="arm"{own}>{mark}\n{link}\n</robot>\n',
        "@urdf": "",
    }


_MARK = "  <!-- ^ URD013 -->"
_TURNED = '<visual>\n<origin quat_xyzw="0 0 0 1"/>{}\n<geometry>\n{}</geometry></visual>'
_BOX, _CAPSULE = '<box size="1 1 1"/>', '<capsule radius="1" length="1"/>{}\n'
GOOD = [_robot(""), _robot("1.0")]
BAD = [
    _robot("1.1", _TURNED.format("", _CAPSULE.format("")), _MARK),
    _robot("1", mark=_MARK),
    _robot("1.3", mark=_MARK),
    _robot("1.0", _TURNED.format(_MARK, _BOX)),
    _robot("", _TURNED.format(_MARK, _CAPSULE.format(_MARK))),
]
