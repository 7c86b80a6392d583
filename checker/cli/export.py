"""`subt-check export`: writes a package's robot as URDF for RViz, or as MJCF."""

from __future__ import annotations

import argparse
import os
import posixpath
import re
from collections.abc import Callable, Sequence
from pathlib import Path

from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.base.errors import CheckerError
from checker.base.extras import PHYSICS
from checker.base.output import EXIT_CLEAN, say_progress, show, write
from checker.base.parts import NotAvailable, WorkerFailed
from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.convert.mjcf_files import controls_of, meshes_apart, mjcf_of, scene_of_trial
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
from checker.report.scene.builder import scene_of
from checker.report.scene.mesh_files import MeshFiles, NoSurfaces

_MODEL = re.compile(r"(?:model|package)://")
_SUFFIXES = {"urdf": ".urdf", "mjcf": ".xml"}


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


def export(path: Path, form: str, output: str = "", *, cached: bool = True) -> int:
    """Write the robot of one package in another format; return the exit code.

    Args:
        path: Package, archive or model file.
        form: `urdf` or `mjcf`.
        output: A file; or, if it exists or ends with `/`, a folder, which then also gets the meshes
            of an MJCF and the commands of its trial. It is created if needed. The standard output
            when empty.
        cached: Whether meshes may come from the cache.

    Raises:
        CheckerError: There is not one robot at the path, or nothing can be written.
    """
    target = Path(output)
    folder = target if output.endswith(("/", os.sep)) or (output and target.is_dir()) else None
    done = export_package(path, form, apart=folder is not None, cached=cached)
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


def export_package(path: Path, form: str, *, apart: bool = False, cached: bool = True) -> Exported:
    """Return the robot of one package in another format.

    Args:
        path: Package, archive or model file.
        form: `urdf` or `mjcf`.
        apart: Whether the meshes of an MJCF are separate files.
        cached: Whether meshes may come from the cache.

    Raises:
        CheckerError: There is not one robot at the path, or it cannot be written.
    """
    with open_input(path) as opened:
        if len(opened.packages) != 1:
            number = len(opened.packages)
            raise CheckerError(f"{path} contains {number} packages; give one of them")
        package = opened.packages[0]
        subject = Subject(package, Cache(cache_folder()) if cached else NO_CACHE)
        try:
            return _exported(path, package, subject, form, apart=apart)
        finally:
            subject.close()


def _exported(
    path: Path, package: Package, subject: Subject, form: str, *, apart: bool
) -> Exported:
    robot = subject.one(Robot)
    if isinstance(robot, NotAvailable):
        raise CheckerError(f"{path} has no robot to write: {robot.reason}")
    if form == "mjcf":
        return _as_mjcf(path, package, robot, subject.cache, apart=apart)
    done = converted_to_urdf(robot, mesh_uri=package_uris(package, robot))
    return Exported(_name(package), document_text(done.tree), notes=done.notes)


def _as_mjcf(path: Path, package: Package, robot: Robot, cache: Cache, *, apart: bool) -> Exported:
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
    meshes = robot.meshes
    surfaces = MeshFiles(meshes) if isinstance(meshes, PackageMeshes) else NoSurfaces()
    shown = scene_of(robot, None, surfaces, marked=False)
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
        choices=("urdf", "mjcf"),
        required=True,
        help="urdf: for RViz, with package:// meshes; mjcf: the trial's scene for MuJoCo",
    )
    parser.add_argument(
        "--output",
        metavar="FILE",
        help="output file; or DIR/, a folder for the scene and its meshes, created if needed",
    )
    parser.add_argument("--no-cache", action="store_true", help="do not use the cache")


def run(options: argparse.Namespace) -> int:
    """Write a package's robot in another format."""
    PHYSICS.require_for("export")
    output = options.output or ""
    return export(Path(options.path), options.format, output, cached=not options.no_cache)
