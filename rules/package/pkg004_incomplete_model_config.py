"""A model.config that does not say what the model is, or where.

Gazebo opens the file that `<sdf>` names: when it names none that is there, the robot cannot be
loaded by its name. The other entries are what Fuel shows of the model, and whom to ask about it.

Fix: name the model file in `<sdf version="1.6">model.sdf</sdf>`, and add name, version, author with
name and email, and description.
Source: Gazebo, "Model structure and requirements"; Model Migration Guide, step 5.
"""

import posixpath
from collections.abc import Iterator

from checker.model.paperwork import ModelConfig
from checker.package.package import Package
from checker.paperwork import Paperwork
from checker.rule import (
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)


@rule("PKG004", "incomplete-model-config", Severity.ERROR)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Look up the model file, and list what is not stated."""
    if reason := paperwork.unread("model.config"):
        yield unchecked(reason)
    config = paperwork.config
    if config is None:
        return
    if not config.sdf:
        yield finding(config, "model.config names no model file: <sdf> is missing", key="sdf")
    yield from _lost(package, config)
    if missing := list(_missing(config)):
        words = f"{', '.join(missing[:-1])} and {missing[-1]}" if missing[1:] else missing[0]
        yield finding(
            config, f"model.config has no {words}", severity=Severity.WARNING, key="missing"
        )


def _lost(package: Package, config: ModelConfig) -> Iterator[Finding]:
    for entry in config.sdf:
        path = posixpath.normpath(entry.file.value)
        found = package.resolve(path) if entry.file.value else None
        if found is not None and found.is_file:
            continue
        alike = [other for other in package.index.similar(path) if other != path]
        yield finding(
            entry.file,
            f"model.config names {entry.file.value or 'no file'}, which does not exist"
            + (f"; there is {alike[0]}" if alike else ""),
            fix=replace_text(entry.file, alike[0], Safety.UNSAFE) if alike else None,
        )


def _missing(config: ModelConfig) -> Iterator[str]:
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
    {"model.config": f"{_START}<name>Rover</name><sdf>model.sdf</sdf></model>"},
    {"model.config": f"<model>{_REST}<sdf>Model.sdf</sdf></model>  <!-- ^ PKG004 -->"},
]
