"""Gazebo does not find the models that a world or a robot names from the workspace.

`<uri>model://shelf</uri>` is looked up below the folders of Gazebo's search path. A model in the
workspace is found only if its parent folder is one of them: else Gazebo prints an error, or asks an
online database, and the model is missing; where it is the floor, the robot falls. A robot whose
meshes are `model://rover/meshes/…` has no shapes then.

It is reported of a world that a launch file names, and of a robot that it spawns, if no package.xml
and no environment hook puts the folder on the path, and no launch file, document, script or
container file of the workspace names the path at all. Ground, sun and other models that are not in
the workspace are not judged; LCH012 reports meshes of packages.

Fix: write `<gazebo_ros gazebo_model_path="${prefix}/models"/>` into `<export>` of the package with
the models, and install the folder; or set `GAZEBO_MODEL_PATH` (in Gazebo Sim
`GZ_SIM_RESOURCE_PATH`) in the launch file.
Source: gazebo-classic, `SystemPaths` and `ModelDatabase`; gz-sim, resource paths; gazebo_ros,
`gazebo_model_path`.
"""

import posixpath
import re
from collections.abc import Iterator, Sequence

from checker.package.package import Package
from checker.package.resource_path import mentions, searched_folders
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import SourceText, Span
from checker.source.xml import XmlDocument

_WORLD = re.compile(r"[\w-]{1,80}\.(?:world|sdf)\b")
_MODEL = re.compile(r"model://([^/\s]{1,100})/?\Z")
_MESH = re.compile(r"model://([^/\s]{1,100})/.")
_CONFIG = "model.config"


@rule("LCH024", "models-not-on-resource-path", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, simulations: Simulations | None) -> Findings:
    """Report each folder of models once, at the launch file that names the world or the robot."""
    every = (package, *package.other_packages)
    named = [*_of_worlds(package, every), *_of_robots(package, simulations)]
    folders = _folders_of_models(every) if named else {}
    if not folders or any(_is_named(each) for each in every):
        return
    path = [folder for each in every for folder in searched_folders(each)]
    if not all(folder.known for folder in path):
        return
    reported: set[str] = set()
    for place, model, what in named:
        folder = folders.get(model)
        if folder is None or folder in reported or folder in {it.folder for it in path}:
            continue
        reported.add(folder)
        yield finding(
            place,
            f"Gazebo does not find model://{model}{what}: nothing puts {folder} on its search path",
            key=folder,
        )


_Named = tuple[Span, str, str]
"""Where a model is named, its name, and what names it, as a clause."""


def _of_worlds(package: Package, every: Sequence[Package]) -> Iterator[_Named]:
    for place, document in _named_worlds(package, every):
        yield from ((place, it, f", which {place.text} includes") for it in _included(document))


def _of_robots(package: Package, simulations: Simulations | None) -> Iterator[_Named]:
    """Yield the models whose files are shapes of robots that launch files spawn."""
    for simulation in simulations.launched if simulations is not None else ():
        for spawned in (*simulation.robots, *simulation.classic_robots):
            uris = [it.geometry.uri for it in spawned.robot.shapes()]
            found = (_MESH.match(it.value) for it in uris if it is not None)
            for model in dict.fromkeys(it[1] for it in found if it is not None):
                holder = package.named(model)
                if holder is None or not holder.exists("package.xml"):
                    robot = spawned.robot.name.value
                    yield spawned.node.span, model, f", so that robot {robot!r} has no such shapes"


def _is_named(package: Package) -> bool:
    return any(True for classic in (True, False) for _ in mentions(package, classic=classic))


def _named_worlds(package: Package, every: Sequence[Package]) -> Iterator[tuple[Span, XmlDocument]]:
    """Yield where launch files name worlds of the workspace, and these."""
    worlds: dict[str, dict[Package, str]] = {}
    for holder in every if package.launch_texts else ():
        for file in holder.index.with_suffix(".world", ".sdf"):
            worlds.setdefault(posixpath.basename(file.path), {}).setdefault(holder, file.path)
    for path in package.launch_texts:
        source = package.read(path)
        for match in _WORLD.finditer(source.text) if isinstance(source, SourceText) else ():
            for holder, world in worlds.get(match[0], {}).items():
                document = holder.xml(world)
                if isinstance(document, XmlDocument) and isinstance(source, SourceText):
                    yield Span(source, *match.span()), document


def _folders_of_models(every: Sequence[Package]) -> dict[str, str]:
    """Return the folder above each model of the workspace, from the folder of share folders."""
    found: dict[str, str] = {}
    for holder in every:
        for file in holder.index.with_suffix(_CONFIG):
            folder, name = posixpath.split(posixpath.dirname(file.path))
            if name and posixpath.basename(file.path) == _CONFIG:
                found[name] = f"{holder.declared_name}/{folder}".rstrip("/")
    return found


def _included(document: XmlDocument) -> Iterator[str]:
    for include in document.root.descendants("include"):
        uri = include.child("uri")
        named = _MODEL.match(uri.text.value.strip()) if uri is not None else None
        if named is not None:
            yield named[1]


_WORLD_FILE = """<sdf version="1.6">
<world name="hall">
  <include><uri>model://sun</uri></include>
  <include><uri>model://shelf</uri></include>
</world>
</sdf>
"""
_START = """        ExecuteProcess(cmd=['gzserver', in_package('worlds', 'hall.world')]),"""
_EXPORT = """<package format="3">
  <name>acme_arm_bringup</name>
  <export><gazebo_ros gazebo_model_path="${prefix}/models"/></export>
</package>
"""


def _hall(**more: str) -> dict[str, object]:
    return {
        "@ros2": _START,
        "worlds/hall.world": _WORLD_FILE,
        "models/shelf/model.config": "<model><name>shelf</name></model>",
        "models/shelf/model.sdf": "<sdf version='1.6'><model name='shelf'/></sdf>",
        **{name.replace("__", "."): text for name, text in more.items()},
    }


_CREATE = 'Node(package="ros_gz_sim", executable="create",'
_ROVER = {
    "@bridge": True,
    "urdf/rover.urdf": """<robot name="rover">
  <link name="base_link">
    <visual><geometry><mesh filename="model://body/meshes/base.dae"/></geometry></visual>
  </link>
</robot>
""",
    "models/body/model.config": "<model><name>body</name></model>",
    "models/body/meshes/base.dae": "<COLLADA/>",
}
GOOD = [
    {**_ROVER, "README.md": "export GZ_SIM_RESOURCE_PATH=$PWD/models\n"},
    _hall(package__xml=_EXPORT),
    _hall(README__md="export GAZEBO_MODEL_PATH=$PWD/models"),
    _hall(start__sh="export GZ_SIM_RESOURCE_PATH=models"),
    {**_hall(), "models/shelf/model.config": None},
]
BAD = [
    {**_ROVER, "@launch": {_CREATE: f"{_CREATE}  # ^ LCH024"}},
    {**_hall(), "@reported": ["launch/arm.launch.py:20"]},
    {
        **_hall(start__py="# set('GAZEBO_MODEL_PATH', models)"),
        "@reported": ["launch/arm.launch.py:20"],
    },
]
