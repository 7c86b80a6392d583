"""Hostile xacro files end with a clear fault, within their limits, and read nothing outside."""

from __future__ import annotations

import json
import os
from pathlib import Path
from time import monotonic

import pytest

from checker.mesh.apart import Ended, apart
from checker.model.urdf.files import XacroFault, XacroFaultKind
from checker.xacro import guard
from tests.urdf.conftest import NAME, Describe, robot

FILE = f"{NAME}/urdf/acme.urdf.xacro"
LINK = '<link name="a"/>'
EXPANSION, LIMIT = XacroFaultKind.EXPANSION, XacroFaultKind.LIMIT
DOUBLING = "".join(
    f'<xacro:macro name="m{n}"><a/><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>'
    for n in range(40)
)
BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{chr(98 + n)}: &{chr(98 + n)} [{', '.join(['*' + chr(97 + n)] * 9)}]\n" for n in range(12)
)


def fault(describe: Describe, body: str, **more: str) -> XacroFault:
    files = {f"{NAME}/urdf/{name}.yaml": text for name, text in more.items()}
    (found,) = describe({FILE: robot(LINK + body), **files}).describing.files.faults
    return found


@pytest.mark.parametrize(
    ("body", "kind", "said"),
    [
        ("<a b=\"${__import__('os').system('x')}\"/>", EXPANSION, "__import__"),
        ("<a b=\"${open('/etc/passwd').read()}\"/>", EXPANSION, "'open' is not defined"),
        ('<a b="${().__class__}"/>', EXPANSION, "__class__"),
        ('<a b="${[x.__class__ for x in [1]]}"/>', EXPANSION, "__class__"),
        ('<a b="${(lambda: (yield)).gi_frame}"/>', EXPANSION, ""),
        ("<a b=\"${python.vars(python)['x']}\"/>", EXPANSION, ""),
        ('<a b="$(find ../../..)/x"/>', EXPANSION, "no name of a package"),
        ('<a b="$(env HOME)"/>', XacroFaultKind.ENVIRONMENT, "HOME"),
        ("<a b=\"$(eval env('HOME'))\"/>", EXPANSION, ""),
        ("<a b=\"$(eval open('/etc/passwd'))\"/>", EXPANSION, ""),
        ("<a b=\"$(eval __import__('os'))\"/>", EXPANSION, ""),
        ('<xacro:include filename="/etc/passwd"/>', EXPANSION, "does not exist"),
        ('<xacro:include filename="../../../../etc/passwd"/>', EXPANSION, "does not exist"),
        ("<a b=\"${load_yaml('/etc/passwd')}\"/>", EXPANSION, "/etc/passwd"),
        ('<xacro:include filename="acme.urdf.xacro"/>', LIMIT, "nested too deeply"),
        ('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', LIMIT, "nested too deeply"),
        ('<xacro:property name="p" value="${p}"/><a b="${p}"/>', EXPANSION, "circular"),
        ("<a b=\"${'x' * 10**10}\"/>", LIMIT, "memory"),
        ('<a b="${10**10**10}"/>', LIMIT, "processor time"),
        ('<a b="${[x for x in python.range(10**12) if x == -1]}"/>', LIMIT, "processor time"),
        (f'{DOUBLING}<xacro:macro name="m40"/><xacro:m0/>', LIMIT, ""),
        ("<xacro:nothing/>", EXPANSION, "unknown macro name"),
    ],
)
def test_a_hostile_file_is_a_fault(
    describe: Describe, body: str, kind: XacroFaultKind, said: str
) -> None:
    started = monotonic()
    found = fault(describe, body)
    assert found.kind is kind, found.message
    assert said in found.message
    assert found.span.place().file == "urdf/acme.urdf.xacro"
    assert monotonic() - started < 60


def test_yaml_of_exploding_anchors(describe: Describe) -> None:
    body = "<a b=\"${load_yaml('bomb.yaml')['m']}\"/>"
    assert fault(describe, body, bomb=BOMB).kind is LIMIT


def test_a_file_that_is_no_utf8_is_not_read(describe: Describe) -> None:
    files = describe({FILE: robot(LINK).encode() + b"<!-- \xff -->"}).describing
    assert not files.applicable or files.files.unread


def test_environment_and_folder_do_not_show(describe: Describe) -> None:
    body = '<link name="$(cwd)"/><link name="$(optenv HOME none)"/>'
    robots = describe({FILE: robot(body)}).robots
    assert isinstance(robots, tuple)
    names = " ".join(robots[0].links_by_name)
    assert "none" in names
    assert os.getcwd() not in names  # noqa: PTH109 - as xacro asks for it
    assert str(Path.home()) not in names.replace("/subt", "")


ESCAPES = {
    "open": lambda: open("/etc/hostname").read(),  # noqa: PTH123, SIM115
    "listing": lambda: os.listdir("/"),  # noqa: PTH208
    "program": lambda: os.system("true"),  # noqa: S605
    "fork": lambda: os.posix_spawn("/bin/true", ["true"], {}),
    "environment": lambda: os.environ["PATH"],
    "module": lambda: __import__("this"),
}


@pytest.mark.parametrize("way", ESCAPES)
def test_behind_the_wall_nothing_opens(way: str) -> None:
    def work() -> bytes:
        guard.put_up()
        try:
            ESCAPES[way]()
        except (PermissionError, KeyError) as refusal:
            return json.dumps(f"refused: {refusal}").encode()
        return b'"escaped"'

    result = apart(work, 5)
    assert not isinstance(result, Ended)
    assert json.loads(result).startswith("refused")
