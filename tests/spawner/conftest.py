"""Workspaces in memory and on disk, and the real Ruby to compare with."""

import json
import os
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from checker.launch.spawner.reader import Spawner, read_spawner
from checker.source.text import SourceText
from support.real_packages import CORPUS, named_folder, needed_folder


@dataclass
class Workspace:
    """Files by path, in memory."""

    files: dict[str, str] = field(default_factory=dict)
    asked: list[str] = field(default_factory=list)

    def read(self, path):
        self.asked.append(path)
        if path not in self.files:
            return "is not there"
        return SourceText(path, self.files[path])

    def exists(self, path):
        return any(f == path or f.startswith(path + "/") for f in self.files)

    def package_folder(self, name):
        return name if self.exists(name) else None

    def spawner(self, path="robot/launch/spawner.rb") -> Spawner:
        return read_spawner(self, path, SourceText(path, self.files[path]))


@dataclass
class Folder:
    """The packages below a folder."""

    root: Path

    def read(self, path):
        file = self.root / path
        return SourceText(path, file.read_bytes().decode()) if file.is_file() else "is not there"

    def exists(self, path):
        return (self.root / path).exists()

    def package_folder(self, name):
        return name if (self.root / name).is_dir() else None

    def spawner(self, package) -> Spawner:
        path = f"{package}/launch/spawner.rb"
        return read_spawner(self, path, self.read(path))


_RUN = """
require 'json'
job = JSON.parse(STDIN.read)
results = job.map do |file, calls|
  load file
  calls.map do |name, arguments, truth|
    $enableGroundTruth = truth
    begin
      send(name, *arguments)
    rescue Exception => error
      "!#{error.class}"
    end
  end
end
print JSON.generate(results)
"""


@dataclass
class Ruby:
    """Runs the functions of Ruby files with the real Ruby."""

    environment: dict[str, str] = field(repr=False)

    def run(self, jobs):
        """Return one list of results for each (file, [(function, arguments, ground truth)])."""
        done = subprocess.run(
            ["ruby", "-W0", "-e", _RUN],
            input=json.dumps([[str(file), calls] for file, calls in jobs]),
            capture_output=True,
            text=True,
            env=self.environment,
            timeout=120,
            check=True,
        )
        return json.loads(done.stdout)


@pytest.fixture(scope="session")
def corpus() -> Folder:
    return Folder(needed_folder(CORPUS))


@pytest.fixture(scope="session")
def ruby(tmp_path_factory) -> Ruby:
    """The real Ruby, with a stand-in `rospack` that answers from the corpus."""
    if shutil.which("ruby") is None:
        pytest.skip("ruby is not installed")
    folder = tmp_path_factory.mktemp("bin")
    rospack = folder / "rospack"
    root = named_folder(CORPUS) or Path("/nowhere")
    rospack.write_text(f'#!/bin/sh\n[ "$1" = find ] && echo "{root.resolve()}/$2"\n')
    rospack.chmod(0o755)
    path = f"{folder}:{os.environ['PATH']}"
    return Ruby({**os.environ, "PATH": path, "LC_ALL": "C.UTF-8"})


@pytest.fixture
def workspace():
    """Make a workspace of one spawner and, when given, of other files."""

    def make(text, **others):
        files = {"robot/launch/spawner.rb": text}
        return Workspace({**files, **{k.replace("__", "/"): v for k, v in others.items()}})

    return make


@pytest.fixture
def emit(workspace):
    """Call `f` of a Ruby text and return what it emits, or what could not be read."""

    def call(text, *arguments, files=None, **options):
        made = workspace(text)
        made.files.update(files or {})
        return made.spawner().evaluate("f", arguments, **options)

    return call
