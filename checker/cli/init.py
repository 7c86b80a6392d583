"""`subt-check init`: writes missing files, overwrites none, and prints what it did."""

from __future__ import annotations

import argparse
import os
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from pathlib import Path
from textwrap import indent
from typing import Any

from checker.base.errors import CheckerError, UnreadableInput
from checker.base.files import NotReadable, read_bytes
from checker.base.output import EXIT_CLEAN, show
from checker.base.record import Record
from checker.base.resources import templates
from checker.base.words import plain
from checker.cli.arguments import PROFILES
from checker.package.inputs import open_input
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.target import usual_profile
from checker.settings import FILE_NAME, find_settings, folders_above

# Adds the hook to a `.pre-commit-config.yaml` and leaves every other character as it is.


ID = "subt-check"
NEW_FILE = "repos:\n"


def hook_entry() -> str:
    """Return the entry for the list `repos`."""
    return templates("init").joinpath("hook.yaml").read_text("utf-8")


def has_hook(text: str) -> bool:
    """Return whether a configuration runs the hook already, wherever it takes it from."""
    content = _loaded(text)
    repositories = content.get("repos") if isinstance(content, dict) else None
    hooks = [
        hook for mapping in _mappings(repositories) for hook in _mappings(mapping.get("hooks"))
    ]
    return any(hook.get("id") == ID for hook in hooks)


def with_hook(text: str) -> str | None:
    """Return a configuration with the hook behind the others.

    None if it cannot be added as text with certainty: the result is read again, and must contain
    what was there before and the hook.
    """
    before = _loaded(text)
    place = _end_of_repositories(text)
    if place is None or not isinstance(before, dict) or not isinstance(before.get("repos"), list):
        return None
    end, column = place
    head = _without_trailing_comments(text[:end])
    line_end = "\r\n" if "\r\n" in text else "\n"
    entry = indent(hook_entry(), " " * column).replace("\n", line_end)
    joint = "" if head.endswith("\n") else line_end
    after = head + joint + entry + text[len(head) :]
    wanted = {**before, "repos": [*before["repos"], *_loaded(hook_entry())]}
    return after if _loaded(after) == wanted else None


def _mappings(value: object) -> list[dict[Any, Any]]:
    return [entry for entry in value if isinstance(entry, dict)] if isinstance(value, list) else []


def _loaded(text: str) -> Any:
    """Return the content of YAML without aliases, by which a short text can mean a huge one."""
    import yaml

    try:
        if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(text, yaml.SafeLoader)):
            return None
        return yaml.safe_load(text)
    except (yaml.YAMLError, ValueError, RecursionError):
        return None


def _end_of_repositories(text: str) -> tuple[int, int] | None:
    """Return where the block list `repos` ends, and the column of its dashes."""
    import yaml

    try:
        root = yaml.compose(text, yaml.SafeLoader)
    except (yaml.YAMLError, ValueError, RecursionError):
        return None
    for key, value in root.value if isinstance(root, yaml.MappingNode) else ():
        if key.value == "repos" and isinstance(value, yaml.SequenceNode) and not value.flow_style:
            return value.end_mark.index, value.start_mark.column
    return None


def _without_trailing_comments(text: str) -> str:
    """Cut blank lines and comments off an end: they belong to what follows."""
    lines = text.splitlines(keepends=True)
    while lines and (not lines[-1].strip() or lines[-1].lstrip().startswith("#")):
        lines.pop()
    return "".join(lines)


# Guesses what the packages of a folder are made for.


_LOOKED_AT = 100
"""Packages; more of them give no new information."""
_WITHOUT_ROBOT = (PackageKind.PLUGIN, PackageKind.UNKNOWN)


class Guess(Record):
    """A profile, and the reason for it.

    Attributes:
        profile: The guessed profile; empty if there is none or more than one.
        reason: A part of a sentence; contains no text of a user.
    """

    profile: str
    reason: str


def guessed_profile(folder: Path) -> Guess:
    """Return the profile that suits all packages of a folder."""
    try:
        with open_input(folder) as opened:
            profiles = Counter(filter(None, map(_profile_of, islice(opened.packages, _LOOKED_AT))))
    except UnreadableInput:
        profiles = Counter()
    counted = ", ".join(
        f"{number} {'package' if number == 1 else 'packages'} for {profile}"
        for profile, number in sorted(profiles.items())
    )
    if len(profiles) == 1:
        return Guess(next(iter(profiles)), counted)
    if profiles:
        return Guess("", f"{counted}; each is checked with the profile that suits it")
    return Guess("", "nothing: there is no robot yet")


def _profile_of(package: Package) -> str:
    """Return the profile that suits a package; empty for one that contains no robot."""
    return "" if package.kind in _WITHOUT_ROBOT else usual_profile(package)


HOOKS_FILE = ".pre-commit-config.yaml"
_SIZE_LIMIT = 1_000_000


def init(path: Path) -> str:
    """Write settings for the packages in a folder, and a hook for the repository around it.

    Returns:
        What was done, and what was left as it is, in lines.

    Raises:
        CheckerError: The folder is none, or cannot be written to.
        InvalidSettings: There are settings that cannot be read.
    """
    folder = path.resolve()
    if not folder.is_dir():
        raise CheckerError(f"{path} is not a folder; give the folder that contains the packages")
    try:
        lines = [*_settings(folder), *_hook(folder)]
    except OSError as error:
        raise CheckerError(f"{error.filename} cannot be written: {error.strerror}") from None
    return "".join(f"{line}\n" for line in lines)


def _settings(folder: Path) -> Iterator[str]:
    known = find_settings(folders_above(folder)).source
    if known is not None:
        yield f"{plain(str(known))} already exists and is not changed"
        return
    target = folder / FILE_NAME
    if os.path.lexists(target):
        yield f"{plain(str(target))} is not changed: it is not a settings file"
        return
    from jinja2 import StrictUndefined, Template

    guess = guessed_profile(folder)
    source = templates("init").joinpath(f"{FILE_NAME}.j2").read_text("utf-8")
    template = Template(source, undefined=StrictUndefined, keep_trailing_newline=True)
    _create(target, template.render(profile=guess.profile, reason=guess.reason, profiles=PROFILES))
    profile = f"profile {guess.profile}" if guess.profile else "no profile"
    yield f"wrote {plain(str(target))}: {profile} ({guess.reason})"


def _hook(folder: Path) -> Iterator[str]:
    root = next((parent for parent in folders_above(folder) if (parent / ".git").exists()), None)
    if root is None:
        yield f"added no hook: {plain(str(folder))} is not in a git repository"
        return
    file = root / HOOKS_FILE
    if not os.path.lexists(file):
        _create(file, NEW_FILE + indent(hook_entry(), "  "))
        yield f"wrote {plain(str(file))} with the hook {ID}; `pre-commit install` starts it"
    else:
        yield from _hook_into(file)


def _hook_into(file: Path) -> Iterator[str]:
    data = read_bytes(file, file.name, _SIZE_LIMIT)
    reason = data.reason if isinstance(data, NotReadable) else ""
    text = _decoded(data) if isinstance(data, bytes) else None
    if text is not None and has_hook(text):
        yield f"{plain(str(file))} already has the hook {ID} and is not changed"
        return
    after = with_hook(text) if text is not None else None
    if after is None:
        reason = reason or "has a form to which the hook cannot be added safely"
        yield f"added no hook: {plain(str(file))} {reason}; add this to its list `repos`:"
        yield hook_entry().rstrip()
        return
    _replace(file, after)
    yield f"added the hook {ID} to {plain(str(file))}; `pre-commit install` starts it"


def _decoded(data: bytes) -> str | None:
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def _create(file: Path, text: str) -> None:
    """Write a file that is not there yet, nor a link."""
    with file.open("x", encoding="utf-8") as stream:
        stream.write(text)


def _replace(file: Path, text: str) -> None:
    """Write a whole file or nothing."""
    with tempfile.NamedTemporaryFile(dir=file.parent, prefix=file.name, delete=False) as new:
        try:
            new.write(text.encode())
            new.close()
            Path(new.name).chmod(file.stat().st_mode & 0o7777)
            Path(new.name).replace(file)
        except OSError:
            with suppress(OSError):
                Path(new.name).unlink()
            raise


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    folder = "folder of the packages (default: the current one)"
    parser.add_argument("path", metavar="FOLDER", nargs="?", default=".", help=folder)


def run(options: argparse.Namespace) -> int:
    """Write what a repository needs to be checked."""
    show(init(Path(options.path)))
    return EXIT_CLEAN
