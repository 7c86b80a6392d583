"""A library in the package that Gazebo on the target machine cannot load.

Gazebo refuses to load a plugin built for another processor, or for another major version of Gazebo,
or the plugin crashes the server. Outside of submissions, only libraries that a model or a world
names are judged: others may be those of a driver, whose installer chooses the right one.

Fix: build the library on the target system, against the libraries of the target release.
Source: header and dynamic section of the ELF file. None of the accepted packages that we checked
ships a library.
"""

import re
import struct
from collections.abc import Iterator

from checker.base.files import NotReadable
from checker.finding import Place
from checker.model.plugin_host import PluginHost
from checker.model.plugin_library import library_stem, release_major
from checker.package.package import Package
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.binary_headers import SharedLibrary, read_shared_library

_SIMULATOR = re.compile(r"lib(?P<name>ignition-gazebo|gz-sim)(?P<major>\d{1,4})\b.*")


@rule("PLG009", "incompatible-plugin-library", Severity.ERROR, Concern.INTERFACE)
def check(
    package: Package,
    host: PluginHost | None,
    context: Context,
    *,
    machine: str = "x64",
    largest: int = 100_000_000,
) -> Findings:
    """Report libraries for another machine or another major version of Gazebo.

    Options:
        machine: Machine for which libraries must be built, as pyelftools names it, such as `x64`,
            `x86` or `AArch64`.
        largest: Size in bytes above which a library is listed as not checked.
    """
    loaded = {library_stem(each.filename.value) for each in host.plugins} if host else set()
    for file in package.index.with_suffix(".so"):
        if not context.is_subt and library_stem(file.path) not in loaded:
            continue
        data = package.read_bytes(file.path, largest)
        if isinstance(data, NotReadable):
            yield unchecked(f"{file.path} {data.reason}")
            continue
        library = read_shared_library(data)
        place = Place(file.path)
        if library is None:
            yield finding(place, f"{file.path} is not a shared library, or is damaged")
            continue
        if library.machine != machine:
            yield finding(place, f"{file.path} is built for {library.machine}, expected {machine}")
        yield from _judge_version(place, library, context.release)


def _judge_version(place: Place, library: SharedLibrary, release: str) -> Iterator[Finding]:
    expected = release_major(release)
    majors = {int(match["major"]) for match in map(_SIMULATOR.match, library.needed) if match}
    if expected is not None and majors - {expected}:
        others = " and ".join(map(str, sorted(majors - {expected})))
        yield finding(
            place, f"{place.file} is built for Gazebo {others}, but the target is {expected}"
        )


def _library(machine: int, needed: bytes) -> str:
    """Make a shared library that is only headers and one needed library."""
    header = struct.pack(
        "<16sHHIQQQIHHHHHH", b"\x7fELF\2\1\1", 3, machine, 1, 0, 64, 0, 0, 64, 56, 2, 64, 0, 0
    )
    load = struct.pack("<IIQQQQQQ", 1, 4, 0, 0, 0, 0x400, 0x400, 8)
    dynamic = struct.pack("<IIQQQQQQ", 2, 4, 0x200, 0x200, 0x200, 0x40, 0x40, 8)
    tags = struct.pack("<8Q", 1, 1, 5, 0x300, 10, 0x40, 0, 0)
    parts = ((header + load + dynamic).ljust(0x200, b"\0"), tags.ljust(0x100, b"\0"))
    return (b"".join(parts) + b"\0" + needed.ljust(0xFF, b"\0")).decode("ascii")


_X64, _X86 = 62, 3
_FILE = "plugins/libArm.so"

_LOADED = {"@profile": "gazebo-harmonic", "@fragment": '<plugin filename="Arm" name="acme::Arm"/>'}
_DRIVER = "sdk/lib/x86/libdriver.so"
GOOD = [
    {**_LOADED, _FILE: _library(_X64, b"libm.so.6"), _DRIVER: _library(_X86, b"libm.so.6")},
    {_FILE: _library(_X64, b"libignition-gazebo4.so.4")},
    {_FILE: _library(_X64, b"libstdc++.so.6")},
]
BAD = [
    {**_LOADED, _FILE: _library(_X86, b"libm.so.6"), "@reported": [f"{_FILE}:1"]},
    {_FILE: _library(_X86, b"libm.so.6"), "@reported": [f"{_FILE}:1"]},
    {_FILE: _library(_X64, b"libignition-gazebo2.so.2"), "@reported": [f"{_FILE}:1"]},
    {_FILE: "version https://git-lfs.github.com/spec/v1\n", "@reported": [f"{_FILE}:1"]},
]
