"""A file that a model of MuJoCo names and that is not there.

MuJoCo takes a path from the folder of the model that it is given, below `meshdir` (meshes, height
fields, skins), `texturedir` (textures) or `assetdir`. If nothing is there, it takes the path from
the folder of the file that states it, **without** `meshdir`. So a robot that loads alone does not
load through a scene in another folder: its meshes are looked for in the folder of the scene.
`<include>` is taken from the folder of the model, then from that of the including file.

A file that `.gitignore` excludes may be on the author's machine; nobody else has it. Where
CMakeLists.txt installs files of another place, a missing file may be one of these: not checked.

Fix: correct the path, add the file, or put the scene into the folder of the robot.
Source: MuJoCo 4.0.0, tried; XMLreference, compiler/meshdir and include.
"""

import posixpath
from itertools import takewhile

from checker.base.words import Suggestions
from checker.finding import Fix
from checker.formats.mjcf.model import MjcfModel, NamedFile
from checker.package.git_ignored import ignored_by
from checker.package.installed import foreign_installs
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rename, rule, unchecked

_ABOVE = "/1/2/3/4/5/6/7/8/"
"""So many folders above the package may be named."""


@rule("MJC002", "missing-model-file", Severity.ERROR, Concern.ROBOT)
def check(package: Package, model: MjcfModel) -> Findings:
    """Report files that are not at any of the paths that MuJoCo tries."""
    installed = foreign_installs(package)
    for file in (*model.missing, *model.files):
        if not file.path and installed:
            yield unchecked(
                f"{installed} installs files of another place, with which models may load"
            )
        elif not file.path:
            yield finding(
                file.uri,
                f"MuJoCo cannot load {model.file}: {_message(package, model, file)}",
                key=f"{file.element.tag} {posixpath.dirname(file.tried[0])}",
                fix=_fix(package, file),
            )
    for element in model.repeated:
        uri = element.get("file")
        yield finding(element, f"MuJoCo cannot load {model.file}: {uri} is included twice")


def _message(package: Package, model: MjcfModel, file: NamedFile) -> str:
    value, own = file.uri.value, posixpath.dirname(model.file)
    paths = [posixpath.relpath(_ABOVE + path, _ABOVE + own) for path in file.tried]
    looked = f"{value!r} does not exist: it is looked for at {' and '.join(paths)}"
    if beside := _beside_robot(package, model, file):
        return (
            f"{looked}, but it is at {beside}: meshdir counts from the folder of {model.file}; put "
            "that file into the folder of the robot"
        )
    if ignored := ignored_by(package, file.tried[0]):
        return f"{looked}; {ignored} excludes it: git add -f adds it"
    near = _near(package, file)
    return f"{looked}, did you mean {near!r}?" if near else looked


def _beside_robot(package: Package, model: MjcfModel, file: NamedFile) -> str:
    """Return where the file would be if the robot were loaded alone; empty if it is not there."""
    folder = model.folder_of(file.element)
    own = posixpath.dirname(file.element.source.file)
    path = posixpath.normpath(posixpath.join(own, folder, file.uri.value))
    return path if folder and path not in file.tried and package.exists(path) else ""


def _near(package: Package, file: NamedFile) -> str:
    """Return what to write for the one file of that name, or of one that is almost it.

    Where the folder is there, only a misspelt name in it counts: in the folder of another thing, a
    file of the same name is another file.
    """
    wanted = file.tried[0].split("/")
    ending = posixpath.splitext(file.uri.value)[1].lower() or "\0"
    paths = [entry.path for entry in package.index.files if entry.path.lower().endswith(ending)]
    folder = posixpath.dirname(file.tried[0])
    if folder and package.exists(folder):
        paths = [path for path in paths if posixpath.dirname(path) == folder]
    names = {posixpath.basename(path) for path in paths}
    name = wanted[-1] if wanted[-1] in names else Suggestions(names).correction(wanted[-1])
    alike = [(_common(path, wanted), path) for path in paths if posixpath.basename(path) == name]
    best = sorted(alike, reverse=True)[:2]
    if not best or (len(best) == 2 and best[0][0] == best[1][0]):
        return ""
    return posixpath.relpath(_ABOVE + best[0][1], _ABOVE + file.base)


def _common(path: str, wanted: list[str]) -> int:
    """Return how many names, the last one left out, end both paths."""
    own = path.split("/")[-2::-1]
    pairs = zip(own, wanted[-2::-1], strict=False)
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))


def _fix(package: Package, file: NamedFile) -> Fix | None:
    near = _near(package, file)
    return rename(file.uri, near) if near else None


_ARM = """<compiler meshdir="meshes"/>
<asset><mesh name="arm" file="{}"/></asset>
<worldbody><body><joint/><geom type="mesh" mesh="arm"/></body></worldbody>"""
_MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
_MARK = "<!-- ^ MJC002 -->"

GOOD = [{"@mjcf": _ARM.format("arm.obj"), "meshes/arm.obj": _MESH}]
BAD = [
    {"@mjcf": _ARM.format("arm.obj").replace("</asset>", "</asset>" + _MARK)},
    {
        "@mjcf": _ARM.format("Arm.obj").replace("</asset>", "</asset>" + _MARK),
        "meshes/arm.obj": _MESH,
    },
    {
        "@mjcf": '<include file="robot/arm.xml"/>',
        "robot/arm.xml": "<mujoco>\n"
        + _ARM.format("arm.obj").replace("</asset>", "</asset>" + _MARK)
        + "\n</mujoco>",
        "robot/meshes/arm.obj": _MESH,
    },
    {"@mjcf": f'<include file="arm_parts.xml"/>{_MARK}\n<worldbody><geom size="1"/></worldbody>'},
]
