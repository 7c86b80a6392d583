"""A model.config that does not describe the model or name its file.

Gazebo opens the file that `<sdf>` names; of several, the one with the newest version that it
supports. If that file does not exist, Gazebo cannot load the robot by its name; if another one is
missing, or a `.gitignore` keeps it out of the repository, as one that a program writes, it is a
warning, and so is a model.config alone in its folder, as an editor leaves it. It is an info in a
package of ROS where Gazebo does not search the folder above and no file includes the model. Fuel
shows the other entries, including the contact of the author: a submission needs them (a warning),
for other models they are an info.

Fix: add what is missing of name, version, author with name and email, description, and
`<sdf version="…">model.sdf</sdf>` with the version that the model file states.
Source: Gazebo, "Model structure and requirements"; Model Migration Guide, step 5.
"""

import posixpath
import re
from collections.abc import Iterator
from html import escape

from checker.finding import Fix
from checker.formats.sdf.document import parse_version
from checker.package.git_ignored import ignored_by
from checker.package.manifests import ModelConfig, Paperwork, SdfEntry
from checker.package.model_file import own_model
from checker.package.package import Package
from checker.package.resource_path import mentions, searched_folders
from checker.package.target import package_around
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.text import SourceText
from checker.source.xml import XmlDocument
from checker.source.xml_insertion import append_to

_TO_DO = re.compile(r"\s*(?:TODO\b|todo@)")
_INCLUDED = re.compile(r"""model://([^\s<>"']{1,300})""")
_INCLUDING = (".sdf", ".world", ".xacro", ".py", ".launch", ".xml", ".sh", ".md", ".cc", ".cpp")
_NOTHING = Severity.INFO
"""A folder without any model: others may use its meshes."""


@rule("PKG004", "incomplete-model-config", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package, paperwork: Paperwork, context: Context) -> Findings:
    """Look up the model file, and list what is missing."""
    if reason := paperwork.unread("model.config"):
        yield unchecked(reason)
    config = paperwork.config
    if config is None:
        return
    if not config.sdf:
        yield finding(
            config,
            "model.config names no model file: <sdf> is missing",
            severity=None if own_model(package) or package.index.with_suffix(".sdf") else _NOTHING,
            key="sdf",
            fix=_model_file_fix(package, context.sdf_version),
        )
    chosen = _target_entry(config, context.reads)
    yield from _missing_files(package, config, chosen, is_subt=context.is_subt)
    for author in config.authors:
        for text in (author.name, author.email):
            if _TO_DO.match(text.value):
                message = f"model.config has the author {text.value[:60]!r}, left from a template"
                yield finding(text, message, key="template")
    if missing := list(_missing_parts(config)):
        words = f"{', '.join(missing[:-1])} and {missing[-1]}" if missing[1:] else missing[0]
        yield finding(
            config,
            f"model.config has no {words}",
            severity=Severity.WARNING if context.is_subt else Severity.INFO,
            key="missing",
        )


def _target_entry(config: ModelConfig, reads: str) -> SdfEntry | None:
    """Return the file that the target opens: of the versions that it reads, the newest."""
    newest = parse_version(reads) or (0, 0)
    read = [it for it in config.sdf if (parse_version(it.version.value) or (0, 0)) <= newest]
    return max(read, key=lambda it: parse_version(it.version.value) or (0, 0), default=None)


def _missing_files(
    package: Package, config: ModelConfig, chosen: SdfEntry | None, *, is_subt: bool
) -> Iterator[Finding]:
    for entry in config.sdf:
        path = posixpath.normpath(entry.file.value)
        written = entry.file.value
        file = package.resolve(path) if written else None
        if file is not None and file.is_file:
            continue
        others = (path, "model.config")
        alike = [it for it in package.index.similar_files(path) if it not in others]
        same = [other for other in alike if other.casefold() == path.casefold()] or alike
        meant = same[0] if len(same) == 1 else ""
        hint = f"; did you mean {alike[0]}?" if alike else ""
        ignored = ignored_by(package, path) if written else ""
        # No model is lost where the folder has nothing else.
        stray = len(package.index.files) == 1 and not is_subt
        harmless = chosen not in (None, entry) or ignored or stray
        if ignored:
            hint = f": {ignored} keeps it out of the repository"
        severity = Severity.WARNING if harmless else None
        yield finding(
            entry.file,
            f"model.config names {written}, but this file does not exist{hint}"
            if written
            else f"model.config names no file: <sdf> is empty{hint}",
            severity=_NOTHING if not (is_subt or stray) and _is_unused(package) else severity,
            fix=replace_text(entry.file, meant, Safety.UNSAFE) if meant else None,
        )


def _is_unused(package: Package) -> bool:
    """Return whether Gazebo does not search the folder above a model, and no file includes it."""
    around = package_around(package)
    if around is None or not around.exists("package.xml"):
        return False
    every = (around, *around.other_packages)
    searched = [
        it
        for each in every
        for kind in (True, False)
        for it in searched_folders(each, classic=kind)
    ]
    named = (True for each in every for kind in (True, False) for _ in mentions(each, classic=kind))
    above = package.root.parent.relative_to(around.root).as_posix()
    share = posixpath.normpath(f"{around.declared_name}/{above}")
    if any(not it.known or it.folder == share for it in searched) or (not searched and any(named)):
        return False
    return package.root.name not in {name for each in every for name in _included_names(each)}


def _included_names(package: Package) -> Iterator[str]:
    """Yield the names of models that files of a package include."""
    for file in package.index.with_suffix(*_INCLUDING):
        source = package.read(file.path)
        found = _INCLUDED.findall(source.text) if isinstance(source, SourceText) else ()
        yield from (posixpath.basename(it.rstrip("/")) for it in found)


def _model_file_fix(package: Package, expected: str) -> Fix | None:
    """Return the fix that writes the package's model file, with its version."""
    config, path = package.xml("model.config"), own_model(package)
    if path is None or len(package.index.with_suffix(".sdf")) != 1:
        return None
    model = package.xml(path)
    if not (isinstance(config, XmlDocument) and isinstance(model, XmlDocument)):
        return None
    version = expected or model.root.get("version")
    if not version:
        return None
    line = f'<sdf version="{version}">{escape(path, quote=False)}</sdf>'
    return Fix(Safety.UNSAFE, (append_to(config.root, [line]),))


def _missing_parts(config: ModelConfig) -> Iterator[str]:
    people = config.authors
    stated = {
        "name": config.name.value,
        "version": config.version.value,
        "author name": any(author.name.value for author in people),
        "author email": any(author.email.value for author in people),
        "description": config.description.value,
    }
    yield from (what for what, value in stated.items() if not value)


_START = "<model>  <!-- ^ PKG004 -->\n"
_AUTHOR = "<author><name>A</name><email>a@example.org</email></author>"
_REST = f"<name>Rover</name><version>1.0</version>{_AUTHOR}<description>A rover</description>"

GOOD = [{"model.config": f'<model>{_REST}<sdf version="1.6">model.sdf</sdf></model>'}]
BAD = [
    {"model.config": f"{_START}{_REST}</model>"},
    {"@profile": "gazebo-harmonic", "model.config": f"{_START}{_REST}</model>"},
    {
        "model.config": f"""<model>{_REST.replace("@", "@x.").replace("<name>A", "<name>TODO")}
<sdf version="1.6">model.sdf</sdf></model>
""".replace("<model>", "<model>  <!-- ^ PKG004 -->")
    },
    {
        "model.config": f"""<model>{_REST}
<sdf version="1.6">made.sdf</sdf>  <!-- ^ PKG004 -->
</model>
""",
        ".gitignore": "made.sdf\n",
    },
    {"model.config": f"{_START}<name>Rover</name><sdf>model.sdf</sdf></model>"},
    {
        "model.config": f"""<model>{_REST}
<sdf version="1.6"></sdf>  <!-- ^ PKG004 -->
</model>
"""
    },
    {
        "model.config": f"""<model>{_REST}
<sdf version="1.6">Model.sdf</sdf>  <!-- ^ PKG004 -->
</model>
"""
    },
]
