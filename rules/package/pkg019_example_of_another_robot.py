"""An example that does not show this robot.

`launch/example.ign` and `worlds/example.sdf` show a reader how to start the robot. A copied example
starts another robot, or an empty world. An example that passes its own folder to the example of
another package shows this robot.

Fix: include `model://<this package>` in the world, or call `spawner` in example.ign.
Source: Model Migration Guide, step 7, final directory structure: `launch/example.ign` and
`worlds/example.sdf`.
"""

import re
from collections.abc import Iterator

from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.submissions import NAME_IN_PATH, blank_xml_comments
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import SourceText, Span

FILES = ("launch/example.ign", "worlds/example.sdf")

_SPAWNS = re.compile(r"\bspawner\b|<spawn\b|\bmodel\.sdf\b")

_OWN_FOLDER = re.compile(r"\b__(?:FILE|dir)__")
_EXAMPLE_OF = re.compile(
    r"\b(?:require|load|require_relative|File\.read|IO\.read|ERB\.new)\b|\brospack\s+find\b"
)
"""Statements that take over the text or the functions of another file."""


@rule("PKG019", "example-of-another-robot", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Look for names of other packages in the examples, and for this robot in one of them."""
    if package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
        return
    sources = [source for path in FILES if isinstance(source := package.read(path), SourceText)]
    base = package.base.package_name if package.base is not None else package.name
    own = {package.name.casefold(), base.casefold()}
    shown = False
    for source in sources:
        text = blank_xml_comments(source.text)
        hands_over = _OWN_FOLDER.search(text) is not None
        names = {
            match.group().casefold()
            for match in NAME_IN_PATH.finditer(text)
            if not (hands_over and _EXAMPLE_OF.search(_line(text, match)))
        }
        shown = shown or (hands_over and _EXAMPLE_OF.search(text) is not None)
        if others := names - own:
            yield from _others(package, source, text, others)
        named = any(name in text.casefold() for name in own)
        shown = shown or named or bool(others) or _SPAWNS.search(text) is not None
    # The world alone proves nothing: example.ign puts most robots into it.
    if not shown and package.exists(FILES[0]):
        files = " and ".join(source.file for source in sources)
        yield finding(sources[0].whole(), f"{package.name} is missing from {files}")


def _line(text: str, match: re.Match[str]) -> str:
    """Return the line around a name."""
    end = text.find("\n", match.end())
    return text[text.rfind("\n", 0, match.start()) + 1 : end if end >= 0 else len(text)]


def _others(package: Package, source: SourceText, text: str, others: set[str]) -> Iterator[Finding]:
    for match in NAME_IN_PATH.finditer(text):
        if match.group().casefold() in others:
            yield finding(
                Span(source, *match.span()),
                f"the example shows {match.group()}, but the package is {package.name}",
                key=match.group(),
            )


def _world(name: str, end: str = "") -> str:
    return f"""<sdf version="1.6"><world name="example"><include>
  <uri>model://{name}</uri>{end}
</include></world></sdf>
"""


_HANDING = """<%
  modelURI = File.expand_path("../", File.dirname(__FILE__))
  base = `rospack find x1_sensor_config_6`.chomp
%>
<%= ERB.new(File.read(base + "/launch/example.ign")).result(binding) %>
"""

GOOD = [
    {"launch/example.ign": None},
    {"worlds/example.sdf": _world("acme_rover_sensor_config_1")},
    {"launch/example.ign": _HANDING},
    {"launch/example.ign": "<ignition><%= spawner(name, uri, 'w', 0, 0, 0, 0, 0, 0) %></ignition>"},
]
BAD = [
    {"worlds/example.sdf": _world("x1_sensor_config_6", "  <!-- ^ PKG019 -->")},
    {"launch/example.ign": "<ignition/>  <!-- ^ PKG019 -->"},
]
