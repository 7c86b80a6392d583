"""Hostile xacro files end with a clear fault, within their limits, and read nothing outside."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from checker.base.forked_work import run_in_fork
from checker.base.parts import NotAvailable, WorkerFailed
from checker.formats.xacro import worker
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.model.robot import Robot
from checker.robots.urdf_files import UrdfFiles
from tests.urdf.conftest import NAME, Describe, robot

FILE = f"{NAME}/urdf/acme.urdf.xacro"
LINK = '<link name="a"/>'
EXPANSION, LIMIT = XacroFaultKind.EXPANSION, XacroFaultKind.LIMIT
RECURSION = XacroFaultKind.RECURSION
DOUBLING = "".join(
    f'<xacro:macro name="m{n}"><a/><xacro:m{n + 1}/><xacro:m{n + 1}/></xacro:macro>'
    for n in range(40)
)
BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{chr(98 + n)}: &{chr(98 + n)} [{', '.join(['*' + chr(97 + n)] * 9)}]\n" for n in range(12)
)
NESTED = "".join(
    f'<xacro:property name="p{n + 1}" value="${{[p{n}, p{n}]}}"/>' for n in range(40)
).join(('<xacro:property name="p0" value="${[1, 1]}"/>', '<a b="${p40}"/>'))
LONG = (
    '<xacro:property name="p" value="${\'x\' * 10**6}"/>'
    f'<xacro:property name="q" value="{"${p}" * 99}"/><a b="${{q}}"/>'
)
STEPS = '<a b="${len([x for x in python.range(30000)])}"/>' * 99


def fault(describe: Describe, body: str, **more: str) -> XacroFault:
    files = {f"{NAME}/urdf/{name}.yaml": text for name, text in more.items()}
    (found,) = describe({FILE: robot(LINK + body), **files}).one(UrdfFiles).faults
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "kind", "said"),
    [
        ("<a b=\"${open('/etc/passwd').read()}\"/>", EXPANSION, "'open' is not defined"),
        ('<a b="$(find ../../..)/x"/>', EXPANSION, "is not a package name"),
        ('<a b="$(env HOME)"/>', XacroFaultKind.ENVIRONMENT, "HOME"),
        ("<a b=\"$(eval env('HOME'))\"/>", EXPANSION, ""),
        ("<a b=\"$(eval open('/etc/passwd'))\"/>", EXPANSION, ""),
        ("<a b=\"$(eval __import__('os'))\"/>", EXPANSION, ""),
        ('<xacro:include filename="/etc/passwd"/>', EXPANSION, "does not exist"),
        ('<xacro:include filename="../../../../etc/passwd"/>', EXPANSION, "does not exist"),
        ("<a b=\"${load_yaml('/etc/passwd')}\"/>", EXPANSION, "/etc/passwd"),
        ('<xacro:include filename="acme.urdf.xacro"/>', RECURSION, "nested too deeply"),
        ('<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>', RECURSION, "too deeply"),
        ('<xacro:property name="p" value="${p}"/><a b="${p}"/>', EXPANSION, "circular"),
        ("<a b=\"${'x' * 10**10}\"/>", LIMIT, "'x' * 10**10' takes more than 100000 steps"),
        ('<a b="${10**10**10}"/>', LIMIT, "a whole number of more than 4096 bits"),
        ('<a b="${[x for x in python.range(10**12) if x == -1]}"/>', LIMIT, "100000 steps"),
        ("<a b=\"${'%999999999d' % 1}\"/>", LIMIT, "more than 1000 characters"),
        ("<a b=\"${load_yaml('bomb.yaml')}\"/>", EXPANSION, "bomb.yaml"),
        (f'<a b="${{{"-" * 9_000}1}}"/>', LIMIT, "nested"),
        (NESTED, LIMIT, "steps"),
        (LONG, LIMIT, "characters"),
        (STEPS, LIMIT, "3000000 steps with those before it"),
        (f'{DOUBLING}<xacro:macro name="m40"/><xacro:m0/>', LIMIT, ""),
        ("<xacro:nothing/>", EXPANSION, "unknown macro name"),
    ],
)
def test_a_hostile_file_is_a_fault(
    describe: Describe, body: str, kind: XacroFaultKind, said: str
) -> None:
    found = fault(describe, body)
    assert found.kind is kind, found.message
    assert said in found.message
    assert found.span.place().file == "urdf/acme.urdf.xacro"


@pytest.mark.parametrize(
    ("expression", "construct"),
    [
        ("__import__('os').system('x')", "the name '__import__'"),
        ("().__class__", "the name '__class__'"),
        ("[x.__class__ for x in [1]]", "the name '__class__'"),
        ("(lambda: (yield)).gi_frame", "yield"),
        ("python.vars(python)['x']", "python as a value"),
        ("python.vars(python.type(1))", "the function type()"),
        ("load_yaml.__globals__", "the name '__globals__'"),
        ("'%*d' % (9, 1)", "the format '%*d'"),
        ("(x for x in [1]).gi_frame", "the attribute .gi_frame of a value of type generator"),
        ("[len][0]([])", "the function len as a value"),
        ("(x := 1)", "an assignment (:=)"),
        ("xacro.root", "the attribute .root of a value of type NameSpace"),
        ("(-1) ** 0.5", "a value of type complex"),
    ],
)
def test_what_is_no_part_of_the_language_is_not_checked(
    describe: Describe, expression: str, construct: str
) -> None:
    files = describe({FILE: robot(f'{LINK}\n<a b="${{{expression}}}"/>')}).one(UrdfFiles)
    assert not files.faults
    (said,) = files.unread
    assert f"expression uses {construct}" in said
    assert f"'{expression}' at urdf/acme.urdf.xacro:3" in said


def test_yaml_of_exploding_anchors(describe: Describe) -> None:
    body = "<a b=\"${load_yaml('bomb.yaml')['m']}\"/>"
    assert fault(describe, body, bomb=BOMB).kind is LIMIT


def test_a_file_that_is_no_utf8_is_not_read(describe: Describe) -> None:
    files = describe({FILE: robot(LINK).encode() + b"<!-- \xff -->"}).one(UrdfFiles)
    assert isinstance(files, NotAvailable) or files.unread


def test_environment_and_folder_do_not_show(describe: Describe) -> None:
    body = '<link name="$(cwd)"/><link name="$(optenv HOME none)"/>'
    robots = describe({FILE: robot(body)}).all(Robot)
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
def test_behind_the_guard_nothing_opens(way: str) -> None:
    def work() -> bytes:
        worker.put_up()
        try:
            ESCAPES[way]()
        except (PermissionError, KeyError) as refusal:
            return json.dumps(f"refused: {refusal}").encode()
        return b'"escaped"'

    result = run_in_fork(work, 5)
    assert not isinstance(result, WorkerFailed)
    assert json.loads(result).startswith("refused")
