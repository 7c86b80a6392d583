"""What the tests of a user's repository share: git, and this checkout as it stands."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
GOOD = "husky_migration_sensor_config_1"
BROKEN = "broken_rover_sensor_config_1"
_WHO = ("-c", "user.name=Tester", "-c", "user.email=tester@example.org")


def git(folder: Path, *arguments: str) -> str:
    """Run git in a temporary repository and return what it prints."""
    command = ["git", *_WHO, *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout


def commit_all(folder: Path) -> str:
    """Commit everything and return the commit."""
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--no-verify", "--message", "all")
    return git(folder, "rev-parse", "HEAD").strip()


def repository(folder: Path) -> Path:
    folder.mkdir()
    git(folder, "init", "--quiet")
    return folder


def copy_of_this_checkout(folder: Path) -> Path:
    """Make a repository of the files that git tracks or would track here, as they are now."""
    listed = git(ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    made = repository(folder)
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            target = made / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, target, follow_symlinks=False)
    return made
