"""Names that may be written into Ruby, XML and launch files as they are."""

from __future__ import annotations

import re

from lxml import etree

from checker.migrate.wishes import NotMigrated

_SAFE = re.compile(r"[\w.:+-]{1,200}")
_NAMED = ("link", "joint", "sensor")


def check_names(tree: etree._Element) -> None:
    """Look at the names of a model that go into other files.

    Ruby would run what stands in `#{…}`, roslaunch replaces `$(…)` and parts `args` at blanks.

    Raises:
        NotMigrated: A name has other characters than letters, digits and `_ . : + -`.
    """
    for tag in _NAMED:
        for element in tree.iter(tag):
            name = element.get("name") or ""
            if _SAFE.fullmatch(name) is None:
                raise NotMigrated(
                    f"{tag} {name[:80]!r} is a name that launch files cannot contain; expected 1 "
                    "to 200 letters, digits and _ . : + -"
                )
