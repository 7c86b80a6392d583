"""Names of packages that ROS distributions have released, and keys that rosdep resolves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache, cached_property
from itertools import takewhile
from types import MappingProxyType

from checker.base.resources import table
from checker.base.words import Suggestions


def distributions_with(name: str) -> tuple[str, ...]:
    """Return the ROS distributions that have released a package, ROS 1's Noetic last."""
    return _released().get(name, ())


def is_listed(distro: str) -> bool:
    """Return whether it is known what a distribution has released; of Iron and older it is not."""
    return any(distro in group.split() for group in table("ros_packages")["packages"])


def is_of_system(name: str) -> bool:
    """Return whether rosdep installs a package of the operating system by this name."""
    return name in _system()


_SHORTEST = 8
"""Characters; shorter names are near to many others."""
_PREFIX = 3
"""Characters that are the same: the beginning of a name often identifies the owner of a package."""


class ReleasedNames:
    """Names that a dependency may have in a distribution; misspelt names are looked up in it."""

    def __init__(self, distro: str) -> None:
        self._distro = distro

    @cached_property
    def _suggestions(self) -> Suggestions:
        """Those of one check: their effort is bounded. Most packages need none."""
        own = [name for name, having in _released().items() if self._distro in having]
        return Suggestions(sorted({*own, *_system()}))

    @cached_property
    def _by_words(self) -> Mapping[tuple[str, ...], list[str]]:
        """The packages of the distribution by the words of their names."""
        found: dict[tuple[str, ...], list[str]] = {}
        for name, having in _released().items():
            if self._distro in having:
                found.setdefault(_words(name), []).append(name)
        return found

    def _has(self, name: str) -> bool:
        return self._distro in distributions_with(name) or is_of_system(name)

    def correction_of(self, name: str) -> str | None:
        """Return the name of which another is a misspelling; None if it may be its own.

        Names of packages that are not available are near to others by chance: one letter may be
        wrong, missing, too many or in the place of its neighbour, or `-` and `_` are confused. The
        words may be in another order, and some names are known to be taken for those of packages.
        """
        instead = table("removed_packages")["names"].get(name, {}).get("instead", "")
        if self._has(instead):
            return str(instead)
        for spelled in (name.replace("-", "_"), name.replace("_", "-")):
            if spelled != name and self._has(spelled):
                return spelled
        if len(same := self._by_words.get(_words(name), [])) == 1:
            return same[0]
        near = self._suggestions.correction(name) if len(name) >= _SHORTEST else None
        alike = near is not None and _is_one_slip(name, near)
        return near if alike else None

    def vendor_of(self, name: str) -> str | None:
        """Return the package by which the distribution has a library of another name, if any."""
        vendor = f"{name}_vendor"
        return vendor if self._distro in distributions_with(vendor) else None


def _words(name: str) -> tuple[str, ...]:
    return tuple(sorted(name.split("_")))


def _shared(one: str, other: str) -> int:
    """Return with how many characters two words begin alike."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _is_one_slip(name: str, known: str) -> bool:
    if name[:_PREFIX] != known[:_PREFIX]:
        return False
    begin = _shared(name, known)
    end = _shared(name[begin:][::-1], known[begin:][::-1])
    rest = name[begin : len(name) - end], known[begin : len(known) - end]
    is_swap = len(rest[0]) == 2 and rest[0] == rest[1][::-1]
    return is_swap or max(map(len, rest)) <= 1


def slip_of(name: str, known: Iterable[str]) -> str | None:
    """Return the one of the packages beside a package of which a name is a misspelling.

    Neighbouring letters may be in the wrong order, or one be missing or too many. Packages that lie
    side by side often differ in a digit or in one letter on purpose.
    """
    near = [
        other
        for other in known
        if len(name) >= _SHORTEST and _is_one_slip(name, other)
        if sorted(name) == sorted(other) or len(name) != len(other)
        if [*filter(str.isdigit, name)] == [*filter(str.isdigit, other)]
    ]
    return near[0] if len(near) == 1 else None


@cache
def _released() -> Mapping[str, tuple[str, ...]]:
    groups = table("ros_packages")["packages"].items()
    names = {name: tuple(key.split()) for key, packages in groups for name in packages}
    return MappingProxyType(names)


@cache
def _system() -> frozenset[str]:
    return frozenset(table("ros_packages")["system"])
