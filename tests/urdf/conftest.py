"""URDF packages of a few files, written where a test wants them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path

import pytest

from checker.engine.subject import Subject
from checker.package.inputs import open_input

HEAD = '<robot name="acme" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
NAME = "acme_description"
_MANIFEST = "<package><name>{}</name></package>"

Describe = Callable[..., Subject]


def robot(body: str) -> str:
    return f"{HEAD}{body}\n</robot>\n"


def write(workspace: Path, files: Mapping[str, str | bytes]) -> Path:
    for path, content in files.items():
        target = workspace / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content if isinstance(content, bytes) else content.encode())
        manifest = workspace / path.split("/", maxsplit=1)[0] / "package.xml"
        manifest.write_text(_MANIFEST.format(manifest.parent.name), "utf-8")
    return workspace / NAME


@pytest.fixture
def describe(tmp_path: Path) -> Iterator[Describe]:
    """Return what opens the package of some files, or one file of it."""
    with ExitStack() as open_things:

        def opened(files: Mapping[str, str | bytes], only: str = "") -> Subject:
            package = write(tmp_path, files)
            found = open_things.enter_context(open_input(package / only if only else package))
            return Subject(found.packages[0])

        yield opened
