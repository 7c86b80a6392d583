"""What the source's package.xml says, for the paperwork of the new package."""

from __future__ import annotations

from checker.migrate.source import Source
from checker.record import record

NO_NAME, NO_EMAIL, NO_LICENSE = "TODO", "todo@example.org", "TODO"


@record()
class Papers:
    """Who made the robot, and under which terms.

    Attributes:
        name: Of the maintainer.
        email: Of the maintainer.
        license: Of the package.
        open_points: What the author has to fill in.
    """

    name: str
    email: str
    license: str
    open_points: tuple[str, ...]


def papers_of(source: Source) -> Papers:
    """Return what is known; what is not stands as TODO."""
    manifest = source.manifest
    people = (*manifest.maintainers, *manifest.authors) if manifest is not None else ()
    person = next((each for each in people if each.name.value and each.email.value), None)
    license = next((each.value for each in manifest.licenses if each.value), "") if manifest else ""
    open_points = []
    if person is None:
        open_points.append("the maintainer, with email (package.xml, model.config)")
    if not license or license.upper() == NO_LICENSE:
        open_points.append("the license (package.xml)")
    return Papers(
        _one_line(person.name.value) if person else NO_NAME,
        _one_line(person.email.value) if person else NO_EMAIL,
        _one_line(license) or NO_LICENSE,
        tuple(open_points),
    )


def _one_line(text: str) -> str:
    """Return a text that stays in its line of the sheet."""
    return " ".join(text.split())
