"""`subt-check export`: writes a package's robot as URDF for RViz, or as MJCF for MuJoCo."""

from __future__ import annotations

import argparse
import os
import posixpath
import re
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

from checker.base.cache import Cache
from checker.base.errors import CheckerError
from checker.base.extras import PHYSICS
from checker.base.output import EXIT_CLEAN, say_progress, show, write
from checker.base.parts import NotAvailable, WorkerFailed
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.cli.arguments import add_search_options, search_wishes
from checker.cli.robot import named_robots
from checker.cli.subjects import subject_of
from checker.convert.mjcf_files import controls_of, meshes_apart, mjcf_of, scene_of_trial
from checker.convert.mjcf_plain import scene_text
from checker.convert.mjcf_robot import robot_mjcf
from checker.convert.sdf_to_urdf import converted_to_urdf
from checker.convert.xml_writer import document_text
from checker.engine.subject import Subject
from checker.model.robot import Robot
from checker.package.inputs import open_input
from checker.package.package import Package
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.mesh.uris import MeshFile, file_behind
from checker.physics.trial.recording import Recording, recorded
from checker.physics.trial.run import TIMESTEP
from checker.pipeline import Task
from checker.report.scene.builder import scene_of
from checker.report.scene.mesh_files import MeshFiles, NoSurfaces
from checker.report.scene.scene import DisplayScene

_MODEL = re.compile(r"(?:model|package)://")
_SUFFIXES = {"urdf": ".urdf", "mjcf": ".xml", "mjcf-replay": ".xml"}
SCENE = "scene.xml"
"""The file with a ground and the robot on it."""


class Exported(Record):
    """The robot in another format.

    Attributes:
        name: The name of the package, and so of the files.
        text: The document.
        files: Further files that it needs, path and text.
        notes: What was left out or decided.
    """

    name: str
    text: str
    files: Sequence[tuple[str, str]] = ()
    notes: Sequence[str] = ()


def export(task: Task, form: str, output: str = "", robot: str = "") -> int:
    """Write a robot in another format; return the exit code.

    Args:
        task: Package, archive or model file, with the settings of the command line.
        form: `urdf`, `mjcf`, or `mjcf-replay` for the scene of the trial.
        output: A file; or, if it exists or ends with `/`, a folder, which then also gets the meshes
            of an MJCF, and a scene or the commands of the trial. It is created if needed. The
            standard output when empty.
        robot: Its name or file, where there are several.

    Raises:
        CheckerError: There is not one robot at the path, or nothing can be written.
    """
    target = Path(output)
    folder = target if output.endswith(("/", os.sep)) or (output and target.is_dir()) else None
    done = exported(task, form, robot, apart=folder is not None)
    for note in done.notes:
        say_progress(plain(shortened(note, 400)))
    if folder is not None:
        for beside, text in done.files:
            write(folder / beside, text)
        write(folder / f"{done.name}{_SUFFIXES[form]}", done.text)
    elif output:
        write(target, done.text)
    else:
        show(done.text)
    return EXIT_CLEAN


def exported(task: Task, form: str, robot: str = "", *, apart: bool = False) -> Exported:
    """Return a robot in another format.

    Args:
        task: Package, archive or model file, with the settings of the command line.
        form: As in `export`.
        robot: Its name or file, where there are several.
        apart: Whether the meshes of an MJCF are separate files.

    Raises:
        CheckerError: There is not one robot at the path, or it cannot be written.
    """
    with open_input(task.path) as opened, ExitStack() as ends:
        subjects = [ends.enter_context(subject_of(each, task))[0] for each in opened.packages]
        subject, chosen = _chosen(task.path, subjects, robot)
        package = subject.package
        if form == "mjcf":
            return _as_mjcf(package, chosen, subject.cache, apart=apart)
        if form == "mjcf-replay":
            return _as_replay(task.path, package, chosen, subject.cache, apart=apart)
        done = converted_to_urdf(chosen, mesh_uri=package_uris(package, chosen))
        return Exported(_name(package), document_text(done.tree), notes=done.notes)


def _chosen(path: Path, subjects: Sequence[Subject], name: str) -> tuple[Subject, Robot]:
    """Return the one robot that is there, or that has a name or file."""
    found: list[tuple[Subject, Robot]] = []
    reasons: list[str] = []
    for subject in subjects:
        robots = subject.all(Robot)
        if isinstance(robots, NotAvailable):
            reasons.append(robots.reason)
        else:
            found += [(subject, robot) for robot in robots]
    # Objects of a world are not meant where there is a robot.
    found = [it for it in found if not it[1].is_prop] or found
    named = [(robot.name.value, _file(path, subject, robot)) for subject, robot in found]
    wanted = [it for it, names in zip(found, named, strict=True) if not name or name in names]
    if not name:
        # What no launch file loads is not meant where one loads another.
        wanted = [it for it in wanted if not it[1].unloaded] or wanted
    if len(wanted) == 1:
        return wanted[0]
    if not found:
        raise CheckerError(f"{path} has no robot to write: {reasons[0] if reasons else 'none'}")
    there = f"{path} has {named_robots(named)}"
    if name:
        raise CheckerError(f"no robot, or more than one, is {name!r}; {there}")
    raise CheckerError(f"{there}; choose one with --robot NAME or --robot FILE")


def _file(path: Path, subject: Subject, robot: Robot) -> str:
    """Return the file of a robot, as seen from the path that was given."""
    around, file = subject.package.root, robot.element.source.file
    folder = path.resolve() if path.is_dir() else around
    near = around.relative_to(folder).as_posix() if around.is_relative_to(folder) else ""
    return posixpath.normpath(posixpath.join(near, file))


def _as_mjcf(package: Package, robot: Robot, cache: Cache, *, apart: bool) -> Exported:
    shown = _shown(robot)
    done, name = robot_mjcf(robot, shown, cache), _name(package)
    files = list(meshes_apart(done.tree)) if apart else []
    if apart:
        files.append((SCENE, scene_text(f"{name}.xml")))
    return Exported(name, document_text(done.tree), files, (*done.notes, *shown.notes))


def _shown(robot: Robot) -> DisplayScene:
    meshes = robot.meshes
    surfaces = MeshFiles(meshes) if isinstance(meshes, PackageMeshes) else NoSurfaces()
    return scene_of(robot, None, surfaces, marked=False)


def _as_replay(
    path: Path, package: Package, robot: Robot, cache: Cache, *, apart: bool
) -> Exported:
    scene, plan = scene_of_trial(robot)
    if scene.unusable:
        raise CheckerError(f"{path} cannot be written as MJCF: {scene.unusable}")
    notes = [f"{repair.part} {repair.what}" for repair in scene.repairs]
    recording = recorded(scene, plan, TIMESTEP, cache)
    trouble = recording.reason if isinstance(recording, WorkerFailed) else recording.refused
    if isinstance(recording, WorkerFailed) or trouble:
        recording = Recording()
        notes.append(f"without gains and keyframes, because the trial ended: {trouble}")
    if any(wheel.friction for wheel in plan.wheels):
        notes.append("MJCF has no friction directions: turns are slower than in the trial")
    if plan.belts:
        notes.append(
            "MJCF has no actuator for belts: set geom_surfacevel to the speed in the .controls.csv "
            "times 1e9 times what the .xml states"
        )
    shown = _shown(robot)
    tree = mjcf_of(robot, scene, plan, recording, shown)
    name = _name(package)
    files = list(meshes_apart(tree)) if apart else []
    if apart and recording.commands:
        files.append((f"{name}.controls.csv", controls_of(tree, scene, plan, recording)))
    return Exported(name, document_text(tree), files, (*notes, *scene.notes, *shown.notes))


def _name(package: Package) -> str:
    return Path(package.only).stem if package.only else package.name


def package_uris(package: Package, robot: Robot) -> Callable[[str], str]:
    """Return what turns the URIs of a robot's meshes and textures into `package://` ones.

    A URI that leads to no file keeps its path; one with another scheme stays as it is.
    """
    folders = {uri.value: Robot.folder_of(uri) for uri in reversed(robot.file_uris)}

    def uri_of(uri: str) -> str:
        folder = folders.get(uri, "")
        file = file_behind(package, folder, uri)
        if isinstance(file, MeshFile):
            return _package_uri(package, file.path)
        if _MODEL.match(uri):
            return _MODEL.sub("package://", uri, count=1)
        if ":" in uri or uri.startswith("/"):
            return uri
        return _package_uri(package, posixpath.normpath(posixpath.join(folder, uri)))

    return uri_of


def _package_uri(package: Package, path: str) -> str:
    """Return the URI of a file by its path relative to the package."""
    if path.startswith("../"):
        return f"package://{path.removeprefix('../')}"
    return f"package://{package.name}/{path}"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.add_argument("path", metavar="PATH", help="a package, an archive or a model file")
    parser.add_argument(
        "--format",
        choices=tuple(_SUFFIXES),
        required=True,
        help="urdf: for RViz, with package:// meshes; mjcf: for MuJoCo, with actuators; "
        "mjcf-replay: the scene of the trial, with its commands",
    )
    parser.add_argument("--robot", metavar="NAME", help="the robot of this name or file")
    parser.add_argument(
        "--output",
        metavar="FILE",
        help="output file; or DIR/, a folder for the robot and its meshes, created if needed",
    )
    add_search_options(parser)
    parser.add_argument("--no-cache", action="store_true", help="do not use the cache")


def run(options: argparse.Namespace) -> int:
    """Write a package's robot in another format."""
    PHYSICS.require_for("export")
    wishes = {**search_wishes(options), "cache": False if options.no_cache else None}
    task = Task(Path(options.path), wishes=wishes)
    return export(task, options.format, options.output or "", options.robot or "")
