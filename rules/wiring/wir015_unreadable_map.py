"""A map that the map server cannot read.

The file of a map names its image, relative to its own folder, and how to read it. Without the
image, or without one of the numbers, map_server does not start, in ROS 1 and ROS 2, and neither
does the rest of Nav2. A map that was saved in a home may keep its absolute path. It is a warning
where no launch file names the map, where the image is below the `WORKDIR` of a Dockerfile, and
where `.gitignore` keeps its image out of the repository.

Fix: write the image's name alone, and put the image beside the file: `image: hall.pgm`.
Source: navigation2, nav2_map_server/src/map_io.cpp, `loadMapYaml`.
"""

import posixpath
from collections.abc import Iterator

from checker.base.words import and_list
from checker.finding import Fix
from checker.package.containers import container_with
from checker.package.git_ignored import ignored_by
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.package.uris import is_on_one_machine
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.yaml import YamlNode, read_root

_NUMBERS = ("resolution", "origin", "negate", "occupied_thresh", "free_thresh")


@rule("WIR015", "unreadable-map", Severity.ERROR, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Report images of maps that are not there, and entries that a map lacks."""
    for file in package.index.with_suffix(".yaml", ".yml"):
        root = read_root(package.read(file.path))
        image = root.get("image") if root is not None else None
        if root is None or image is None or not any(map(root.get, _NUMBERS)):
            continue
        severity = None if _is_launched(package, file.path) else Severity.WARNING
        if missing := [name for name in _NUMBERS if root.get(name) is None]:
            message = f"the map has no {and_list(missing)}, which map_server requires"
            yield finding(image, message, severity=severity, key="entries")
        yield from _image(package, posixpath.dirname(file.path), image, severity)


def _is_launched(package: Package, path: str) -> bool:
    """Return whether a launch file names the map: of this package, or with this package's name.

    Of several maps of one name it names the folder, too.
    """
    folder, name = posixpath.split(path)
    alike = [it for it in package.index.files if posixpath.basename(it.path) == name]
    needed = posixpath.basename(folder) if len(alike) > 1 else ""
    return any(
        name in text
        and (not needed or has_word(text, needed))
        and (file.startswith(f"{package.name}/") or package.declared_name in text)
        for file, text in package.workspace.launch_texts.items()
    )


def _image(
    package: Package, folder: str, image: YamlNode, severity: Severity | None
) -> Iterator[Finding]:
    written = str(image.scalar)
    path = posixpath.normpath(posixpath.join(folder, written))
    name = posixpath.basename(written)
    here = posixpath.join(folder, name)
    if is_on_one_machine(written):
        container = container_with(package, written)
        where = f"in the container of {container} alone" if container else "on its author's machine"
        yield finding(
            image,
            f"the map's image {written} is {where}: write {name}, beside this file",
            severity=Severity.WARNING if container else severity,
            fix=_beside(image, name) if package.exists(here) else None,
        )
    elif (entry := package.resolve(path)) is not None:
        if not entry.size:
            yield finding(image, f"the map's image {written} is empty", severity=severity)
    elif not written.startswith("/"):
        ignored = ignored_by(package, path)
        alike = [posixpath.basename(it) for it in package.index.similar_files(path)]
        others = [it for it in alike if not it.endswith((".yaml", ".yml"))]
        hint = f": {ignored} keeps it out of the repository" if ignored else ""
        yield finding(
            image,
            f"the map's image {written} does not exist"
            + (f"; did you mean {others[0]}?" if others and not hint else hint),
            severity=Severity.WARNING if ignored else severity,
            fix=_beside(image, others[0]) if len(others) == 1 else None,
        )


def _beside(image: YamlNode, name: str) -> Fix:
    return replace_text(image, name, Safety.UNSAFE)


_LAUNCH = """        Node(package='nav2_map_server', executable='map_server', parameters=[
            {'yaml_filename': in_package('maps', 'hall.yaml')}]),"""


def _map(image: str, more: str = "negate: 0\n", mark: str = "  # ^ WIR015") -> dict[str, object]:
    return {
        "@ros2": _LAUNCH,
        "maps/hall.pgm": "P5 1 1 255\n0",
        "maps/hall.yaml": f"image: {image}{mark}\nresolution: 0.05\norigin: [0, 0, 0]\n{more}"
        "occupied_thresh: 0.65\nfree_thresh: 0.25\n",
    }


GOOD = [
    _map("hall.pgm", mark=""),
    _map("/maps/hall.pgm", mark=""),
    {"@ros2": _LAUNCH, "maps/hall.yaml": "image: ros:jazzy\n"},
]
BAD = [
    _map("hall.png"),
    _map("office.pgm"),
    _map("/home/ann/maps/hall.pgm"),
    {**_map("/home/ann/ws/hall.pgm"), "Dockerfile": "FROM ros:jazzy\nWORKDIR /home/ann/ws\n"},
    _map("hall.pgm", more=""),
    {**_map("hall.pgm"), "maps/hall.pgm": ""},
]
