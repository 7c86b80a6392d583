"""The command line that starts a launch file, as a spawner writes it."""

from __future__ import annotations

from collections.abc import Mapping

from checker.record import record


@record()
class LaunchCommand:
    """`roslaunch --wait P vehicle_topics.launch world_name:=w name:=n`, taken apart.

    Attributes:
        package: The package; empty when the launch file is named by its path.
        file: Name or path of the launch file; empty when the command names none.
        arguments: Args by name; the last one counts.
        options: Words that start with a hyphen.
        leftover: Words that fit nowhere.
    """

    package: str
    file: str
    arguments: Mapping[str, str]
    options: tuple[str, ...] = ()
    leftover: tuple[str, ...] = ()

    @classmethod
    def parse(cls, command: str) -> LaunchCommand | None:
        """Read a command line; None when it does not call roslaunch."""
        program, *words = command.split() or [""]
        if program.rsplit("/", 1)[-1] != "roslaunch":
            return None
        arguments: dict[str, str] = {}
        options, names = [], []
        for word in words:
            name, assigned, value = word.partition(":=")
            if assigned and name:
                arguments[name] = value
            elif word.startswith("-"):
                options.append(word)
            else:
                names.append(word)
        package, file, leftover = _package_and_file(names)
        return cls(package, file, arguments, tuple(options), tuple(leftover))


def _package_and_file(names: list[str]) -> tuple[str, str, list[str]]:
    if names and names[0].endswith((".launch", ".xml")):
        return "", names[0], names[1:]
    if len(names) >= 2:
        return names[0], names[1], names[2:]
    return "", "", names
