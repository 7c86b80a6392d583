"""A launch file starts a world that includes a model which nothing provides.

Gazebo Sim looks for `model://shelf` below the folders of its resource path alone. It has no online
database for `model://`, not even for `model://sun` and `model://ground_plane`, which Gazebo Classic
installs: it prints "Unable to find uri" and stops, so that nothing is simulated.

It is reported where no available package has the model, and all that is put on the resource path
is known: the launch file was read in full, and no hook, document or script names the path in a way
that is not understood. So is a model that a model of the world includes. It is not reported if a
CMakeLists.txt or setup.py of the workspace names the model, which may then be installed, nor if a
package.xml declares a package of worlds or models that is not available.

Fix: add the model to the package, and its folder to the resource path; or include it from Fuel:
`<uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Sun</uri>`.
Source: gz-sim, `Server` and resource paths; libsdformat, `readXml` of includes, error 14; ap_nongps
issue 3 for the words of Gazebo.
"""

import re
from collections.abc import Collection, Iterator, Sequence

from checker.model.world import World
from checker.package.manifests import Paperwork
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.ros.resource_path import ResourcePath, resource_path
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located, SourceText

_MODEL = re.compile(r"model://([^/\s]{1,100})/?\Z")
_BUILD = ("CMakeLists.txt", "setup.py")
_MAY_HOLD_MODELS = re.compile(r"model|world|simul|gazebo|\Agz|\Aign")
"""Names of packages that may put models on the path."""
_HOLDS_NONE = re.compile(
    r"ros_gz|ros_ign|(?:gz|ign|gazebo)_ros|gazebo_(?:plugins|msgs|dev)\b|gazebo\Z"
    r"|gz[-_]\w+_vendor|(?:gz|ignition)-"
)
"""Packages of Gazebo and its bridges, which put none there."""
_SHOWN = 3
"""Models that a message names."""


@rule("WLD013", "included-model-not-available", Severity.ERROR, Concern.ROBOT)
def check(simulations: Simulations, package: Package) -> Findings:
    """Report each world once that Gazebo Sim does not load because it finds no model."""
    for simulation in simulations.launched:
        if simulation.graph is None or not simulation.starts_gazebo:
            continue
        missing = [
            (server, world, uris)
            for server in simulation.servers
            for world in server.worlds
            if server.starts and (uris := [*_missing(package, world)])
        ]
        if missing and _is_settled(package, resource_path(package, simulation.graph)):
            for server, world, uris in missing:
                file = world.element.document.source.file
                yield finding(
                    server,
                    f"Gazebo stops: it does not find {_listed(uris)} of {file}, which no "
                    "available package has: add the model, or include it from Fuel",
                    key=f"{file} {uris[0].value}",
                    related=[(uris[0].span, "included here")],
                )


def _missing(package: Package, world: World) -> Iterator[Located[str]]:
    """Yield the includes of a world and of its models whose model no available package is."""
    every = (package, *package.other_packages)
    builds = [source.text for each in every for source in _builds(each)]
    of_models = (uri for model in world.models for uri in model.unresolved_includes)
    for uri in (*world.unknown, *of_models):
        named = _MODEL.match(uri.value.strip())
        if named is None or package.named(named[1]) is not None:
            continue
        if not any(has_word(text, named[1]) for text in builds):
            yield uri


def _builds(package: Package) -> Iterator[SourceText]:
    """Yield what builds and installs a package."""
    for name in _BUILD:
        if package.exists(name) and isinstance(source := package.read(name), SourceText):
            yield source


def _is_settled(package: Package, path: ResourcePath) -> bool:
    """Return whether all folders on the resource path are of available packages."""
    every = (package, *package.other_packages)
    names = {each.declared_name for each in every}
    return (
        path.complete
        and all(
            it.folder is not None and (not it.folder or it.folder.partition("/")[0] in names)
            for it in path.folders
        )
        and not any(_needs_models(each, names) for each in every)
    )


def _needs_models(package: Package, names: Collection[str]) -> bool:
    """Return whether a package needs one that is not available and may hold models."""
    manifest = Paperwork(package).manifest
    needed = manifest.dependencies if manifest is not None else ()
    return any(
        name not in names and _MAY_HOLD_MODELS.search(name) and not _HOLDS_NONE.match(name)
        for name in (it.package.value for it in needed)
    )


def _listed(uris: Sequence[Located[str]]) -> str:
    names = [*dict.fromkeys(uri.value.strip() for uri in uris)]
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more


_START = 'launch_arguments=[("gz_args", "-r empty.sdf")]'
_NAMING = '\n            launch_arguments=[("gz_args", os.path.join(HERE, "worlds", "hall.sdf"))]'
_WORLD = """<sdf version="1.9">
<world name="hall">
  <include><uri>{}</uri></include>
</world>
</sdf>
"""
_SHELF = """<sdf version="1.9"><model name="shelf">
  <include><uri>model://board</uri></include>
</model></sdf>
"""


def _hall(uri: str, mark: str = "") -> dict[str, object]:
    naming = f"{_NAMING}{mark}\n        "
    return {"@bridge": True, "@launch": {_START: naming}, "worlds/hall.sdf": _WORLD.format(uri)}


_MARK = "  # ^ WLD013"
_SHIPPED = {
    **_hall("model://shelf"),
    "models/shelf/model.config": "<model><name>shelf</name></model>",
    "models/shelf/model.sdf": _SHELF.replace("<include><uri>model://board</uri></include>", ""),
}
_INSTALLING = "project(hall)\ninstall(FILES model.sdf DESTINATION share/hall/models/shelf)\n"
_NEEDING = """<package format="3">
  <name>acme_rover_bringup</name>
  <depend>acme_worlds</depend>
</package>
"""
GOOD = [
    _SHIPPED,
    _hall("https://fuel.gazebosim.org/1.0/OpenRobotics/models/Sun"),
    {**_hall("model://sun"), "README.md": "Set GZ_SIM_RESOURCE_PATH before you launch it.\n"},
    {**_hall("model://shelf"), "CMakeLists.txt": _INSTALLING},
    {**_hall("model://shelf"), "package.xml": _NEEDING},
]
BAD = [
    _hall("model://sun", _MARK),
    {**_SHIPPED, **_hall("model://shelf", _MARK), "models/shelf/model.sdf": _SHELF},
]
