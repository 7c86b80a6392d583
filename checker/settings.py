"""Settings: what to check and how strictly, from files and from the command line.

A package's settings are in `subt-check.toml`, or below `[tool.subt-check]` in `pyproject.toml`,
in its own folder or in the nearest folder above that has one.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec import field
from msgspec.structs import replace

from checker.base.errors import InvalidSettings
from checker.base.files import NotReadable
from checker.base.record import Record
from checker.base.words import Suggestions
from checker.finding import Severity
from checker.model.devices.form import problem_of_device, problem_of_match
from checker.package.detected_target import detect_target
from checker.package.index import normal_path
from checker.package.model_target import model_target
from checker.package.package import Package
from checker.package.ros_1_target import ros_1_target
from checker.package.simulator_signs import CLASSIC
from checker.package.target import MODEL, ROS_1, ROS_2, ros_2_package, usual_profile
from checker.rule import Rule
from checker.rulebook.profiles import Profile, distro_names, gazebo_profile, profile_names
from checker.rulebook.profiles import profile as profile_of
from checker.rulebook.suppression.baseline import Baseline, read_baseline
from checker.rulebook.suppression.entries import SettingsEntry, entries_of
from checker.source.text_file import read_text

FILE_NAME = "subt-check.toml"
SHARED_FILE_NAME = "pyproject.toml"
SIZE_LIMIT = 200_000
_LARGEST = 10**300
_DOTTED = re.compile(r"""(?<![\w-])(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){20}""")
"""A key of many parts: reading one takes the square of their number."""
DEFAULT_PROFILE = "subt"
CLASSIC_ROS_2, CLASSIC_MODEL = "ros2-classic", "gazebo-classic"
FORTRESS_MODEL = "gazebo-fortress"
DEVICES_LIMIT = 100


class Settings(Record):
    """Scope and strictness of a check.

    Attributes:
        profile: Name of the profile that judges.
        profile_chosen: Whether the user named it; otherwise what is checked decides.
        select: Rules to run, as `Rule.selectors` names them: of a group or a concern, those of the
            profile. Empty for all of the profile.
        ignore: Rule ids or groups to leave out.
        fail_on: Findings at or above this severity make the exit code 1.
        severity: Severity by rule id, where the user wants another.
        options: Options by rule id.
        source: The file they were read from; None for the defaults.
        commanded: Fields that the command line sets, not a file.
        trial: Whether robots are driven.
        thorough: Whether they are driven again at half the time step, and URDF is read by a second
            library.
        cache: Whether results are kept on disk, and taken from there.
        devices: Sensor devices of the user's, each in the form of `devices.json`.
        display: Whether the report contains the robot in 3D.
        package_path: Folders in which further packages are found.
        xacro_args: Arguments for xacro files, before those that launch files give.
        payload: Mass that an arm is to carry at its end, kg.
        suppress: Findings that do not count.
        baseline: Findings that were there before, which do not count either.
        distro: ROS 2 distribution to judge for; empty for the profile's default.
        gazebo: Release of Gazebo that a package is made for, if it is not that of the distribution.
        target_reason: Reason for the profile or distribution, from the package's content.
    """

    profile: str = DEFAULT_PROFILE
    profile_chosen: bool = False
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    fail_on: Severity = Severity.ERROR
    severity: Mapping[str, Severity] = field(default_factory=dict)
    options: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    source: Path | None = None
    commanded: tuple[str, ...] = ()
    trial: bool = True
    thorough: bool = False
    cache: bool = True
    devices: tuple[Mapping[str, Any], ...] = ()
    display: bool = False
    package_path: tuple[Path, ...] = ()
    xacro_args: Mapping[str, str] = field(default_factory=dict)
    payload: float = 0.0
    suppress: tuple[SettingsEntry, ...] = ()
    baseline: Baseline = field(default_factory=Baseline)
    distro: str = ""
    gazebo: str = ""
    target_reason: str = ""

    def selects(self, rule: Rule) -> bool:
        """Return whether the user selects this rule."""
        chosen = not self.select or _names(self.select, rule)
        return chosen and not _names(self.ignore, rule)

    def names(self, rule: Rule) -> bool:
        """Return whether the user selects this rule itself, not only its group or concern."""
        return any(name in self.select for name in rule.names)

    def with_overrides(self, **changes: Any) -> Settings:
        """Return settings in which those that are not None replace these."""
        wanted = {key: value for key, value in changes.items() if value is not None}
        chosen = self.profile_chosen or "profile" in wanted
        commanded = tuple(sorted({*self.commanded, *wanted}))
        return replace(self, profile_chosen=chosen, commanded=commanded, **wanted)

    def problem(self, name: str, words: str) -> InvalidSettings:
        """Return the fault of a field, with the place where it is set."""
        if name in self.commanded:
            return InvalidSettings(None, f"--{name.replace('_', '-')}: {words}")
        return InvalidSettings(self.source, words)

    def for_package(self, package: Package) -> Settings:
        """Return the settings for what is checked: without a choice, its usual profile counts.

        Models and worlds in a ROS 2 package are judged for the Gazebo of its distribution. What a
        ROS 2 package is made for decides where the user names neither release nor distribution;
        for models in no such package, Gazebo Classic or Fortress where the files around them name
        only that, and Classic where the packages of the workspace are for it alone. Of a package of
        ROS 1, only the report states what it is made for.
        """
        usual = usual_profile(package)
        is_chosen = self.profile_chosen or self.profile != DEFAULT_PROFILE
        if is_chosen and self.profile != ROS_2:
            return self
        wanted = usual if usual == MODEL or not is_chosen else ROS_2
        settings = replace(self, profile=wanted)
        whole = ros_2_package(package) if wanted in (ROS_2, MODEL) else None
        if whole is not None:
            settings = settings._with_package(whole)
        if wanted == ROS_1:
            return replace(settings, target_reason=ros_1_target(package))
        if wanted != MODEL:
            return settings
        in_classic = settings.profile == CLASSIC_ROS_2
        if not self.distro or in_classic:
            gazebo, sign = model_target(package, whole, in_classic=in_classic)
            if sign:
                profile = CLASSIC_MODEL if gazebo == CLASSIC else FORTRESS_MODEL
                return replace(settings, profile=profile, distro="", gazebo="", target_reason=sign)
        profile = CLASSIC_MODEL if in_classic else gazebo_profile(settings.distro, settings.gazebo)
        return replace(settings, profile=profile)

    def _with_package(self, package: Package) -> Settings:
        """Return the settings with the target detected from the content of a ROS 2 package."""
        target = detect_target(package, self.distro)
        profile = CLASSIC_ROS_2 if target.is_classic else self.profile
        reason = target.reason
        if not reason and not target.distro:
            usual = profile_of(ROS_2).context.distro
            reason = f"ROS 2 {usual.capitalize()}, as no other was found: --distro chooses one"
        return replace(
            self,
            profile=profile,
            distro=target.distro,
            gazebo=target.gazebo,
            target_reason=reason,
        )

    @property
    def judge_profile(self) -> Profile:
        """The profile, for the distribution and the release of Gazebo that are set."""
        return profile_of(self.profile, self.distro, self.gazebo)

    @property
    def description(self) -> str:
        """Changes of a settings file, in words; empty for the defaults and the command line."""
        if self.source is None:
            return ""
        changes = [f"profile {self.profile}"]
        changes += [f"distro {self.distro}"] if self.distro else []
        changes += [f"only {', '.join(self.select)}"] if self.select else []
        changes += [f"without {', '.join(self.ignore)}"] if self.ignore else []
        changes += [f"severity of {', '.join(self.severity)}"] if self.severity else []
        changes += [f"options of {', '.join(self.options)}"] if self.options else []
        changes += [f"own devices: {len(self.devices)}"] if self.devices else []
        changes += [f"xacro arguments: {', '.join(self.xacro_args)}"] if self.xacro_args else []
        changes += [f"payload {self.payload:g} kg"] if self.payload else []
        changes += [f"{len(self.suppress)} suppressed with reasons"] if self.suppress else []
        changes += [f"baseline {self.baseline.path.name}"] if self.baseline.path else []
        changes += [] if self.trial else ["without trial"]
        changes += ["thorough"] if self.thorough else []
        return f"{self.source.name} ({'; '.join(changes)})"


def _names(patterns: Sequence[str], rule: Rule) -> bool:
    return any(pattern in rule.selectors for pattern in patterns)


def folders_above(folder: Path, top: Path | None = None) -> Iterator[Path]:
    """Yield a folder and those above it, nearest first.

    Args:
        folder: Links resolved.
        top: The last one; without it, the repository's root or the home folder is.
    """
    for place in (folder, *folder.parents):
        yield place
        if place in (top, _home()) or (top is None and _is_there(place / ".git")):
            return


def _home() -> Path | None:
    try:
        return Path.home().resolve()
    except RuntimeError:  # a user without a home, as in some containers
        return None


def _is_there(path: Path) -> bool:
    try:
        return path.exists()
    except OSError:
        return False


def find_settings(folders: Iterable[Path]) -> Settings:
    """Return the settings of the first folder that has any; else the defaults.

    Raises:
        InvalidSettings: The file is no TOML or holds what settings do not know.
    """
    for folder in folders:
        own = folder / FILE_NAME
        if _is_there(own) and own.is_file():
            return parse_settings(_read_toml(own), own)
        shared = folder / SHARED_FILE_NAME
        if _is_there(shared) and shared.is_file():
            section = _tool_section(_read_toml(shared))
            if section is not None:
                return parse_settings(section, shared)
    return Settings()


def _read_toml(path: Path) -> dict[str, Any]:
    source = read_text(path.resolve(), path.name, SIZE_LIMIT)
    if isinstance(source, NotReadable):
        raise InvalidSettings(path, source.reason)
    if _DOTTED.search(source.text):
        raise InvalidSettings(path, "has a key of more than 20 parts")
    import tomllib

    try:
        return tomllib.loads(source.text)
    except ValueError as error:
        raise InvalidSettings(path, f"is not valid TOML: {error}") from None
    except RecursionError:
        raise InvalidSettings(path, "is nested too deeply") from None


def _tool_section(content: Mapping[str, Any]) -> Any:
    tools = content.get("tool")
    return tools.get("subt-check") if isinstance(tools, dict) else None


_KEYS = {
    "profile": "profile",
    "distro": "distro",
    "select": "select",
    "ignore": "ignore",
    "fail-on": "fail_on",
    "severity": "severity",
    "rules": "options",
    "trial": "trial",
    "thorough": "thorough",
    "devices": "devices",
    "package-path": "package_path",
    "xacro-args": "xacro_args",
    "payload": "payload",
    "suppress": "suppress",
    "baseline": "baseline",
}
"""Keys of the file, and the fields they set."""


def parse_settings(content: object, path: Path) -> Settings:
    """Turn the content of a settings file into settings.

    Raises:
        InvalidSettings: A key is unknown or a value has the wrong type.
    """
    if _is_huge(content):
        raise InvalidSettings(path, "contains a number of more than 300 digits")
    values: dict[str, Any] = {}
    for key, value in _table("tool.subt-check", content, path).items():
        if key not in _KEYS:
            raise InvalidSettings(path, f"unknown key {key!r}{_expected(key, _KEYS)}")
        values[_KEYS[key]] = _convert(key, value, path)
    chosen = "profile" in values
    return replace(Settings(), **values, profile_chosen=chosen, source=path)


def _is_huge(content: object) -> bool:
    """Return whether a number is in it that is too large for a float or for a message."""
    waiting = [content]
    while waiting:
        value = waiting.pop()
        if isinstance(value, dict):
            waiting += value.values()
        elif isinstance(value, list):
            waiting += value
        elif isinstance(value, int) and abs(value) > _LARGEST:
            return True
    return False


def _convert(key: str, value: Any, path: Path) -> Any:
    match key:
        case "profile" | "distro":
            names = profile_names() if key == "profile" else distro_names()
            return _one_of(key, value, names, path)
        case "fail-on":
            return Severity(_one_of(key, value, ("error", "warning"), path))
        case "select" | "ignore":
            if not isinstance(value, list) or not all(isinstance(v, str) for v in value):
                raise InvalidSettings(path, f"{key} is {value!r}, expected a list of rule ids")
            return tuple(value)
        case "trial" | "thorough":
            if not isinstance(value, bool):
                raise InvalidSettings(path, f"{key} is {value!r}, expected true or false")
            return value
        case "devices" | "suppress" | "baseline" | "package-path" | "xacro-args" | "payload":
            return _READERS[key](value, path)
        case _:
            return _by_rule(key, value, path)


def _by_rule(key: str, value: Any, path: Path) -> dict[str, Any]:
    """Read a table of severities, or of options, by rule."""
    if key == "severity":
        levels = [str(level) for level in Severity]
        return {
            rule: Severity(_one_of(f"severity.{rule}", level, levels, path))
            for rule, level in _table(key, value, path).items()
        }
    return {
        rule: _table(f"rules.{rule}", options, path)
        for rule, options in _table(key, value, path).items()
    }


def _devices(value: Any, path: Path) -> tuple[Mapping[str, Any], ...]:
    if not isinstance(value, list) or len(value) > DEVICES_LIMIT:
        problem = f"devices is not a list of at most {DEVICES_LIMIT} tables"
        raise InvalidSettings(path, problem)
    for number, entry in enumerate(value, 1):
        problem = problem_of_device(entry) or problem_of_match(entry["match"])
        if problem:
            raise InvalidSettings(path, f"device {number} {problem}")
    return tuple(value)


def _suppressed(value: Any, path: Path) -> tuple[SettingsEntry, ...]:
    try:
        return entries_of(value)
    except ValueError as error:
        raise InvalidSettings(path, str(error)) from None


def _baseline(value: Any, path: Path) -> Baseline:
    """Read the baseline next to a settings file."""
    return read_baseline(_checked_path("baseline", value, path, "a file"))


def _package_path(value: Any, path: Path) -> tuple[Path, ...]:
    if not isinstance(value, list):
        raise InvalidSettings(path, f"package-path is {value!r}, expected a list of folders")
    folders = tuple(_checked_path("package-path", folder, path, "a folder") for folder in value)
    for folder in folders:
        if not folder.is_dir():
            raise InvalidSettings(
                path, f"package-path names {folder.name!r}, which is not a folder"
            )
    return folders


def _xacro_arguments(value: Any, path: Path) -> dict[str, str]:
    """Read a table of arguments; TOML's own numbers and truth values represent their texts."""
    arguments: dict[str, str] = {}
    for name, given in _table("xacro-args", value, path).items():
        if not isinstance(given, str | int | float):
            raise InvalidSettings(path, f"xacro-args.{name} is not a string, number or truth value")
        arguments[name] = str(given).lower() if isinstance(given, bool) else str(given)
    return arguments


def _payload(value: Any, path: Path) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 <= value < math.inf:
        raise InvalidSettings(path, f"payload is {value!r}, expected a mass in kg")
    return float(value)


def _checked_path(key: str, value: Any, path: Path, kind: str) -> Path:
    """Return the path that settings name: a stranger's may not name what is elsewhere."""
    inside = normal_path(value) if isinstance(value, str) else None
    if inside is None or not _lies_in(path.parent, inside):
        expected = f"expected the path of {kind} in or below the folder of these settings"
        raise InvalidSettings(path, f"{key} is {value!r}, {expected}")
    return path.parent / inside


_READERS: Mapping[str, Callable[[Any, Path], Any]] = {
    "devices": _devices,
    "suppress": _suppressed,
    "baseline": _baseline,
    "package-path": _package_path,
    "xacro-args": _xacro_arguments,
    "payload": _payload,
}


def _lies_in(folder: Path, inside: str) -> bool:
    """Return whether a path stays in a folder; not so one that cannot be followed to its end."""
    try:
        return (folder / inside).resolve().is_relative_to(folder.resolve())
    except (OSError, RuntimeError, ValueError):
        return False


def _one_of(key: str, value: Any, choices: Sequence[str], path: Path) -> str:
    if value not in choices:
        raise InvalidSettings(path, f"{key} is {value!r}{_expected(value, choices)}")
    return str(value)


def _expected(value: object, choices: Iterable[str]) -> str:
    """Return the end of a message: the word that may be meant, else all that are known."""
    known = list(choices)
    word = str(value)[:100].lower().replace("_", "-")
    near = word if word in known else Suggestions(known).closest(word)
    return f"; did you mean {near!r}?" if near else f", expected one of {', '.join(known)}"


def _table(key: str, value: object, path: Path) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InvalidSettings(path, f"{key} is {value!r}, expected a table")
    return value
