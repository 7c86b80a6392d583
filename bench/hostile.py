"""Models as only programs write them: huge, deep, misspelt throughout. Each must end in findings.

Run with `make bench`. The figures are seconds for one check under a profile; what matters is that
none explodes and that no rule crashes. Most models are as large as one that is checked can be:
50 000 elements.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from time import perf_counter

from checker.pipeline import check_package
from checker.settings import Settings

LONG = 10_000
VISUAL = "<visual name='v'><geometry/></visual>"


def chain(joints: int, *, closed: bool) -> str:
    """Return so many links, each tied to the one before it."""
    links = "".join(f"<link name='l{n}'/>" for n in range(joints + 1))
    ends = ((n, (n + 1) % joints if closed else n + 1) for n in range(joints))
    return links + "".join(
        f"<joint name='j{a}' type='revolute'><parent>l{a}</parent><child>l{b}</child>"
        "<axis><xyz>0 0 1</xyz></axis></joint>"
        for a, b in ends
    )


def drives(count: int) -> str:
    """Return so many plugins that turn wheels."""
    tags = "<left_joint>a</left_joint><right_joint>b</right_joint>"
    name = "ignition::gazebo::systems::DiffDrive"
    return "".join(f"<plugin name='{name}' filename='d{n}'>{tags}</plugin>" for n in range(count))


def sensors(count: int) -> str:
    """Return so many cameras on one link."""
    cameras = "".join(f"<sensor name='s{n}' type='camera'/>" for n in range(count))
    return f"<link name='l'>{cameras}</link>"


def bridges(count: int) -> str:
    """Return a launch file with so many bridges of cameras."""
    topics = (f"/world/w/model/m/link/l/sensor/s{n}/image" for n in range(count))
    types = "sensor_msgs/Image@ignition.msgs.Image"
    nodes = "".join(
        f"<node pkg='ros_ign_bridge' type='parameter_bridge' name='b{n}' args='{topic}@{types}'/>"
        for n, topic in enumerate(topics)
    )
    return f"<launch>{nodes}</launch>"


def meshes(*files: str) -> str:
    """Return a link with a visual and a collision for each mesh file."""
    shapes = "".join(
        f"<{kind} name='{kind}{n}'><geometry><mesh><uri>{file}</uri></mesh></geometry></{kind}>"
        for n, file in enumerate(files)
        for kind in ("visual", "collision")
    )
    return f"<link name='l'>{shapes}</link>"


def _shows(level: int) -> str:
    return f"<instance_node url='#n{level}'/>"


def scene_of_nodes(levels: int) -> str:
    """Return a COLLADA file in which each node shows the next one twice."""
    nodes = "".join(
        f"<node id='n{level}'>{_shows(level + 1) * 2}</node>" for level in range(levels)
    )
    return f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="a" count="9">0 0 0 1 0 0 0 1 1</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1">
<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_nodes>{nodes}
<node id="n{levels}"><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node><instance_node url="#n0"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


CASES: Mapping[str, Callable[[], str | Mapping[str, str]]] = {
    "names of 10 000 characters": lambda: (
        f"<link name='{'n' * LONG}'/><{'z' * LONG}/><joint name='{'j' * LONG}' type='{'t' * LONG}'>"
        f"<parent>{'p' * LONG}</parent><child>{'c' * LONG}</child></joint>"
    ),
    "24 000 visuals in one link": lambda: f"<link name='l'>{VISUAL * 24_000}</link>",
    "49 000 unknown elements": lambda: "".join(f"<foo{n}/>" for n in range(49_000)),
    "48 000 misspelt elements": lambda: (
        f"<link name='l'>{'<inertail/><colision/><vissual/>' * 16_000}</link>"
    ),
    "400 000 elements, which are too many": lambda: f"<link name='l'>{VISUAL * 200_000}</link>",
    "8 000 joints in a chain": lambda: chain(8_000, closed=False),
    "8 000 joints in a loop": lambda: chain(8_000, closed=True),
    "12 000 joints that end at nothing": lambda: "".join(
        f"<joint name='j{n}' type='fixed'><parent>x{n}</parent><child>y{n}</child></joint>"
        for n in range(12_000)
    ),
    "5 000 poses of 1e400 --5 0x10 1,5": lambda: "".join(
        f"<link name='l{n}'><pose>1e400 --5 0x10 1,5 nan inf</pose></link>" for n in range(5_000)
    ),
    "16 000 drives": lambda: f"<link name='l'/>{drives(16_000)}",
    "20 000 bridges of 2 000 cameras": lambda: {
        "model.sdf": sensors(2_000),
        "launch/vehicle_topics.launch": bridges(20_000),
    },
    "4 000 wrong names of 4 000 meshes": lambda: {
        "model.sdf": meshes(*(f"model://package/meshes/lft_{n}.dae" for n in range(4_000))),
        **{f"meshes/left_{n}.dae": "x" for n in range(4_000)},
    },
    "a mesh of 2^100 triangles": lambda: {
        "model.sdf": meshes("meshes/a.dae"),
        "meshes/a.dae": scene_of_nodes(100),
    },
}


def measured(content: str | Mapping[str, str], folder: Path) -> Iterator[str]:
    """Yield a line for each profile: seconds, findings, rules that could not run."""
    files = {"model.sdf": content} if isinstance(content, str) else content
    for path, text in files.items():
        (folder / path).parent.mkdir(exist_ok=True)
        (folder / path).write_text(text, "utf-8")
    (folder / "package.xml").write_text("<package/>", "utf-8")
    model = f"<sdf version='1.6'><model name='m'>{files['model.sdf']}</model></sdf>"
    (folder / "model.sdf").write_text(model, "utf-8")
    for profile in ("subt", "sdf"):
        started = perf_counter()
        (report,) = check_package(folder, Settings(profile=profile, cache=False)).packages
        seconds = perf_counter() - started
        crashed = "CRASHED" if report.crashed else ""
        yield f"{profile:<5} {seconds:7.1f} s  {len(report.findings):7d} findings  {crashed}"


def main() -> None:
    """Measure and print everything."""
    for name, content in CASES.items():
        with tempfile.TemporaryDirectory() as parent:
            folder = Path(parent) / "package"
            folder.mkdir()
            for line in measured(content(), folder):
                print(f"{name:<36} {line}")


if __name__ == "__main__":
    main()
