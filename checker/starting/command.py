"""`subt-check init`: writes what is missing, overwrites nothing, and says what it did."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from textwrap import indent

from checker.disk_file import NotReadable, read_bytes
from checker.errors import CheckerError
from checker.report.wording import plain
from checker.resources import templates
from checker.settings import FILE_NAME, find_settings, folders_above
from checker.starting.guess import guessed_profile
from checker.starting.hook import ID, NEW_FILE, has_hook, hook_entry, with_hook

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
    _create(target, template.render(profile=guess.profile, reason=guess.reason))
    profile = f"profile {guess.profile}" if guess.profile else "no profile"
    yield f"wrote {plain(str(target))}: {profile} ({guess.reason})"


def _hook(folder: Path) -> Iterator[str]:
    root = next((each for each in folders_above(folder) if (each / ".git").exists()), None)
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
