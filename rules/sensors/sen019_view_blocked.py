"""The robot blocks the view of its own camera or lidar.

A sensor cannot see past its own robot. A camera inside its housing shows plastic, and a lidar
behind a mast reports the mast all the time. Mapping and obstacle detection treat this as a wall
that moves along. A visual that is nearer than the near clip looks cut open in the image.

The rule casts rays over the view at the robot's visuals, both boxes and meshes, with all joints in
their initial position. Simulators draw only the outer side of a surface, beyond the near clip or
the minimum range, so a sensor in its own closed housing sees through it. Transparent parts do not
count. A lidar of Gazebo Classic without GPU (`type="ray"`) meets collisions in place of visuals.

Fix: move the sensor to the front of its housing, where the real lens is, or move the visual away;
for a lidar increase `<range><min>` above the radius of its own housing.
Source: SubT review findings (a RealSense whose pose was that of its frame, inside its visual). In
18 accepted packages the robot fills up to 42 % of a camera's view, up to 10 % within 10 cm, and up
to 29 % of a lidar's; the limits here are higher.
"""

from collections.abc import Iterator

from checker.model.sensing.view import SensorViews, View
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked


@rule("SEN019", "view-blocked", Severity.WARNING, Concern.INTERFACE)
def check(
    seen: SensorViews,
    context: Context,
    *,
    most: float = 0.3,
    most_of_picture: float = 0.5,
    close: float = 0.1,
    useless: float = 0.6,
) -> Findings:
    """Report views of which the robot fills more than a share.

    Other than in SubT it is an info, unless little is left of the scan of a lidar.

    Options:
        most: Share of a lidar's rays that may hit the robot; also the share of a camera's view that
            it may fill closer than `close`, or that the near clip may cut open.
        most_of_picture: Share of a camera's view that the robot may fill at any distance; larger
            than `most`, because a camera may see the robot below it; more is reported.
        close: Metres from a camera; parts of the robot nearer than this count for `most`.
        useless: Share of a lidar's rays above which a scan shows little but the robot.
    """
    for view in seen.views:
        fault = next(_faults(view, most, most_of_picture, close), None)
        if fault is None:
            continue
        sensor = view.mounted.sensor
        tag = view.by[1].element.tag if view.by is not None else ""
        grave = context.is_subt or (sensor.kind.is_lidar and view.hidden_share > useless)
        by = f"; mainly {tag} {view.by[1].name.value!r}" if view.by is not None else ""
        yield finding(
            sensor.pose,
            f"{sensor.kind.replace('_', ' ')} {sensor.name.value!r} {fault}{by}",
            severity=None if grave else Severity.INFO,
            related=[(view.by[1], f"this {tag}")] if view.by is not None else (),
        )
    if seen.robot.missing_parts:
        yield unchecked(seen.robot.missing_parts)
    if seen.unseen:
        others = len(seen.unseen) - 1
        more = f", and {others} more meshes that may be in a view are not known" if others else ""
        yield unchecked(seen.unseen[0] + more)


def _faults(view: View, most: float, most_of_picture: float, close: float) -> Iterator[str]:
    """Return what is wrong with a view, the worst first."""
    if view.mounted.sensor.kind.is_lidar:
        if view.hidden_share > most:
            yield _fault(view.hidden_share, "of its rays hit the robot itself", most)
        return
    near = view.hidden_share_within(close)
    if near > most:
        yield _fault(near, f"of its view is filled by the robot within {close:g} m", most)
    if view.cut > most:
        yield _fault(
            view.cut, "of its view passes through visuals that its near clip cuts open", most
        )
    if view.hidden_share > most_of_picture:
        yield _fault(
            view.hidden_share, "of its view is filled by the robot itself", most_of_picture
        )


def _fault(share: float, what: str, most: float) -> str:
    return f"is blocked: {share:.0%} {what}, expected {most:.0%} or less"


def _head(sensor: str, visual: str, more: str = "") -> str:
    return f"""
<link name="head">
  <visual name="housing">{visual}{more}</visual>
  {sensor}
</link>
"""


def _camera(pose: str, mark: str = "") -> str:
    return f"""
  <sensor name="front" type="camera">
    <pose>{pose}</pose>{mark}
    <camera><horizontal_fov>1.2</horizontal_fov><clip><near>0.01</near></clip></camera>
  </sensor>
"""


def _lidar(pose: str, mark: str = "") -> str:
    return f"""
  <sensor name="top" type="gpu_lidar">
    <pose>{pose}</pose>{mark}
    <lidar>
      <scan>
        <horizontal>
          <samples>900</samples><min_angle>-3.14159</min_angle><max_angle>3.14159</max_angle>
        </horizontal>
        <vertical><samples>4</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></vertical>
      </scan>
      <range><min>0.1</min><max>100</max></range>
    </lidar>
  </sensor>
"""


def _box(size: str, pose: str = "0 0 0 0 0 0") -> str:
    return f"<pose>{pose}</pose><geometry><box><size>{size}</size></box></geometry>"


_MARK = "  <!-- ^ SEN019 -->"
_WALL = _box("0.02 1 1", "0.05 0 0 0 0 0")
_DRUM = "<geometry><cylinder><radius>0.05</radius><length>0.08</length></cylinder></geometry>"
_MESH = "<geometry><mesh><uri>meshes/tetrahedron.stl</uri></mesh></geometry>"
_STL = """solid tetrahedron
facet normal 0 0 0
outer loop
vertex 0.05 -1 -1
vertex 0.05 0 1
vertex 0.05 1 -1
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0.05 -1 -1
vertex 0.3 0 0
vertex 0.05 0 1
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0.05 0 1
vertex 0.3 0 0
vertex 0.05 1 -1
endloop
endfacet
facet normal 0 0 0
outer loop
vertex 0.05 1 -1
vertex 0.3 0 0
vertex 0.05 -1 -1
endloop
endfacet
endsolid tetrahedron
"""


def _with_mesh(pose: str, mark: str = "") -> dict[str, str]:
    return {"@fragment": _head(_camera(pose, mark), _MESH), "meshes/tetrahedron.stl": _STL}


def _dae(**places: float) -> str:
    """Return a COLLADA file of thin walls: name and metres in front of the file's origin."""
    corners = [(x, y, z) for x in (-0.01, 0.01) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
    faces = "0 1 3 0 3 2 4 7 5 4 6 7 0 5 1 0 4 5 2 3 7 2 7 6 0 6 4 0 2 6 1 5 7 1 7 3"
    numbers = " ".join(str(number) for corner in corners for number in corner)
    nodes = "".join(
        f'<node name="{name}"><translate>{x} 0 0</translate><instance_geometry url="#g"/></node>'
        for name, x in places.items()
    )
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="24">{numbers}</float_array><technique_common>
<accessor source="#a" count="8" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{faces}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def _with_part(name: str, center: int, mark: str = "") -> dict[str, str]:
    """Return a camera behind one of two walls: one at 0.05 m, one far behind the camera."""
    part = f"<submesh><name>{name}</name><center>{center}</center></submesh>"
    mesh = f"<geometry><mesh><uri>meshes/walls.dae</uri>{part}</mesh></geometry>"
    body = _head(_camera("-0.05 0 0 0 0 0", mark), mesh)
    return {"@fragment": body, "meshes/walls.dae": _dae(near=0.05, far=-3.0)}


GOOD = [
    # Inside its own housing, and in front of it.
    _head(_camera("0 0 0 0 0 0"), _box("0.1 0.1 0.1")),
    _head(_camera("0.051 0 0 0 0 0"), _box("0.1 0.1 0.1")),
    _head(_lidar("0 0 0 0 0 0"), _DRUM),
    # A window, and the floor of its own robot below.
    _head(_camera("0 0 0 0 0 0"), _WALL, "<transparency>0.7</transparency>"),
    _head(_camera("0 0 0.3 0 0.2 0"), _box("2 1 0.01")),
    # A thin mast.
    _head(_lidar("0 0 0 0 0 0"), _box("0.03 0.03 1", "0.3 0 0 0 0 0")),
    _with_mesh("0.1 0 0 0 0 0"),
    _with_mesh("0 0 0 0 0 3.14159"),
    _with_part("far", 0),
]
BAD = [
    _head(_camera("0 0 0 0 0 0", _MARK), _WALL),
    _head(_camera("0.035 0 0 0 0 0", _MARK), _WALL),
    _head(_camera("0 0 0.3 0 1.2 0", _MARK), _box("2 2 0.01")),
    _head(_lidar("0 0 0 0 0 0", _MARK), _box("0.02 4 1", "0.3 0 0 0 0 0")),
    _head(_lidar("0 0 0 0 0 0", _MARK), _box("0.5 0.5 0.1", "0.4 0 0 0 0 0")),
    _with_mesh("0 0 0 0 0 0", _MARK),
    _with_part("near", 0, _MARK),
    # Moved to the origin.
    _with_part("far", 1, _MARK),
]
