"""Names and values that depend on a thing without naming it."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from checker.editor.names.mention import Mention, NameKind
from checker.editor.names.readers.topics import DERIVED, info_topic, own_part
from checker.editor.names.rename.request import Rename, place_of

_LAUNCH = ("launch", "python", "yaml")


def dependent(rename: Rename) -> str:
    """Return what would lose its name or value with the old name; empty for nothing."""
    if rename.kind is NameKind.TOPIC:
        return next(_beside_topic(rename), "")
    if rename.kind is NameKind.ARGUMENT:
        return next(_handed_on(rename), "")
    return ""


def _beside_topic(rename: Rename) -> Iterator[str]:
    """Yield the mentions of the camera_info of a topic, which would move along."""
    stated = {it.name for it in rename.index.mentions if it.is_definition}
    for name in rename.names:
        old, new = info_topic(name), info_topic(rename.topic_after(name))
        if old == new or own_part(name) == DERIVED or old in stated:
            continue
        for path, file in rename.index.files.items():
            for it in file.names:
                if NameKind.TOPIC in it.kinds and it.name == old:
                    shown = place_of(path, file, it)
                    yield f"{shown} names {old!r}, which moves along with the topic"


def _handed_on(rename: Rename) -> Iterator[str]:
    """Yield which launch file has the argument from the one that includes it, unsaid.

    A launch file of ROS 2 passes on its arguments; one of ROS 1 where `pass_all_args` states it.
    """
    index = rename.index
    for it in rename.mentions:
        file = index.files[it.path]
        text = file.source.text
        if not it.is_definition or file.format not in _LAUNCH:
            continue
        if it.path.endswith(".launch") and "pass_all_args" not in text:
            continue
        for other in _declared(rename):
            named = other.scope != it.scope and posixpath.basename(other.path) in text
            if named and all(mention.path != it.path for mention in index.mentions_of_same(other)):
                yield (
                    f"{it.path} includes {other.path}, which also declares {rename.old!r} and "
                    "takes its value from there"
                )


def _declared(rename: Rename) -> Iterator[Mention]:
    """Yield all declarations of the old name in launch files."""
    files = rename.index.files
    for it in rename.index.mentions:
        is_named = it.is_definition and it.kind is rename.kind and it.name == rename.old
        if is_named and files[it.path].format in _LAUNCH:
            yield it
