"""Faults in masses, inertias, shapes, axes and limits of a URDF file or a model.sdf."""

from __future__ import annotations

from random import Random

from lxml import etree

from bench.planted.edits import (
    Change,
    Kind,
    below,
    kind,
    removed,
    scaled,
    with_attribute,
    with_child,
    with_text,
)
from bench.planted.model import BASE, WHEEL, model
from bench.planted.urdf import MOVING, urdf

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_LINK = (
    "//link[collision or visual][inertial/inertia][@name=/robot/joint[@type!='fixed']/child/@link]"
)
_HEAVY = f"{_LINK}[inertial/mass/@value > 0.3]"
_WHEEL = "//link[collision//cylinder][@name=/robot/joint[@type='continuous']/child/@link]"
_ROLLING = "/robot/joint[@type='continuous'][axis]"


def _moments(*values: float) -> Change:
    """Return a change of the moments of URDF's `<inertia>`."""

    def change(element: etree._Element, _: Random) -> None:
        for name, value in zip(_MOMENTS, values, strict=True):
            element.set(name, f"{value:g}")

    return change


def _times(factor: float) -> Change:
    """Return a change of all moments of URDF's `<inertia>`."""

    def change(element: etree._Element, random: Random) -> None:
        for name in _MOMENTS:
            scaled(factor, of=name)(element, random)

    return change


def _swapped(first: str, second: str) -> Change:
    """Return a change that exchanges two attributes."""

    def change(element: etree._Element, _: Random) -> None:
        one, other = element.get(first, "0"), element.get(second, "0")
        element.set(first, other)
        element.set(second, one)

    return change


def _texts_swapped(element: etree._Element, _: Random) -> None:
    """Exchange the lower and the upper limit of SDF."""
    lower, upper = element.find("lower"), element.find("upper")
    assert lower is not None
    assert upper is not None
    lower.text, upper.text = upper.text, lower.text


OF_URDF: tuple[Kind, ...] = (
    kind("moments in other units", "INE004", urdf(f"{_HEAVY}/inertial/inertia", _times(1e4))),
    kind(
        "the unit tensor",
        "INE004 INE007",
        urdf(f"{_HEAVY}/inertial/inertia", _moments(1, 0, 0, 1, 0, 1)),
    ),
    kind("moments of zero", "INE003", urdf(f"{_HEAVY}/inertial/inertia", _moments(*[0] * 6))),
    kind(
        "a moment with a lost sign",
        "INE002",
        urdf(f"{_HEAVY}/inertial/inertia", scaled(-1, of="ixx")),
    ),
    kind(
        "a product above the moments",
        "INE002",
        urdf(f"{_HEAVY}/inertial/inertia", _moments(0.01, 0.05, 0, 0.01, 0, 0.01)),
    ),
    kind(
        "a centre of mass in millimetres",
        "INE005",
        urdf(f"{_HEAVY}/inertial/origin[@xyz!='0 0 0']", scaled(1e3, of="xyz")),
    ),
    kind(
        "a mass in grams",
        "INE006 INE004",
        urdf(
            f"{_HEAVY}[collision//box or collision//cylinder]/inertial/mass",
            scaled(1e3, of="value"),
        ),
    ),
    kind("no inertial", "URD007", urdf(f"{_LINK}/inertial", removed)),
    kind("an axis of length 2", "KIN004", urdf(f"{MOVING}/axis", scaled(2, of="xyz"))),
    kind(
        "limits reversed",
        "KIN005",
        urdf("//joint[@type='revolute']/limit[@lower!=@upper]", _swapped("lower", "upper")),
    ),
    kind(
        "limits in degrees",
        "GEO016",
        urdf(
            "//joint[@type='revolute']/limit[@lower and @upper]",
            with_attribute("lower", "-90"),
            with_attribute("upper", "90"),
        ),
    ),
    kind("negative damping", "KIN015", urdf("//joint/dynamics", with_attribute("damping", "-0.5"))),
    kind(
        "an angle in degrees",
        "GEO016",
        urdf("//link/*[self::collision or self::visual]/origin", with_attribute("rpy", "0 0 90")),
    ),
    kind(
        "a wheel's cylinder upright",
        "GEO003",
        urdf(f"{_WHEEL}/collision/origin", with_attribute("rpy", "0 0 0")),
    ),
    kind(
        "a wheel's axis across", "GEO003", urdf(f"{_ROLLING}/axis", with_attribute("xyz", "1 0 0"))
    ),
    kind("a wheel's axis reversed", "GEO013", urdf(f"{_ROLLING}/axis", scaled(-1, of="xyz"))),
    kind("a negative radius", "GEO008", urdf("//collision//cylinder", scaled(-1, of="radius"))),
    kind(
        "a mesh in millimetres",
        "MSH005",
        urdf("//visual//mesh", with_attribute("scale", "1000 1000 1000")),
    ),
    kind(
        "a mesh scaled twice",
        "MSH005",
        urdf("//visual//mesh", with_attribute("scale", "0.000001 0.000001 0.000001")),
    ),
)
_SDF_INERTIA = "//link[collision][inertial/mass > 0.5]/inertial"
OF_SDF: tuple[Kind, ...] = (
    kind(
        "moments in other units",
        "INE004",
        model(
            _SDF_INERTIA, *(below(f"inertia/{name}", scaled(1e4)) for name in ("ixx", "iyy", "izz"))
        ),
    ),
    kind(
        "the unit tensor",
        "INE004 INE007",
        model(
            _SDF_INERTIA,
            *(below(f"inertia/{name}", with_text("1")) for name in ("ixx", "iyy", "izz")),
        ),
    ),
    kind(
        "a moment with a lost sign",
        "INE002",
        model(_SDF_INERTIA, below("inertia/ixx", scaled(-1))),
    ),
    kind(
        "moments that break the triangle inequality",
        "INE002",
        model(_SDF_INERTIA, below("inertia/izz", scaled(10))),
    ),
    kind("no inertia", "INE001", model(f"{_SDF_INERTIA}/inertia", removed)),
    kind("no inertial", "INE001", model(f"{WHEEL}/inertial", removed)),
    kind(
        "a centre of mass in millimetres",
        "INE005",
        model(f"{_SDF_INERTIA}/pose", with_text("40 0 25 0 0 0")),
    ),
    kind("a mass in grams", "INE006 INE004", model(f"{WHEEL}/inertial/mass", scaled(1e3))),
    kind(
        "a wheel's cylinder upright",
        "GEO003",
        model(f"{WHEEL}/collision/pose", with_text("0 0 0 0 0 0")),
    ),
    kind(
        "a wheel's axis across",
        "GEO003",
        model("//joint[@type='revolute']/axis/xyz[.='0 1 0']", with_text("1 0 0")),
    ),
    kind(
        "a wheel's axis reversed",
        "GEO013",
        model("//joint[@type='revolute']/axis/xyz[.='0 1 0']", with_text("0 -1 0")),
    ),
    kind("an axis of length 2", "KIN004", model("//joint/axis/xyz", scaled(2))),
    kind("the drive's radius doubled", "GEO004", model("//plugin/wheel_radius", scaled(2))),
    kind(
        "the drive's separation halved", "GEO005", model("//plugin/wheel_separation", scaled(0.5))
    ),
    kind(
        "limits reversed",
        "KIN005",
        model("//joint/axis/limit[number(lower) < number(upper)][lower > -100]", _texts_swapped),
    ),
    kind("a negative radius", "GEO008", model(f"{WHEEL}/collision//radius", scaled(-1))),
    kind("no gravity", "KIN016", model(BASE, with_child("<gravity>false</gravity>"))),
    kind("an angle in degrees", "GEO016", model("//visual/pose", with_text("0 0 0 0 0 90"))),
    kind("a mesh in millimetres", "MSH005", model("//visual//mesh[scale]/scale", scaled(1e3))),
)
