"""Packages that are neither available nor released, and that nothing of the repository brings."""

from __future__ import annotations

import re

from checker.package.files_above import files_above
from checker.package.manifests import Paperwork
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.package.released import distributions_with, is_of_system
from checker.source.text import SourceText

_LISTS = (".gitmodules", ".repos", ".rosinstall")
_BRINGING = re.compile(
    r"(?:\A|/)(?:\.gitmodules|[^/]+\.(?:repos|rosinstall|sh|dockerfile)|dockerfile[^/]*)\Z"
)
"""Files that may bring packages of other repositories."""


def is_nowhere(package: Package, name: str) -> bool:
    """Return whether a package that is named in a repository of several exists nowhere.

    It may come from elsewhere where a file above the packages lists other repositories, or names
    it, and where a package depends on it or starts it. Of a single package nothing is known.

    Args:
        package: A package of the repository.
        name: The name in question.
    """
    every = (package, *package.other_packages)
    if len(every) == 1 or distributions_with(name) or is_of_system(name):
        return False
    if package.named(name) is not None or package.workspace.without_manifest(name):
        return False
    return not (may_be_brought(package, name) or any(_uses(it, name) for it in every))


def may_be_brought(package: Package, name: str) -> bool:
    """Return whether a file above a package lists other repositories, or names one of its own."""
    above = (text for texts in files_above(package, _BRINGING) for text in texts)
    return any(_brings(it, name) for it in above)


def _brings(source: SourceText, name: str) -> bool:
    """Return whether a file may bring a package: lists give the names of repositories."""
    return source.file.endswith(_LISTS) or has_word(source.text, name)


def _uses(package: Package, name: str) -> bool:
    """Return whether a package depends on another one, or its launch files name that."""
    manifest = Paperwork(package).manifest
    depends = manifest is not None and manifest.depends_on(name)
    return depends or any(has_word(text, name) for text in package.launch_texts.values())
