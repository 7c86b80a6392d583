"""Profiles: a target and its rules. They are data (`checker/data/profiles.json`)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.resources import table
from checker.finding import Severity
from checker.rule import Context, Rule


class Profile(Record):
    """Rules and target of a profile.

    Attributes:
        rules: Groups (`SDF`) or ids (`SEN001`) that belong to it.
        without: Ids, or groups, left out of them.
        severity: The severities that differ from the rule's own.
    """

    name: str
    title: str
    context: Context
    rules: tuple[str, ...]
    without: tuple[str, ...]
    severity: Mapping[str, Severity]

    def includes(self, rule: Rule) -> bool:
        """Return whether a rule belongs to this profile; groups of other distributions do."""
        if rule.id in self.without or rule.group in self.without:
            return False
        return rule.group in self.rules or rule.id in self.rules or rule.group not in _groups()


@cache
def _groups() -> frozenset[str]:
    names = [name for judge in map(profile, profile_names()) for name in judge.rules]
    return frozenset(name.rstrip("0123456789") for name in names)


def profile_names() -> tuple[str, ...]:
    """Return the names of all profiles; the first is the default."""
    return tuple(name for name in table("profiles") if not name.startswith("_"))


def profile(name: str, distro: str = "", gazebo: str = "") -> Profile:
    """Return a profile.

    Args:
        name: The name of the profile.
        distro: ROS 2 distribution, for a profile that is about one; its own default when empty.
        gazebo: Release of Gazebo in place of that of the distribution.

    Raises:
        KeyError: There is no profile or no distribution of that name.
    """
    entry = table("profiles")[name]
    entry = {**table("profiles").get(entry.get("like", ""), {}), **entry}
    context = Context(name, entry["release"], entry["sdf_version"], entry["reads"])
    if context.release == "classic":
        context = replace(context, distro=distro or entry["distro"] if "distro" in entry else "")
    elif "distro" in entry:
        context = _for_distro(context, distro or entry["distro"], gazebo)
    return Profile(
        name,
        entry["title"],
        replace(context, distro_is_known=bool(distro)),
        tuple(entry["rules"]),
        (*entry["without"], *entry.get("also_without", ())),
        {rule: Severity(level) for rule, level in entry["severity"].items()},
    )


def distro_names() -> tuple[str, ...]:
    """Return the names of the ROS 2 distributions."""
    return tuple(entry["distro"] for entry in table("gazebo_releases")["ros"])


def gazebo_profile(distro: str, gazebo: str = "") -> str:
    """Return the profile of the Gazebo release of a distribution, or the usual one."""
    return f"gazebo-{profile('ros2', distro, gazebo).context.release}"


def _for_distro(context: Context, distro: str, gazebo: str) -> Context:
    """Return the context with the Gazebo release given, or that a distribution comes with."""
    releases = {entry["distro"]: entry["gazebo"] for entry in table("gazebo_releases")["ros"]}
    reads = {it["release"]: it["sdf_version"] for it in table("gazebo_releases")["releases"]}
    release = gazebo or releases[distro]
    return replace(context, distro=distro, release=release, reads=reads[release])
