"""What names a link, a joint or a frame in the parameters of a plugin."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.base.resources import table
from checker.model.components import Plugin
from checker.source.text import Located

_NAMING = re.compile("joint|link", re.IGNORECASE)


def named_by(plugin: Plugin) -> Iterator[Located[str]]:
    """Yield the texts that may name a part of the robot.

    Of a plugin whose parameters are not known, those that are called after joints or links, and
    names that lead into a nested model.
    """
    known = table("plugin_references")["plugins"].get(plugin.class_name)
    sure = [named for path in known or () for named in plugin.at(path)]
    yield from sure
    places = {named.span.start for named in sure}
    for name, text in _texts(plugin):
        naming = "::" in text.value or (known is None and _NAMING.search(name) is not None)
        if naming and text.span.start not in places:
            yield text


def _texts(plugin: Plugin) -> Iterator[tuple[str, Located[str]]]:
    """Yield all texts and attributes below a plugin with the names they have."""
    for element in plugin.element.descendants():
        if element.text.stated:
            yield element.tag, element.text
        for name in element.attributes:
            attribute = element.attribute(name)
            if attribute is not None:
                yield name, attribute
