"""A world includes a model by a path on the machine of its author.

`<uri>file:///home/me/models/rover</uri>` leads nowhere on every other machine: Gazebo prints an
error, and the world has no such model, even where the workspace contains one of that name. Where
the model is the robot, there is nothing to simulate.
So is it for an include in a `<model>` of the world.
Below the `WORKDIR` of a Dockerfile it is a warning: the model is in its container alone.

Fix: write `model://` and the name of the model, and put the folder of the models on Gazebo's search
path; or a path relative to the world. In Gazebo's own store of downloaded models, the folder of a
model contains one for each version.
Source: SDFormat specification, include/uri.
"""

import posixpath

from checker.model.world import World
from checker.package.containers import container_with
from checker.package.package import Package
from checker.package.uris import is_on_one_machine
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WLD012", "include-on-one-machine", Severity.ERROR, Concern.PORTABILITY)
def check(world: World, package: Package) -> Findings:
    """Report includes whose path is in a home, on a drive, or in a built workspace."""
    uris = (placed.child("uri") for placed in world.element.descendants("include"))
    for uri in (element.text for element in uris if element is not None):
        if is_on_one_machine(uri.value):
            container = container_with(package, uri.value)
            where = f"in the container of {container}" if container else "on its author's machine"
            yield finding(
                uri,
                f"{uri.value.strip()} is {where}, and the world has no such model elsewhere: write "
                f"model://{_model_in(uri.value.strip())}",
                severity=Severity.WARNING if container else None,
            )


def _model_in(path: str) -> str:
    """Return the name of the model in a path; a number behind it is that of a version."""
    above, name = posixpath.split(path.rstrip("/"))
    is_version = name.isdecimal() and posixpath.basename(posixpath.dirname(above)) == "models"
    return posixpath.basename(above) if is_version else name


def _world(uri: str, mark: str = "") -> dict[str, str]:
    text = f"""<sdf version="1.9">
<world name="hall">
  <include>
    <uri>{uri}</uri>{mark}
  </include>
</world>
</sdf>
"""
    return {"@fragment": text}


def _in_model(uri: str) -> dict[str, str]:
    text = _world(uri, _MARK)["@fragment"]
    text = text.replace("  <include>", '  <model name="a">\n  <include merge="true">')
    return {"@fragment": text.replace("</include>", "</include>\n  </model>")}


_MARK = "  <!-- ^ WLD012 -->"
GOOD = [_world("model://rover"), _world("https://fuel.gazebosim.org/1.0/acme/models/rover")]
BAD = [
    _in_model("/home/ann/ws/install/acme_arms/share/acme_arms/models/arm"),
    _world("file:///home/ann/models/rover", _MARK),
    _world("file:///home/ann/.gz/fuel/fuel.gazebosim.org/acme/models/rover/5", _MARK),
    {
        **_world("file:///home/ann/ws/install/acme_hall/share/acme_hall/models/crate", _MARK),
        "@name": "acme_hall",
        "models/crate/model.sdf": '<sdf version="1.9"><model name="crate"/></sdf>',
    },
    {
        **_world("file:///home/ann/ws/models/rover", _MARK),
        "Dockerfile": "FROM ros:jazzy\nWORKDIR /home/ann/ws\n",
    },
]
