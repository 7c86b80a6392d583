"""The schema's type of an element by the tags around it, though the text may not parse."""

from __future__ import annotations

from collections.abc import Sequence

from checker.formats.sdf.schema import VERSIONS, ElementType, sdf_root


def schema_type(tags: Sequence[str], version: str) -> ElementType | None:
    """Return the type of an element of SDF; None for one that has no place there.

    Args:
        tags: The tags from `sdf` down to it.
        version: SDF version. A newer one counts where it does not know the element.
    """
    later = VERSIONS[VERSIONS.index(version) + 1 :] if version in VERSIONS else ()
    found = (_followed(tags, it) for it in (version, *later[-1:]))
    return next((kind for kind in found if kind is not None), None)


def _followed(tags: Sequence[str], version: str) -> ElementType | None:
    kind: ElementType | None = sdf_root(version)
    for tag in tags[1:]:
        if kind is None or kind.free:
            return None
        kind = kind.children.get(tag)
    return kind
