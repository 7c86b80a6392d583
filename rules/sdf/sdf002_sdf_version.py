"""An SDF version that the target does not use, or that does not exist.

The version defines what each element means: the frame of a pose, the joint types and the sensors. A
parser reads a file by its stated version, converts older ones to its own, and refuses newer ones:
Dome's reads up to 1.7, Fortress's 1.9, Harmonic's 1.11, Ionic's and Jetty's 1.12. SubT requires
1.6; another version that Dome reads is a warning. If `model.config` states another version than the
model file, tools that choose by it choose the wrong file; with one file there is nothing to choose,
and this is an info outside SubT.

Fix: write a version that the target reads, for the SubT simulator `<sdf version="1.6">`, in
`model.sdf` and in `model.config`, and check the file against that version.
Source: libsdformat, SDF_VERSION of branches sdf10 to sdf16, and Converter.cc; Model Migration
Guide, step 5; SDFormat specification, the attribute `version`.
"""

from collections.abc import Iterator
from posixpath import normpath

from checker.formats.sdf.document import SdfDocument, parse_version
from checker.formats.sdf.schema import VERSIONS
from checker.package.manifests import Paperwork, SdfEntry
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.text import Located

OLDER = ("1.0", "1.2", "1.3")
"""Versions that exist, but whose elements are not in the tables."""


@rule("SDF002", "sdf-version", Severity.ERROR, Concern.PORTABILITY)
def check(sdf: SdfDocument, paperwork: Paperwork, context: Context) -> Findings:
    """Report versions that differ from the target's, from one another, or that do not exist."""
    if sdf.root.tag != "sdf":
        return  # SDF005 says so.
    written = sdf.root.attribute("version")
    version = Located("", sdf.root.span, stated=False) if written is None else written
    if version.value.strip() in OLDER:
        yield unchecked(f"the checker does not know the elements of SDF {version.value.strip()}")
    yield from _of_model(version, context)
    expected = context.sdf_version or version.value.strip()
    config = paperwork.config
    entries = config.sdf if config is not None and expected else ()
    is_choice = len(entries) > 1 or context.profile == "subt"
    for entry in entries:
        if normpath(entry.file.value) == sdf.document.source.file:
            yield from _of_config(entry, expected, is_choice)


def _of_model(version: Located[str], context: Context) -> Iterator[Finding]:
    expected = context.sdf_version
    if not version.value.strip():
        yield finding(
            version, f"<sdf> states no version{f', expected {expected}' if expected else ''}"
        )
    elif version.value.strip() not in (*VERSIONS, *OLDER):
        yield finding(
            version,
            f"SDF version {version.value!r} does not exist, expected {expected or '1.4 to 1.12'}",
        )
    elif _is_refused(version.value, context) or (expected and version.value.strip() != expected):
        wanted = expected or f"{context.reads} or older, which {context.release.capitalize()} reads"
        yield finding(
            version,
            f"the model is written in SDF {version.value.strip()}, expected {wanted}",
            severity=None if _is_refused(version.value, context) else Severity.WARNING,
        )


def _is_refused(version: str, context: Context) -> bool:
    """Return whether the target's parser is older than a file."""
    stated, newest = parse_version(version), parse_version(context.reads)
    return stated is None or newest is None or stated > newest


def _of_config(entry: SdfEntry, expected: str, is_choice: bool) -> Iterator[Finding]:
    written = entry.version.value.strip()
    if written == expected:
        return
    state = f"states SDF {written}" if written else "states no SDF version"
    yield finding(
        entry.version,
        f"model.config {state} for {entry.file.value}, expected {expected}",
        severity=Severity.WARNING if is_choice else Severity.INFO,
        fix=replace_text(entry.version, expected) if written else None,
    )


def _config(version: str) -> str:
    return f"<model>\n<name>x</name>\n<sdf{version}\n</model>\n"


def _model(version: str, mark: str = "") -> str:
    return f'''<sdf version="{version}">{mark}
  <model name="rover"><link name="base_link"/></model>
</sdf>
'''


_MARK = "  <!-- ^ SDF002 -->"
GOOD = [
    '<sdf version="1.6"><model name="rover"><link name="base_link"/></model></sdf>',
    {"model.config": _config(' version="1.6">model.sdf</sdf>')},
    {"@profile": "gazebo-harmonic", "model.config": None, "model.sdf": _model("1.10")},
]
BAD = [
    _model("1.7", _MARK),
    """
<sdf>  <!-- ^ SDF002 -->
  <model name="rover"><link name="base_link"/></model>
</sdf>
""",
    {"model.config": _config(' version="1.5">model.sdf</sdf>  <!-- ^ SDF002 -->')},
    {"@profile": "gazebo-fortress", "model.config": None, "model.sdf": _model("1.10", _MARK)},
]
