"""A file that a model of MuJoCo names and that is not there.

MuJoCo takes a path from the folder of the model that it is given, below `meshdir` (meshes, height
fields, skins), `texturedir` (textures) or `assetdir`. If nothing is there, it takes the path from
the folder of the file that states it, **without** `meshdir`. So a robot that loads alone does not
load through a scene in another folder: its meshes are looked for in the folder of the scene.
`<include>` is taken from the folder of the model, then from that of the including file.

A file that `.gitignore` excludes may be on the author's machine; nobody else has it.

Fix: correct the path, add the file, or put the scene into the folder of the robot.
Source: MuJoCo 4.0.0, tried; XMLreference, compiler/meshdir and include.
"""

import posixpath

from checker.base.words import Suggestions
from checker.finding import Fix
from checker.formats.mjcf.model import MjcfModel, NamedFile
from checker.package.git_ignored import ignored_by
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rename, rule


@rule("MJC002", "missing-model-file", Severity.ERROR, Concern.ROBOT)
def check(package: Package, model: MjcfModel) -> Findings:
    """Report files that are not at any of the paths that MuJoCo tries."""
    for file in (*model.missing, *model.files):
        if not file.path:
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
    value, tried = file.uri.value, " and ".join(file.tried)
    if beside := _beside_robot(package, model, file):
        return (
            f"{value!r} is looked for at {tried}, but it is at {beside}: meshdir counts from the "
            f"folder of {model.file}; put that file into the folder of the robot"
        )
    if ignored := ignored_by(package, file.tried[0]):
        return f"{value!r} is not at {tried}; {ignored} excludes it: git add -f adds it"
    near = _near(package, file)
    hint = f", did you mean {near!r}?" if near else ""
    return f"{value!r} is not at {tried}{hint}"


def _beside_robot(package: Package, model: MjcfModel, file: NamedFile) -> str:
    """Return where the file would be if the robot were loaded alone; empty if it is not there."""
    folder = model.compiler.get("meshdir") or model.compiler.get("assetdir")
    own = posixpath.dirname(file.element.source.file)
    if folder is None or file.element.tag == "include":
        return ""
    path = posixpath.normpath(posixpath.join(own, folder.value, file.uri.value))
    return path if path not in file.tried and package.exists(path) else ""


def _near(package: Package, file: NamedFile) -> str:
    """Return what to write for the one file of that name, or of one that is almost it."""
    folder = posixpath.dirname(file.tried[0])
    ending = posixpath.splitext(file.uri.value)[1].lower()
    names = {
        posixpath.basename(entry.path): entry.path
        for entry in package.index.files
        if entry.path.lower().endswith(ending or "\0")
    }
    wanted = posixpath.basename(file.tried[0])
    found = names.get(wanted) or names.get(Suggestions(names).correction(wanted) or "")
    return posixpath.relpath(f"/{found}", f"/{folder}") if found and ".." not in folder else ""


def _fix(package: Package, file: NamedFile) -> Fix | None:
    near = _near(package, file)
    folder = posixpath.dirname(file.uri.value)
    return rename(file.uri, posixpath.normpath(posixpath.join(folder, near))) if near else None


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
