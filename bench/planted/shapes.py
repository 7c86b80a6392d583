"""Faults in the shapes and meshes of a model.sdf."""

from __future__ import annotations

from copy import deepcopy
from random import Random

from lxml import etree

from bench.planted.edits import Kind, below, kind, removed, scaled, shifted, text, with_text
from bench.planted.model import BASE, CYLINDER, WHEEL, model


def copied_mesh(element: etree._Element, _: Random) -> None:
    """Make the visual's mesh the shape of a collision too."""
    (visual, *_rest) = element.xpath("../visual[.//mesh]")
    geometry = element.find("geometry")
    assert geometry is not None
    geometry.append(deepcopy(visual.find("geometry/mesh")))
    element.replace(element.find("pose"), deepcopy(visual.find("pose")))


GEOMETRY = (
    kind(
        "an angle of 1.57", "GEO001", model(f"{WHEEL}/collision/pose", with_text("0 0 0 1.57 0 0"))
    ),
    kind(
        "an angle of 3.14",
        "GEO001",
        model("//visual/pose", scaled(0), shifted(3.14, fields=slice(5, 6))),
    ),
    kind(
        "nothing that touches the ground",
        "GEO002",
        *(model(f"{WHEEL}/collision", removed) for _ in range(4)),
        model(f"{BASE}[collision]/collision", removed),
    ),
    kind(
        "a wheel's cylinder upright",
        "GEO003",
        model(f"{WHEEL}/collision/pose", with_text("0 0 0 0 0 0")),
    ),
    kind(
        "a wheel's collision askew",
        "GEO003",
        model(f"{WHEEL}/collision/pose", with_text("0 0 0 1.4 0 0")),
    ),
    kind("one larger wheel", "GEO006 GEO004", model(f"{CYLINDER}/radius", scaled(1.3))),
    kind(
        "a wheel placed lower", "GEO006", model(f"{WHEEL}/pose", shifted(-0.05, fields=slice(2, 3)))
    ),
    kind(
        "a wheel placed farther out",
        "GEO005 GEO006",
        model(f"{WHEEL}/pose", scaled(1.6, fields=slice(1, 2))),
    ),
    kind(
        "a collision far from its visual",
        "GEO007",
        model(f"{WHEEL}/collision/pose", with_text("0.5 0 0 1.5707963267948966 0 0")),
    ),
    kind(
        "a collision beside its wheel",
        "GEO007",
        model(f"{WHEEL}/collision/pose", with_text("0 0.04 0 1.5707963267948966 0 0")),
    ),
    kind(
        "a visual in millimetres",
        "GEO007 MSH005 GEO014",
        model("//visual[geometry/mesh]", below("geometry/mesh/scale", with_text("1000 1000 1000"))),
    ),
    kind("a box without size", "GEO008", model("//box/size", with_text("0 0 0"))),
    kind("a negative radius", "GEO008", model("//cylinder/radius", scaled(-1))),
    kind("a cylinder of no length", "GEO008", model("//cylinder/length", with_text("0"))),
    kind("a wheel without friction", "GEO009", model(f"{WHEEL}//ode/mu", with_text("0"))),
    kind(
        "a wheel on a mesh",
        "GEO010",
        model(
            f"{WHEEL}[visual//mesh]/collision",
            below("geometry/cylinder", removed),
            copied_mesh,
        ),
    ),
    kind(
        "a chassis below the wheels",
        "GEO011",
        model(f"{BASE}[../{WHEEL[2:]}]/collision/pose", with_text("0 0 -0.3 0 0 0")),
    ),
    kind("a visual that floats", "GEO012", model(f"{BASE}/visual/pose", with_text("4 4 4 0 0 0"))),
    kind(
        "a robot of forty metres",
        "GEO014 GEO007",
        model(f"{BASE}/collision//box/size", with_text("40 1 0.1")),
    ),
    kind(
        "a wheel's visual of another size",
        "GEO007 GEO006 GEO004",
        model(f"{WHEEL}/visual/geometry/mesh/scale", scaled(3)),
    ),
)

MESHES = (
    kind(
        "a mesh that is not there",
        "REF002",
        model("//mesh/uri", with_text("meshes/body_final.dae")),
    ),
    kind(
        "a mesh in the wrong case",
        "REF002",
        model("//mesh/uri[contains(.,'.dae')]", with_text("meshes/Wheel.DAE")),
    ),
    kind(
        "a path of one machine",
        "REF001",
        text("model.sdf", r"<uri>meshes/", "<uri>file:///home/me/ws/meshes/"),
    ),
    kind(
        "a path from the root",
        "REF001",
        text("model.sdf", r"<uri>meshes/", "<uri>/opt/robot/meshes/"),
    ),
    kind(
        "a path out of the package",
        "REF003 REF002",
        text("model.sdf", r"<uri>meshes/", "<uri>../../meshes/"),
    ),
    kind(
        "a mesh of another package",
        "REF001",
        text("model.sdf", r"<uri>meshes/", "<uri>package://other_robot/meshes/"),
    ),
    kind(
        "a mesh format that nothing reads",
        "MSH003 REF002",
        text("model.sdf", r"<uri>meshes/(\w+)\.\w+<", r"<uri>meshes/\1.blend<"),
    ),
    kind(
        "a wheel's mesh in centimetres",
        "MSH005 GEO007 GEO014",
        model(f"{WHEEL}/visual//mesh/scale", scaled(100)),
    ),
    kind(
        "a mesh scaled away", "MSH005 GEO007 GEO008", model("//visual//mesh/scale", scaled(0.001))
    ),
    kind("a mesh of no scale", "GEO008 SDF006 MSH005", model("//mesh/scale", with_text("0 0 0"))),
    kind("a mesh scaled by words", "SDF006", model("//mesh/scale", with_text("half"))),
)

KINDS: tuple[Kind, ...] = (*GEOMETRY, *MESHES)
