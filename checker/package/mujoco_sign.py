"""The version of MuJoCo that the files around a model require."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.package.files_above import files_around

if TYPE_CHECKING:
    from checker.package.package import Package

_FILES = re.compile(
    r"\A(?:\.\./)*(?:requirements[\w.-]*\.txt|pyproject\.toml|setup\.(?:py|cfg)|pixi\.toml"
    r"|environment[\w.-]*\.ya?ml|readme[\w.-]*|dockerfile)\Z"
)
_PINNED = re.compile(r"\bmujoco\s{0,3}(?:==|~=|<=|<|=)\s{0,3}[\"']?v?(\d+(?:\.\d+){0,2})")
_OF_VERSION_2 = re.compile(r"\bmujoco(?:[-_]py|\s?(?:1\.50|131|150|200|210))\b", re.IGNORECASE)


class MujocoSign(Record):
    """A version and what states it.

    Attributes:
        version: The version, such as `3.2.3`; `2.1` for mujoco-py, which knows no later one.
        words: The place and the text: `requirements.txt:3 has mujoco==3.2.3`.
    """

    version: str
    words: str


def mujoco_sign(package: Package) -> MujocoSign | None:
    """Return the version of MuJoCo that requirements or a README around a package state."""
    for source in files_around(package, _FILES):
        for pattern, old in ((_PINNED, ""), (_OF_VERSION_2, "2.1")):
            if found := pattern.search(source.text):
                stated = f"{source.where(found.start())} has {found[0].strip()}"
                return MujocoSign(old or found[1], stated)
    return None


def numbers_of(version: str) -> tuple[int, ...]:
    """Return the numbers of a version, to compare it with others."""
    return tuple(int(number) for number in re.findall(r"\d+", version)[:3])
