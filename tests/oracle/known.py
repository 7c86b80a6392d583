"""Where the checker and libsdformat 12 differ on purpose; docs/oracles.md gives the same list."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Known:
    """A difference with its reason.

    Attributes:
        title: The row's name in docs/oracles.md.
        patterns: What matches the words of the difference, from their beginning.
    """

    title: str
    patterns: tuple[str, ...]


REFUSED_BY_US: Sequence[Known] = (
    Known("versions that do not exist", ("SDF002 ",)),
    Known(
        "numbers followed by other text",
        (r"SDF006 <\w+> contains '", r"SDF006 <\w+> is '?[\w.,+-]*.*', expected a whole number"),
    ),
    Known("values that the specification excludes", (r"SDF006 .* is .*, expected",)),
    Known("infinite moments of inertia", (r"INE002 .* moment of inertia of -?inf ",)),
    Known("two parts of a world with one name", (r"SDF009 <\w+> '.*' has the same name as a <",)),
    Known(
        "frames of parts and axes",
        (r"KIN010 (the inertial|the axis|visual|collision|sensor|light) ",),
    ),
    Known("names that are truth values", (r"KIN\d+ .*'(\w+::)*(true|false)'",)),
    Known("joints in nested models", (r"KIN00[12] joint 'wrist' (has (no )?parent|connects)",)),
    Known(
        "required parts that are not checked",
        ("SDF005 <mesh> lacks <uri>", "SDF005 <use_parent_model_frame> of <axis> is empty"),
    ),
)
"""Errors of ours on files that libsdformat loads."""
REFUSED_BY_THEM: Sequence[Known] = (
    Known("libsdformat ends", ("libsdformat ends with",)),
    Known("models that are not available", ("Unable to find uri",)),
    Known("old axes without direction", ("Error reading element <xyz>",)),
    Known("includes in any place", ("<include> element missing",)),
    Known("colours above 1", ("Error reading element <(ambient|diffuse|specular|emissive)>",)),
    Known(
        "`__model__` as the end of a joint", (r".* name\[(.*::)?__model__\] specified by joint",)
    ),
)
"""Files that libsdformat refuses, and the checker does not, by its first words."""
READ_OTHERWISE: Sequence[Known] = (
    Known("joints that end at a static model", (r"ends of .*, theirs \[.*__model__'",)),
    Known(
        "names that are truth values",
        (r"\w+: ours .*'(true|false)'", r"pose of (.*::)?[01]: "),
    ),
)
"""Robots that both read, and that differ."""


def explained(words: Iterable[str], known: Sequence[Known]) -> list[str]:
    """Return those words that no known difference explains."""
    patterns = [re.compile(pattern) for each in known for pattern in each.patterns]
    return [each for each in words if not any(pattern.match(each) for pattern in patterns)]
